//! Strips that fail: in runs, at every drive angle, and by chance, on an ideal drive and on a motor.

use anyhow::Result;
use rayon::prelude::*;
use serde::Serialize;
use softstop_console::progress::Progress;
use softstop_dynamics::zone::hysteresis;

use super::coupled::{Coupling, Motor, Point, System};

/// Steps of the master in a drive period.
const STEPS: usize = 24;
/// Strokes with a strip before the first that fails, and after the last.
const AROUND: (usize, usize) = (5, 80);
/// Impacts by which a motion is judged in the end, and the share of a turn by which their intervals may differ from it.
const JUDGED: usize = 16;
const ALIKE: f64 = 0.02;
/// Interval between two impacts, in turns, from which on a stroke was missed between.
const GAP: f64 = 1.5;
/// Part of the zone that is looked at, as shares of the way from g0 to s_SN.
const SHARES: (f64, f64) = (0.7, 1.0);
/// Strips that fail in a row.
pub(super) const MISSING: [usize; 6] = [0, 1, 2, 4, 8, 16];
/// Model of supply by its number, as the feeder has it.
const PATTERN: f64 = 2.0;
const RANDOM: f64 = 3.0;

/// What became of the motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Fate {
    /// Each stroke had its impact.
    Kept,
    /// Strokes were missed, but z = 1 came back.
    Back,
    /// It is another motion in the end.
    Lost,
}

impl Fate {
    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Kept => "no stroke missed",
            Self::Back => "strokes missed, z = 1 again",
            Self::Lost => "z = 1 lost",
        }
    }
}

/// A run of strips that fail.
#[derive(Debug, Clone, Copy, Serialize)]
pub(super) struct Run {
    pub drive: &'static str,
    /// Frequency of the drive in the z = 1 motion, in rad/s.
    pub frequency: f64,
    /// How many.
    pub missing: usize,
    /// Drive angle in degrees at which strips come.
    pub angle: f64,
    /// Times at which strokes were missed.
    pub missed: usize,
    pub fate: Fate,
}

/// Strips that fail by chance.
#[derive(Debug, Clone, Copy, Serialize)]
pub(super) struct Chance {
    pub drive: &'static str,
    /// As in [`Run`].
    pub frequency: f64,
    /// Probability that a stroke gets a strip.
    pub probability: f64,
    /// Times at which strokes were missed, for each stroke.
    pub missed: f64,
}

/// What the machine does at strips that fail.
pub(super) struct Strips {
    /// Range of frequencies in rad/s, up to s_SN.
    pub range: (f64, f64),
    pub runs: Vec<Run>,
    pub chances: Vec<Chance>,
}

impl Strips {
    /// The worst fate over all drive angles.
    pub fn worst(&self, drive: &str, frequency: f64, missing: usize) -> Option<Fate> {
        let own = self
            .runs
            .iter()
            .filter(|it| it.drive == drive && it.frequency == frequency && it.missing == missing);
        own.map(|it| it.fate).max()
    }

    /// True if no stroke was missed when strips failed by chance.
    pub fn is_sure(&self, drive: &str, frequency: f64, probability: f64) -> bool {
        let own = self.chances.iter().filter(|it| {
            it.drive == drive && it.frequency == frequency && it.probability == probability
        });
        own.map(|it| it.missed).all(|missed| missed == 0.0)
    }

    /// The frequencies in rising order.
    pub fn frequencies(&self) -> Vec<f64> {
        let mut all: Vec<f64> = self.runs.iter().map(|it| it.frequency).collect();
        all.dedup();
        all.sort_by(f64::total_cmp);
        all.dedup();
        all
    }
}

/// How fine it is looked at: frequencies, angles, and seeds of each probability.
#[derive(Debug, Clone, Copy)]
pub(super) struct Detail {
    pub frequencies: usize,
    pub angles: usize,
    pub seeds: u64,
}

impl Detail {
    /// How many runs that makes.
    pub fn runs(self) -> usize {
        DRIVES.len() * self.frequencies * (MISSING.len() * self.angles + PROBABILITIES.len())
    }
}

/// The drives by name.
pub(super) const DRIVES: [(&str, Option<Motor>); 2] =
    [("ideal drive", None), ("motor", Some(Motor::SYSTEM))];
/// Probabilities that a stroke gets a strip.
pub(super) const PROBABILITIES: [f64; 3] = [0.9, 0.7, 0.5];

/// A machine on a drive.
type Driven<'a> = (&'static str, Option<Motor>, &'a Point);

/// Looks at all of them.
pub(super) fn study(detail: Detail, progress: &Progress) -> Result<Strips> {
    let zone = hysteresis(&Point::b()?.scene)?;
    let frequency =
        |share: f64| zone.frequency_g0 + (zone.frequency_sn - zone.frequency_g0) * share;
    let share =
        |k: usize| SHARES.0 + (SHARES.1 - SHARES.0) * (k as f64 + 0.5) / detail.frequencies as f64;
    let point = |k: usize| Point::at(frequency(share(k)));
    let points = (0..detail.frequencies)
        .map(point)
        .collect::<Result<Vec<_>>>()?;
    let (mut runs, mut chances) = (Vec::new(), Vec::new());
    for (point, (name, motor)) in points.iter().flat_map(|point| DRIVES.map(|of| (point, of))) {
        let driven: Driven = (name, motor, point);
        for missing in MISSING {
            let angles = (0..detail.angles).map(|k| 360.0 * k as f64 / detail.angles as f64);
            runs.extend(angles.map(|angle| (driven, missing, angle)));
        }
        chances.extend(PROBABILITIES.map(|probability| (driven, probability)));
    }
    let run = |&(driven, missing, angle): &(Driven, usize, f64)| {
        progress.step()?;
        run(driven, missing, angle)
    };
    let chance = |&(driven, probability): &(Driven, f64)| {
        progress.step()?;
        chance(driven, probability, detail.seeds)
    };
    Ok(Strips {
        range: (frequency(SHARES.0), frequency(SHARES.1)),
        runs: runs.par_iter().map(run).collect::<Result<_>>()?,
        chances: chances.par_iter().map(chance).collect::<Result<_>>()?,
    })
}

fn run((drive, motor, point): Driven<'_>, missing: usize, angle: f64) -> Result<Run> {
    let supply = [
        ("feed.angle", angle.to_radians()),
        ("supply.model", PATTERN),
        ("supply.pattern.count", 3.0),
        ("supply.pattern.strokes[1]", AROUND.0 as f64),
        ("supply.pattern.strokes[2]", missing as f64),
        ("supply.pattern.strokes[3]", 1e6),
    ];
    let mut system = System::new(point.in_motion(), motor, &supply, Coupling::RollBack)?;
    let intervals = intervals(&mut system, point, AROUND.0 + missing + AROUND.1)?;
    let missed = missed(&intervals);
    let last = &intervals[intervals.len().saturating_sub(JUDGED)..];
    let is_single = last.len() == JUDGED && last.iter().all(|it| (it - 1.0).abs() < ALIKE);
    let fate = match (is_single, missed) {
        (true, 0) => Fate::Kept,
        (true, _) => Fate::Back,
        (false, _) => Fate::Lost,
    };
    Ok(Run {
        drive,
        frequency: point.speed(),
        missing,
        angle,
        missed,
        fate,
    })
}

fn chance((drive, motor, point): Driven<'_>, probability: f64, seeds: u64) -> Result<Chance> {
    let mut gaps = 0;
    for seed in 0..seeds {
        let supply = [
            ("supply.model", RANDOM),
            ("supply.probability", probability),
            ("supply.seed", seed as f64),
        ];
        let mut system = System::new(point.in_motion(), motor, &supply, Coupling::RollBack)?;
        gaps += missed(&intervals(&mut system, point, AROUND.1)?);
    }
    Ok(Chance {
        drive,
        frequency: point.speed(),
        probability,
        missed: gaps as f64 / (seeds * AROUND.1 as u64) as f64,
    })
}

fn missed(intervals: &[f64]) -> usize {
    intervals.iter().filter(|it| **it > GAP).count()
}

/// Drives the machine for some turns; the intervals between its impacts, in turns of the z = 1 motion.
fn intervals(system: &mut System, point: &Point, turns: usize) -> Result<Vec<f64>> {
    let period = point.scene.period();
    let (mut intervals, mut last) = (Vec::new(), None);
    for _ in 0..turns * STEPS {
        system.step(period / STEPS as f64)?;
        if system.press.get("impact.step.count")? == 0.0 {
            continue;
        }
        let first = system.press.get("impact.step.first.time")?;
        intervals.extend(last.map(|last| (first - last) / period));
        last = Some(system.press.get("impact.time")?);
    }
    // An impact that does not come any more.
    let since = last.map(|last| (system.time - last) / period);
    intervals.extend(since.filter(|since| *since > GAP));
    Ok(intervals)
}
