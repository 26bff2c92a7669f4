//! The result: plain data whose field names are the keys of the JSON.

use std::collections::BTreeMap;

use serde::Serialize;
use softstop::Stop;
use softstop_dynamics::models::{Likeness, Quantity, Rung};

use super::cost::Cost;
use super::structure::{Agreement, Origin, Structure, Track};
use super::study::{Entry, Missing, Study, name};
use super::{FidelityArguments, word};
use crate::fidelity::chart::{Candidate, FidelityPicture};
use softstop_console::column::{Column, Unit, Units, text};
use softstop_console::columns;
use softstop_console::export::Report;
use softstop_console::table::heading;

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
    error: Option<f64>,
}

/// A model.
#[derive(Debug, Clone, Serialize)]
pub(super) struct ModelReport {
    #[serde(flatten)]
    pub(super) named: Named,
    pub(super) is_scene: bool,
    stop: Stop,
    contact_damping: f64,
    /// z = p/n; none if it does not repeat.
    motion: Option<String>,
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

/// The regimes of a model over the sweep. Frequencies in units of sqrt(k1/m).
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

/// The whole result, SI units.
#[derive(Debug, Clone, Serialize)]
pub(super) struct FidelityReport {
    scene: String,
    pub(super) quantity: Quantity,
    unit: &'static str,
    pub(super) tolerance: f64,
    /// The scene's own value.
    value: Option<f64>,
    /// Before-impact velocity in m/s of the scene's motion.
    pub(super) operating_velocity: Option<f64>,
    pub(super) predictive: bool,
    pub(super) cheapest: Option<Named>,
    pub(super) cheapest_is_scene: bool,
    pub(super) models: Vec<ModelReport>,
    pub(super) unmatched: Vec<UnmatchedReport>,
    structure: Option<Vec<TrackReport>>,
}

impl FidelityReport {
    pub(super) fn new(
        arguments: &FidelityArguments,
        study: &Study,
        structure: Option<&Structure>,
    ) -> Self {
        let quantity = arguments.quantity;
        let cheapest = study.cheapest(arguments.tolerance);
        Self {
            scene: arguments.scene.display().to_string(),
            quantity,
            unit: quantity.unit(),
            tolerance: arguments.tolerance,
            value: quantity.value(&study.truth),
            operating_velocity: study.velocity,
            predictive: arguments.predictive,
            cheapest: cheapest.map(|entry| named(entry.rung, entry.likeness)),
            cheapest_is_scene: cheapest.is_some_and(|entry| entry.is_truth),
            models: study
                .entries
                .iter()
                .map(|entry| model(entry, quantity, study))
                .collect(),
            unmatched: study.missing.iter().map(unmatched).collect(),
            structure: structure.map(|structure| {
                let tracks = structure.tracks.iter();
                tracks.map(|one| track(structure, one)).collect()
            }),
        }
    }

    /// What the scene is called.
    pub(super) fn scene(&self) -> &str {
        &self.scene
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

    /// Which model to take.
    fn advice(&self) -> String {
        let matched = match self.operating_velocity {
            _ if self.predictive => {
                "Matched at the velocity of each model's own motion.".to_owned()
            }
            Some(velocity) => format!("Matched at the scene's own {velocity:.6} m/s."),
            None => "The scene's motion has no impact.".to_owned(),
        };
        let tolerance = self.tolerance;
        let found = match self.cheapest {
            None => format!("No model is within {tolerance}."),
            Some(named) if self.cheapest_is_scene => format!(
                "Within {tolerance} nothing costs less than the scene itself ({named}): take it as it is."
            ),
            Some(named) => format!("The cheapest model within {tolerance}: {named}."),
        };
        format!("{matched} Costs are per drive period.\n{found}\n")
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
            title: format!("How simple a model of {} may be", self.scene),
            quantity: self.quantity.name().replace('-', " "),
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
        "unit" [None], "of its value" => row.quantity.unit();
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

fn model(entry: &Entry, quantity: Quantity, study: &Study) -> ModelReport {
    let answer = |quantity: Quantity| Answer {
        value: quantity.value(&entry.answers),
        error: quantity.error(&study.truth, &entry.answers),
    };
    let regime = entry.answers.observed.regime;
    ModelReport {
        named: named(entry.rung, entry.likeness),
        is_scene: entry.is_truth,
        stop: entry.scene.stop.clone(),
        contact_damping: entry.scene.contact_damping,
        motion: regime.map(|regime| format!("z = {regime}")),
        value: quantity.value(&entry.answers),
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

fn track(structure: &Structure, track: &Track) -> TrackReport {
    let bound = |one: fn(&softstop_dynamics::models::Bounds) -> Option<f64>| {
        structure.scaled(track.bounds.as_ref().and_then(one))
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

impl Report for FidelityReport {
    fn text(&self) -> String {
        let value = Units::SI.label(self.quantity.name(), Unit::Of(self.unit));
        let title = format!("Models of {} for its {value}", self.scene);
        let mut text =
            heading(&title) + &text(&models(), &self.models, &Units::SI) + "\n" + &self.advice();
        for missing in &self.unmatched {
            text += &format!("Without a model: {}: {}\n", missing.named, missing.reason);
        }
        if let Some(tracks) = &self.structure {
            text += "\n";
            text += &heading("Regimes over the sweep, from rest and from a flung start");
            text += &self::text(&regimes(), tracks, &Units::SI);
        }
        text
    }
}

fn models() -> [Column<ModelReport>; 5] {
    columns! { ModelReport, model;
        "model" [None] Plain, "its name" => model.name();
        "value" [None] Fixed(6), "of the quantity" => model.value;
        "error" [None] Plain, "of it" => error(model.error);
        "evaluations" [None] Fixed(1), "per drive period" => model.cost.evaluations_per_period;
        "time" [Of("us")] Fixed(2), "per drive period" => model.cost.microseconds_per_period;
    }
}

fn regimes() -> [Column<TrackReport>; 6] {
    columns! { TrackReport, track;
        "model" [None] Plain, "its name" => track.named.to_string();
        "same_z" [None] Percent(1), "share" => track.agreement.map(|it| it.same_regime);
        "same_kind" [None] Percent(1), "share" => track.agreement.map(|it| it.same_kind);
        "g0" [None] Fixed(6), "grazing" => track.grazing_frequency;
        "s_PD" [None] Fixed(6), "flip" => track.flip_frequency;
        "s_SN" [None] Fixed(6), "fold" => track.fold_frequency;
    }
}

impl ModelReport {
    fn name(&self) -> String {
        let scene = if self.is_scene { " = the scene" } else { "" };
        format!("{}{scene}", self.named)
    }
}

fn error(error: Option<f64>) -> String {
    match error {
        None => "no value".to_owned(),
        Some(0.0) => "0".to_owned(),
        Some(error) if error.is_finite() => format!("{error:.2e}"),
        Some(_) => "other".to_owned(),
    }
}
