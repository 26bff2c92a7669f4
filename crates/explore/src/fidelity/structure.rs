//! The regimes of all models over a range of drive frequencies, from two starts.

use anyhow::Context;
use softstop::{Dimension, Machine, Scene, Start};
use softstop_dynamics::Regime;

use super::study::{Entry, Study};
use super::{FidelityArguments, word};
use softstop_console::column::Column;
use softstop_console::columns;
use softstop_console::failure::Failure;
use softstop_console::progress::Progress;
use softstop_console::report::MotionName;

/// Drive periods after which a motion counts as settled.
const TRANSIENT: u64 = 200;
/// Velocity of the second start, from position 0, in units of the clearance times sqrt(k1/m): the paper's
/// (0, 14) at rho = 10.
const FLUNG: f64 = 1.4;

/// Where a motion of the sweep starts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Origin {
    /// At rest.
    Rest,
    /// Towards the stop.
    Flung,
}

impl Origin {
    const fn name(self) -> &'static str {
        match self {
            Self::Rest => "rest",
            Self::Flung => "flung",
        }
    }
}

const ORIGINS: [Origin; 2] = [Origin::Rest, Origin::Flung];

/// The regimes of one model from both starts, at every frequency; none where nothing repeats.
#[derive(Debug)]
pub(super) struct Track<'a> {
    pub(super) entry: &'a Entry,
    pub(super) regimes: [Vec<Option<Regime>>; 2],
}

/// The regimes of all models.
#[derive(Debug)]
pub(super) struct Structure<'a> {
    /// In the machine's own units.
    pub(super) frequencies: Vec<f64>,
    pub(super) tracks: Vec<Track<'a>>,
}

/// How much of a model's regimes are those of the scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Agreement {
    /// Share of frequencies and starts with the same z = p/n, or without one in both.
    pub(super) same_regime: f64,
    /// Share with the same kind: no impacts, z = 1, another period, none.
    pub(super) same_kind: f64,
}

impl<'a> Structure<'a> {
    /// Runs all models of a study from both starts at these frequencies.
    pub(super) fn new(
        machine: &Machine,
        study: &'a Study,
        frequencies: Vec<f64>,
    ) -> Result<Self, Failure> {
        let count = ORIGINS.len() * frequencies.len() * study.entries.len();
        let progress = Progress::new(count as u64, "motions");
        let regimes = |entry: &Entry, origin| {
            let each = frequencies.iter().map(|frequency| {
                let frequency = machine.to_si(Dimension::Frequency, *frequency);
                let regime = regime(&entry.scene, frequency, origin)?;
                progress.step()?;
                Ok(regime)
            });
            each.collect::<Result<Vec<_>, Failure>>()
        };
        let track = |entry: &'a Entry| {
            Ok(Track {
                entry,
                regimes: [regimes(entry, ORIGINS[0])?, regimes(entry, ORIGINS[1])?],
            })
        };
        let tracks = study.entries.iter().map(track);
        let tracks = tracks.collect::<Result<_, Failure>>()?;
        Ok(Self {
            frequencies,
            tracks,
        })
    }

    /// How far a model agrees with the scene itself.
    pub(super) fn agreement(&self, model: &Track) -> Option<Agreement> {
        let truth = self.tracks.iter().find(|track| track.entry.is_truth)?;
        let pairs = || {
            let all = |track: &Track| track.regimes.concat();
            all(truth).into_iter().zip(all(model))
        };
        let share = |same: fn(&(Option<Regime>, Option<Regime>)) -> bool| {
            pairs().filter(same).count() as f64 / pairs().count() as f64
        };
        Some(Agreement {
            same_regime: share(|(a, b)| a == b),
            same_kind: share(|(a, b)| kind(*a) == kind(*b)),
        })
    }

    /// The rows of `structure.csv`: all motions.
    pub(super) fn table(&self) -> impl Iterator<Item = Row<'_>> {
        self.tracks.iter().flat_map(move |track| {
            ORIGINS.into_iter().flat_map(move |start| {
                let regimes = self.frequencies.iter().zip(&track.regimes[start as usize]);
                regimes.map(move |(frequency, regime)| Row {
                    track,
                    start,
                    frequency: *frequency,
                    motion: MotionName::of_regime(*regime),
                })
            })
        })
    }
}

impl Track<'_> {
    /// z or kind of its motions in order of frequency, each once where it is the same at neighbours.
    pub(super) fn sequence(&self, origin: Origin) -> Vec<String> {
        let regimes = self.regimes[origin as usize].iter();
        let names = regimes.map(|regime| MotionName::of_regime(*regime).word().to_owned());
        let mut names: Vec<String> = names.collect();
        names.dedup();
        names
    }
}

/// A row of `structure.csv`.
pub(super) struct Row<'a> {
    track: &'a Track<'a>,
    start: Origin,
    frequency: f64,
    motion: MotionName,
}

/// The columns of `structure.csv`.
pub(super) fn columns<'a>() -> [Column<Row<'a>>; 6] {
    columns! { Row<'a>, row;
        "rung" [None], "the model's law" => row.track.entry.rung.name();
        "matched" [None], "what it shares with the contact, if anything" => row.track.entry.likeness.map(word);
        "start" [None], "rest, or flung towards the stop" => row.start.name();
        "frequency" [Frequency], "of the drive" => row.frequency;
        "kind" [None], "of the motion: periodic or unsettled" => row.motion.kind;
        "z" [None], "regime z = p/n, if the motion repeats" => row.motion.z.as_deref();
    }
}

/// Ends of the sweep unless they are given, in units of sqrt(k1/m).
const SWEEP: [f64; 2] = [0.95, 1.4];

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

fn regime(scene: &Scene, frequency: f64, origin: Origin) -> Result<Option<Regime>, Failure> {
    let scene = scene.at_frequency(frequency);
    let unit = (scene.stiffness / scene.mass).sqrt();
    let length = scene
        .clearance
        .abs()
        .max(scene.excitation.amplitude / scene.stiffness);
    let velocity = match origin {
        Origin::Rest => 0.0,
        Origin::Flung => FLUNG * length * unit,
    };
    // With interference the mass would stand beyond a rigid stop.
    let position = scene.clearance.min(0.0);
    let start = Start::new(position, velocity);
    let (regime, _) = Regime::after(&scene, start, TRANSIENT)
        .with_context(|| format!("cannot run the sweep at {frequency} rad/s"))?;
    Ok(regime)
}

/// What a regime is, coarsely: no impacts, z = 1, another period, none.
fn kind(regime: Option<Regime>) -> u8 {
    match regime.map(|regime| (regime.impacts, regime.periods)) {
        None => 0,
        Some((0, _)) => 1,
        Some((1, 1)) => 2,
        Some(_) => 3,
    }
}
