//! Decides after each return of a motion to the same impact, every one to four drive periods, whether its limit cycle
//! is proven and how many periods can be extrapolated.
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

use super::certificate::{Certificate, find_ball};
use super::contraction_norm::{ContractionNorm, spectral_radius};
use super::cycle::Cycle;
use super::cycle_state::{Drive, Passage};
use super::extrapolate_limit::{MIN_DECAY, RETURNS_PER_GUESS, extrapolate_limit};
use super::law::Constants;

/// Largest difference between the time of a return and a whole number of drive periods, in drive periods.
const MAX_TIME_OFFSET: f64 = 0.25;
/// Most drive periods between two returns.
const MAX_PERIODS: f64 = 4.0;
/// Largest distance of a return from the first one that counts as a recurrence, as a share of the distance of the return
/// next to the first.
const MAX_RECURRENCE_RATIO: f64 = 0.3;
/// Drive periods from the beginning of a job to the first recording of returns.
const PERIODS_BEFORE_RECORDING: f64 = 28.0;
/// Drive periods from a failed attempt to the next recording of returns, before the first growth.
const FIRST_PAUSE_PERIODS: f64 = 6.0;
/// Ratio of the length of each pause to that of the one before.
const PAUSE_GROWTH: f64 = 1.5;
/// Drive periods at the end of a job that are never extrapolated.
const FOLLOWED_LAST_PERIODS: f64 = 2.0;
/// Fewest drive periods left, per period of the cycle, with which their extrapolation is worth a trial.
const MIN_PERIODS_LEFT: f64 = 24.0;
/// Largest distance between two returns from which the number of returns until they are close is predicted; velocities
/// in units of the first return's, times as angles of the drive in rad.
const MAX_PREDICTION_DISTANCE: f64 = 0.3;
/// Largest distance between two returns, in these units, from which their limit is extrapolated.
const MAX_EXTRAPOLATION_DISTANCE: f64 = 0.02;
/// Largest last step of Newton's method, in these units.
const MAX_LAST_STEP: f64 = 1e-7;
/// Largest ratio of a step of Newton's method to the one before with which the trial goes on.
const MAX_STEP_RATIO: f64 = 0.3;

/// The state of a motion just after an impact.
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
    /// The impact that leads to this return, as a crossing from the state after it.
    fn as_passage(&self) -> Passage {
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

/// The recorded returns of one lane and what is known of their limit.
#[derive(Debug, Default)]
pub(super) struct Returns {
    per_period: f64,
    stage: Stage,
    /// Number of returns recorded.
    count: usize,
    /// Drive periods and impacts from one to the next.
    every: f64,
    each: f64,
    /// Drive periods until returns are recorded again after no limit was found.
    pause: f64,
    /// The last returns of the motion itself, not of a trial cycle.
    own: [Return; RETURNS_PER_GUESS],
    /// What all are measured by: a velocity, drive periods left and a moment in them.
    velocity: f64,
    left: f64,
    moment: f64,
    /// The trial cycle: its first return, its crossings and its derivatives.
    tried: Return,
    passages: Vec<Passage>,
    cycle: Cycle,
}

/// What is known of the limit of the returns.
#[derive(Debug, Clone, Copy, Default)]
enum Stage {
    /// Nothing yet.
    #[default]
    Open,
    /// A trial cycle is followed; its distance from the guess before.
    Trial(f64),
    /// The limit cycle, and what is proven of the motions about it.
    Known(Certificate),
}

/// What a lane does after a return.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ReturnDecision {
    /// Where it goes on, if not where it is.
    pub resume_at: Option<Return>,
    /// Drive periods left at which its returns are recorded again.
    pub record_again_at: f64,
    /// Drive periods that are extrapolated.
    pub extrapolated_periods: f64,
}

impl Returns {
    /// Begins with a job of so many drive periods; how many of them are left when returns are recorded first.
    pub fn begin_job(&mut self, per_period: f64, left: f64) -> f64 {
        self.per_period = per_period;
        (self.every, self.pause) = (1.0, FIRST_PAUSE_PERIODS);
        self.forget_returns(left - PERIODS_BEFORE_RECORDING)
            .record_again_at
    }

    /// Records a crossing of the trial cycle.
    pub fn record_crossing(&mut self, passage: Passage) {
        self.passages.push(passage);
    }

    /// Records a return; what the lane does next, if not just to go on.
    pub fn record(
        &mut self,
        now: Return,
        laws: &[Constants],
        drive: &Drive,
    ) -> Option<ReturnDecision> {
        match self.stage {
            Stage::Known(certificate) => return self.approach_limit(now, &certificate),
            Stage::Trial(most) => {
                if !self.is_cycle_complete(&self.tried, &now)? {
                    return self.end_trial();
                }
                let decision = self.refine_trial(&now, most, laws, drive);
                return decision.or_else(|| self.end_trial());
            }
            Stage::Open => {}
        }
        if self.count > 0 {
            let before = self.own[self.count - 1];
            if !self.is_cycle_complete(&before, &now)? {
                self.every = self.every % MAX_PERIODS + 1.0;
                return Some(self.pause_recording(now.left));
            }
            self.each = now.impacts - before.impacts;
        }
        self.own[self.count] = now;
        self.count += 1;
        if self.count < RETURNS_PER_GUESS {
            return None;
        }
        if now.left < MIN_PERIODS_LEFT * self.every {
            return Some(self.forget_returns(f64::NEG_INFINITY));
        }
        let decision = self.guess_limit();
        Some(decision.unwrap_or_else(|| {
            self.every = self.recurrence_period();
            self.pause_recording(now.left)
        }))
    }

    /// Whether a cycle is complete from one impact to another; none if it is still under way.
    fn is_cycle_complete(&self, before: &Return, now: &Return) -> Option<bool> {
        let periods = (before.left - now.left) + (now.offset - before.offset) * self.per_period;
        if periods < self.every - MAX_TIME_OFFSET {
            return None;
        }
        let made = now.impacts - before.impacts;
        let same = before.position == now.position && before.phase == now.phase;
        let is_first = self.count == 1 && matches!(self.stage, Stage::Open);
        Some(periods <= self.every + MAX_TIME_OFFSET && same && (is_first || made == self.each))
    }

    /// Drive periods after which the motion comes much closer to its first return than after others; 1 if none does.
    fn recurrence_period(&self) -> f64 {
        let [first, rest @ ..] = self.own_points();
        let away = rest.map(|point| (point - first).norm());
        let recurs = match away {
            [one, two, _] if two < MAX_RECURRENCE_RATIO * one => 2.0,
            [one, _, three] if three < MAX_RECURRENCE_RATIO * one => 3.0,
            _ => 1.0,
        };
        let every = self.every * recurs;
        if every > MAX_PERIODS { 1.0 } else { every }
    }

    /// True while a trial cycle is followed.
    pub fn is_trial(&self) -> bool {
        matches!(self.stage, Stage::Trial(_))
    }

    /// True if a trial cycle should have come back to its impact long ago.
    pub fn is_trial_overdue(&self, left: f64) -> bool {
        self.is_trial() && self.tried.left - left > self.every + 1.0
    }

    /// Ends a trial that leads nowhere: the lane goes on from the last return of its own motion.
    pub fn end_trial(&mut self) -> Option<ReturnDecision> {
        let to = self.own[RETURNS_PER_GUESS - 1];
        self.is_trial().then(|| ReturnDecision {
            resume_at: Some(to),
            ..self.pause_recording(to.left)
        })
    }

    /// Records again after a longer pause than before.
    fn pause_recording(&mut self, left: f64) -> ReturnDecision {
        self.pause *= PAUSE_GROWTH;
        self.forget_returns(left - self.pause)
    }

    /// Forgets what is known; returns are recorded again when so many periods are left.
    fn forget_returns(&mut self, record_again_at: f64) -> ReturnDecision {
        (self.stage, self.count) = (Stage::Open, 0);
        ReturnDecision::wait(record_again_at)
    }

    /// Whole drive periods up to a return, and the return as a point (velocity, drive angle).
    fn return_point(&self, it: &Return) -> (f64, Vector2<f64>) {
        let periods = (self.left - it.left) + it.offset * self.per_period;
        let number = ((periods - self.moment) / self.every + 0.5) as i64;
        let whole = number as f64 * self.every;
        let point = Vector2::new(it.velocity / self.velocity, TAU * (periods - whole));
        (whole, point)
    }

    fn own_points(&self) -> [Vector2<f64>; RETURNS_PER_GUESS] {
        std::array::from_fn(|index| self.return_point(&self.own[index]).1)
    }

    /// The return at a point (velocity, drive angle), so many returns after the last one of the motion itself.
    fn return_at(&self, point: Vector2<f64>, times: f64) -> Return {
        let after = &self.own[RETURNS_PER_GUESS - 1];
        let (number, _) = self.return_point(after);
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

    /// Extrapolates the limit from the motion's own returns and begins a trial there, or waits until they are close.
    fn guess_limit(&mut self) -> Option<ReturnDecision> {
        let first = &self.own[0];
        (self.velocity, self.left) = (first.velocity, first.left);
        self.moment = first.offset * self.per_period;
        let points = self.own_points();
        let step = (points[3] - points[2]).norm();
        if step >= MAX_PREDICTION_DISTANCE {
            return None;
        }
        let (limit, radius) = extrapolate_limit(&points)?;
        if step > MAX_EXTRAPOLATION_DISTANCE {
            let wait = (MAX_EXTRAPOLATION_DISTANCE / step).ln() / radius.ln()
                - (RETURNS_PER_GUESS - 1) as f64;
            let left = self.own[RETURNS_PER_GUESS - 1].left;
            return Some(self.forget_returns(left - wait.max(0.0) * self.every));
        }
        Some(self.begin_trial(limit, f64::INFINITY))
    }

    /// Begins to follow the trial cycle from a guess of its return.
    fn begin_trial(&mut self, guess: Vector2<f64>, step: f64) -> ReturnDecision {
        self.tried = self.return_at(guess, 0.0);
        self.passages.clear();
        self.stage = Stage::Trial(step);
        ReturnDecision {
            resume_at: Some(self.tried),
            ..ReturnDecision::wait(f64::INFINITY)
        }
    }

    /// A step of Newton's method from the trial cycle; after the last one, the proof about its limit.
    fn refine_trial(
        &mut self,
        now: &Return,
        before: f64,
        laws: &[Constants],
        drive: &Drive,
    ) -> Option<ReturnDecision> {
        let velocity = self.velocity;
        let begun = self.tried.as_passage();
        self.cycle
            .linearise(laws, drive, (begun, &self.passages), velocity)?;
        let map = self.cycle.map;
        let inverse = (Matrix2::identity() - map).try_inverse()?;
        let tried = self.return_point(&self.tried).1;
        let step = inverse * (self.return_point(now).1 - tried);
        let limit = tried + step;
        let length = step.norm();
        if length > MAX_LAST_STEP || length.is_nan() {
            let goes_on = length < MAX_STEP_RATIO * before && limit.x > 0.0;
            return goes_on.then(|| self.begin_trial(limit, length));
        }
        if spectral_radius(map.trace(), map.determinant()) > 1.0 - MIN_DECAY {
            return None;
        }
        let norm = ContractionNorm::of_map(&map)?;
        self.cycle.divide_into_windows(laws, drive)?;
        let aside = norm.norm_of(&step);
        let off = self.own_points()[RETURNS_PER_GUESS - 1] - limit;
        let most = norm.norm_of(&off) + aside;
        let (radius, curvature) = find_ball(&self.cycle, &norm, &inverse, most.max(MAX_LAST_STEP))?;
        let certificate = Certificate {
            limit,
            map,
            norm,
            radius,
            curvature,
            aside,
        };
        if !certificate.is_exact() {
            return (length < MAX_STEP_RATIO * before).then(|| self.begin_trial(limit, length));
        }
        Some(self.extrapolate_to_end(&certificate))
    }

    /// What the lane does after a return of a motion whose limit is known.
    fn approach_limit(&mut self, now: Return, certificate: &Certificate) -> Option<ReturnDecision> {
        let last = self.own[RETURNS_PER_GUESS - 1];
        let same = last.position == now.position && last.phase == now.phase;
        if !same || (self.return_point(&now).1 - certificate.limit).norm() > MAX_PREDICTION_DISTANCE
        {
            return None;
        }
        self.own[RETURNS_PER_GUESS - 1] = now;
        let decision = self.extrapolate_to_end(certificate);
        Some(ReturnDecision {
            resume_at: decision.resume_at.filter(|to| *to != now),
            ..decision
        })
    }

    /// Extrapolates all periods but the last at once from the motion's own last return, or waits until that is exact
    /// enough.
    fn extrapolate_to_end(&mut self, certificate: &Certificate) -> ReturnDecision {
        let own = self.own[RETURNS_PER_GUESS - 1];
        let off = self.return_point(&own).1 - certificate.limit;
        let times = ((own.left - FOLLOWED_LAST_PERIODS) / self.every).floor();
        let back = |decision| ReturnDecision {
            resume_at: Some(own),
            ..decision
        };
        if own.left < MIN_PERIODS_LEFT * self.every {
            return back(self.forget_returns(f64::NEG_INFINITY));
        }
        let excess = certificate.excess(&off, times);
        if excess > 1.0 || excess.is_nan() {
            self.stage = Stage::Known(*certificate);
            let wait = certificate.returns_until_exact(excess);
            return back(ReturnDecision::wait(
                own.left - (wait * self.every - MAX_TIME_OFFSET),
            ));
        }
        let to = self.return_at(certificate.return_after(&off, times), times);
        self.forget_returns(f64::NEG_INFINITY);
        ReturnDecision {
            resume_at: Some(to),
            extrapolated_periods: times * self.every,
            ..ReturnDecision::wait(f64::NEG_INFINITY)
        }
    }
}

impl ReturnDecision {
    /// Goes on as it is; returns are recorded again when so many drive periods are left.
    fn wait(record_again_at: f64) -> Self {
        Self {
            resume_at: None,
            record_again_at,
            extrapolated_periods: 0.0,
        }
    }
}
