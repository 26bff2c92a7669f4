//! The result: plain data whose field names are the keys of the JSON.

use std::collections::BTreeMap;

use anyhow::{Context, anyhow};
use serde::Serialize;
use softstop::Stop;
use softstop_dynamics::models::{Likeness, Quantity, Rung};

use super::cost::Cost;
use super::structure::{Agreement, Origin, Structure, Track};
use super::study::{Entry, Missing, Study, name};
use super::{CHART, FidelityArguments, REGIMES, STRIPS, TABLE, word};
use crate::fidelity::chart::{Candidate, FidelityPicture};
use softstop_console::failure::Failure;
use softstop_console::output::Folder;

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
    /// z = p/n of its motion, none if it does not repeat.
    regime: Option<String>,
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
    pub(super) structure: Option<Vec<TrackReport>>,
    pub(super) files: BTreeMap<&'static str, String>,
}

impl FidelityReport {
    pub(super) fn new(
        arguments: &FidelityArguments,
        study: &Study,
        structure: Option<&Structure>,
        folder: &Folder,
    ) -> Self {
        let quantity = arguments.quantity;
        let cheapest = study.cheapest(arguments.tolerance);
        let mut files = vec![("table", TABLE), ("chart", CHART)];
        if structure.is_some() {
            files.extend([("regimes", REGIMES), ("regime chart", STRIPS)]);
        }
        let place = |(what, name)| (what, folder.place(name).display().to_string());
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
            files: files.into_iter().map(place).collect(),
        }
    }

    /// What the scene is called.
    pub(super) fn scene(&self) -> &str {
        &self.scene
    }

    /// All quantities of all models as a table.
    ///
    /// # Errors
    /// [`Failure::Run`] if it cannot be written.
    pub(super) fn csv(&self) -> Result<String, Failure> {
        let mut table = csv::Writer::from_writer(Vec::new());
        for model in &self.models {
            for quantity in Quantity::ALL {
                let answer = model.answers[quantity.name()];
                table
                    .serialize(Row {
                        rung: model.named.rung,
                        matched: model.named.matched,
                        quantity,
                        unit: quantity.unit(),
                        value: answer.value,
                        error: answer.error,
                        evaluations_per_period: model.cost.evaluations_per_period,
                        microseconds_per_period: model.cost.microseconds_per_period,
                    })
                    .context("cannot write a table")?;
            }
        }
        let bytes = table
            .into_inner()
            .map_err(|error| anyhow!("cannot write a table: {error}"))?;
        Ok(String::from_utf8(bytes).context("cannot write a table")?)
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

#[derive(Serialize)]
struct Row {
    rung: Rung,
    matched: Option<&'static str>,
    quantity: Quantity,
    unit: &'static str,
    value: Option<f64>,
    error: Option<f64>,
    evaluations_per_period: f64,
    microseconds_per_period: f64,
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
        regime: regime.map(|regime| regime.to_string()),
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
