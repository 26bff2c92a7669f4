//! The result: plain data whose field names are the keys of the JSON.

use std::collections::BTreeMap;

use serde::Serialize;
use softstop::{Dimension, Language, Machine, Start};
use softstop_dynamics::models::{Likeness, Quantity, Rung};
use softstop_dynamics::zone::Bounds;

use super::cost::Cost;
use super::structure::{Agreement, Origin, Structure, Track};
use super::study::{Entry, Missing, Study, name};
use super::{FidelityArguments, word};
use crate::fidelity::chart::{Candidate, FidelityPicture};
use softstop_console::arguments::title;
use softstop_console::column::{Column, Units};
use softstop_console::columns;
use softstop_console::report::{MachineReport, MotionName};
use softstop_console::units;

/// A model by its name.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub(super) struct Named {
    pub(super) rung: Rung,
    /// What it has in common with the contact.
    pub(super) matched: Option<&'static str>,
    #[serde(skip)]
    likeness: Option<Likeness>,
}

/// A quantity of a model.
#[derive(Debug, Clone, Copy, Serialize)]
struct Answer {
    value: Option<f64>,
    unit: &'static str,
    error: Option<f64>,
}

/// A model.
#[derive(Debug, Clone, Serialize)]
pub(super) struct ModelReport {
    #[serde(flatten)]
    pub(super) named: Named,
    pub(super) is_scene: bool,
    /// The machine with this stop.
    machine: MachineReport,
    /// What it settles on.
    #[serde(flatten)]
    motion: MotionName,
    /// Of the quantity that was asked for.
    pub(super) value: Option<f64>,
    pub(super) error: Option<f64>,
    #[serde(flatten)]
    pub(super) cost: Cost,
    /// All quantities.
    answers: BTreeMap<&'static str, Answer>,
}

/// A rung without a model.
#[derive(Debug, Clone, Serialize)]
pub(super) struct UnmatchedReport {
    #[serde(flatten)]
    pub(super) named: Named,
    pub(super) reason: String,
}

/// The regimes of a model over the sweep.
#[derive(Debug, Clone, Serialize)]
pub(super) struct TrackReport {
    #[serde(flatten)]
    pub(super) named: Named,
    #[serde(flatten)]
    pub(super) agreement: Option<Agreement>,
    pub(super) grazing_frequency: Option<f64>,
    pub(super) flip_frequency: Option<f64>,
    pub(super) fold_frequency: Option<f64>,
    sequence_from_rest: Vec<String>,
    sequence_flung: Vec<String>,
}

/// The whole result, in the machine's own units.
#[derive(Debug, Clone, Serialize)]
pub(super) struct FidelityReport {
    machine: MachineReport,
    /// Where its motion starts.
    start: Start,
    #[serde(skip)]
    pub(super) title: String,
    #[serde(skip)]
    pub(super) units: Units,
    pub(super) quantity: Quantity,
    pub(super) unit: &'static str,
    pub(super) tolerance: f64,
    /// The scene's own value.
    value: Option<f64>,
    /// Before-impact velocity of the machine's motion.
    pub(super) operating_velocity: Option<f64>,
    pub(super) predictive: bool,
    pub(super) cheapest: Option<Named>,
    pub(super) cheapest_is_scene: bool,
    pub(super) models: Vec<ModelReport>,
    pub(super) unmatched: Vec<UnmatchedReport>,
    pub(super) structure: Option<Vec<TrackReport>>,
}

impl FidelityReport {
    pub(super) fn new(
        arguments: &FidelityArguments,
        machine: &Machine,
        study: &Study,
        structure: Option<&Structure>,
    ) -> Self {
        let quantity = arguments.quantity;
        let cheapest = study.cheapest(arguments.tolerance);
        Self {
            title: title(machine),
            units: Units::of(machine),
            machine: MachineReport::of(machine),
            start: machine.start,
            quantity,
            unit: unit(machine, quantity),
            tolerance: arguments.tolerance,
            value: own(machine, quantity, quantity.value(&study.truth)),
            operating_velocity: study.velocity,
            predictive: arguments.predictive,
            cheapest: cheapest.map(|entry| named(entry.rung, entry.likeness)),
            cheapest_is_scene: cheapest.is_some_and(|entry| entry.is_truth),
            models: study
                .entries
                .iter()
                .map(|entry| model(machine, entry, quantity, study))
                .collect(),
            unmatched: study.missing.iter().map(unmatched).collect(),
            structure: structure.map(|structure| {
                let tracks = structure.tracks.iter();
                tracks.map(|one| track(machine, structure, one)).collect()
            }),
        }
    }

    /// What the scene is called.
    pub(super) fn scene(&self) -> &str {
        &self.title
    }

    /// The rows of `fidelity.csv`: all quantities of all models.
    pub(super) fn rows(&self) -> impl Iterator<Item = Row<'_>> {
        self.models.iter().flat_map(|model| {
            Quantity::ALL.into_iter().map(move |quantity| Row {
                model,
                quantity,
                answer: model.answers[quantity.name()],
            })
        })
    }

    /// What the chart shows.
    pub(super) fn picture(&self) -> FidelityPicture {
        let candidate = |model: &ModelReport| Candidate {
            name: model.named.to_string(),
            cost: model.cost.evaluations_per_period,
            error: model.error,
            is_chosen: Some(model.named) == self.cheapest,
        };
        FidelityPicture {
            title: format!("How simple a model of {} may be", self.title),
            quantity: self.quantity.name().replace('_', " "),
            tolerance: self.tolerance,
            candidates: self.models.iter().map(candidate).collect(),
        }
    }
}

impl std::fmt::Display for Named {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(&name(self.rung, self.likeness))
    }
}

/// A row of `fidelity.csv`.
pub(super) struct Row<'a> {
    model: &'a ModelReport,
    quantity: Quantity,
    answer: Answer,
}

/// The columns of `fidelity.csv`.
pub(super) fn columns<'a>() -> [Column<Row<'a>>; 8] {
    columns! { Row<'a>, row;
        "rung" [None], "the model's law" => row.model.named.rung.name();
        "matched" [None], "what it shares with the contact, if anything" => row.model.named.matched;
        "quantity" [None], "what is compared" => row.quantity.name();
        "unit" [None], "of its value" => row.answer.unit;
        "value" [Of("unit")], "of the model" => row.answer.value;
        "error" [None], "relative to the machine's own value" => row.answer.error;
        "evaluations_per_period" [None], "of the law of force" => row.model.cost.evaluations_per_period;
        "microseconds_per_period" [Of("us")], "median" => row.model.cost.microseconds_per_period;
    }
}

fn named(rung: Rung, likeness: Option<Likeness>) -> Named {
    Named {
        rung,
        matched: likeness.map(word),
        likeness,
    }
}

/// The unit of a quantity as the machine has it.
fn unit(machine: &Machine, quantity: Quantity) -> &'static str {
    let own = |dimension| units::name(machine, dimension);
    match (quantity.unit(), machine.speaks) {
        ("rad/s", _) => own(Dimension::Frequency),
        ("m/s", _) => own(Dimension::Velocity),
        ("m", _) => own(Dimension::Length),
        ("N", _) => own(Dimension::Force),
        ("s", _) => own(Dimension::Time),
        ("J", _) => own(Dimension::Energy),
        ("W", Language::Ratios) => "F0^2/sqrt(m k1)",
        (unit, _) => unit,
    }
}

/// A value of a quantity in the machine's own units.
fn own(machine: &Machine, quantity: Quantity, value: Option<f64>) -> Option<f64> {
    match quantity.unit() {
        "rad/s" => value.map(|value| machine.to_own(Dimension::Frequency, value)),
        _ => value,
    }
}

fn model(machine: &Machine, entry: &Entry, quantity: Quantity, study: &Study) -> ModelReport {
    let answer = |quantity: Quantity| Answer {
        value: own(machine, quantity, quantity.value(&entry.answers)),
        unit: unit(machine, quantity),
        error: quantity.error(&study.truth, &entry.answers),
    };
    ModelReport {
        named: named(entry.rung, entry.likeness),
        is_scene: entry.is_truth,
        machine: MachineReport::of(&Machine {
            scene: entry.scene.clone(),
            preload_deflection: None,
            ..machine.clone()
        }),
        motion: MotionName::of_regime(entry.answers.observed.regime),
        value: own(machine, quantity, quantity.value(&entry.answers)),
        error: entry.error,
        cost: entry.cost,
        answers: Quantity::ALL
            .into_iter()
            .map(|quantity| (quantity.name(), answer(quantity)))
            .collect(),
    }
}

fn unmatched(missing: &Missing) -> UnmatchedReport {
    UnmatchedReport {
        named: named(missing.rung, missing.likeness),
        reason: missing.reason.clone(),
    }
}

fn track(machine: &Machine, structure: &Structure, track: &Track) -> TrackReport {
    let bound = |one: fn(&Bounds) -> Option<f64>| {
        own(
            machine,
            Quantity::FoldFrequency,
            track.bounds.as_ref().and_then(one),
        )
    };
    TrackReport {
        named: named(track.rung, track.likeness),
        agreement: structure.agreement(track),
        grazing_frequency: bound(|bounds| bounds.grazing),
        flip_frequency: bound(|bounds| bounds.flip),
        fold_frequency: bound(|bounds| bounds.fold),
        sequence_from_rest: Structure::sequence(track, Origin::Rest),
        sequence_flung: Structure::sequence(track, Origin::Flung),
    }
}
