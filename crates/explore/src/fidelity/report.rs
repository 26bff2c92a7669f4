//! The result, in the machine's own units.

use std::collections::BTreeMap;

use serde::Serialize;
use serde_json::json;
use softstop::{Dimension, Machine, Start};
use softstop_dynamics::models::{Likeness, Quantity, Rung};
use softstop_dynamics::zone::Bounds;

use super::answers::{ANSWER, Row, columns, own, unit};
use super::structure::{Origin, Structure, Track};
use super::study::{Entry, Study, name};
use super::{FidelityArguments, word};
use softstop_console::arguments::title;
use softstop_console::column::{Column, Told, Unit, Units};
use softstop_console::columns;
use softstop_console::export::Report;
use softstop_console::record::{Record, below};
use softstop_console::report::{MachineReport, MotionName};
use softstop_console::table::heading;

/// A model by its name.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
struct Named {
    rung: Rung,
    /// What it has in common with the contact.
    matched: Option<&'static str>,
}

impl Named {
    fn of(rung: Rung, likeness: Option<Likeness>) -> Self {
        Self {
            rung,
            matched: likeness.map(word),
        }
    }
}

/// A model.
#[derive(Debug, Serialize)]
struct ModelReport {
    #[serde(flatten)]
    named: Named,
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

/// A rung without a model.
#[derive(Debug, Serialize)]
struct UnmatchedReport {
    #[serde(flatten)]
    named: Named,
    reason: String,
}

/// The regimes of a model over the sweep.
#[derive(Debug, Serialize)]
struct TrackReport {
    #[serde(flatten)]
    named: Named,
    #[serde(flatten)]
    figures: Record,
}

/// The whole result.
#[derive(Debug, Serialize)]
pub(super) struct FidelityReport {
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
    cheapest: Option<Named>,
    cheapest_is_scene: bool,
    models: Vec<ModelReport>,
    unmatched: Vec<UnmatchedReport>,
    structure: Option<Vec<TrackReport>>,
    #[serde(skip)]
    text: String,
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

fn tracks<'a>() -> [Column<Tracked<'a>>; 7] {
    columns! { Tracked<'a>, it;
        "same_regime" [None] Percent(1), "share" => it.1.agreement(it.2).map(|it| it.same_regime);
        "same_kind" [None] Percent(1), "share" => it.1.agreement(it.2).map(|it| it.same_kind);
        "grazing_frequency" [Frequency] Fixed(6), "g0" => bound(it, |it| it.grazing);
        "flip_frequency" [Frequency] Fixed(6), "s_PD" => bound(it, |it| it.flip);
        "fold_frequency" [Frequency] Fixed(6), "s_SN" => bound(it, |it| it.fold);
        "sequence_from_rest" [None], "regimes in order of frequency" => sequence(it.2, Origin::Rest);
        "sequence_flung" [None], "the same, flung" => sequence(it.2, Origin::Flung);
    }
}

fn bound((machine, _, track): &Tracked, one: fn(&Bounds) -> Option<f64>) -> Option<f64> {
    let bound = track.entry.answers.bounds.as_ref().and_then(one);
    own(machine, Quantity::FoldFrequency, bound)
}

fn sequence(track: &Track, origin: Origin) -> Told {
    Told {
        value: track.sequence(origin).into(),
        words: String::new(),
    }
}

fn model(row: Row) -> ModelReport {
    let entry = row.model;
    let answer = |quantity: Quantity| Record::of(&columns()[ANSWER], &Row { quantity, ..row });
    let answers = Quantity::ALL.map(|quantity| (quantity.name(), answer(quantity)));
    ModelReport {
        named: Named::of(entry.rung, entry.likeness),
        is_scene: entry.is_truth,
        machine: MachineReport::of(&Machine {
            scene: entry.scene.clone(),
            preload_deflection: None,
            ..row.machine.clone()
        }),
        motion: MotionName::of_regime(entry.answers.observed.regime),
        figures: Record::of(&figures(), &row),
        answers: answers.into(),
    }
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
        let models = study.entries.iter().map(|entry| {
            model(Row {
                machine,
                study,
                model: entry,
                quantity,
            })
        });
        let unmatched = study.missing.iter().map(|it| UnmatchedReport {
            named: Named::of(it.rung, it.likeness),
            reason: it.reason.clone(),
        });
        let structure = structure.map(|structure| {
            let tracks_found = structure.tracks.iter().map(|track| TrackReport {
                named: Named::of(track.entry.rung, track.entry.likeness),
                figures: Record::of(&tracks(), &(machine, structure, track)),
            });
            tracks_found.collect::<Vec<_>>()
        });
        let mut report = Self {
            machine: MachineReport::of(machine),
            start: machine.start,
            quantity,
            unit: unit(machine, quantity),
            tolerance: arguments.tolerance,
            value: own(machine, quantity, quantity.value(&study.truth)),
            operating_velocity: study.velocity,
            predictive: arguments.predictive,
            cheapest: cheapest.map(|entry| Named::of(entry.rung, entry.likeness)),
            cheapest_is_scene: cheapest.is_some_and(|entry| entry.is_truth),
            models: models.collect(),
            unmatched: unmatched.collect(),
            structure,
            text: String::new(),
        };
        report.text = report.write(machine, study);
        report
    }

    /// For people.
    fn write(&self, machine: &Machine, study: &Study) -> String {
        let units = Units::of(machine);
        let named = |figures: &Record, entry: &Entry| {
            let named = Record::default().with("model", "", entry.full_name());
            named.and(figures.clone())
        };
        let models = self.models.iter().zip(&study.entries);
        let models = models.map(|(it, entry)| named(&it.figures, entry));
        let models: Vec<Record> = models.collect();
        let value = units.label(self.quantity.name(), Unit::Of(self.unit));
        let mut text = heading(&format!("Models of {} for its {value}", title(machine)));
        text += &format!("{}\n{}", below(&models, &units), self.advice(&units, study));
        for missing in &study.missing {
            let name = name(missing.rung, missing.likeness);
            text += &format!("Without a model: {name}: {}\n", missing.reason);
        }
        if let Some(tracks) = &self.structure {
            let tracks = tracks.iter().zip(&study.entries);
            let tracks = tracks.map(|(it, entry)| named(&it.figures, entry));
            let tracks: Vec<Record> = tracks.collect();
            let title = heading("Regimes over the sweep, from rest and from a flung start");
            text += &format!("\n{title}{}", below(&tracks, &units));
        }
        text
    }

    /// Which model to take.
    fn advice(&self, units: &Units, study: &Study) -> String {
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
        let found = match study.cheapest(tolerance) {
            None => format!("No model is within {tolerance}."),
            Some(entry) if entry.is_truth => format!(
                "Within {tolerance} nothing costs less than the scene itself ({}): take it as it is.",
                entry.name()
            ),
            Some(entry) => format!("The cheapest model within {tolerance}: {}.", entry.name()),
        };
        format!("{matched} Costs are per drive period.\n{found}\n")
    }
}

impl Report for FidelityReport {
    fn text(&self) -> String {
        self.text.clone()
    }
}
