//! The motion from the machine's own start, once it has settled.

use serde::{Deserialize, Serialize};
use softstop::{Clock, Machine, Trajectory};
use softstop_dynamics::MotionKind;

use crate::answer::{Answer, Answered, kind};
use crate::diagram::{Patience, motion_of};
use crate::machine::pair;

/// A motion to show.
#[derive(Debug, Deserialize)]
pub(crate) struct Shown {
    /// Drive periods that are drawn.
    drawn: u64,
    /// Drive periods whose states are seen at drive angle phi, of a motion that does not return.
    seen: u64,
    #[serde(flatten)]
    patience: Patience,
}

#[derive(Serialize)]
struct MotionReport {
    motion: MotionKind,
    name: String,
    kind: [f64; 3],
    /// State at drive angle phi from which it is shown.
    from: [f64; 2],
    hardest: f64,
    /// How many samples, impacts and states follow.
    counts: [usize; 3],
}

/// Samples of a drive period.
const FINENESS: f64 = 160.0;
/// Samples of an arc, at least.
const FEWEST: f64 = 6.0;

impl Shown {
    /// Samples (time, position, velocity), impacts (time, before-impact velocity) and states at drive angle phi.
    pub(crate) fn answer(&self, machine: &Machine) -> Answered {
        let scene = &machine.scene;
        let settled = self.patience.follow(&[(scene, machine.start)]).pop();
        let settled = settled.ok_or("no motion")?;
        let motion = motion_of(scene, &settled);
        let settled = settled.map_err(|error| error.to_string())?;
        let repeats = settled.periods.unwrap_or(self.seen);
        let periods = repeats.max(self.drawn);
        let trajectory = scene.trajectory(settled.from, periods);
        let trajectory = trajectory.map_err(|error| error.to_string())?;
        let samples = samples(&trajectory, self.drawn as f64 * scene.period());
        let clock = trajectory.clock;
        let impacts: Vec<_> = trajectory
            .impacts()
            .map(|it| [clock.time(it.instant), it.before_impact_velocity])
            .collect();
        let states: Vec<_> = (0..repeats)
            .filter_map(|period| trajectory.at(Clock::at_cycle(period)))
            .map(pair)
            .collect();
        let told = MotionReport {
            name: motion.to_string(),
            kind: kind(&motion),
            from: pair(settled.from),
            hardest: settled.hardest_impact(),
            counts: [samples.len(), impacts.len(), states.len()],
            motion,
        };
        let mut numbers = samples.concat();
        numbers.extend(impacts.concat());
        numbers.extend(states.concat());
        Ok(Answer::new(&told, numbers))
    }
}

/// Samples of each arc up to a time, both its ends among them.
fn samples(trajectory: &Trajectory, end: f64) -> Vec<[f64; 3]> {
    let clock = &trajectory.clock;
    let mut samples = Vec::new();
    for arc in &trajectory.arcs {
        let begin = clock.time(arc.start);
        if begin >= end {
            break;
        }
        let shown = arc.duration.min(end - begin);
        let steps = (FINENESS * shown / clock.period()).ceil().max(FEWEST);
        for step in 0..=steps as u32 {
            let elapsed = shown * f64::from(step) / steps;
            let drive = clock.drive(clock.after(arc.start, elapsed));
            let (position, velocity) = arc.course.state_at(elapsed, drive);
            samples.push([begin + elapsed, position, velocity]);
        }
    }
    samples
}
