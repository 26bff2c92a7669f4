//! The regimes of all models over a range of drive frequencies, from two starts.

use anyhow::Context;
use softstop::{Dimension, Machine, Scene, Start};
use softstop_dynamics::Regime;

use super::FidelityArguments;
use super::study::{ModelComparison, ModelEntry};
use softstop_console::column::Column;
use softstop_console::columns;
use softstop_console::failure::Failure;
use softstop_console::progress::Progress;
use softstop_console::report::MotionName;

/// Drive periods after which a motion counts as settled.
const TRANSIENT: u64 = 200;
/// Names of the two starts, and velocities from position 0 in units of the clearance times sqrt(k1/m): at rest, and towards
/// the stop as the paper's (0, 14) at rho = 10.
const STARTS: [(&str, f64); 2] = [("rest", 0.0), ("flung", 1.4)];
/// Ends of the sweep unless they are given, in units of sqrt(k1/m).
const SWEEP: [f64; 2] = [0.95, 1.4];

/// The regimes of one model from both starts, at every frequency; none where nothing repeats.
#[derive(Debug)]
pub(super) struct RegimeTrack<'a> {
    pub(super) entry: &'a ModelEntry,
    pub(super) regimes: [Vec<Option<Regime>>; 2],
}

/// The regimes of all models.
#[derive(Debug)]
pub(super) struct RegimeStructure<'a> {
    /// In the machine's own units.
    pub(super) frequencies: Vec<f64>,
    pub(super) tracks: Vec<RegimeTrack<'a>>,
}

impl<'a> RegimeStructure<'a> {
    /// Motions of all models from both starts at a number of frequencies.
    pub(super) fn motion_count(study: &ModelComparison, frequencies: usize) -> usize {
        STARTS.len() * frequencies * study.entries.len()
    }

    /// Runs all models of a study from both starts at these frequencies.
    pub(super) fn new(
        machine: &Machine,
        study: &'a ModelComparison,
        frequencies: Vec<f64>,
    ) -> Result<Self, Failure> {
        let count = Self::motion_count(study, frequencies.len());
        let progress = Progress::new(count as u64, "motions");
        let regimes = |entry: &ModelEntry, (_, flung)| {
            let each = frequencies.iter().map(|frequency| {
                let frequency = machine.to_si(Dimension::Frequency, *frequency);
                let regime = regime(&entry.scene, frequency, flung)?;
                progress.step()?;
                Ok(regime)
            });
            each.collect::<Result<Vec<_>, Failure>>()
        };
        let track = |entry: &'a ModelEntry| {
            Ok(RegimeTrack {
                entry,
                regimes: [regimes(entry, STARTS[0])?, regimes(entry, STARTS[1])?],
            })
        };
        let tracks = study.entries.iter().map(track);
        Ok(Self {
            tracks: tracks.collect::<Result<_, Failure>>()?,
            frequencies,
        })
    }

    /// The share of frequencies and starts at which something of a model's regime is that of the scene itself.
    pub(super) fn agreement<T: PartialEq>(
        &self,
        model: &RegimeTrack,
        of: fn(Option<Regime>) -> T,
    ) -> Option<f64> {
        let truth = self.tracks.iter().find(|track| track.entry.is_truth)?;
        let pairs = truth
            .regimes
            .iter()
            .flatten()
            .zip(model.regimes.iter().flatten());
        let same = pairs.clone().filter(|(a, b)| of(**a) == of(**b));
        Some(same.count() as f64 / pairs.count() as f64)
    }

    /// The rows of `structure.csv`: all motions.
    pub(super) fn rows(&self) -> impl Iterator<Item = StructureRow<'_>> {
        self.tracks.iter().flat_map(move |track| {
            STARTS
                .iter()
                .zip(&track.regimes)
                .flat_map(move |((start, _), regimes)| {
                    let regimes = self.frequencies.iter().zip(regimes);
                    regimes.map(move |(frequency, regime)| StructureRow {
                        track,
                        start,
                        frequency: *frequency,
                        motion: MotionName::of_regime(*regime),
                    })
                })
        })
    }
}

impl RegimeTrack<'_> {
    /// z or kind of its motions from a start in order of frequency, each once where it is the same at neighbours.
    pub(super) fn sequence(&self, start: usize) -> Vec<String> {
        let regimes = self.regimes[start].iter();
        let names = regimes.map(|regime| MotionName::of_regime(*regime).word().to_owned());
        let mut names: Vec<String> = names.collect();
        names.dedup();
        names
    }
}

/// A row of `structure.csv`.
pub(super) struct StructureRow<'a> {
    track: &'a RegimeTrack<'a>,
    start: &'static str,
    frequency: f64,
    motion: MotionName,
}

/// The columns of `structure.csv`.
pub(super) fn columns<'a>() -> [Column<StructureRow<'a>>; 6] {
    columns! { StructureRow<'a>, row;
        "rung" [None], "the model's law" => row.track.entry.name.rung.name();
        "matched" [None], "what it shares with the contact, if anything" => row.track.entry.name.word();
        "start" [None], "rest, or flung towards the stop" => row.start;
        "frequency" [Frequency], "of the drive" => row.frequency;
        "kind" [None], "of the motion: periodic or unsettled" => row.motion.kind;
        "z" [None], "regime z = p/n, if the motion repeats" => row.motion.z.as_deref();
    }
}

/// The frequencies in the machine's own units, both ends included.
pub(super) fn frequencies(
    machine: &Machine,
    arguments: &FidelityArguments,
) -> Result<Vec<f64>, Failure> {
    let scene = &machine.scene;
    let unit = (scene.stiffness / scene.mass).sqrt();
    let usual = SWEEP.map(|end| machine.to_own(Dimension::Frequency, end * unit));
    let [low, high] = arguments.sweep.unwrap_or(usual);
    if unit == 0.0 || low <= 0.0 {
        return Err(Failure::usage(format!(
            "--sweep {low}:{high}, stiffness = {}: must both be > 0",
            scene.stiffness
        )));
    }
    let step = (high - low) / (arguments.points - 1) as f64;
    let points = 0..arguments.points;
    Ok(points.map(|point| low + point as f64 * step).collect())
}

fn regime(scene: &Scene, frequency: f64, flung: f64) -> Result<Option<Regime>, Failure> {
    let scene = scene.at_frequency(frequency);
    let unit = (scene.stiffness / scene.mass).sqrt();
    let static_deflection = scene.excitation.amplitude / scene.stiffness;
    let length = scene.clearance.abs().max(static_deflection);
    // With interference the mass would stand beyond a rigid stop.
    let start = Start::new(scene.clearance.min(0.0), flung * length * unit);
    let (regime, _) = Regime::after_transient(&scene, start, TRANSIENT)
        .with_context(|| format!("cannot run the sweep at {frequency} rad/s"))?;
    Ok(regime)
}

/// What a regime is, coarsely: no impacts, z = 1, another period, none.
pub(super) fn kind(regime: Option<Regime>) -> u8 {
    match regime.map(|regime| (regime.impacts, regime.periods)) {
        None => 0,
        Some((0, _)) => 1,
        Some((1, 1)) => 2,
        Some(_) => 3,
    }
}
