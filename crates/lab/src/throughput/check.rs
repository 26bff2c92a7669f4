//! Random machines by both engines: in how many motions they count different crossings or end elsewhere.

use std::ops::AddAssign;
use std::time::Instant;

use anyhow::{Context, Result};
use rayon::prelude::*;
use serde::Serialize;
use softstop::{Scene, SceneError, Start};
use softstop_lanes::{Instructions, Job, Machine, Outcome, run_with};

use super::doubt::{self, Verdict};
use super::random_machines::{Draw, Kind, Motion};
use softstop_console::failure::Failure;
use softstop_console::progress::Progress;

/// Motions that are drawn and run together.
const PART: u64 = 256;
/// Differing motions that are told one by one.
const TOLD: usize = 5;
/// How far apart the engines may end, in units of the errors that come together: 1e-9 times the growth of an error.
const APART: f64 = 1e-9 / doubt::ROUNDING;
/// Drive periods before a leap from which the rest of a motion is compared that rounding has changed before.
const AHEAD: u64 = 8;

/// Which motions are compared.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Plan {
    /// How many.
    pub trajectories: u64,
    /// Drive periods of each.
    pub periods: u64,
    /// Seed of the random machines.
    pub seed: u64,
    /// They are aimed at trouble.
    pub aimed: bool,
}

/// What came of a check.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Tally {
    /// Motions.
    pub trajectories: u64,
    /// Motions whose crossings rounding can change, or that are chaotic.
    pub chaotic: u64,
    /// Other motions in which the engines count different impacts or crossings of any face, or end elsewhere.
    pub different: u64,
    /// Chaotic motions in which they count different impacts.
    pub different_in_chaos: u64,
    /// Impacts of all motions, by the scalar engine.
    pub impacts: u64,
    /// Motions that lanes leapt over in part.
    pub leapt: u64,
    /// Chaotic ones of those that were compared from just before the leap on, and those that could not be.
    pub compared_from_leap: u64,
    /// Chaotic ones that leapt and could not be compared from there: they are in contact then, or chaotic still.
    pub not_compared: u64,
    /// The farthest that the engines end apart in a motion that is not chaotic, over the growth of an error, in m or m/s.
    pub farthest: f64,
    /// Motions that lanes left to the scalar engine for a while.
    pub handed_over: u64,
    /// Drive periods of that.
    pub handed_over_periods: u64,
    /// The first differing ones.
    pub first: Vec<Difference>,
}

/// A motion in which the engines differ, outside chaos.
#[derive(Debug, Clone, Serialize)]
pub struct Difference {
    /// The machine.
    pub kind: Kind,
    /// The machine.
    pub scene: Scene,
    /// Position and velocity at time 0.
    pub start: (f64, f64),
    /// Impacts, crossings, position and velocity at the end, in lanes.
    pub batch: (u64, u64, f64, f64),
    /// By the scalar engine.
    pub scalar: (u64, u64, f64, f64),
}

/// A check with what it is to be repeated by.
#[derive(Debug, Clone, Serialize)]
pub struct Check {
    /// What came of it.
    #[serde(flatten)]
    pub tally: Tally,
    /// What was asked for.
    pub plan: Plan,
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
        self.leapt += other.leapt;
        self.compared_from_leap += other.compared_from_leap;
        self.not_compared += other.not_compared;
        self.farthest = self.farthest.max(other.farthest);
        self.handed_over += other.handed_over;
        self.handed_over_periods += other.handed_over_periods;
        self.first.extend(other.first);
        self.first.truncate(TOLD);
    }
}

/// Compares motions, on all cores.
///
/// # Errors
/// [`Failure::Run`] if a motion cannot be computed, [`Failure::Interrupted`] after Ctrl-C.
pub fn check(plan: Plan) -> Result<Check, Failure> {
    let begin = Instant::now();
    let progress = Progress::new(plan.trajectories, "random motions");
    let parts = plan.trajectories.div_ceil(PART);
    let tallies = (0..parts).into_par_iter().map(|part| {
        let count = PART.min(plan.trajectories - part * PART);
        let motions = draw(&mut Draw::new(plan.seed, part), count, plan.aimed);
        let tally = compare(motions.map_err(Failure::Run)?, plan.periods)?;
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
        plan,
        rounding: doubt::ROUNDING,
        chaos: doubt::CHAOS,
        seconds: begin.elapsed().as_secs_f64(),
    })
}

fn draw(draw: &mut Draw, count: u64, aimed: bool) -> Result<Vec<Motion>> {
    let mut motions = Vec::new();
    while (motions.len() as u64) < count {
        if aimed {
            motions.extend(draw.aimed()?.unwrap_or_default());
        } else {
            motions.push(draw.machine().context("a random machine")?);
        }
    }
    motions.truncate(count as usize);
    Ok(motions)
}

/// Compares motions over so many drive periods.
///
/// # Errors
/// [`Failure::Run`] if one cannot be computed.
pub fn compare(motions: Vec<Motion>, periods: u64) -> Result<Tally, Failure> {
    let machines = motions.iter();
    let machines = machines.map(|(_, scene, _)| Ok(Machine::new(&scene.check()?)));
    let machines = machines.collect::<Result<Vec<_>, SceneError>>();
    let machines = machines.context("a random machine")?;
    let outcomes = in_lanes(&machines, &motions, |_| periods)?;
    let until_leap = |index: usize| match &outcomes[index] {
        outcome if outcome.leapt > 0 => periods.saturating_sub(outcome.leapt + AHEAD),
        _ => 0,
    };
    let before = in_lanes(&machines, &motions, until_leap)?;
    let mut tally = Tally::default();
    for (index, (kind, scene, start)) in motions.into_iter().enumerate() {
        let outcome = &outcomes[index];
        let mut verdict = doubt::judge(&scene, start, periods).context("a random motion")?;
        tally.add(verdict, outcome);
        if verdict.doubtful && outcome.leapt > 0 {
            let done = until_leap(index);
            verdict = from_leap(&scene, &before[index], periods - done)?;
            tally.compared_from_leap += u64::from(!verdict.doubtful);
            tally.not_compared += u64::from(verdict.doubtful);
        }
        if verdict.doubtful {
            continue;
        }
        let apart = apart(outcome.end, verdict.end);
        tally.farthest = tally.farthest.max(apart / verdict.errors * doubt::ROUNDING);
        let counts = (outcome.impacts, outcome.crossings);
        if counts != (verdict.impacts, verdict.crossings) || apart > APART * verdict.errors {
            tally.different += 1;
            tally.first.push(Difference {
                kind,
                scene,
                start: (start.position, start.velocity),
                batch: told(counts, outcome.end),
                scalar: told((verdict.impacts, verdict.crossings), verdict.end),
            });
        }
    }
    Ok(tally)
}

/// The motions in lanes, each over its own number of drive periods.
fn in_lanes(
    machines: &[Machine],
    motions: &[Motion],
    periods: impl Fn(usize) -> u64,
) -> Result<Vec<Outcome>, Failure> {
    let job = |(machine, (_, _, start)): (usize, &Motion)| Job {
        machine,
        start: *start,
        periods: periods(machine),
    };
    let jobs: Vec<Job> = motions.iter().enumerate().map(job).collect();
    let outcomes = run_with(Instructions::Widest, machines, &jobs, &mut ());
    match outcomes.iter().find_map(|outcome| outcome.error.clone()) {
        Some(error) => Err(Failure::Run(anyhow::Error::new(error).context("lanes"))),
        None => Ok(outcomes),
    }
}

/// The rest of a motion from where it was before a leap, with what was counted up to there. It has to be short of all
/// faces there, for a state in contact does not tell the branch of the law.
fn from_leap(scene: &Scene, before: &Outcome, periods: u64) -> Result<Verdict, Failure> {
    let levels = doubt::levels(scene);
    let is_free = levels.iter().all(|level| before.end.position < *level);
    let rest = doubt::judge(scene, before.end, periods).context("a random motion")?;
    Ok(Verdict {
        impacts: before.impacts + rest.impacts,
        crossings: before.crossings + rest.crossings,
        doubtful: rest.doubtful || !is_free || before.leapt > 0,
        ..rest
    })
}

fn apart(a: Start, b: Start) -> f64 {
    (a.position - b.position).hypot(a.velocity - b.velocity)
}

fn told((impacts, crossings): (u64, u64), end: Start) -> (u64, u64, f64, f64) {
    (impacts, crossings, end.position, end.velocity)
}

impl Tally {
    fn add(&mut self, verdict: Verdict, outcome: &Outcome) {
        let differs = outcome.impacts != verdict.impacts;
        self.trajectories += 1;
        self.chaotic += u64::from(verdict.doubtful);
        self.different_in_chaos += u64::from(differs && verdict.doubtful);
        self.impacts += verdict.impacts;
        self.leapt += u64::from(outcome.leapt > 0);
        self.handed_over += u64::from(outcome.handed_over > 0);
        self.handed_over_periods += outcome.handed_over;
    }
}
