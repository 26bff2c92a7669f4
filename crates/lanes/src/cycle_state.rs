//! One instant of a cycle: its guard crossing, its state with derivatives, and the drive.

use nalgebra::{Complex, Matrix2, Vector2};

use super::lane_laws::PhaseConstants;

/// A recorded crossing of a guard by a trial cycle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct GuardCrossing {
    pub position: f64,
    /// Velocities before and after it.
    pub velocity: f64,
    pub velocity_after: f64,
    /// The phase after it.
    pub phase: usize,
    /// Drive periods left in the job, and seconds into the present period.
    pub left: f64,
    pub offset: f64,
}

/// Frequency, period and initial angle of the drive of the machine of a trial cycle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Forcing {
    pub frequency: f64,
    pub period: f64,
    /// cos + i sin of its angle at the beginning of a period.
    pub begin: Complex<f64>,
}

/// Position, velocity, acceleration and jerk at one instant.
pub(super) type Jet = [f64; 4];

/// The state of a trial cycle at one instant: its motion with derivatives, split into free and steady part.
#[derive(Debug, Clone, Copy)]
pub(super) struct CycleState {
    /// Position, velocity, acceleration and jerk.
    pub jet: Jet,
    /// Position and velocity of the free part of the motion.
    pub free: Vector2<f64>,
    /// Velocity and acceleration of the steady part.
    pub steady_rate: Vector2<f64>,
}

/// Derivatives of the state of a trial cycle at one instant: by the state at the start of its arc (`transition`), by the delay of
/// the crossing that began the arc (`response`), and by velocity and drive angle of the first impact (`tangent`).
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Derivatives {
    pub transition: Matrix2<f64>,
    pub response: Vector2<f64>,
    pub tangent: Matrix2<f64>,
}

impl Forcing {
    /// cos + i sin of the drive angle `offset` seconds into a period of the cycle.
    pub fn angle_at(&self, offset: f64) -> Complex<f64> {
        self.begin * Complex::cis(self.frequency * offset)
    }
}

impl PhaseConstants {
    /// The state of a trial cycle in this phase at position x and velocity v, when the drive stands at `angle`, cos + i sin.
    pub fn state_at(&self, drive: &Forcing, (x, v): (f64, f64), angle: Complex<f64>) -> CycleState {
        let steady = self.steady_state_at(angle);
        self.state_of(drive, Vector2::new(x - self.offset, v) - steady, steady)
    }

    /// The state of a trial cycle in this phase from position and velocity of its free and of its steady part.
    pub fn state_of(
        &self,
        drive: &Forcing,
        free: Vector2<f64>,
        steady: Vector2<f64>,
    ) -> CycleState {
        let square = drive.frequency * drive.frequency;
        let second = self.stiffness * free.x + self.damping * free.y;
        let third = self.stiffness * free.y + self.damping * second;
        let state = free + steady;
        CycleState {
            jet: [
                state.x + self.offset,
                state.y,
                second - square * steady.x,
                third - square * steady.y,
            ],
            free,
            steady_rate: Vector2::new(steady.y, -square * steady.x),
        }
    }
}
