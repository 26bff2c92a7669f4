//! Decides after each return of a motion to the same impact, every one to four drive periods, whether its limit cycle
//! is proven and how many periods can be extrapolated.
//!
//! Four returns of a motion (velocity, moment) tell about where its limit is (minimal polynomial extrapolation, Cabay and
//! Jackson 1976). From there the lane follows one cycle, whose exact derivative M gives the next guess by Newton's method,
//! until its step is below 1e-7. The multipliers have to be below 0.999. Then:
//!
//! 1. In the norm |P y| with P'P the sum of (M'/g)^k (M/g)^k, g a little above the spectral radius, M contracts by a
//!    rate r < 1 (Stein).
//! 2. In a ball of this norm the next return deviates by M d but for K |d|^2. A [`ContractionCertificate`] has K from the law's
//!    constants, and from the Hermite cubic of each window with its error (Birkhoff and Priver 1967) that no motion of the
//!    ball reaches another guard of its phase.
//! 3. If the radius is at most r (1 - r) / 2K, the ball is mapped into itself: all its motions make the cycle's crossings
//!    for ever.
//! 4. The lane goes back to the motion's own last return and follows it until a return lies in the ball and all that is not
//!    linear, as it is at the last return of the job, adds up to less than 2e-10 in v/v0 and angle. It goes to that return
//!    at once, to the limit plus M^n d, and follows the last two periods or a few more.

use std::f64::consts::TAU;

use nalgebra::{Matrix2, Vector2};

use super::contraction_certificate::{ContractionCertificate, find_ball};
use super::contraction_norm::{ContractionNorm, spectral_radius};
use super::cycle::Cycle;
use super::cycle_state::{Forcing, GuardCrossing};
use super::extrapolate_limit::{MIN_DECAY, RETURNS_PER_GUESS, extrapolate_limit};
use super::lane_laws::PhaseConstants;
use super::post_impact_state::PostImpactState;
use super::return_settings::SETTINGS;

/// The recorded returns of one lane to an impact, its trial cycle, and what is known of their limit.
#[derive(Debug, Default)]
pub(super) struct ReturnHistory {
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
    own: [PostImpactState; RETURNS_PER_GUESS],
    /// What all are measured by: a velocity, drive periods left and a moment in them.
    velocity: f64,
    left: f64,
    moment: f64,
    /// The trial cycle: its first return, its crossings and its derivatives.
    tried: PostImpactState,
    pub crossings: Vec<GuardCrossing>,
    cycle: Cycle,
}

/// How far the search for the limit of a lane's returns has come.
#[derive(Debug, Clone, Copy, Default)]
enum Stage {
    /// Nothing yet.
    #[default]
    Open,
    /// A trial cycle is followed; its distance from the guess before.
    Trial(f64),
    /// The limit cycle, and what is proven of the motions about it.
    Known(ContractionCertificate),
}

/// What a lane does after a return: where it goes on, and when its returns are recorded again.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ReturnDecision {
    /// Where it goes on, if not where it is.
    pub resume_at: Option<PostImpactState>,
    /// Drive periods left at which its returns are recorded again.
    pub record_again_at: f64,
    /// Drive periods that are extrapolated.
    pub extrapolated_periods: f64,
}

impl ReturnHistory {
    /// Begins with a job of `left` drive periods, of 1 / `per_period` seconds; how many are left when returns are recorded first.
    pub fn begin_job(&mut self, per_period: f64, left: f64) -> f64 {
        self.per_period = per_period;
        (self.every, self.pause) = (1.0, SETTINGS.first_pause_periods);
        self.forget_returns(left - SETTINGS.periods_before_recording)
            .record_again_at
    }

    /// Records a return, and decides what the lane does next; none if it just goes on.
    pub fn record(
        &mut self,
        now: PostImpactState,
        laws: &[PhaseConstants],
        drive: &Forcing,
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
                self.every = self.every % SETTINGS.max_periods + 1.0;
                return Some(self.pause_recording(now.left));
            }
            self.each = now.impacts - before.impacts;
        }
        self.own[self.count] = now;
        self.count += 1;
        if self.count < RETURNS_PER_GUESS {
            return None;
        }
        if now.left < SETTINGS.min_periods_left * self.every {
            return Some(self.forget_returns(f64::NEG_INFINITY));
        }
        let decision = self.guess_limit();
        Some(decision.unwrap_or_else(|| {
            self.every = self.recurrence_period();
            self.pause_recording(now.left)
        }))
    }

    /// Whether the motion is back at the same impact from one state after an impact to another, in the expected drive periods;
    /// none if these are not over.
    fn is_cycle_complete(&self, before: &PostImpactState, now: &PostImpactState) -> Option<bool> {
        let periods = (before.left - now.left) + (now.offset - before.offset) * self.per_period;
        if periods < self.every - SETTINGS.max_time_offset {
            return None;
        }
        let made = now.impacts - before.impacts;
        let same = before.position == now.position && before.phase == now.phase;
        let is_first = self.count == 1 && matches!(self.stage, Stage::Open);
        Some(
            periods <= self.every + SETTINGS.max_time_offset
                && same
                && (is_first || made == self.each),
        )
    }

    /// Drive periods after which the motion comes much closer to its first return than after others; 1 if there are none.
    fn recurrence_period(&self) -> f64 {
        let [first, rest @ ..] = self.own_points();
        let away = rest.map(|point| (point - first).norm());
        let recurs = match away {
            [one, two, _] if two < SETTINGS.max_recurrence_ratio * one => 2.0,
            [one, _, three] if three < SETTINGS.max_recurrence_ratio * one => 3.0,
            _ => 1.0,
        };
        let every = self.every * recurs;
        if every > SETTINGS.max_periods {
            1.0
        } else {
            every
        }
    }

    /// True while the lane follows a trial cycle instead of its own motion.
    pub fn is_trial(&self) -> bool {
        matches!(self.stage, Stage::Trial(_))
    }

    /// True if the trial cycle should have come back to its impact long ago; `left`: drive periods left.
    pub fn is_trial_overdue(&self, left: f64) -> bool {
        self.is_trial() && self.tried.left - left > self.every + 1.0
    }

    /// Ends a trial cycle without success: the lane goes on from the last return of its own motion. None if it follows none.
    pub fn end_trial(&mut self) -> Option<ReturnDecision> {
        let to = self.own[RETURNS_PER_GUESS - 1];
        self.is_trial().then(|| ReturnDecision {
            resume_at: Some(to),
            ..self.pause_recording(to.left)
        })
    }

    /// Records no returns for longer than the last time.
    fn pause_recording(&mut self, left: f64) -> ReturnDecision {
        self.pause *= SETTINGS.pause_growth;
        self.forget_returns(left - self.pause)
    }

    /// Forgets all returns; they are recorded again when `record_again_at` drive periods are left.
    fn forget_returns(&mut self, record_again_at: f64) -> ReturnDecision {
        (self.stage, self.count) = (Stage::Open, 0);
        ReturnDecision::wait(record_again_at)
    }

    /// A return as whole drive periods since the first one and a point (velocity over the first one's, drive angle) of the map.
    fn return_point(&self, it: &PostImpactState) -> (f64, Vector2<f64>) {
        let periods = (self.left - it.left) + it.offset * self.per_period;
        let number = ((periods - self.moment) / self.every + 0.5) as i64;
        let whole = number as f64 * self.every;
        let point = Vector2::new(it.velocity / self.velocity, TAU * (periods - whole));
        (whole, point)
    }

    fn own_points(&self) -> [Vector2<f64>; RETURNS_PER_GUESS] {
        std::array::from_fn(|index| self.return_point(&self.own[index]).1)
    }

    /// The state after an impact at a point (velocity, drive angle) of the return map, `times` returns after the motion's last.
    fn return_at(&self, point: Vector2<f64>, times: f64) -> PostImpactState {
        let after = &self.own[RETURNS_PER_GUESS - 1];
        let (number, _) = self.return_point(after);
        let periods = point.y / TAU;
        let whole = periods.floor();
        PostImpactState {
            velocity: point.x * self.velocity,
            offset: (periods - whole) / self.per_period,
            left: self.left - (number + times * self.every + whole),
            angle: None,
            impacts: times.mul_add(self.each, after.impacts),
            crossings: times.mul_add(self.crossings.len() as f64, after.crossings),
            ..*after
        }
    }

    /// Extrapolates the limit from the motion's own returns and begins a trial cycle there, or waits until they are close to it;
    /// none if they do not approach one.
    fn guess_limit(&mut self) -> Option<ReturnDecision> {
        let first = &self.own[0];
        (self.velocity, self.left) = (first.velocity, first.left);
        self.moment = first.offset * self.per_period;
        let points = self.own_points();
        let step = (points[3] - points[2]).norm();
        if step >= SETTINGS.max_prediction_distance {
            return None;
        }
        let (limit, radius) = extrapolate_limit(&points)?;
        if step > SETTINGS.max_extrapolation_distance {
            let wait = (SETTINGS.max_extrapolation_distance / step).ln() / radius.ln()
                - (RETURNS_PER_GUESS - 1) as f64;
            let left = self.own[RETURNS_PER_GUESS - 1].left;
            return Some(self.forget_returns(left - wait.max(0.0) * self.every));
        }
        Some(self.begin_trial(limit, f64::INFINITY))
    }

    /// Lets the lane follow a trial cycle from a guess of the limit, `step` away from the guess before.
    fn begin_trial(&mut self, guess: Vector2<f64>, step: f64) -> ReturnDecision {
        self.tried = self.return_at(guess, 0.0);
        self.crossings.clear();
        self.stage = Stage::Trial(step);
        ReturnDecision {
            resume_at: Some(self.tried),
            ..ReturnDecision::wait(f64::INFINITY)
        }
    }

    /// Makes a step of Newton's method from the trial cycle, which leads to the next trial; after the last one proves that
    /// returns contract to the limit. None if either fails.
    fn refine_trial(
        &mut self,
        now: &PostImpactState,
        before: f64,
        laws: &[PhaseConstants],
        drive: &Forcing,
    ) -> Option<ReturnDecision> {
        let velocity = self.velocity;
        let begun = self.tried.as_crossing();
        self.cycle
            .linearise(laws, drive, (begun, &self.crossings), velocity)?;
        let map = self.cycle.map;
        let inverse = (Matrix2::identity() - map).try_inverse()?;
        let tried = self.return_point(&self.tried).1;
        let step = inverse * (self.return_point(now).1 - tried);
        let limit = tried + step;
        let length = step.norm();
        if length > SETTINGS.max_last_step || length.is_nan() {
            let goes_on = length < SETTINGS.max_step_ratio * before && limit.x > 0.0;
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
        let (radius, curvature) = find_ball(
            &self.cycle,
            &norm,
            &inverse,
            most.max(SETTINGS.max_last_step),
        )?;
        let certificate = ContractionCertificate {
            limit,
            map,
            norm,
            radius,
            curvature,
            aside,
        };
        if !certificate.is_exact() {
            return (length < SETTINGS.max_step_ratio * before)
                .then(|| self.begin_trial(limit, length));
        }
        Some(self.extrapolate_to_end(&certificate))
    }

    /// Decides what a lane does after a return when the limit is known and proven: goes on, or extrapolates.
    fn approach_limit(
        &mut self,
        now: PostImpactState,
        certificate: &ContractionCertificate,
    ) -> Option<ReturnDecision> {
        let last = self.own[RETURNS_PER_GUESS - 1];
        let same = last.position == now.position && last.phase == now.phase;
        if !same
            || (self.return_point(&now).1 - certificate.limit).norm()
                > SETTINGS.max_prediction_distance
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

    /// Extrapolates all drive periods but the last from the motion's own last return, or waits until that is exact enough.
    fn extrapolate_to_end(&mut self, certificate: &ContractionCertificate) -> ReturnDecision {
        let own = self.own[RETURNS_PER_GUESS - 1];
        let off = self.return_point(&own).1 - certificate.limit;
        let times = ((own.left - SETTINGS.followed_last_periods) / self.every).floor();
        let back = |decision| ReturnDecision {
            resume_at: Some(own),
            ..decision
        };
        if own.left < SETTINGS.min_periods_left * self.every {
            return back(self.forget_returns(f64::NEG_INFINITY));
        }
        let excess = certificate.excess(&off, times);
        if excess > 1.0 || excess.is_nan() {
            self.stage = Stage::Known(*certificate);
            let wait = certificate.returns_until_exact(excess);
            return back(ReturnDecision::wait(
                own.left - (wait * self.every - SETTINGS.max_time_offset),
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
    /// The decision to go on as before; returns are recorded again when `record_again_at` drive periods are left.
    fn wait(record_again_at: f64) -> Self {
        Self {
            resume_at: None,
            record_again_at,
            extrapolated_periods: 0.0,
        }
    }
}
