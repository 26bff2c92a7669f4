//! What motions come to along a parameter: many machines, each from some starts, together in the lanes.

use serde::Deserialize;
use softstop::{Machine, MotionError, Parameter, Scene, Start};
use softstop_dynamics::MotionKind;
use softstop_dynamics::monitor::unmonitored;
use softstop_dynamics::settled::{SettledMotion, Settling};

use crate::answer::{Answer, Answered, kind};
use crate::machine::parameter;

/// How motions are followed until they are looked at.
#[derive(Debug, Clone, Copy, Deserialize)]
pub(crate) struct Patience {
    /// Drive periods.
    pub periods: u64,
    /// Those of motions that have not settled by then, at most.
    pub longest: u64,
}

/// Values of a parameter, evenly spaced, and starts for each.
#[derive(Debug, Deserialize)]
pub(crate) struct Diagram {
    /// The parameter's key.
    along: String,
    from: f64,
    to: f64,
    columns: usize,
    starts: Vec<[f64; 2]>,
    #[serde(flatten)]
    patience: Patience,
}

/// Drive periods that are looked at.
pub(crate) const WATCHED: u64 = 64;

impl Patience {
    /// Follows motions.
    pub(crate) fn follow(
        self,
        motions: &[(&Scene, Start)],
    ) -> Vec<Result<SettledMotion, MotionError>> {
        let settling = Settling {
            periods: self.periods,
            watched: WATCHED.min(self.periods),
            longest: self.longest,
            ..Settling::default()
        };
        settling
            .follow_motions(motions, &unmonitored)
            .unwrap_or_default()
    }
}

/// What a motion is.
pub(crate) fn motion_of(scene: &Scene, seen: &Result<SettledMotion, MotionError>) -> MotionKind {
    let motion = |seen: &SettledMotion| {
        Some(
            seen.motion_kind(&seen.watched_map(&scene.check().ok()?))
                .ok()?
                .0,
        )
    };
    seen.as_ref()
        .ok()
        .and_then(motion)
        .unwrap_or(MotionKind::Lost)
}

impl Diagram {
    /// For each value, start by start: the motion's kind in three numbers, how many before-impact velocities and how many
    /// states at drive angle phi follow, and these; the last state is that at the end.
    pub(crate) fn answer(&self, machine: &Machine) -> Answered {
        let along = parameter(machine, &self.along)?;
        let scenes: Vec<Scene> = (0..self.columns)
            .map(|column| self.scene(machine, along, column))
            .collect();
        let starts = self.starts.iter();
        let starts: Vec<Start> = starts.map(|[x, v]| Start::new(*x, *v)).collect();
        let motions = scenes.iter();
        let motions = motions.flat_map(|scene| starts.iter().map(move |start| (scene, *start)));
        let motions: Vec<_> = motions.collect();
        let mut numbers = Vec::new();
        for ((scene, _), seen) in motions.iter().zip(self.patience.follow(&motions)) {
            numbers.extend(kind(&motion_of(scene, &seen)));
            let (velocities, states) = seen.map_or_else(
                |_| Default::default(),
                |seen| (seen.velocities, seen.states),
            );
            numbers.extend([velocities.len() as f64, states.len() as f64]);
            numbers.extend(velocities);
            numbers.extend(
                states
                    .iter()
                    .flat_map(|state| [state.position, state.velocity]),
            );
        }
        Ok(Answer::new(&(), numbers))
    }

    /// The machine in a column; outside of what it can have it is no scene, and so has no motion.
    fn scene(&self, machine: &Machine, along: Parameter, column: usize) -> Scene {
        let share = column as f64 / self.columns.saturating_sub(1).max(1) as f64;
        let mut machine = machine.clone();
        machine.set(along, self.from + share * (self.to - self.from));
        machine.scene
    }
}
