//! `softstop fidelity`: how simple a model of a scene may be.

mod chart;
pub mod models;
mod report;
mod structure;
mod study;

use std::path::PathBuf;

use clap::builder::{StringValueParser, TypedValueParser};
use clap::{Args, ValueEnum};
use models::{MatchedProperty, Quantity};
use softstop::Allowed;

use report::report;
use softstop_console::arguments::{
    CommandArguments, refuse_followers_of_frequency, refuse_stop_below,
};
use softstop_console::column;
use softstop_console::export::Export;
use softstop_console::failure::Failure;
use softstop_console::range::{self, within};
use structure::RegimeStructure;
use study::ModelComparison;

const EXAMPLES: &str = "\
Examples:
  softstop fidelity B --quantity before_impact_velocity --tolerance 1e-3
      the paper's piercing machine: which model gives the velocity to a thousandth?
  softstop fidelity A --quantity impact_phase --tolerance 1e-3
      the unloaded machine; the answer depends on what is asked
  softstop fidelity docs/scenes/stiff.toml --tolerance 0.02 --format json
      any machine; a stiff stop may well be taken as rigid
  softstop fidelity B --predictive
      models matched at the velocity of their own motion, as if that of B were unknown
  softstop fidelity A --structure
      also the regimes z = p/n of all models over 91 frequencies, from two starts

The models, simple ones first: linear (no stop), rigid (with the contact's restitution),
kelvinVoigt (a spring beside a damper), preloaded (the scene's own stop without the strip before
it), hertz (a sphere with Hunt and Crossley's dissipation), full (the scene itself). Each agrees
with the scene's contact at one velocity: in its restitution and, if it is soft, in its largest
penetration or its duration. docs/fidelity.md has the models and names the sources of their formulas.

The error is that of the model, not of computing: all motions are exact. The cost that decides is
the number of evaluations of the law of force, which is the same on every machine; times are
medians, measured turn and turn about. Files, whole or not at all: fidelity.csv, fidelity.svg and,
with --structure, structure.csv and structure.svg.";

/// Arguments of `softstop fidelity`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, after_long_help = help(), allow_negative_numbers = true)]
pub struct FidelityArguments {
    /// What the model is wanted for
    #[arg(long, value_name = "QUANTITY", value_parser = quantity(),
          default_value = Quantity::BeforeImpactVelocity.name())]
    pub quantity: Quantity,
    /// Largest error of the quantity, relative to the machine's own (of impact_phase a share of the drive period), >= 0
    #[arg(long, value_name = "SHARE", default_value_t = 1e-3)]
    pub tolerance: f64,
    /// What soft models have in common with the contact, besides the restitution
    #[arg(long = "match", value_enum, value_name = "WHAT", default_value_t)]
    pub matched: Matched,
    /// Match each model at the velocity of its own motion, not of the scene's
    #[arg(long)]
    pub predictive: bool,
    /// Compare the regimes of all models over a range of drive frequencies
    #[arg(long)]
    pub structure: bool,
    /// Drive frequencies of --structure [default: 0.95 to 1.4 times sqrt(k1/m)]
    #[arg(long, value_name = "LOW:HIGH", value_parser = range::rising, requires = "structure")]
    pub sweep: Option<[f64; 2]>,
    /// How many of them, 2 to 10000
    #[arg(long, value_name = "N", default_value_t = 91, requires = "structure")]
    pub points: u64,
    /// Drive periods that are timed, 1 to 1000000
    #[arg(long, value_name = "N", default_value_t = 1000)]
    pub periods: u64,
    /// How often they are timed, 1 to 1000
    #[arg(long, value_name = "N", default_value_t = 9)]
    pub repeats: u64,
    /// Draw the models small, without titles
    #[arg(long)]
    pub small: bool,
    /// Folder for the files
    #[arg(long, value_name = "DIR", default_value = "softstop-fidelity")]
    pub output: PathBuf,
    /// How it prints its result, the machine, and what it may cost.
    #[command(flatten)]
    pub common: CommandArguments,
}

/// What soft models have in common with the contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum Matched {
    /// The largest penetration: the energy stored there
    Penetration,
    /// The duration of the contact
    Duration,
    /// Two models, one of each
    #[default]
    Both,
}

impl Matched {
    const fn likenesses(self) -> &'static [MatchedProperty] {
        match self {
            Self::Penetration => &[MatchedProperty::Penetration],
            Self::Duration => &[MatchedProperty::Duration],
            Self::Both => &[MatchedProperty::Penetration, MatchedProperty::Duration],
        }
    }
}

/// Reads a quantity by its name; hyphens stand for underscores.
fn quantity() -> impl TypedValueParser<Value = Quantity> {
    let names = Quantity::ALL.map(Quantity::name);
    StringValueParser::new().try_map(move |given| {
        let name = given.replace('-', "_");
        let mut all = Quantity::ALL.into_iter();
        let found = all.find(|quantity| quantity.name() == name);
        found.ok_or_else(|| format!("must be one of {}", names.join(", ")))
    })
}

const FILES: [(&str, &str); 4] = [
    ("fidelity_csv", "fidelity.csv"),
    ("fidelity_svg", "fidelity.svg"),
    ("structure_csv", "structure.csv"),
    ("structure_svg", "structure.svg"),
];

fn help() -> String {
    let structure = column::help("structure.csv", &structure::columns());
    EXAMPLES.to_owned() + &column::help("fidelity.csv", &report::columns()) + &structure
}

/// Compares the models, writes the files and prints the result.
pub fn run(arguments: &FidelityArguments) -> Result<(), Failure> {
    check(arguments)?;
    let machine = arguments.common.machine.machine()?;
    refuse_stop_below(&machine)?;
    let frequencies = arguments.structure;
    let frequencies = frequencies.then(|| structure::frequencies(&machine, arguments));
    let frequencies = frequencies.transpose()?;
    let files = &FILES[..if arguments.structure { 4 } else { 2 }];
    let export = Export::open(&arguments.output, files)?;
    if arguments.structure {
        refuse_followers_of_frequency(&machine)?;
    }
    let limit = arguments.common.limit.budget;
    let study = limit.limit(|| ModelComparison::new(&machine, arguments))?;
    let structure = frequencies.map(|frequencies| {
        let motions = RegimeStructure::motion_count(&study, frequencies.len());
        limit.limit_many(motions, || {
            RegimeStructure::new(&machine, &study, frequencies)
        })
    });
    let structure = structure.transpose()?;
    let chart = chart::models(arguments, &machine, &study);
    let rows = report::rows(&machine, &study);
    let kinds = ["fidelity_csv", "fidelity_svg"];
    let chart = if arguments.small {
        chart.small()
    } else {
        chart
    };
    export.sheet(kinds, &report::columns(), rows, &chart.svg())?;
    if let Some(structure) = &structure {
        let kinds = ["structure_csv", "structure_svg"];
        let chart = chart::regimes(&machine, structure);
        export.sheet(kinds, &structure::columns(), structure.rows(), &chart)?;
    }
    let (result, text) = report(arguments, (&machine, &study), structure.as_ref());
    export.finish(&result, text, arguments.common.format)
}

fn check(arguments: &FidelityArguments) -> Result<(), Failure> {
    Allowed::NotNegative.check("tolerance", arguments.tolerance)?;
    within("points", arguments.points, 2..=10_000)?;
    within("periods", arguments.periods, 1..=1_000_000)?;
    within("repeats", arguments.repeats, 1..=1000)
}
