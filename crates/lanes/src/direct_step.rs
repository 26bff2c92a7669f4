//! Crosses a phase in one step, without windows: to the position that ends it in the direction of the velocity, or to
//! where the velocity passes zero.

use pulp::Simd;

use super::engine::Engine;
use super::free_and_steady_parts::Parts;
use super::guard_interval::GuardInterval;
use super::lane_laws::Laws;
use super::lanes::{Lanes, Mask, Pair};
use super::local_taylor;
use super::move_lanes::LaneEnd;
use super::nearby_zero::nearby_zero;
use super::scan_windows::LEAVING_MARGIN;
use super::sine_cosine::SMALL_ANGLE_DEGREE;

/// Least time from the crossing of a direct step to the end of the period, in windows: more than rounding could bridge.
const MIN_TIME_TO_END: f64 = 1e-4;

/// Where a direct step would take each lane: the surface and the time at which its phase ends.
struct DirectPath<S: Simd, const N: usize> {
    /// Lanes that move upwards, and lanes that start from rest.
    up: Mask<S, N>,
    rests: Mask<S, N>,
    /// Lanes whose velocity passes zero before they come to the surface.
    turns: Mask<S, N>,
    surface: Lanes<S, N>,
    acceleration: Lanes<S, N>,
    /// Approximate duration.
    time: Lanes<S, N>,
}

impl<S: Simd, const N: usize> Engine<'_, S, N> {
    /// Moves the lanes to the end of their phase in one step where their velocity provably keeps its sign up to there and they
    /// meet no further guard before; returns the lanes that are not moved.
    #[inline(always)]
    pub fn direct_step(
        &mut self,
        phase: usize,
        active: Mask<S, N>,
        due: Lanes<S, N>,
    ) -> Mask<S, N> {
        let law = &self.laws[phase];
        let frequency = self.state.drive.frequency;
        let (x, v) = (self.state.x, self.state.v);
        let (zero, one) = (x.like(0.0), x.like(1.0));
        let here = self.motion_parts(law);
        let path = self.direct_path(law, &here);
        let turns = active & path.turns;
        let parts = here.within_window(law, frequency, &here.after_window(law), path.time);
        let derivatives = local_taylor::motion_derivatives(law, frequency, &parts);
        let mut sought = local_taylor::guard_taylor::<S, N, false>(&derivatives, (one, zero, zero));
        sought[0] = sought[0] - path.surface;
        if turns.any() {
            let velocity =
                local_taylor::guard_taylor::<S, N, true>(&derivatives, (zero, one, zero));
            for (sought, velocity) in sought.iter_mut().zip(velocity) {
                *sought = turns.choose(velocity, *sought);
            }
        }
        let crossing = nearby_zero(&sought, law.window, active);
        let moment = crossing.time;
        let time = path.time + moment;
        let latest = law.window.min(due - law.window * due.like(MIN_TIME_TO_END));
        let in_time = zero.below(time) & time.below(latest);

        let (mut end_x, mut end_v) = (path.surface, crossing.slope);
        let mut rate = local_taylor::curvature_at(&sought, moment);
        let distance = (path.surface - x).abs();
        let mut apart = law.ambiguity.below(distance);
        if turns.any() {
            let (position, _) = local_taylor::position_and_velocity_at(&derivatives, moment);
            let short = ((position - x).abs() + law.ambiguity).below(distance);
            apart = turns.choose_mask(short, apart);
            rate = turns.choose(crossing.slope, rate);
            end_x = turns.choose(position, end_x);
            end_v = turns.choose(zero, end_v);
        }
        let ends = [(v, path.acceleration), (end_v, rate)];
        let alone = path.keeps_direction(law, &here, time, ends);
        let hits = active & crossing.sure & in_time & apart & alone;

        let beyond = path.up.choose(law.beyond_high, law.beyond_low);
        let bounce = path.up.choose(law.bounce, law.bounce_low);
        let impact = path.up.choose(law.impact, law.impact_low);
        let end = LaneEnd {
            x: end_x,
            v: end_v * turns.choose(one, bounce),
            beyond: turns.choose(law.beyond_guard, beyond),
            impact: turns.choose(zero, impact),
            before: end_v,
        };
        let angle = parts
            .turn_drive::<SMALL_ANGLE_DEGREE>(frequency, moment)
            .drive_angle(law);
        self.state.window_fraction = hits.choose(one, self.state.window_fraction);
        self.move_lanes((hits, hits), &end, angle, time);
        active.and_not(hits)
    }

    /// Predicts where the lanes leave their phase, by the Taylor series of the position up to the snap.
    #[inline(always)]
    fn direct_path(&self, law: &Laws<S, N>, here: &Parts<S, N>) -> DirectPath<S, N> {
        let (x, v) = (self.state.x, self.state.v);
        let frequency = self.state.drive.frequency;
        let (zero, half) = (x.like(0.0), x.like(0.5));
        let acceleration = here.acceleration(law, frequency);
        let (jerk, snap) = here.jerk_and_snap(law, frequency);
        let rests = v.equals(zero);
        let up = zero.below(rests.choose(acceleration, v));
        let surface = up.choose(law.high, law.low);
        let distance = surface - x;
        let twice = distance + distance;
        let square = v.mul_add(v, acceleration * twice);
        let root = square.square_root();
        let start = twice / (v + up.choose(root, -root));
        let (third, sixth) = (jerk * x.like(1.0 / 6.0), snap * x.like(1.0 / 24.0));
        let mean = cubic_value(v, [acceleration * half, third, sixth], start);
        let off = start.mul_add(mean, -distance);
        let change = [acceleration, jerk * half, snap * x.like(1.0 / 6.0)];
        let mut time = start - off / cubic_value(v, change, start);
        let last = cubic_value(v, change, time);
        let turns = zero.below(up.choose(last, -last)).not() & law.ends_at_reversal();
        if turns.any() {
            let start = -v / acceleration;
            let bend = start.mul_add(snap * x.like(1.0 / 3.0), jerk) * half;
            let off = start * start * bend;
            let slope = start.mul_add(start.mul_add(snap * half, jerk), acceleration);
            time = turns.choose(start - off / slope, time);
        }
        DirectPath {
            up,
            rests,
            turns,
            surface,
            acceleration,
            time,
        }
    }
}

impl<S: Simd, const N: usize> DirectPath<S, N> {
    /// True where the velocity, given with its rate at both `ends`, keeps its sign for `time` and the further guard is not met.
    #[inline(always)]
    fn keeps_direction(
        &self,
        law: &Laws<S, N>,
        here: &Parts<S, N>,
        time: Lanes<S, N>,
        ends: [Pair<S, N>; 2],
    ) -> Mask<S, N> {
        let [(v0, a0), (v1, a1)] = ends;
        let one = time.like(1.0);
        let third = time * one.like(1.0 / 3.0);
        let share = time * law.per_window;
        let square = share * share;
        let error_bound = here.velocity_error(law) * (square * square);
        let side = self.up.choose(one, -one);
        let (b1, b2) = (side * third.mul_add(a0, v0), side * (v1 - third * a1));
        // At an end where it is zero its first Bernstein coefficient needs no proof.
        let first = self.rests.choose(b1, side * v0);
        let last = self.turns.choose(b2, side * v1);
        let margin =
            (self.rests | self.turns).choose(error_bound * one.like(LEAVING_MARGIN), error_bound);
        let keeps = (law.slow + margin).below(first.min(last).min(b1.min(b2)));
        let reverses = law.ends_at_reversal();
        let away = (side * law.by_velocity).below(one.like(0.0));
        let mut alone = reverses & away;
        if keeps.and_not(reverses).any() {
            let [(v0, a0), (v1, a1)] = ends;
            let x = here.y + (here.p - law.edge);
            let ends = [[x, v0, a0], [self.surface, v1, a1]];
            let error_bounds = (here.position_error(law) * (square * square), error_bound);
            let interval = GuardInterval::of_further_guard(law, ends, time, error_bounds);
            alone = alone | interval.is_clear_of_further(law).and_not(reverses);
        }
        keeps & alone
    }
}

/// Value of the cubic of a direct step at a time: value + time (first + time (second + time third)).
#[inline(always)]
fn cubic_value<S: Simd, const N: usize>(
    value: Lanes<S, N>,
    [first, second, third]: [Lanes<S, N>; 3],
    time: Lanes<S, N>,
) -> Lanes<S, N> {
    let change = time.mul_add(time.mul_add(third, second), first);
    time.mul_add(change, value)
}
