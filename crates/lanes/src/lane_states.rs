//! The state of all lanes: positions, velocities, phases, time and counts.

use pulp::Simd;

use super::job::Outcome;
use super::lanes::{Lanes, Mask, Pair};
use super::lowered_machine::LoweredMachine;
use super::post_impact_state::PostImpactState;
use super::sine_cosine::cos_sin;
use softstop::Start;

/// Number of drive periods after which a lane computes cos and sin of the drive angle from the time again, not by rotation.
const ANGLE_RENEWAL_PERIODS: f64 = 32.0;

/// Position, velocity, phase, time and counts of the motion in every lane.
#[derive(Debug, Clone, Copy)]
pub(super) struct LaneStates<S: Simd, const N: usize> {
    /// Position and velocity.
    pub x: Lanes<S, N>,
    pub v: Lanes<S, N>,
    /// cos and sin of the drive angle.
    pub angle: Pair<S, N>,
    /// Seconds since the beginning of the drive period.
    pub offset: Lanes<S, N>,
    /// Drive periods left, the present one included; none in a lane without a job.
    pub left: Lanes<S, N>,
    /// Drive periods of the job.
    pub periods: Lanes<S, N>,
    /// The phase each is in.
    pub phase: Lanes<S, N>,
    /// Impacts so far.
    pub impacts: Lanes<S, N>,
    /// Crossings so far.
    pub crossings: Lanes<S, N>,
    /// Drive periods left from which on returns to an impact are recorded; none in a lane whose are not.
    pub record_from: Lanes<S, N>,
    /// Length of the next interval to decide as a fraction of a window: less than 1 where a whole one could not be decided.
    pub window_fraction: Lanes<S, N>,
    pub drive: DriveLanes<S, N>,
}

/// Frequency, period and initial angle of the drive in every lane.
#[derive(Debug, Clone, Copy)]
pub(super) struct DriveLanes<S: Simd, const N: usize> {
    pub frequency: Lanes<S, N>,
    /// A drive period in s, and its reciprocal.
    pub period: Lanes<S, N>,
    pub per_period: Lanes<S, N>,
    /// cos and sin of the angle at the beginning of a period.
    pub begin: Pair<S, N>,
}

impl<S: Simd, const N: usize> LaneStates<S, N> {
    /// The states of lanes without a job.
    #[inline(always)]
    pub fn idle(simd: S) -> Self {
        let (none, one) = (Lanes::splat(simd, 0.0), Lanes::splat(simd, 1.0));
        Self {
            x: none,
            v: none,
            angle: (one, none),
            offset: none,
            left: none,
            periods: none,
            phase: none,
            impacts: none,
            crossings: none,
            record_from: none,
            window_fraction: one,
            drive: DriveLanes {
                frequency: one,
                period: one,
                per_period: one,
                begin: (one, none),
            },
        }
    }

    /// Gives a lane the drive of a machine.
    #[inline(always)]
    pub fn set_drive(&mut self, lane: usize, machine: &LoweredMachine) {
        let drive = &mut self.drive;
        let (frequency, period) = (
            machine.scene().excitation.frequency,
            machine.scene().period(),
        );
        drive.frequency.set(lane, frequency);
        drive.period.set(lane, period);
        drive.per_period.set(lane, 1.0 / period);
        drive.begin.0.set(lane, machine.angle.0);
        drive.begin.1.set(lane, machine.angle.1);
    }

    /// Puts a lane into a state at the beginning of a drive period, with `left` periods of its job left.
    #[inline(always)]
    pub fn begin_period(&mut self, lane: usize, state: Start, phase: usize, left: u64) {
        self.x.set(lane, state.position);
        self.v.set(lane, state.velocity);
        self.angle.0.set(lane, self.drive.begin.0.get(lane));
        self.angle.1.set(lane, self.drive.begin.1.get(lane));
        self.offset.set(lane, 0.0);
        self.left.set(lane, left as f64);
        self.phase.set(lane, phase as f64);
        self.window_fraction.set(lane, 1.0);
    }

    /// The lanes that have a job.
    #[inline(always)]
    pub fn busy_lanes(&self) -> Mask<S, N> {
        self.left.like(0.0).below(self.left)
    }

    /// Position and velocity of a lane.
    #[inline(always)]
    pub fn position_and_velocity(&self, lane: usize) -> Start {
        Start {
            position: self.x.get(lane),
            velocity: self.v.get(lane),
        }
    }

    /// The present state of a lane, just after an impact.
    pub fn post_impact_state(&self, lane: usize) -> PostImpactState {
        PostImpactState {
            position: self.x.get(lane),
            velocity: self.v.get(lane),
            offset: self.offset.get(lane),
            angle: Some((self.angle.0.get(lane), self.angle.1.get(lane))),
            left: self.left.get(lane),
            impacts: self.impacts.get(lane),
            crossings: self.crossings.get(lane),
            phase: self.phase.get(lane),
        }
    }

    /// Puts a lane into a state just after an impact, of its own motion or extrapolated.
    pub fn set_post_impact_state(&mut self, lane: usize, to: PostImpactState) {
        self.x.set(lane, to.position);
        self.v.set(lane, to.velocity);
        self.offset.set(lane, to.offset);
        self.left.set(lane, to.left);
        self.impacts.set(lane, to.impacts);
        self.crossings.set(lane, to.crossings);
        self.phase.set(lane, to.phase);
        self.window_fraction.set(lane, 1.0);
        let (cos, sin) = to.angle.unwrap_or_else(|| {
            let (s, c) = (self.drive.frequency.get(lane) * to.offset).sin_cos();
            let (c0, s0) = (self.drive.begin.0.get(lane), self.drive.begin.1.get(lane));
            (c0 * c - s0 * s, s0 * c + c0 * s)
        });
        self.angle.0.set(lane, cos);
        self.angle.1.set(lane, sin);
    }

    /// Moves the numbers of impacts and crossings that a lane has counted into an outcome.
    #[inline(always)]
    pub fn take_counts(&mut self, lane: usize, outcome: &mut Outcome) {
        outcome.impacts += self.impacts.get(lane) as u64;
        outcome.crossings += self.crossings.get(lane) as u64;
        self.impacts.set(lane, 0.0);
        self.crossings.set(lane, 0.0);
    }

    /// Computes the drive angle of some lanes from the time since the beginning of their drive period.
    #[inline(always)]
    fn renew_angle(&mut self, lanes: Mask<S, N>) {
        let (c, s) = cos_sin(self.offset * self.drive.per_period);
        let (c0, s0) = self.drive.begin;
        self.angle.0 = lanes.choose(c0 * c - s0 * s, self.angle.0);
        self.angle.1 = lanes.choose(s0 * c + c0 * s, self.angle.1);
    }

    /// How often each lane has had to compute the drive angle from the time so far, by the periods that are complete.
    #[inline(always)]
    fn angle_renewals(&self) -> Lanes<S, N> {
        let done = self.periods - self.left;
        (done * done.like(1.0 / ANGLE_RENEWAL_PERIODS)).floor()
    }

    /// Moves lanes whose time has passed the end of a drive period into the next one, and computes the drive angle from the time
    /// every [`ANGLE_RENEWAL_PERIODS`] of a lane's own periods.
    #[inline(always)]
    pub fn count_periods(&mut self) {
        let one = self.left.like(1.0);
        let begun = self.angle_renewals();
        loop {
            let wraps = self.drive.period.at_most(self.offset) & one.below(self.left);
            if !wraps.any() {
                break;
            }
            self.left = wraps.choose(self.left - one, self.left);
            self.offset = wraps.choose(self.offset - self.drive.period, self.offset);
        }
        let renewed = begun.below(self.angle_renewals());
        if renewed.any() {
            self.renew_angle(renewed);
        }
    }
}
