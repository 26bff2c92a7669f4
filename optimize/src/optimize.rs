//! `softstop optimize`: the hardest impact inside the hysteresis zone.

mod best;
mod branch;
mod chart;
mod configuration;
mod fmu;
mod task;

use std::collections::BTreeMap;
use std::path::PathBuf;

use anyhow::Context;
use clap::Args;
use softstop_dynamics::orbit::{self, Orbit};

use crate::design::search::{self, SearchError};
use crate::design::{Design, Problem};
use crate::library::library;
use crate::optimize::chart::Chart;
use crate::report::{self, DesignReport, OptimizeReport, ReferenceReport, SearchReport};
use best::Best;
use softstop_console::failure::Failure;
use softstop_console::machine::{Regime, SceneSettings};
use softstop_console::output::{self, Folder, Format};
use task::{Job, Named};

const EXAMPLES: &str = "\
Examples:
  softstop optimize
      the unloaded machine within stiffness 1 to 30 and clearance 2 to 22
  softstop optimize --regime loaded --margin 0.1
      with a strip to pierce, closer to the fold: harder, but easier to lose
  softstop optimize --fix stiffness=7 --bounds clearance=2:22 --format json
      the paper's stop at its best clearance, for programs
  softstop optimize --fix clearance=10 --bounds frequency=1.1:1.2 --preload-deflection 10
      only frequencies that the drive can run at; the preload following the stiffness
  softstop optimize --config task.toml --seed 1
      with task.toml holding, say,
          regime = \"loaded\"
          margin = 0.25
          [fix]
          stiffness = 7.0
          [bounds]
          clearance = [2.0, 22.0]
          [scene]
          damping = 0.02

The zone of a stiffness and clearance reaches from g0 to s_SN; the drive frequency is
eta = g0 + s (s_SN - g0) with s in [M, 1 - M]. A value given for --stiffness, --clearance or
--frequency is held, as by --fix. Three files are written, whole or not at all: design.json
(what --format json prints), design.svg (velocity over frequency) and design.fmu (the machine
for FMI 2.0 co-simulation, starting in the design's motion).";

/// Arguments of `softstop optimize`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct OptimizeArguments {
    /// Least distance M from both ends of the zone, as a share of its width: 0 to 0.5
    /// [default: 0.25]
    #[arg(long, value_name = "M", allow_negative_numbers = true)]
    pub margin: Option<f64>,
    /// Hold a value: stiffness, clearance or frequency; repeatable
    #[arg(long, value_name = "NAME=VALUE")]
    pub fix: Vec<Named<f64>>,
    /// Search a range: stiffness [default: 1:30], clearance [default: 2:22] or frequency
    /// [default: the whole zone]; repeatable
    #[arg(long, value_name = "NAME=LOW:HIGH")]
    pub bounds: Vec<Named<[f64; 2]>>,
    /// Task in a TOML file, by the same names; the command line has the last word
    #[arg(long, value_name = "FILE.toml")]
    pub config: Option<PathBuf>,
    /// How to print the result [default: text]
    #[arg(long, value_enum)]
    pub format: Option<Format>,
    /// Folder for design.json, design.svg and design.fmu [default: softstop-design]
    #[arg(long, value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// Seed of the search: the same one gives the same result [default: 0]
    #[arg(long, value_name = "N")]
    pub seed: Option<u64>,
    /// Zones to compute at most, at least 100 [default: 1200]
    #[arg(long, value_name = "N")]
    pub evaluations: Option<u64>,
    /// The machine.
    #[command(flatten)]
    pub machine: SceneSettings,
}

/// Searches, prints and writes the files.
///
/// # Errors
/// [`Failure::Usage`] for values that cannot be, [`Failure::Run`] if no design is found or
/// the folder cannot be written, [`Failure::Interrupted`] after Ctrl-C.
pub fn run(arguments: &OptimizeArguments) -> Result<(), Failure> {
    let job = Job::new(arguments)?;
    let folder = Folder::open(&job.output, &[JSON, CHART, FMU])?;
    let library = library()?;
    let design = solve(&job)?;
    let references = References::find()?;
    let report = compose(&job, &design, &references, &folder);
    let json = output::json(&report)?;
    let chart = chart(&job, &design, &references)?;
    folder.stage(JSON, json.as_bytes())?;
    folder.stage(CHART, chart.svg().as_bytes())?;
    folder.stage(FMU, &fmu::archive(&library, &design)?)?;
    folder.commit(&[JSON, CHART, FMU])?;
    output::print(&match job.format {
        Format::Json => json,
        Format::Text => report::text::optimize(&report),
    })
}

fn solve(job: &Job) -> Result<Design, Failure> {
    let best = Best::new(job.settings.evaluations);
    let outcome = search::search(&job.problem, job.settings, &best);
    drop(best);
    outcome.map_err(|error| match error {
        SearchError::Stopped => Failure::Interrupted,
        error => Failure::Run(error.into()),
    })
}

/// The paper's points A and B.
struct References {
    unloaded: Orbit,
    loaded: Orbit,
}

impl References {
    fn find() -> Result<Self, Failure> {
        let find = |regime: Regime| -> anyhow::Result<Orbit> {
            let scene = regime.ratios().scene()?;
            orbit::find(&scene).with_context(|| format!("the paper's point {}", regime.point()))
        };
        Ok(Self {
            unloaded: find(Regime::Unloaded)?,
            loaded: find(Regime::Loaded)?,
        })
    }

    fn of(&self, regime: Regime) -> &Orbit {
        match regime {
            Regime::Unloaded => &self.unloaded,
            Regime::Loaded => &self.loaded,
        }
    }

    fn reports(&self, velocity: f64) -> BTreeMap<&'static str, ReferenceReport> {
        [Regime::Unloaded, Regime::Loaded]
            .map(|regime| {
                (
                    regime.point(),
                    ReferenceReport::new(regime, self.of(regime), velocity),
                )
            })
            .into()
    }
}

const JSON: &str = "design.json";
const CHART: &str = "design.svg";
const FMU: &str = "design.fmu";

fn compose(job: &Job, design: &Design, references: &References, folder: &Folder) -> OptimizeReport {
    let Problem {
        stiffness,
        clearance,
        frequency,
        ..
    } = job.problem;
    let bounds = [
        ("stiffness", stiffness),
        ("clearance", clearance),
        ("frequency", frequency),
    ];
    let files = [("json", JSON), ("svg", CHART), ("fmu", FMU)];
    OptimizeReport {
        design: DesignReport::new(&job.problem, design),
        reference: references.reports(design.before_impact_velocity()),
        search: SearchReport {
            bounds: bounds.map(|(name, range)| (name, range.to_string())).into(),
            seed: job.settings.seed,
            evaluations: job.settings.evaluations,
        },
        files: files
            .map(|(kind, name)| (kind, folder.place(name).display().to_string()))
            .into(),
    }
}

fn chart(job: &Job, design: &Design, references: &References) -> Result<Chart, Failure> {
    let Problem {
        machine, margin, ..
    } = job.problem;
    let chart = Chart::new(
        design,
        margin,
        machine.regime,
        references.of(machine.regime),
    )
    .context("cannot draw the chart")?;
    Ok(chart)
}
