//! What is run: a machine of the paper's at a thousand frequencies, by either engine.

use rayon::prelude::*;
use serde::Serialize;
use softstop::{Clock, MotionError, Scene, SceneError, Start};
use softstop_console::machine::PaperMachine;
use softstop_dynamics::internals::ImpactCounter;
use softstop_lanes::{BatchObserver, Job, LoweredMachine, Outcome, run_parallel};

/// The motions.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Range {
    /// The machine.
    pub machine: PaperMachine,
    /// Lowest and highest frequency ratio eta.
    pub frequencies: (f64, f64),
    /// Frequencies, evenly over the range.
    pub motions: u32,
    /// Drive periods of each.
    pub periods: u64,
    /// Position and velocity at time 0.
    pub start: (f64, f64),
}

/// The range that softstop's figures are given for.
pub const RANGE: Range = Range {
    machine: PaperMachine::Unloaded,
    frequencies: (0.95, 1.4),
    motions: 1000,
    periods: 200,
    start: (0.0, 14.0),
};

/// Machines that are lowered together: they stay in the processor's cache, and all lanes are busy nearly to the end.
const PART: usize = 256;

/// The machines of a range, not yet lowered.
#[derive(Debug, Clone)]
pub struct MotionBatch {
    scenes: Vec<Scene>,
    jobs: Vec<Job>,
}

/// What one way through found.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Count {
    /// Impacts of all motions together.
    pub impacts: u64,
    /// Zones.
    pub found: u64,
    /// Drive periods that lanes left to the scalar engine.
    pub handed_over: u64,
    /// Drive periods that lanes leapt over.
    pub leapt: u64,
}

impl Range {
    /// Its machines.
    ///
    /// # Errors
    /// [`SceneError`] if a frequency is none.
    pub fn batch(self) -> Result<MotionBatch, SceneError> {
        let (low, high) = self.frequencies;
        let step = (high - low) / f64::from(self.motions.max(2) - 1);
        let scene = |number| {
            let frequency = low + step * f64::from(number);
            self.machine.ratios().at_frequency(frequency).scene()
        };
        let scenes: Vec<Scene> = (0..self.motions).map(scene).collect::<Result<_, _>>()?;
        let start = Start::new(self.start.0, self.start.1);
        let job = |machine| Job {
            machine,
            start,
            periods: self.periods,
        };
        let jobs = (0..scenes.len()).map(job).collect();
        Ok(MotionBatch { scenes, jobs })
    }

    /// Drive periods of all motions together.
    pub fn all_periods(&self) -> u64 {
        u64::from(self.motions) * self.periods
    }
}

impl MotionBatch {
    /// One motion after the other by the safe engine, each machine lowered first.
    ///
    /// # Errors
    /// [`MotionError`] if a motion cannot be computed.
    pub fn safe(&self) -> Result<Count, MotionError> {
        let mut impacts = ImpactCounter::default();
        for (scene, job) in self.scenes.iter().zip(&self.jobs) {
            let mut motion = scene.motion(job.start)?;
            motion.advance(Clock::at_cycle(job.periods), &mut impacts)?;
        }
        Ok(Count {
            impacts: impacts.0,
            ..Count::default()
        })
    }

    /// All by a run of the lanes on this thread, each machine lowered first.
    ///
    /// # Errors
    /// As [`MotionBatch::safe`].
    pub fn follow(
        &self,
        run: impl Fn(&[LoweredMachine], &[Job]) -> Vec<Outcome>,
    ) -> Result<Count, MotionError> {
        let mut all = Vec::new();
        for (scenes, jobs) in self.scenes.chunks(PART).zip(self.jobs.chunks(PART)) {
            let machines = scenes
                .iter()
                .map(|scene| Ok(LoweredMachine::new(&scene.check()?)));
            let machines: Vec<LoweredMachine> = machines.collect::<Result<_, SceneError>>()?;
            let own = |(machine, job): (usize, &Job)| Job { machine, ..*job };
            let jobs: Vec<Job> = jobs.iter().enumerate().map(own).collect();
            all.extend(run(&machines, &jobs));
        }
        Count::of(&all)
    }

    /// All in lanes, `rounds` times over, on the threads of the pool that this is called in.
    ///
    /// # Errors
    /// As [`MotionBatch::safe`].
    pub fn parallel(&self, rounds: usize) -> Result<Count, MotionError> {
        let machines = self.scenes.par_iter();
        let machines = machines.map(|scene| Ok(LoweredMachine::new(&scene.check()?)));
        let machines: Vec<LoweredMachine> = machines.collect::<Result<_, SceneError>>()?;
        let jobs = self.jobs.repeat(rounds);
        let (outcomes, _) = run_parallel(&machines, &jobs, |_| ());
        Count::of(&outcomes)
    }
}

/// Hears of each impact, so that no motion with impacts is leapt over.
pub struct EachImpact;

impl BatchObserver for EachImpact {
    fn observed(&self) -> (bool, bool) {
        (true, false)
    }
}

impl Count {
    fn of(outcomes: &[Outcome]) -> Result<Self, MotionError> {
        let mut count = Self::default();
        for outcome in outcomes {
            if let Some(error) = &outcome.error {
                return Err(error.clone());
            }
            count.impacts += outcome.impacts;
            count.handed_over += outcome.handed_over;
            count.leapt += outcome.leapt;
        }
        Ok(count)
    }
}
