//! The result, in the machine's own units.

use std::collections::BTreeMap;

use serde::Serialize;
use serde_json::json;
use softstop::{Dimension, Machine, Start};
use softstop_dynamics::models::Quantity;
use softstop_dynamics::zone::Bounds;

use super::FidelityArguments;
use super::structure::{Structure, Track, kind};
use super::study::{Entry, Name, Study, Unmatched};
use softstop_console::arguments::title;
use softstop_console::column::{Column, Told, Unit, Units};
use softstop_console::export::Report;
use softstop_console::record::{Record, below};
use softstop_console::report::{MachineReport, MotionName};
use softstop_console::table::heading;
use softstop_console::{columns, units};

/// A row of `fidelity.csv`: a quantity of a model.
#[derive(Clone, Copy)]
pub(super) struct Row<'a> {
    machine: &'a Machine,
    study: &'a Study,
    model: &'a Entry,
    quantity: Quantity,
}

/// The columns of `fidelity.csv`; from the fourth to the sixth they are what an answer is in JSON.
pub(super) fn columns<'a>() -> [Column<Row<'a>>; 8] {
    columns! { Row<'a>, it;
        "rung" [None], "the model's law" => it.model.name.rung.name();
        "matched" [None], "what it shares with the contact, if anything" => it.model.name.word();
        "quantity" [None], "what is compared" => it.quantity.name();
        "unit" [None], "of its value" => unit(it.machine, it.quantity);
        "value" [Of("unit")], "of the model" => own(it.machine, it.quantity, it.quantity.value(&it.model.answers));
        "error" [None], "relative to the machine's own value" => it.quantity.error(&it.study.truth, &it.model.answers);
        "evaluations_per_period" [None], "of the law of force" => it.model.cost.evaluations_per_period;
        "microseconds_per_period" [Of("us")], "median" => it.model.cost.microseconds_per_period;
    }
}

/// The rows of `fidelity.csv`: all quantities of all models.
pub(super) fn rows<'a>(machine: &'a Machine, study: &'a Study) -> impl Iterator<Item = Row<'a>> {
    study.entries.iter().flat_map(move |model| {
        Quantity::ALL.into_iter().map(move |quantity| Row {
            machine,
            study,
            model,
            quantity,
        })
    })
}

/// The unit of a quantity as the machine has it.
fn unit(machine: &Machine, quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::Regime => "impacts per period",
        _ => units::name(machine, quantity.dimension()),
    }
}

/// A value of a quantity in the machine's own units.
fn own(machine: &Machine, quantity: Quantity, value: Option<f64>) -> Option<f64> {
    value.map(|value| machine.to_own(quantity.dimension(), value))
}

/// What is told of a model.
fn figures<'a>() -> [Column<Row<'a>>; 4] {
    columns! { Row<'a>, it;
        "value" [None] Fixed(6), "of the quantity" => own(it.machine, it.quantity, it.quantity.value(&it.model.answers));
        "error" [None] Plain, "of it" => error(it.model.error);
        "evaluations_per_period" [None] Fixed(1), "of the law of force" => it.model.cost.evaluations_per_period;
        "microseconds_per_period" [None] Fixed(2), "median" => it.model.cost.microseconds_per_period;
    }
}

fn error(error: Option<f64>) -> Told {
    Told {
        value: json!(error),
        words: match error {
            None => "no value".to_owned(),
            Some(0.0) => "0".to_owned(),
            Some(error) if error.is_finite() => format!("{error:.2e}"),
            Some(_) => "other".to_owned(),
        },
    }
}

type Tracked<'a> = (&'a Machine, &'a Structure<'a>, &'a Track<'a>);

/// What is told of the regimes of a model.
fn tracks<'a>() -> [Column<Tracked<'a>>; 7] {
    columns! { Tracked<'a>, it;
        "same_regime" [None] Percent(1), "share" => it.1.agreement(it.2, |regime| regime);
        "same_kind" [None] Percent(1), "share" => it.1.agreement(it.2, kind);
        "grazing_frequency" [Frequency] Fixed(6), "g0" => bound(it, |it| it.grazing);
        "flip_frequency" [Frequency] Fixed(6), "s_PD" => bound(it, |it| it.flip);
        "fold_frequency" [Frequency] Fixed(6), "s_SN" => bound(it, |it| it.fold);
        "sequence_from_rest" [None], "regimes in order of frequency" => sequence(it.2, 0);
        "sequence_flung" [None], "the same, flung" => sequence(it.2, 1);
    }
}

fn bound((machine, _, track): &Tracked, one: fn(&Bounds) -> Option<f64>) -> Option<f64> {
    let bound = track.entry.answers.bounds.as_ref().and_then(one);
    own(machine, Quantity::FoldFrequency, bound)
}

fn sequence(track: &Track, start: usize) -> Told {
    Told {
        value: track.sequence(start).into(),
        words: String::new(),
    }
}

/// A model.
#[derive(Debug, Serialize)]
struct ModelReport {
    #[serde(flatten)]
    name: Name,
    is_scene: bool,
    /// The machine with this stop.
    machine: MachineReport,
    /// What it settles on.
    #[serde(flatten)]
    motion: MotionName,
    /// Of the quantity that was asked for.
    #[serde(flatten)]
    figures: Record,
    /// All quantities.
    answers: BTreeMap<&'static str, Record>,
}

impl ModelReport {
    fn new(row: Row) -> Self {
        let entry = row.model;
        let answer = |quantity: Quantity| Record::of(&columns()[3..6], &Row { quantity, ..row });
        Self {
            name: entry.name,
            is_scene: entry.is_truth,
            machine: MachineReport::of(&Machine {
                scene: entry.scene.clone(),
                preload_deflection: None,
                ..row.machine.clone()
            }),
            motion: MotionName::of_regime(entry.answers.observed.regime),
            figures: Record::of(&figures(), &row),
            answers: Quantity::ALL.map(|it| (it.name(), answer(it))).into(),
        }
    }
}

/// The regimes of a model over the sweep.
#[derive(Debug, Serialize)]
struct TrackReport {
    #[serde(flatten)]
    name: Name,
    #[serde(flatten)]
    figures: Record,
}

/// The whole result.
#[derive(Debug, Serialize)]
pub(super) struct FidelityReport<'a> {
    machine: MachineReport,
    /// Where its motion starts.
    start: Start,
    quantity: Quantity,
    unit: &'static str,
    tolerance: f64,
    /// The scene's own value.
    value: Option<f64>,
    /// Before-impact velocity of the machine's motion.
    operating_velocity: Option<f64>,
    predictive: bool,
    cheapest: Option<Name>,
    cheapest_is_scene: bool,
    models: Vec<ModelReport>,
    unmatched: Vec<Unmatched>,
    structure: Option<Vec<TrackReport>>,
    #[serde(skip)]
    of: (&'a Machine, &'a Study),
}

impl<'a> FidelityReport<'a> {
    pub(super) fn new(
        arguments: &FidelityArguments,
        (machine, study): (&'a Machine, &'a Study),
        structure: Option<&Structure>,
    ) -> Self {
        let quantity = arguments.quantity;
        let cheapest = study.cheapest(arguments.tolerance);
        let models = rows(machine, study).filter(|row| row.quantity == quantity);
        let track = |structure, track: &Track| TrackReport {
            name: track.entry.name,
            figures: Record::of(&tracks(), &(machine, structure, track)),
        };
        let regimes = structure.map(|it| it.tracks.iter().map(|own| track(it, own)).collect());
        Self {
            machine: MachineReport::of(machine),
            start: machine.start,
            quantity,
            unit: unit(machine, quantity),
            tolerance: arguments.tolerance,
            value: own(machine, quantity, quantity.value(&study.truth)),
            operating_velocity: study.velocity,
            predictive: arguments.predictive,
            cheapest: cheapest.map(|entry| entry.name),
            cheapest_is_scene: cheapest.is_some_and(|entry| entry.is_truth),
            models: models.map(ModelReport::new).collect(),
            unmatched: study.unmatched.clone(),
            structure: regimes,
            of: (machine, study),
        }
    }

    /// Which model to take.
    fn advice(&self, units: &Units) -> String {
        let matched = match self.operating_velocity {
            _ if self.predictive => {
                "Matched at the velocity of each model's own motion.".to_owned()
            }
            Some(velocity) => {
                let unit = units.name(Unit::Own(Dimension::Velocity));
                let matched = format!("Matched at the machine's own {velocity:.6} {unit}");
                matched.trim_end().to_owned() + "."
            }
            None => "The scene's motion has no impact.".to_owned(),
        };
        let tolerance = self.tolerance;
        let found = match self.cheapest {
            None => format!("No model is within {tolerance}."),
            Some(name) if self.cheapest_is_scene => format!(
                "Within {tolerance} nothing costs less than the scene itself ({name}): take it as it is."
            ),
            Some(name) => format!("The cheapest model within {tolerance}: {name}."),
        };
        format!("{matched} Costs are per drive period.\n{found}\n")
    }
}

impl Report for FidelityReport<'_> {
    fn text(&self) -> String {
        let (machine, study) = self.of;
        let units = Units::of(machine);
        let table = |figures: Vec<&Record>| {
            let named = figures.into_iter().zip(&study.entries).map(|(it, entry)| {
                let name = Record::default().with("model", "", entry.full_name());
                name.and(it.clone())
            });
            below(&named.collect::<Vec<_>>(), &units)
        };
        let models = table(self.models.iter().map(|it| &it.figures).collect());
        let value = units.label(self.quantity.name(), Unit::Of(self.unit));
        let mut text = heading(&format!("Models of {} for its {value}", title(machine)));
        text += &format!("{models}\n{}", self.advice(&units));
        for Unmatched { name, reason } in &self.unmatched {
            text += &format!("Without a model: {name}: {reason}\n");
        }
        if let Some(tracks) = &self.structure {
            let title = heading("Regimes over the sweep, from rest and from a flung start");
            let tracks = table(tracks.iter().map(|it| &it.figures).collect());
            text += &format!("\n{title}{tracks}");
        }
        text
    }
}
