//! Where a motion is going that comes back to the same impact after one to four drive periods.
//!
//! Close to a periodic motion the differences of successive returns follow d'' = trace d' - determinant d, with trace and
//! determinant of the return map. Four returns give both, and the point that they go to (the minimal polynomial
//! extrapolation of Cabay and Jackson 1976). From beside that guess the lane takes four returns again, until they confirm
//! it; if they do not, it goes back to its own last one. The map is stable if the multipliers that these returns show are,
//! and linear as far away as the motion is if the motion's own returns follow it.

use std::f64::consts::TAU;

use nalgebra::{Matrix2, Vector2};

use super::return_map::{Map, ROUNDING, TOGETHER};

/// What a return may come before or after a drive period, in periods.
const SLIP: f64 = 0.25;
/// Most drive periods from one return to the next; how much closer one has to be that recurs.
const MOST_PERIODS: f64 = 4.0;
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
/// Difference below which the last return is as good a guess, and what may be rounding in all four of them.
const SETTLED: f64 = 1e-8;
const ALL_ROUNDING: f64 = 2e-12;
/// How far a motion begins beside a guess, how little the next guess may differ for it to be final, and how much less
/// than the one before otherwise.
const ASIDE: Vector2<f64> = Vector2::new(3e-8, -2e-8);
const FINAL: f64 = 1e-7;
const SMALLER: f64 = 0.3;
/// Share of a difference's decay in one return that the map's curvature may make up.
const LINEAR: f64 = 0.25;
/// Error of the point that a motion goes to, and of how far from it the motion ends.
const ERROR: f64 = 4e-12;

/// A state just after an impact.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Return {
    pub position: f64,
    pub velocity: f64,
    /// Seconds into the drive period; drive periods left, this one included.
    pub offset: f64,
    pub left: f64,
    pub impacts: f64,
    pub phase: f64,
}

/// The returns of one lane.
#[derive(Debug, Clone, Copy, Default)]
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
    /// The motion's own, and those from a guess.
    own: [Return; TOGETHER],
    tried: [Return; TOGETHER],
    /// What all are measured by: a velocity, drive periods left and a moment in them.
    velocity: f64,
    left: f64,
    moment: f64,
}

/// What is known of where a motion goes.
#[derive(Debug, Clone, Copy, Default)]
enum Stage {
    /// Nothing.
    #[default]
    Open,
    /// A guess is tried; how far it was from the one before, or what the motion's own returns differ by.
    Guess(f64),
    /// The map is confirmed; one return from its fixed point says how far off that is.
    Last(Map),
    /// The map, but it is not linear yet as far away as the motion is.
    Known(Map),
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

    /// Takes note of a return.
    pub fn note(&mut self, now: Return) -> Option<Turn> {
        let is_guess = self.is_guess();
        if self.count == 0 && self.is_elsewhere(&now) {
            return None;
        }
        let returns = if is_guess {
            &mut self.tried
        } else {
            &mut self.own
        };
        if self.count > 0 {
            let before = &returns[self.count - 1];
            let periods = (before.left - now.left) + (now.offset - before.offset) * self.per_period;
            if periods < self.every - SLIP {
                return None;
            }
            let made = now.impacts - before.impacts;
            let same = before.position == now.position && before.phase == now.phase;
            let is_first = self.count == 1 && matches!(self.stage, Stage::Open);
            let is_like = is_first || made == self.each;
            if periods > self.every + SLIP || !same || !is_like {
                return Some(self.give_up(now.left, self.every % MOST_PERIODS + 1.0));
            }
            self.each = made;
        }
        returns[self.count] = now;
        self.count += 1;
        let enough = match self.stage {
            Stage::Last(_) => 2,
            _ => TOGETHER,
        };
        (self.count == enough).then(|| self.turn(now.left))
    }

    /// True if a motion whose map is known has come to another impact than that of the map.
    fn is_elsewhere(&self, now: &Return) -> bool {
        let Stage::Known(map) = &self.stage else {
            return false;
        };
        let last = &self.own[TOGETHER - 1];
        let same = last.position == now.position && last.phase == now.phase;
        !same || (self.point(now).1 - map.fixed).norm() > NEAR
    }

    /// What the returns lead to.
    fn turn(&mut self, left: f64) -> Turn {
        let turn = match self.stage {
            Stage::Guess(most) => self.confirm(most),
            Stage::Last(map) => self.polish(map),
            _ if left < FEWEST * self.every => Some(self.open(f64::NEG_INFINITY)),
            Stage::Open => self.guess(),
            Stage::Known(map) => Some(self.repeat(&map)),
        };
        turn.unwrap_or_else(|| self.give_up(left, self.recurs()))
    }

    /// After how many of these returns the motion comes closest to the first, if it comes much closer than others.
    fn recurs(&self) -> f64 {
        let [first, rest @ ..] = self.points(&self.own);
        let away = rest.map(|point| (point - first).norm());
        let recurs = match away {
            [one, two, _] if two < CLOSER * one => 2.0,
            [one, _, three] if three < CLOSER * one => 3.0,
            _ => 1.0,
        };
        let every = self.every * recurs;
        if every > MOST_PERIODS { 1.0 } else { every }
    }

    /// True while a guess is tried.
    pub fn is_guess(&self) -> bool {
        matches!(self.stage, Stage::Guess(_) | Stage::Last(_))
    }

    /// True if a guess is tried that should have come back long ago.
    pub fn is_overdue(&self, left: f64) -> bool {
        let longest = self.every * (TOGETHER + 1) as f64;
        self.is_guess() && self.tried[0].left - left > longest
    }

    /// Where a lane goes on that tries a guess which leads nowhere.
    pub fn back(&mut self) -> Option<Turn> {
        let to = self.own[TOGETHER - 1];
        self.is_guess().then(|| Turn {
            to: Some(to),
            ..self.pause(to.left)
        })
    }

    fn give_up(&mut self, left: f64, every: f64) -> Turn {
        let back = self.back();
        back.unwrap_or_else(|| {
            self.every = every;
            self.pause(left)
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

    fn points(&self, returns: &[Return; TOGETHER]) -> [Vector2<f64>; TOGETHER] {
        std::array::from_fn(|index| self.point(&returns[index]).1)
    }

    /// The return at a point, so many times after the last of the motion's own.
    fn at(&self, point: Vector2<f64>, times: f64) -> Return {
        let after = &self.own[TOGETHER - 1];
        let (number, _) = self.point(after);
        let periods = point.y / TAU;
        let whole = periods.floor();
        Return {
            velocity: point.x * self.velocity,
            offset: (periods - whole) / self.per_period,
            left: self.left - (number + times * self.every + whole),
            impacts: times.mul_add(self.each, after.impacts),
            ..*after
        }
    }

    /// A first guess from the motion's own returns.
    fn guess(&mut self) -> Option<Turn> {
        let first = &self.own[0];
        (self.velocity, self.left) = (first.velocity, first.left);
        self.moment = first.offset * self.per_period;
        let points = self.points(&self.own);
        let step = (points[3] - points[2]).norm();
        if step < SETTLED {
            return Some(self.set_off(points[3], FINAL));
        }
        let map = (step < NEAR).then(|| Map::through(&points))?;
        let map = map.filter(Map::is_stable)?;
        let (far, radius) = ((map.fixed - points[3]).norm(), map.radius());
        let is_like = far * (1.0 - radius) < step + step;
        if is_like && step > CLOSE {
            let wait = (CLOSE / step).ln() / radius.ln() - (TOGETHER - 1) as f64;
            let left = self.own[TOGETHER - 1].left;
            return Some(self.open(left - wait.max(0.0) * self.every));
        }
        is_like.then(|| self.set_off(map.fixed, step))
    }

    /// Goes on from beside a guess.
    fn set_off(&mut self, guess: Vector2<f64>, most: f64) -> Turn {
        self.go_on(guess + ASIDE, Stage::Guess(most))
    }

    fn go_on(&mut self, from: Vector2<f64>, stage: Stage) -> Turn {
        let to = self.at(from, 0.0);
        (self.tried[0], self.count) = (to, 1);
        self.stage = stage;
        Turn {
            to: Some(to),
            ..Turn::later(f64::INFINITY)
        }
    }

    /// Looks at the returns from beside a guess: it is final, or another one follows.
    fn confirm(&mut self, most: f64) -> Option<Turn> {
        let points = self.points(&self.tried);
        let map = Map::through(&points).filter(|map| map.is_known && map.is_stable())?;
        let step = (map.fixed - points[0] + ASIDE).norm();
        if step > FINAL {
            return (step < most * SMALLER).then(|| self.set_off(map.fixed, step));
        }
        Some(self.go_on(map.fixed, Stage::Last(map)))
    }

    /// Corrects the fixed point by the return from it; nothing if rounding moves it too far.
    fn polish(&mut self, mut map: Map) -> Option<Turn> {
        let [from, to, ..] = self.points(&self.tried);
        let way = map.inverse * (to - from);
        map.fixed = from + way;
        let error = map.inverse.norm() * (ROUNDING + map.error * way.norm());
        if error > ERROR {
            return None;
        }
        let turn = self.repeat(&map);
        let to = turn.to.unwrap_or(self.own[TOGETHER - 1]);
        Some(Turn {
            to: Some(to),
            ..turn
        })
    }

    /// Goes over all periods but the last at once from the motion's own returns, or waits until that can be done.
    fn repeat(&mut self, map: &Map) -> Turn {
        let off = self.points(&self.own).map(|point| point - map.fixed);
        let bent = |k: usize| off[k + 2] - off[k + 1] * map.trace + off[k] * map.determinant;
        let (far, radius) = (off[0].norm().max(off[1].norm()), map.radius());
        let share = match bent(0).norm().max(bent(1).norm()) {
            bent if bent > ALL_ROUNDING => bent / (far * (1.0 - radius)),
            _ => 0.0,
        };
        let left = self.own[TOGETHER - 1].left;
        let times = ((left - LAST) / self.every).floor();
        let spread = far * radius.powf(times);
        if times * map.error * spread > ERROR {
            return self.pause(left);
        }
        let excess = (share / LINEAR).max(share * spread / ERROR);
        self.count = 0;
        if excess > 1.0 {
            self.stage = Stage::Known(*map);
            // The next three returns pass meanwhile.
            let wait = excess.ln() / -radius.ln() - (TOGETHER - 1) as f64;
            return Turn::later(left - wait.max(0.0) * self.every);
        }
        let power = Matrix2::new(map.trace, -map.determinant, 1.0, 0.0).pow(times as u32);
        let rest = off[3] * power[(0, 0)] + off[2] * power[(0, 1)];
        let to = self.at(map.fixed + rest, times);
        self.stage = Stage::Open;
        Turn {
            to: Some(to),
            leapt: times * self.every,
            ..Turn::later(f64::NEG_INFINITY)
        }
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    /// A return map: velocity and moment of the next return after one or more drive periods.
    type ReturnMap = fn(f64, f64) -> (f64, f64);

    fn end(map: ReturnMap, periods: f64) -> (Return, f64) {
        let mut at = Return {
            velocity: 9.0,
            offset: 0.4,
            left: periods,
            ..Return::default()
        };
        let mut returns = Returns::default();
        let (mut noted, mut leapt) = (returns.begin(1.0, periods), 0.0);
        while at.left > 1.0 {
            let (velocity, offset) = map(at.velocity, at.offset);
            at = Return {
                velocity,
                offset,
                left: at.left - 1.0,
                impacts: at.impacts + 1.0,
                ..at
            };
            if at.left > noted {
                continue;
            }
            if let Some(turn) = returns.note(at) {
                noted = turn.again;
                leapt += turn.leapt;
                at = turn.to.unwrap_or(at);
            }
        }
        (at, leapt)
    }

    fn compare(map: ReturnMap, periods: f64) -> f64 {
        let (found, leapt) = end(map, periods);
        let mut exact = (9.0, 0.4);
        for _ in 1..periods as u64 {
            exact = map(exact.0, exact.1);
        }
        assert_eq!(found.impacts, periods - 1.0);
        assert!(
            (found.velocity - exact.0).abs() < 4e-11,
            "{found:?}, {exact:?}"
        );
        assert!(
            (found.offset - exact.1).abs() < 4e-12,
            "{found:?}, {exact:?}"
        );
        leapt
    }

    /// A turning, shrinking map about (10, 0.3), bent.
    fn spiral(v: f64, t: f64) -> (f64, f64) {
        let (x, y) = ((v - 10.0) / 10.0, t - 0.3);
        let (x, y) = (
            0.5 * x - 0.7 * y + 0.2 * x * y,
            0.7 * x + 0.5 * y - 0.3 * x * x,
        );
        (10.0 + 10.0 * x, 0.3 + y)
    }

    /// The same with real multipliers, 0.9 and 0.001.
    fn node(v: f64, t: f64) -> (f64, f64) {
        let (x, y) = ((v - 10.0) / 10.0, t - 0.3);
        (10.0 + 9.0 * x + 0.8 * x * y, 0.3 + 0.001 * y - 0.05 * x * x)
    }

    /// With the multipliers 0.5 and 1.02: the start lies nearly on the way in.
    fn saddle(v: f64, t: f64) -> (f64, f64) {
        let (x, y) = ((v - 10.0) / 10.0, t - 0.4);
        (10.0 + 5.0 * x, 0.4 + 1.02 * y - y * y * y)
    }

    /// To one point at once.
    fn point(_: f64, _: f64) -> (f64, f64) {
        (10.0, 0.3)
    }

    /// With both multipliers close to 1 and to each other.
    fn slow(v: f64, t: f64) -> (f64, f64) {
        let (x, y) = ((v - 10.0) / 10.0, t - 0.3);
        (10.0 + 9.9 * x + 0.02 * y, 0.3 + 0.985 * y + 0.01 * x * x)
    }

    /// Two points by turns.
    fn by_turns(v: f64, t: f64) -> (f64, f64) {
        let (x, y) = ((v - 10.0) / 10.0, t - 0.3);
        (10.0 - 10.0 * (1.3 * x - 4.0 * x * x * x), 0.3 + 0.2 * y)
    }

    #[test]
    fn what_settles_is_followed_to_its_end() {
        for periods in [60.0, 200.0, 201.0, 1e4] {
            let leapt = compare(spiral, periods);
            assert!(leapt > periods - 120.0, "{leapt} of {periods}");
        }
        assert!(compare(node, 1000.0) > 700.0);
        assert!(compare(point, 1000.0) > 900.0);
        compare(slow, 1e4);
    }

    #[test]
    fn two_points_by_turns_are_leapt_over_in_pairs() {
        for periods in [400.0, 401.0] {
            assert!(compare(by_turns, periods) > 200.0);
        }
    }

    #[test]
    fn an_unstable_point_is_never_taken_for_the_end() {
        // Rounding alone takes a motion from there that starts at 0.4 exactly.
        assert_eq!(end(saddle, 3000.0).1, 0.0);
        let beside = |v: f64, t: f64| saddle(v, if v == 9.0 { t + 1e-13 } else { t });
        let (found, _) = end(beside, 3000.0);
        assert!((found.offset - 0.4).abs() > 0.1, "{found:?}");
    }
}
