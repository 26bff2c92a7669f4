//! One stretch of smooth motion as a crate's solver sees it: y' = f(t, y) and the roots that end it.
//! What it gives back: how far it has followed the leg until a guard ended it.

use crate::methods::MethodError;
use softstop::Scene;
use softstop::internals::{Guard, Phase, PhaseTracker};
use std::cell::Cell;

/// Two numbers that a solver follows: position in m and velocity in m/s or, of a mass that is held, the
/// drive per mass in m/s^2 and its rate.
pub(super) type SolverState = [f64; 2];

/// A smooth law and its guards, where it begins and how far it may go. Counts how often it is asked.
pub(super) struct Leg<'a> {
    scene: &'a Scene,
    /// The phase whose law holds under the drive. Without one the mass is held: q'' = -w^2 q, q the drive per mass, so that
    /// the solver has something to resolve until the forcing lets the mass go.
    phase: Option<&'a Phase>,
    guards: &'a [Guard],
    evaluations: Cell<u64>,
    /// Time in s at which it begins.
    pub from: f64,
    /// The state there.
    pub state: SolverState,
    /// Time in s at which the motion ends.
    pub until: f64,
    /// Steps that are left.
    pub most_steps: u64,
}

impl<'a> Leg<'a> {
    /// The leg that follows in a walk: the motion in a phase or, while the mass is held, that of the drive.
    pub fn new(scene: &'a Scene, walk: &'a PhaseTracker, until: f64, most_steps: u64) -> Self {
        let (from, start) = (walk.time(), walk.state());
        let (forcing, rate) = drive(scene, from);
        Self {
            scene,
            phase: walk.phase(),
            guards: walk.guards(),
            evaluations: Cell::new(0),
            from,
            state: match walk.phase() {
                Some(_) => [start.position, start.velocity],
                None => [forcing, rate],
            },
            until,
            most_steps,
        }
    }

    /// How often the law was asked.
    pub fn evaluations(&self) -> u64 {
        self.evaluations.get()
    }

    /// How many guards watch it.
    pub fn guard_count(&self) -> usize {
        self.guards.len()
    }

    /// dy/dt.
    pub fn rate(&self, time: f64, [position, velocity]: SolverState) -> SolverState {
        self.count();
        let acceleration = match self.phase {
            Some(phase) => {
                let (forcing, _) = drive(self.scene, time);
                phase.acceleration(position, velocity, forcing, self.scene.mass)
            }
            None => -self.scene.excitation.frequency.powi(2) * position,
        };
        [velocity, acceleration]
    }

    /// The Jacobian of the rate times a vector.
    pub fn rate_along(&self, [position, velocity]: SolverState, along: SolverState) -> SolverState {
        self.count();
        let (stiffness, damping) = match self.phase {
            Some(phase) => {
                let (stiffness, damping) = phase.force_derivatives(position, velocity);
                (stiffness / self.scene.mass, damping / self.scene.mass)
            }
            None => (self.scene.excitation.frequency.powi(2), 0.0),
        };
        [along[1], -stiffness * along[0] - damping * along[1]]
    }

    /// The value of a guard; it ends the leg where it rises through zero.
    pub fn guard(&self, index: usize, [first, second]: SolverState) -> f64 {
        let guard = &self.guards[index];
        let weighted = match self.phase {
            Some(_) => guard.position * first + guard.velocity * second,
            None => guard.forcing * first,
        };
        weighted - guard.level
    }

    /// The guard that stands highest, and its value.
    pub fn highest(&self, state: SolverState) -> Option<(usize, f64)> {
        let all = (0..self.guards.len()).map(|index| (index, self.guard(index, state)));
        all.max_by(|one, other| one.1.total_cmp(&other.1))
    }

    /// How high the highest guard stands; below zero if there is none.
    pub fn height(&self, state: SolverState) -> f64 {
        self.highest(state).map_or(-1.0, |(_, value)| value)
    }

    /// The largest level of a guard: its rounding is relative to this.
    pub fn size(&self) -> f64 {
        let levels = self.guards.iter().map(|guard| guard.level.abs());
        levels.fold(0.0, f64::max)
    }

    fn count(&self) {
        self.evaluations.set(self.evaluations.get() + 1);
    }
}

/// The drive per mass in m/s^2 and its rate in m/s^3.
fn drive(scene: &Scene, time: f64) -> (f64, f64) {
    let drive = scene.excitation;
    let (sine, cosine) = (drive.frequency * time + drive.reduced_phase()).sin_cos();
    let amplitude = drive.amplitude / scene.mass;
    (amplitude * cosine, -amplitude * drive.frequency * sine)
}

/// Where a leg ended.
#[derive(Debug, Clone, Copy)]
pub(super) struct Reached {
    /// Time in s.
    pub time: f64,
    /// The state then.
    pub state: SolverState,
    /// The guard that ended it; none at the end of the span.
    pub guard: Option<usize>,
    /// Accepted steps.
    pub steps: u64,
}

/// What comes of a leg; of a failure the steps of this leg.
pub(super) type Outcome = Result<Reached, MethodError>;

/// The steps are used up.
pub(super) fn out_of_steps(time: f64, steps: u64) -> MethodError {
    MethodError::stuck(time, steps, "the steps allowed are used up")
}

/// Largest number that counts as bounded.
const BOUND: f64 = 1e100;

/// Refuses a state that has left all bounds.
pub(super) fn bounded(time: f64, state: SolverState) -> Result<(), MethodError> {
    match state.iter().all(|value| value.abs() <= BOUND) {
        true => Ok(()),
        false => Err(MethodError::BlownUp { time }),
    }
}
