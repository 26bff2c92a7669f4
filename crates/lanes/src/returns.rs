//! Where a motion is going that comes back to the same impact after one to four drive periods.
//!
//! Four returns of a motion (velocity, moment) tell about where its limit is (minimal polynomial extrapolation, Cabay and
//! Jackson 1976). From there the lane follows one cycle, whose exact derivative M gives the next guess by Newton's method,
//! until its step is below 1e-7. The multipliers have to be below 0.999. Then:
//!
//! 1. In the norm |P y| with P'P the sum of (M'/g)^k (M/g)^k, g a little above the spectral radius, M contracts by a
//!    rate r < 1 (Stein).
//! 2. In a ball of this norm the next return deviates by M d but for K |d|^2. A [`Certificate`] has K from the law's
//!    constants, and from the Hermite cubic of each window with its error (Birkhoff and Priver 1967) that no motion of the
//!    ball reaches another face of its phase.
//! 3. If the radius is at most r (1 - r) / 2K, the ball is mapped into itself: all its motions make the cycle's crossings
//!    for ever.
//! 4. The lane goes back to the motion's own last return and follows it until a return lies in the ball and all that is not
//!    linear, as it is at the last return of the job, adds up to less than 2e-10 in v/v0 and angle. It goes to that return
//!    at once, to the limit plus M^n d, and follows the last two periods or a few more.

use std::f64::consts::TAU;

use nalgebra::{Matrix2, Vector2};

use super::contraction::{ContractionNorm, spectral_radius};
use super::cycle::Cycle;
use super::law::Constants;
use super::place::{Drive, Passage};

/// Returns that a first guess is made from.
const GUESSED_FROM: usize = 4;
/// What a return may come before or after a drive period, in periods.
const SLIP: f64 = 0.25;
/// Most drive periods from one return to the next; how much closer one has to be that recurs.
const MAX_PERIODS: f64 = 4.0;
const CLOSER: f64 = 0.3;
/// Drive periods before a motion is looked at for the first time, and between looks.
const FIRST: f64 = 28.0;
const PAUSE: f64 = 6.0;
/// How much longer each pause is than the one before.
const LONGER: f64 = 1.5;
/// Drive periods at the end of a job that are gone through as always, and the fewest that are worth a look.
const LAST: f64 = 2.0;
const FEWEST: f64 = 24.0;
/// Differences of velocities are told in units of the velocity, those of times as angles of the drive: the largest one
/// between returns that shows how long they take to come close, and the largest from which their end is guessed.
const NEAR: f64 = 0.3;
const CLOSE: f64 = 0.02;
/// Difference of returns below which the last one is as good a guess as any.
const SETTLED: f64 = 1e-8;
/// Most that Newton's last step may be, and how much less than the one before the others.
const FINAL: f64 = 1e-7;
const SMALLER: f64 = 0.3;
/// Least decay in one return.
const SLOWEST: f64 = 1e-3;
/// Bounds on the error of the limit, and on that of how far from it the motion ends; the latter adds up what is left
/// out in all returns, as if each bent the motion the same way.
const ERROR: f64 = 4e-12;
const MAX_SUM: f64 = 2e-10;
/// Balls that are tried, and how much smaller each is than the one before.
const MAX_BALLS: usize = 8;
const SHRINK: f64 = 0.25;
/// Least norm of a map in the bound on how deviations die out.
const LEAST_RATE: f64 = 0.25;

/// A state just after an impact.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Return {
    pub position: f64,
    pub velocity: f64,
    /// Seconds into the drive period; drive periods left, this one included.
    pub offset: f64,
    pub left: f64,
    /// cos and sin of the drive angle then, if known.
    pub angle: Option<(f64, f64)>,
    pub impacts: f64,
    pub crossings: f64,
    pub phase: f64,
}

impl Return {
    /// The crossing that leads to it, seen from behind.
    fn passage(&self) -> Passage {
        Passage {
            position: self.position,
            velocity: self.velocity,
            velocity_after: self.velocity,
            phase: self.phase as usize,
            left: self.left,
            offset: self.offset,
        }
    }
}

/// The returns of one lane.
#[derive(Debug, Default)]
pub(super) struct Returns {
    per_period: f64,
    stage: Stage,
    /// How many returns there are.
    count: usize,
    /// Drive periods and impacts from one to the next.
    every: f64,
    each: f64,
    /// Drive periods until they are looked at again after nothing was found.
    pause: f64,
    /// The motion's own; the last one of them is the last that is kept.
    own: [Return; GUESSED_FROM],
    /// What all are measured by: a velocity, drive periods left and a moment in them.
    velocity: f64,
    left: f64,
    moment: f64,
    /// The cycle that is tried: its first return, its crossings and its derivatives.
    tried: Return,
    passages: Vec<Passage>,
    cycle: Cycle,
}

/// What is known of where a motion goes.
#[derive(Debug, Clone, Copy, Default)]
enum Stage {
    /// Nothing.
    #[default]
    Open,
    /// A cycle is tried; how far it is from the guess before.
    Trial(f64),
    /// The limit, and what is proven of the motions about it.
    Known(Certificate),
}

/// What holds for all returns in a ball about a limit.
#[derive(Debug, Clone, Copy)]
struct Certificate {
    limit: Vector2<f64>,
    map: Matrix2<f64>,
    norm: ContractionNorm,
    /// Radius of the ball, in the norm.
    radius: f64,
    /// The next return deviates by the linear map's, but for at most curvature times the square of the deviation, in
    /// the norm; the cycle that this holds about lies so far from the limit.
    curvature: f64,
    aside: f64,
}

/// What a lane does after a return.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Turn {
    /// Where it goes on, if not where it is.
    pub to: Option<Return>,
    /// Drive periods left at which its returns are looked at again.
    pub again: f64,
    /// Drive periods that it has leapt over.
    pub leapt: f64,
}

impl Returns {
    /// Those of a lane begin, with so many drive periods left; how many are left when they are looked at first.
    pub fn begin(&mut self, per_period: f64, left: f64) -> f64 {
        self.per_period = per_period;
        (self.every, self.pause) = (1.0, PAUSE);
        self.open(left - FIRST).again
    }

    /// Takes note of a crossing of the cycle that is tried.
    pub fn pass(&mut self, passage: Passage) {
        self.passages.push(passage);
    }

    /// Takes note of a return.
    pub fn note(&mut self, now: Return, laws: &[Constants], drive: &Drive) -> Option<Turn> {
        match self.stage {
            Stage::Known(certificate) => return self.approach(now, &certificate),
            Stage::Trial(most) => {
                if !self.is_complete(&self.tried, &now)? {
                    return self.back();
                }
                let turn = self.refine(&now, most, laws, drive);
                return turn.or_else(|| self.back());
            }
            Stage::Open => {}
        }
        if self.count > 0 {
            let before = self.own[self.count - 1];
            if !self.is_complete(&before, &now)? {
                self.every = self.every % MAX_PERIODS + 1.0;
                return Some(self.pause(now.left));
            }
            self.each = now.impacts - before.impacts;
        }
        self.own[self.count] = now;
        self.count += 1;
        if self.count < GUESSED_FROM {
            return None;
        }
        if now.left < FEWEST * self.every {
            return Some(self.open(f64::NEG_INFINITY));
        }
        let turn = self.guess();
        Some(turn.unwrap_or_else(|| {
            self.every = self.recurs();
            self.pause(now.left)
        }))
    }

    /// Whether a cycle is complete from one impact to another; none if it is still under way.
    fn is_complete(&self, before: &Return, now: &Return) -> Option<bool> {
        let periods = (before.left - now.left) + (now.offset - before.offset) * self.per_period;
        if periods < self.every - SLIP {
            return None;
        }
        let made = now.impacts - before.impacts;
        let same = before.position == now.position && before.phase == now.phase;
        let is_first = self.count == 1 && matches!(self.stage, Stage::Open);
        Some(periods <= self.every + SLIP && same && (is_first || made == self.each))
    }

    /// After how many of these returns the motion comes closest to the first, if it comes much closer than others.
    fn recurs(&self) -> f64 {
        let [first, rest @ ..] = self.points();
        let away = rest.map(|point| (point - first).norm());
        let recurs = match away {
            [one, two, _] if two < CLOSER * one => 2.0,
            [one, _, three] if three < CLOSER * one => 3.0,
            _ => 1.0,
        };
        let every = self.every * recurs;
        if every > MAX_PERIODS { 1.0 } else { every }
    }

    /// True while a cycle is tried.
    pub fn is_trial(&self) -> bool {
        matches!(self.stage, Stage::Trial(_))
    }

    /// True if a cycle is tried that should have come back long ago.
    pub fn is_overdue(&self, left: f64) -> bool {
        self.is_trial() && self.tried.left - left > self.every + 1.0
    }

    /// Where a lane goes on that tries a cycle which leads nowhere.
    pub fn back(&mut self) -> Option<Turn> {
        let to = self.own[GUESSED_FROM - 1];
        self.is_trial().then(|| Turn {
            to: Some(to),
            ..self.pause(to.left)
        })
    }

    /// Looks again after a longer pause than before.
    fn pause(&mut self, left: f64) -> Turn {
        self.pause *= LONGER;
        self.open(left - self.pause)
    }

    /// Looks again later, as if nothing were known.
    fn open(&mut self, again: f64) -> Turn {
        (self.stage, self.count) = (Stage::Open, 0);
        Turn::later(again)
    }

    /// Drive periods to a return, and the return as a point: velocity and drive angle.
    fn point(&self, it: &Return) -> (f64, Vector2<f64>) {
        let periods = (self.left - it.left) + it.offset * self.per_period;
        let number = ((periods - self.moment) / self.every + 0.5) as i64;
        let whole = number as f64 * self.every;
        let point = Vector2::new(it.velocity / self.velocity, TAU * (periods - whole));
        (whole, point)
    }

    fn points(&self) -> [Vector2<f64>; GUESSED_FROM] {
        std::array::from_fn(|index| self.point(&self.own[index]).1)
    }

    /// The return at a point, so many times after the last of the motion's own.
    fn at(&self, point: Vector2<f64>, times: f64) -> Return {
        let after = &self.own[GUESSED_FROM - 1];
        let (number, _) = self.point(after);
        let periods = point.y / TAU;
        let whole = periods.floor();
        Return {
            velocity: point.x * self.velocity,
            offset: (periods - whole) / self.per_period,
            left: self.left - (number + times * self.every + whole),
            angle: None,
            impacts: times.mul_add(self.each, after.impacts),
            crossings: times.mul_add(self.passages.len() as f64, after.crossings),
            ..*after
        }
    }

    /// A first guess from the motion's own returns.
    fn guess(&mut self) -> Option<Turn> {
        let first = &self.own[0];
        (self.velocity, self.left) = (first.velocity, first.left);
        self.moment = first.offset * self.per_period;
        let points = self.points();
        let step = (points[3] - points[2]).norm();
        if step >= NEAR {
            return None;
        }
        let (limit, radius) = extrapolate(&points)?;
        if step > CLOSE {
            let wait = (CLOSE / step).ln() / radius.ln() - (GUESSED_FROM - 1) as f64;
            let left = self.own[GUESSED_FROM - 1].left;
            return Some(self.open(left - wait.max(0.0) * self.every));
        }
        Some(self.set_off(limit, f64::INFINITY))
    }

    /// Tries the cycle from a guess.
    fn set_off(&mut self, guess: Vector2<f64>, step: f64) -> Turn {
        self.tried = self.at(guess, 0.0);
        self.passages.clear();
        self.stage = Stage::Trial(step);
        Turn {
            to: Some(self.tried),
            ..Turn::later(f64::INFINITY)
        }
    }

    /// A step of Newton's method from the cycle that was tried; after the last one, what is proven about it.
    fn refine(
        &mut self,
        now: &Return,
        before: f64,
        laws: &[Constants],
        drive: &Drive,
    ) -> Option<Turn> {
        let velocity = self.velocity;
        let begun = self.tried.passage();
        self.cycle
            .linearise(laws, drive, (begun, &self.passages), velocity)?;
        let map = self.cycle.map;
        let inverse = (Matrix2::identity() - map).try_inverse()?;
        let tried = self.point(&self.tried).1;
        let step = inverse * (self.point(now).1 - tried);
        let limit = tried + step;
        let length = step.norm();
        if length > FINAL || length.is_nan() {
            let goes_on = length < SMALLER * before && limit.x > 0.0;
            return goes_on.then(|| self.set_off(limit, length));
        }
        if spectral_radius(map.trace(), map.determinant()) > 1.0 - SLOWEST {
            return None;
        }
        let norm = ContractionNorm::of_map(&map)?;
        self.cycle.divide(laws, drive)?;
        let aside = norm.length(&step);
        let off = self.points()[GUESSED_FROM - 1] - limit;
        let most = norm.length(&off) + aside;
        let (radius, curvature) = self.ball(&norm, &inverse, most.max(FINAL))?;
        let rate = norm.rate.max(LEAST_RATE);
        if curvature * aside * aside / (1.0 - rate) * norm.spread() > ERROR {
            return (length < SMALLER * before).then(|| self.set_off(limit, length));
        }
        let certificate = Certificate {
            limit,
            map,
            norm,
            radius,
            curvature,
            aside,
        };
        Some(self.leap(&certificate))
    }

    /// The largest ball of those tried, not larger than `most`, whose motions all make the cycle's crossings and are drawn to
    /// the limit, and the curvature in it; none if rounding moves the limit too far.
    fn ball(
        &self,
        norm: &ContractionNorm,
        inverse: &Matrix2<f64>,
        most: f64,
    ) -> Option<(f64, f64)> {
        let rate = norm.rate.max(LEAST_RATE);
        let mut radius = most;
        for _ in 0..MAX_BALLS {
            let ball = norm.from * radius;
            let Some(remainder) = self.cycle.remainder(&ball) else {
                radius *= SHRINK;
                continue;
            };
            if (inverse.abs() * remainder.rounding).norm() > ERROR {
                return None;
            }
            let curvature = norm.largest(&remainder.curvature) / (radius * radius);
            let drawn = 0.5 * rate * (1.0 - rate) / curvature;
            if curvature.is_nan() || radius > drawn {
                radius = 0.9 * drawn;
            } else if self.cycle.is_clear(&ball) {
                return Some((radius, curvature));
            } else {
                radius *= SHRINK;
            }
        }
        None
    }

    /// What a return leads to of a motion whose limit is known.
    fn approach(&mut self, now: Return, certificate: &Certificate) -> Option<Turn> {
        let last = self.own[GUESSED_FROM - 1];
        let same = last.position == now.position && last.phase == now.phase;
        if !same || (self.point(&now).1 - certificate.limit).norm() > NEAR {
            return None;
        }
        self.own[GUESSED_FROM - 1] = now;
        let turn = self.leap(certificate);
        Some(Turn {
            to: turn.to.filter(|to| *to != now),
            ..turn
        })
    }

    /// Goes over all periods but the last at once from the motion's own last return, or waits there until that can be done.
    fn leap(&mut self, certificate: &Certificate) -> Turn {
        let Certificate {
            norm,
            curvature,
            aside,
            ..
        } = certificate;
        let own = self.own[GUESSED_FROM - 1];
        let off = self.point(&own).1 - certificate.limit;
        let rate = norm.rate.max(LEAST_RATE);
        let times = ((own.left - LAST) / self.every).floor();
        let back = |turn| Turn {
            to: Some(own),
            ..turn
        };
        if own.left < FEWEST * self.every {
            return back(self.open(f64::NEG_INFINITY));
        }
        let length = norm.length(&off) + aside;
        // |d_k| <= q rate^k |d_0| with 1/q = 1 - curvature |d_0| / (rate (1 - rate)); what is not linear adds up.
        let q = 1.0 / (1.0 - curvature * length / (rate * (1.0 - rate))).max(0.5);
        let bent = curvature * length * q * (q * length / (1.0 - rate) + 2.0 * times * aside);
        let error = bent * rate.powf(times - 1.0) * norm.spread();
        let excess = ((length + aside) / certificate.radius).max(error / MAX_SUM);
        if excess > 1.0 || excess.is_nan() {
            self.stage = Stage::Known(*certificate);
            let wait = (excess.ln() / -rate.ln()).ceil();
            return back(Turn::later(own.left - (wait * self.every - SLIP)));
        }
        let power = certificate.map.pow(times as u32);
        let to = self.at(certificate.limit + power * off, times);
        self.open(f64::NEG_INFINITY);
        Turn {
            to: Some(to),
            leapt: times * self.every,
            ..Turn::later(f64::NEG_INFINITY)
        }
    }
}

/// The limit of returns and how much closer to it the later ones are (Cabay and Jackson 1976): differences of successive
/// returns obey d'' = trace d' - determinant d.
fn extrapolate(points: &[Vector2<f64>; GUESSED_FROM]) -> Option<(Vector2<f64>, f64)> {
    let [a, b, c] = [0, 1, 2].map(|k| points[k + 1] - points[k]);
    let last = points[GUESSED_FROM - 1];
    if c.norm() < SETTLED {
        return Some((last, 0.0));
    }
    let area = b.perp(&a);
    let (trace, determinant) = match area.abs() > 1e-4 * a.norm() * b.norm() {
        true => (c.perp(&a) / area, c.perp(&b) / area),
        false => (c.dot(&b) / b.norm_squared(), 0.0),
    };
    let radius = spectral_radius(trace, determinant);
    let way = (c * trace - (c + b) * determinant) / (1.0 - trace + determinant);
    let is_like = way.norm() * (1.0 - radius) < 2.0 * c.norm();
    let limit = last + way;
    (radius < 1.0 - SLOWEST && is_like && limit.x > 0.0).then_some((limit, radius))
}

impl Turn {
    /// Goes on as it is until so many drive periods are left.
    fn later(again: f64) -> Self {
        Self {
            to: None,
            again,
            leapt: 0.0,
        }
    }
}
