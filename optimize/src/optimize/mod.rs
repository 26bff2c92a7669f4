//! `softstop optimize`: the hardest impact inside the hysteresis zone, or of all stable z = 1 motions.

mod cases;
mod met;
mod objective;
pub mod outcome;
mod packing;
mod pareto;
mod progress;
pub mod reference;
mod require;
mod solve;
pub mod study;
mod task;
mod task_spec;
pub mod title;
mod tolerance;
mod toml_leaves;
mod vary;
mod ways;

use std::path::PathBuf;

use clap::Args;
use clap::builder::RangedU64ValueParser;
use softstop::{Machine, Start};
use softstop_console::arguments::MachineArguments;
use softstop_console::budget::Budget;
use softstop_console::export::Export;
use softstop_console::failure::Failure;
use softstop_console::interrupt;
use softstop_console::keep::{Keep, KeepArguments};
use softstop_console::output::{self, Format};
use softstop_console::scene_file;
use softstop_explore::prove::{ProofReport, can_be_proven};

use crate::design::share::MAX_MACHINES;
use crate::fmu::{Standard, archive, library, parameters};
use crate::page::figure::Figure;
use crate::page::figures::{self, figures, response};
use crate::page::html;
use crate::report::OptimizeReport;
use outcome::Outcome;
use packing::{can_be_packed, named};
use solve::solve;
use task::Job;
use vary::VariedParameter;

const EXAMPLES: &str = "\
Examples:
  softstop optimize
      the unloaded machine within stiffness 1 to 30 and clearance 2 to 22
  softstop optimize press.toml --vary clearance=5e-3:40e-3 --vary excitation.frequency_hz=10:40
      a machine in SI units (softstop schema says how it is stated), within what can be built
  softstop optimize loaded --margin 0.1
      with a strip to pierce, closer to the fold: harder, but easier to lose
  softstop optimize --vary stop.stiffness=7 --vary clearance=2:22 --format json
      the paper's stop at its best clearance, for programs
  softstop optimize --vary clearance=10 --vary eta=1.1:1.2 --set stop.preload_deflection=10
      only frequencies that the drive can run at; the preload following the stiffness
  softstop optimize --config task.toml --evaluations 400
      with task.toml (softstop schema task says what it may hold) holding, say,
          machine = \"loaded\"
          set = [\"damping=0.02\"]
          [vary]
          stop.stiffness = 7.0
          clearance = [2.0, 22.0]
          [require]
          margin = 0.25

The hysteresis zone of a machine reaches from g0 to s_SN; the drive frequency is g0 + s (s_SN - g0) with s in
[M, 1 - M]. What --set says of a searched value is held, as by --vary NAME=VALUE.

A machine's file may hold a task (docs/tutorials/press.md takes a press from file to report):
    [vary]                                   what is searched, instead of the usual
    clearance = [5e-3, 40e-3]                a range; a single number is held
    stop.stiffness = { values = [1e7, 2e7] } a catalogue
    contact.damping = { follows = \"stop.stiffness\", factor = 1.8e-4 }
    [tolerance]                              half-widths, or shares of the value
    clearance = 3e-4
    stop.stiffness = \"5 %\"
    damping = { half_width = \"20 %\", distribution = \"normal\", cpk = 1.33 }
    [objective]                              maximise or minimise: velocity, impact_energy, impact_power,
    maximise = \"velocity\"                  stroke_work, drive_force, drive_power, stop_force, cost; lists, such as
                                           maximise = [\"velocity\"], minimise = [\"stop_force\"], give a front of designs
    cost = \"120 + 3e-5 * stop.stiffness\"   a formula over parameters and figures of a motion
    [require]                                a bound on its good side, or { least = 1, most = 2 }
    margin_sn = 0.5                          (softstop schema task lists all that can be required)
    stop_force = 5e5
    run_up = true                            or { ways = [\"frequency_raised\"], ramp_rate = 0.2, force = 5e5 }
    violating = \"0.27 %\"                     of machines with normal tolerances, at most
    starts = { position = [-0.02, 0.02], velocity = [-1, 1] }   the box of starts for certainty
    [[case]]                                 a further operating point, in which all of this holds too
    name = \"worn strip\"
    weight = 0.5                             of what is sought, 1 in the drawing and by default, 0: it only has to hold
    piercing.friction = 2e6                  what is other than in the drawing
    [search]
    evaluations = 2000
    zone = \"z = 1\"                           stable z = 1 below g0 too, where the machine strikes by itself;
                                             \"hysteresis\": beside rest, it has to be started
    [report]                                 title, author and date above the report
    author = \"A. Engineer\"
With tolerances, all machines within them keep the motion and the requirements (of normal ones all but a share), and a million
of them are looked at (--samples).

Files, whole or not at all: report.html (for people, one page), design.json (what --format json prints),
design.toml (the machine, for every command), design.fmu (FMI 2.0 co-simulation, starting in the design's
motion), design.ssv (its parameters for SSP), design.svg (velocity over frequency), CSVs and pictures of the report; of a front pareto.csv and
pareto.svg, and the design with the best of the figure that is named first in the others. Files that only an
earlier run has written there are removed.
Ctrl-C writes the best design so far, marked as such and without its report; a second one ends at once.";

/// Has the tasks checked that stand in machine files, by every command.
pub fn check_tasks() {
    scene_file::check_tasks(task::check);
}

/// The JSON Schema of task files.
pub fn task_schema() -> serde_json::Value {
    task_spec::TaskSpec::schema()
}

/// Arguments of `softstop optimize`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct OptimizeArguments {
    /// Least distance M from both ends of the zone, as a share of its width: 0 to 0.5
    /// [default: 0.25]
    #[arg(long, value_name = "M", allow_negative_numbers = true)]
    pub margin: Option<f64>,
    /// Hold a value, or search a range of it, by its key in the machine's file or its letter: stop.stiffness
    /// [default: 1:30 times k1], clearance [default: 2:22 times F0/k1], excitation.frequency [default: the whole
    /// zone] or any other; repeatable
    #[arg(long, value_name = "NAME=VALUE|LOW:HIGH")]
    pub vary: Vec<VariedParameter>,
    /// Task in a TOML file (softstop schema task says what it may hold); the command line has the last word
    #[arg(long, value_name = "FILE.toml")]
    pub config: Option<PathBuf>,
    /// How to print the result [default: text]
    #[arg(long, value_enum)]
    pub format: Option<Format>,
    /// Folder for design.json, design.svg and design.fmu [default: softstop-design]
    #[arg(long, value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// Zones to compute at most, at least 100; the search ends before when it gains nothing [default: 1200]
    #[arg(long, value_name = "N")]
    pub evaluations: Option<u64>,
    /// Machines looked at within the tolerances
    #[arg(long, value_name = "N", default_value_t = 1 << 20)]
    #[arg(value_parser = RangedU64ValueParser::<usize>::new().range(..=MAX_MACHINES as u64))]
    pub samples: usize,
    /// Work that survey and ascents of the search may cost, in millions of scan windows for each of
    /// --evaluations; a search that would cost more is refused, the same on every computer
    #[arg(long, value_name = "MILLIONS", default_value_t = Budget::ZONE)]
    pub budget: Budget,
    /// Search alone: without report.html, the basin along the zone and the trade-offs
    #[arg(long)]
    pub no_report: bool,
    /// Prove the design's motion by interval arithmetic, with a certificate, proof.json (see softstop prove)
    #[arg(long)]
    pub prove: bool,
    /// Whether it goes on with an earlier one.
    #[command(flatten)]
    pub keep: KeepArguments,
    /// The machine.
    #[command(flatten)]
    pub machine: MachineArguments,
}

/// The files of a run by their kinds, besides the tables.
const FILES: [(&str, &str); 8] = [
    ("json", "design.json"),
    ("svg", "design.svg"),
    ("fmu", "design.fmu"),
    ("toml", "design.toml"),
    ("ssv", "design.ssv"),
    ("html", "report.html"),
    ("pareto_svg", "pareto.svg"),
    ("proof_json", "proof.json"),
];

/// Searches, prints and writes the files.
pub fn run(arguments: &OptimizeArguments) -> Result<(), Failure> {
    let mut job = Job::new(arguments)?;
    can_be_packed(&job.problem)?;
    if arguments.prove {
        can_be_proven(&job.problem.machine)?;
    }
    let mut export = Export::open(&job.output, &FILES)?;
    for ending in [".csv", ".svg"] {
        export.refuse_folders_called(ending)?;
    }
    let library = library(Standard::Fmi2)?;
    let keep = Keep::open(&job.output, "optimize", &job.identity(), arguments.keep)?;
    let mut outcome = match solve(&job, &keep) {
        Err(failure @ Failure::Run(_)) => {
            keep.forget();
            return Err(failure);
        }
        outcome => outcome?,
    };
    job.problem = outcome.solution.problem(&job.problem);
    if let Some(mut front) = outcome.solution.pareto.take() {
        outcome.go_on(|_| pareto::look_at_machines(&job, &mut front))?;
        outcome.solution.pareto = Some(front);
    }
    let mut report = match outcome.go_on(|outcome| look_at(&job, outcome, true))? {
        Some(report) => report,
        None => look_at(&job, &outcome, false)?,
    };
    let state = outcome.design().orbit.state();
    let start = Start::from(state);
    let machine = Machine {
        start,
        ..named(&job.problem, &outcome)
    };
    let text = machine.to_toml();
    export.file("toml", text.as_bytes())?;
    // The same machine to the last bit, though no number of Hz may give the frequency that was found.
    let machine = Machine::from_toml(&text).map_err(anyhow::Error::from)?;
    // The files of a design are written even if its motion cannot be proven.
    let proof = arguments
        .prove
        .then(|| ProofReport::of_single(&machine, state));
    let (proof, unproven) = match proof.transpose() {
        Ok(proof) => (proof, None),
        Err(failure) => (None, Some(failure)),
    };
    report.proof = proof.as_ref().map(ProofReport::figures);
    let name = job.problem.machine.name.as_deref().unwrap_or_default();
    let page = (!report.figures.is_empty()).then(|| html(&report));
    let drawn = |it: &Option<Figure>| it.as_ref().map(|it| it.document(name));
    for (kind, text) in [
        ("proof_json", proof.map(|it| output::json(&it)).transpose()?),
        ("svg", drawn(&report.response)),
        ("pareto_svg", drawn(&report.front)),
        ("html", page.transpose().map_err(anyhow::Error::from)?),
    ] {
        match text {
            Some(text) => export.file(kind, text.as_bytes())?,
            None => export.forgo(kind),
        }
    }
    export.file("fmu", &archive(&library, &machine, start)?)?;
    export.file("ssv", parameters(&machine, start)?.as_bytes())?;
    if let Some(front) = &report.pareto {
        export.sheets([&front.sheet])?;
    }
    if !report.figures.is_empty() {
        export.sheets(&report.sheets())?;
    }
    // What has no data of its own stands in the page alone.
    for figure in &report.figures {
        if let Some(sheet) = figure.sheets.first() {
            export.picture(&sheet.name, &figure.document(name))?;
        }
    }
    export.finish(&report, report.text(), job.format)?;
    if let Some(interrupted) = outcome.interrupted {
        interrupt::under_way().closing = interrupted.closing();
        return Err(Failure::Interrupted);
    }
    keep.forget();
    unproven.map_or(Ok(()), Err)
}

/// The report of what is looked at of a design; of an unfinished run only what takes no time.
fn look_at(job: &Job, outcome: &Outcome, is_whole: bool) -> Result<OptimizeReport, Failure> {
    let (problem, design) = (&job.problem, outcome.design());
    let references = reference::references(&problem.machine)?;
    let study = match is_whole {
        true => study::study(job, outcome)?,
        false => None,
    };
    let study = study.as_ref();
    let evaluations = job.settings.evaluations;
    let mut report = OptimizeReport::new(problem, outcome, &references, study, evaluations);
    report.title = job.title.clone();
    report.sources = job.sources.clone();
    report.response = Some(response(problem, design, &references, study));
    let front = outcome.solution.pareto.as_ref();
    report.front = front.map(|it| figures::pareto(problem, it));
    if is_whole && job.report {
        let (figures, missing) = figures(problem, outcome, study);
        report.figures = figures;
        report.warnings.extend(missing);
    }
    Ok(report)
}
