//! The study as its file states it, checked.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use softstop::{Machine, Parameter};
use softstop_console::arguments::{MachineArguments, refuse_without_zone};
use softstop_console::budget::Budget;
use softstop_console::change::Change;
use softstop_console::failure::Failure;
use softstop_console::machine::PaperMachine;
use softstop_console::range::{require, within};
use softstop_console::{record_log, scene_file};
use softstop_dynamics::settled::Settling;
use softstop_dynamics::spread_points::MAX_DIMENSIONS;

use super::axis::{AxisSettings, StudyAxis};
use super::certainty::Certainty;
use super::outputs::{Need, StudyOutput};

/// The file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    machine: Option<PathBuf>,
    #[serde(default)]
    set: Vec<Change>,
    axis: Vec<AxisSettings>,
    samples: Option<u64>,
    #[serde(default)]
    seed: u32,
    outputs: Vec<String>,
    #[serde(default)]
    motion: Motion,
    #[serde(default)]
    certainty: Certainty,
}

/// The table `[motion]`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct Motion {
    periods: u64,
    watched: Option<u64>,
    longest: Option<u64>,
    tolerance: f64,
}

impl Default for Motion {
    fn default() -> Self {
        let tolerance = Settling::default().tolerance;
        Self {
            // Watching costs as much again: it is to be a small part.
            periods: 1000,
            watched: None,
            longest: None,
            tolerance,
        }
    }
}

/// Times as many drive periods that a motion is followed if it has not returned, unless the study says how many.
const PATIENCE: u64 = 16;

/// Most points: Parquet has no room for more row groups.
pub(super) const MOST: u64 = 4_000_000_000;

/// A study.
#[derive(Debug)]
pub struct Study {
    /// The machine; what axes change plays no part.
    pub(super) machine: Machine,
    /// The same without words: there is one at each point.
    pub(super) wordless: Machine,
    pub(super) axes: Vec<StudyAxis>,
    /// Samples at each point of the grid, if any axis is drawn.
    pub(super) samples: Option<u64>,
    pub(super) seed: u32,
    pub(super) outputs: Vec<StudyOutput>,
    pub(super) settling: Settling,
    pub(super) certainty: Certainty,
    /// What a point may cost.
    pub(super) budget: Budget,
    /// Points of the grid times samples.
    pub(super) points: u64,
    /// What studies that come to the same have in common.
    pub(super) hash: String,
}

impl Study {
    /// Reads a file.
    ///
    /// # Errors
    /// [`Failure::Usage`] naming the file, the key, its value and what is allowed.
    pub fn read(path: &Path, budget: Budget) -> Result<Self, Failure> {
        let file: File = scene_file::read_toml(path)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        Self::new(file, folder, budget).map_err(|failure| failure.in_file(path))
    }

    fn new(file: File, folder: &Path, budget: Budget) -> Result<Self, Failure> {
        let machine = machine(&file, folder)?;
        if file.axis.is_empty() || file.axis.len() > MAX_DIMENSIONS as usize {
            let many = file.axis.len();
            return Err(Failure::usage(format!(
                "axis: there are {many}, must be 1 to {MAX_DIMENSIONS}"
            )));
        }
        let axes = file
            .axis
            .iter()
            .map(|stated| StudyAxis::new(&machine, stated));
        let axes: Vec<StudyAxis> = axes.collect::<Result<_, _>>()?;
        for (index, axis) in axes.iter().enumerate() {
            if axes[..index]
                .iter()
                .any(|other| other.target == axis.target)
            {
                let name = &axis.name;
                return Err(Failure::usage(format!("axis {name}: there are two of it")));
            }
        }
        let is_drawn = axes.iter().any(|axis| axis.draw().is_some());
        match file.samples {
            None if is_drawn => {
                return Err(Failure::usage("samples: must say how many are drawn"));
            }
            Some(_) if !is_drawn => {
                return Err(Failure::usage(
                    "samples: plays no part, no axis has sample = \"random\" or \"sobol\"",
                ));
            }
            samples => within("samples", samples.unwrap_or(1), 1..=MOST)?,
        }
        let own = axes.iter().filter_map(|axis| axis.values.count());
        let counts = own.chain(file.samples);
        let points = counts.clone().try_fold(1u64, u64::checked_mul);
        let Some(points) = points.filter(|points| *points <= MOST) else {
            let all: f64 = counts.clone().map(|count| count as f64).product();
            let counts: Vec<String> = counts.map(|count| count.to_string()).collect();
            return Err(Failure::usage(format!(
                "{} = {all:e} points: must be at most {MOST}; take fewer, split the study, or draw samples instead \
                 of a grid",
                counts.join(" x ")
            )));
        };
        let outputs = outputs(&file.outputs)?;
        let is_over_frequencies =
            |it: &&StudyOutput| it.needs(Need::Zone) || it.needs(Need::Grazing);
        if let Some(output) = outputs.iter().find(is_over_frequencies) {
            refuse_without_zone(&machine).map_err(|failure| match failure {
                Failure::Usage(what) => Failure::usage(format!("outputs: {}: {what}", output.name)),
                failure => failure,
            })?;
        }
        let mut study = Self {
            settling: settling(&file.motion)?,
            certainty: file.certainty.checked()?,
            budget,
            samples: file.samples,
            seed: file.seed,
            wordless: Machine {
                name: None,
                description: None,
                ..machine.clone()
            },
            machine,
            axes,
            outputs,
            points,
            hash: String::new(),
        };
        study.hash = record_log::fingerprint(&study.identity())?;
        Ok(study)
    }

    /// What all that it comes to follows from.
    fn identity(&self) -> impl Serialize + use<> {
        let machine = &self.machine;
        let stated = (
            machine.preload_deflection,
            machine.to_own(softstop::Dimension::Frequency, 1.0),
            machine.to_own(softstop::Dimension::Damping, 1.0),
            [machine.start.position, machine.start.velocity],
            Parameter::ALL.map(|it| machine.expression(it).map(str::to_owned)),
        );
        let axes = self.axes.iter();
        let axes: Vec<_> = axes
            .map(|axis| (axis.name.clone(), axis.values.clone()))
            .collect();
        let outputs: Vec<&str> = self.outputs.iter().map(|output| output.name).collect();
        let drawn = (self.samples, self.seed);
        let how = (self.settling, self.certainty, self.budget);
        (machine.scene.clone(), stated, axes, drawn, outputs, how)
    }
}

/// The machine, seen from the file's folder.
fn machine(file: &File, folder: &Path) -> Result<Machine, Failure> {
    let named = file.machine.as_ref();
    let named = named.map(|machine| match PaperMachine::called(machine) {
        Some(_) => machine.clone(),
        None => folder.join(machine),
    });
    let arguments = MachineArguments {
        machine: named,
        set: file.set.clone(),
    };
    arguments.machine()
}

fn outputs(names: &[String]) -> Result<Vec<StudyOutput>, Failure> {
    let mut outputs: Vec<StudyOutput> = Vec::new();
    for name in names {
        let output = StudyOutput::named(name).ok_or_else(|| {
            let all: Vec<&str> = StudyOutput::all().map(|it| it.name).collect();
            Failure::usage(format!(
                "outputs: {name:?} is not known; there are {}",
                all.join(", ")
            ))
        })?;
        if outputs.iter().any(|it| it.name == name) {
            return Err(Failure::usage(format!("outputs: {name:?} stands twice")));
        }
        outputs.push(output);
    }
    match outputs.is_empty() {
        true => Err(Failure::usage("outputs = []: must name one")),
        false => Ok(outputs),
    }
}

fn settling(motion: &Motion) -> Result<Settling, Failure> {
    let Motion {
        periods,
        watched,
        longest,
        tolerance,
    } = *motion;
    within("motion.periods", periods, 16..=1_000_000)?;
    let watched = watched.unwrap_or(Settling::default().watched.min(periods));
    within("motion.watched", watched, 16..=periods.min(4096))?;
    let longest = longest.unwrap_or(PATIENCE * periods);
    within("motion.longest", longest, periods..=PATIENCE * 1_000_000)?;
    let fits = tolerance > 0.0 && tolerance < 1.0;
    require(fits, "motion.tolerance", tolerance, "> 0 and < 1")?;
    Ok(Settling {
        periods,
        watched,
        longest,
        tolerance,
    })
}
