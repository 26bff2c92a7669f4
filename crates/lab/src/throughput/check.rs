//! Random machines by both engines: in how many motions they count different impacts.

use std::ops::AddAssign;
use std::time::Instant;

use anyhow::Context;
use rayon::prelude::*;
use serde::Serialize;
use softstop::{Scene, Start};
use softstop_lanes::{Instructions, Job, Machine, Outcome, run_with};

use super::doubt::{self, Verdict};
use super::random_machines::{Draw, Kind};
use softstop_console::failure::Failure;
use softstop_console::progress::Progress;

/// Motions that are drawn and run together.
const PART: u64 = 256;
/// Differing motions that are told one by one.
const TOLD: usize = 5;

/// What came of a check.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Tally {
    /// Motions.
    pub trajectories: u64,
    /// Motions whose number of impacts rounding can change, or that are chaotic.
    pub chaotic: u64,
    /// Other motions in which the engines count different impacts.
    pub different: u64,
    /// The same among the chaotic ones.
    pub different_in_chaos: u64,
    /// Impacts of all motions, by the scalar engine.
    pub impacts: u64,
    /// Motions that lanes left to the scalar engine for a while.
    pub handed_over: u64,
    /// Drive periods of that.
    pub handed_over_periods: u64,
    /// The first differing ones.
    pub first: Vec<Difference>,
}

/// A motion whose impacts the engines count differently, outside chaos.
#[derive(Debug, Clone, Serialize)]
pub struct Difference {
    /// The machine.
    pub kind: Kind,
    /// The machine.
    pub scene: Scene,
    /// Position and velocity at time 0.
    pub start: (f64, f64),
    /// Impacts in lanes.
    pub batch: u64,
    /// Impacts by the scalar engine.
    pub scalar: u64,
}

/// A check with what it is to be repeated by.
#[derive(Debug, Clone, Serialize)]
pub struct Check {
    /// What came of it.
    #[serde(flatten)]
    pub tally: Tally,
    /// Drive periods of each motion.
    pub periods: u64,
    /// Seed of the random machines.
    pub seed: u64,
    /// Errors that are carried along, in m and m/s.
    pub rounding: f64,
    /// Their growth from which a motion is chaotic.
    pub chaos: f64,
    /// Time that it took, in s, on all cores.
    pub seconds: f64,
}

impl AddAssign for Tally {
    fn add_assign(&mut self, other: Self) {
        self.trajectories += other.trajectories;
        self.chaotic += other.chaotic;
        self.different += other.different;
        self.different_in_chaos += other.different_in_chaos;
        self.impacts += other.impacts;
        self.handed_over += other.handed_over;
        self.handed_over_periods += other.handed_over_periods;
        self.first.extend(other.first);
        self.first.truncate(TOLD);
    }
}

/// Compares so many motions, each over so many drive periods, on all cores.
///
/// # Errors
/// [`Failure::Run`] if a motion cannot be computed, [`Failure::Interrupted`] after Ctrl-C.
pub fn check(trajectories: u64, periods: u64, seed: u64) -> Result<Check, Failure> {
    let begin = Instant::now();
    let progress = Progress::new(trajectories, "random motions");
    let parts = trajectories.div_ceil(PART);
    let tallies = (0..parts).into_par_iter().map(|part| {
        let count = PART.min(trajectories - part * PART);
        let tally = compare(&mut Draw::new(seed, part), count, periods)?;
        progress.steps(count)?;
        Ok::<_, Failure>(tally)
    });
    let add = |mut sum: Tally, other| {
        sum += other;
        Ok(sum)
    };
    let tally = tallies.try_reduce(Tally::default, add)?;
    Ok(Check {
        tally,
        periods,
        seed,
        rounding: doubt::ROUNDING,
        chaos: doubt::CHAOS,
        seconds: begin.elapsed().as_secs_f64(),
    })
}

fn compare(draw: &mut Draw, count: u64, periods: u64) -> Result<Tally, Failure> {
    let motions = (0..count).map(|_| draw.machine());
    let motions = motions.collect::<Result<Vec<(Kind, Scene, Start)>, _>>();
    let motions = motions.context("a random machine")?;
    let machines = motions.iter().map(|(_, scene, _)| Machine::new(scene));
    let machines = machines.collect::<Result<Vec<_>, _>>();
    let machines = machines.context("a random machine")?;
    let job = |(machine, (_, _, start)): (usize, &(Kind, Scene, Start))| Job {
        machine,
        start: *start,
        periods,
    };
    let jobs: Vec<Job> = motions.iter().enumerate().map(job).collect();
    let outcomes = run_with(Instructions::Widest, &machines, &jobs, &mut ());
    let mut tally = Tally::default();
    for ((kind, scene, start), outcome) in motions.into_iter().zip(outcomes) {
        let verdict = doubt::judge(&scene, start, periods).context("a random motion")?;
        if let Some(error) = outcome.error {
            return Err(Failure::Run(anyhow::Error::new(error).context("lanes")));
        }
        tally.add(verdict, &outcome);
        if !verdict.doubtful && outcome.impacts != verdict.impacts {
            tally.first.push(Difference {
                kind,
                scene,
                start: (start.position, start.velocity),
                batch: outcome.impacts,
                scalar: verdict.impacts,
            });
        }
    }
    Ok(tally)
}

impl Tally {
    fn add(&mut self, verdict: Verdict, outcome: &Outcome) {
        let differs = outcome.impacts != verdict.impacts;
        self.trajectories += 1;
        self.chaotic += u64::from(verdict.doubtful);
        self.different += u64::from(differs && !verdict.doubtful);
        self.different_in_chaos += u64::from(differs && verdict.doubtful);
        self.impacts += verdict.impacts;
        self.handed_over += u64::from(outcome.handed_over > 0);
        self.handed_over_periods += outcome.handed_over;
    }
}
