//! A task as the stepping methods see it: forces at a time and a state, and what asking for them costs.

use super::{MethodError, Solution, Task, Work};
use softstop::internals::{PhaseId, Phases};
use softstop::{CheckedScene, Impact, MotionError, SceneError, Start};

/// Which law of force a step goes by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Laws {
    /// That of one phase, smoothly continued beyond its ends.
    One(PhaseId),
    /// Whichever holds where the state is; sign(0) = 0 under dry friction.
    All,
}

/// Positions in m beyond which a motion has blown up.
const FARTHEST: f64 = 1e100;

/// A state between two steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct State {
    pub position: f64,
    pub velocity: f64,
    /// The acceleration that the schemes of the alpha family carry on; the last one's guess for others.
    pub acceleration: f64,
}

impl State {
    pub const fn new(position: f64, velocity: f64, acceleration: f64) -> Self {
        Self {
            position,
            velocity,
            acceleration,
        }
    }

    pub const fn of(start: Start) -> Self {
        Self::new(start.position, start.velocity, 0.0)
    }

    pub const fn parts(self) -> (f64, f64, f64) {
        (self.position, self.velocity, self.acceleration)
    }

    /// The same state, unless it left all bounds in a step from this time on.
    pub fn bounded(self, time: f64) -> Result<Self, MethodError> {
        match self.position.abs() <= FARTHEST && self.velocity.is_finite() {
            true => Ok(self),
            false => Err(MethodError::BlownUp { time }),
        }
    }
}

/// Forces and steps, and counts of what was asked.
pub(super) struct Machine {
    pub scene: CheckedScene,
    pub steps: Steps,
    pub work: Work,
    pub impacts: Vec<Impact>,
    most_steps: u64,
}

/// A duration divided into equal steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Steps {
    pub duration: f64,
    pub count: u64,
}

impl Steps {
    /// The least number of equal steps that are no longer than `longest` but by rounding.
    fn new(task: &Task, longest: f64) -> Result<Self, MethodError> {
        let duration = task.until()?;
        let count = (duration / longest * (1.0 - 1e-12)).ceil();
        if count > task.most_steps as f64 {
            let reason = format!("{count} steps are needed, {} are allowed", task.most_steps);
            return Err(MethodError::stuck(0.0, 0, reason));
        }
        let count = count as u64;
        Ok(Self { duration, count })
    }

    /// The time in s at which a step begins.
    pub fn time(&self, index: u64) -> f64 {
        if index == self.count {
            self.duration
        } else {
            self.duration * (index as f64 / self.count as f64)
        }
    }
}

/// Refuses a setting that is not as `allowed`.
pub(crate) fn in_range(
    name: &'static str,
    value: f64,
    holds: bool,
    allowed: &'static str,
) -> Result<(), MethodError> {
    if holds {
        return Ok(());
    }
    let error = SceneError::OutOfRange {
        name,
        value,
        allowed,
    };
    Err(MotionError::Scene(error).into())
}

impl Machine {
    /// A task's, whose steps are no longer than this; refuses what makes no sense.
    pub fn new(task: &Task, step: f64) -> Result<Self, MethodError> {
        let holds = step.is_finite() && step > 0.0;
        in_range("step", step, holds, "finite and > 0")?;
        if let Some(below) = &task.scene.below {
            let name = "stop.below.clearance";
            let allowed = "left out: methods are compared on stops on one side";
            in_range(name, below.clearance, false, allowed)?;
        }
        // A motion refuses all that is wrong with a scene and a start.
        let scene = task.scene.check().map_err(MotionError::from)?;
        scene.motion(task.start)?;
        Ok(Self {
            scene,
            steps: Steps::new(task, step)?,
            work: Work::default(),
            impacts: Vec::new(),
            most_steps: task.most_steps,
        })
    }

    /// The phases of its scene.
    pub fn phases(&self) -> &Phases {
        self.scene.phases()
    }

    /// Push of the drive per mass in m/s^2.
    pub fn push(&self, time: f64) -> f64 {
        let (drive, amplitude) = (self.scene.excitation, self.phases().amplitude);
        amplitude * (drive.frequency * time + drive.reduced_phase()).cos()
    }

    /// Acceleration in m/s^2; counted.
    pub fn acceleration(&mut self, laws: Laws, time: f64, position: f64, velocity: f64) -> f64 {
        self.work.evaluations += 1;
        let push = self.push(time);
        let of = |phase| self.phases().acceleration(phase, position, velocity, push);
        match self.laws(laws, position, velocity) {
            [one, other] if one == other => of(one),
            [one, other] => 0.5 * (of(one) + of(other)),
        }
    }

    /// -d(acceleration)/d(position) in 1/s^2 and -d(acceleration)/d(velocity) in 1/s. They come with an
    /// evaluation.
    pub fn force_derivatives(&self, laws: Laws, position: f64, velocity: f64) -> (f64, f64) {
        let of = |phase: PhaseId| self.phases()[phase].force_derivatives(position, velocity);
        let [one, other] = self.laws(laws, position, velocity).map(of);
        let per_mass = 0.5 / self.scene.mass;
        ((one.0 + other.0) * per_mass, (one.1 + other.1) * per_mass)
    }

    fn laws(&self, laws: Laws, position: f64, velocity: f64) -> [PhaseId; 2] {
        match laws {
            Laws::One(phase) => [phase; 2],
            Laws::All => self.phases().laws_at(position, velocity, true),
        }
    }

    /// Counts a step that begins at `time`.
    pub fn count_step(&mut self, time: f64) -> Result<(), MethodError> {
        if self.work.steps >= self.most_steps {
            return Err(self.stuck(time, "more steps are needed than are allowed"));
        }
        self.work.steps += 1;
        Ok(())
    }

    pub fn stuck(&self, time: f64, reason: &str) -> MethodError {
        MethodError::stuck(time, self.work.steps, reason)
    }

    pub fn finish(self, end: State) -> Solution {
        Solution {
            end: (end.position, end.velocity),
            impacts: self.impacts,
            work: self.work,
        }
    }
}
