//! The result, in the machine's own units.

use super::models::{ObservedFigures, Quantity};
use serde_json::json;
use softstop::{Dimension, Machine};

use super::FidelityArguments;
use super::structure::{RegimeStructure, RegimeTrack, kind};
use super::study::{ModelComparison, ModelEntry, ModelName};
use softstop_console::arguments::title;
use softstop_console::column::{Column, Told, Unit, Units};
use softstop_console::record::{Record, below};
use softstop_console::report::{MotionName, stated_machine};
use softstop_console::table::heading;
use softstop_console::{columns, units};

/// A row of `fidelity.csv`: a quantity of a model.
#[derive(Clone, Copy)]
pub(super) struct AnswerRow<'a> {
    machine: &'a Machine,
    study: &'a ModelComparison,
    model: &'a ModelEntry,
    quantity: Quantity,
}

/// The columns of `fidelity.csv`; from the fourth to the sixth they are what an answer is in JSON.
pub(super) fn columns<'a>() -> [Column<AnswerRow<'a>>; 8] {
    columns! { AnswerRow<'a>, it;
        "rung" [None], "the model's law" => it.model.name.rung.name();
        "matched" [None], "what it shares with the contact, if anything" => it.model.name.word();
        "quantity" [None], "what is compared" => it.quantity.name();
        "unit" [None], "of its value" => unit(it.machine, it.quantity);
        "value" [Of("unit")], "of the model" => own(it.machine, it.quantity, &it.model.answers);
        "error" [None], "relative to the machine's own value, of impact_phase as a share of the drive period; of another regime inf, which JSON has as null" => it.study.truth.error(&it.model.answers, it.quantity);
        "evaluations_per_period" [None], "of the law of force" => it.model.evaluations_per_period;
        "microseconds_per_period" [Of("us")], "median" => it.model.microseconds_per_period;
    }
}

/// The rows of `fidelity.csv`: all quantities of all models.
pub(super) fn rows<'a>(
    machine: &'a Machine,
    study: &'a ModelComparison,
) -> impl Iterator<Item = AnswerRow<'a>> {
    study.entries.iter().flat_map(move |model| {
        Quantity::ALL.into_iter().map(move |quantity| AnswerRow {
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
fn own(machine: &Machine, quantity: Quantity, answers: &ObservedFigures) -> Option<f64> {
    let value = answers.value(quantity);
    value.map(|value| machine.to_own(quantity.dimension(), value))
}

/// What is told of a model.
fn figures<'a>() -> [Column<AnswerRow<'a>>; 4] {
    columns! { AnswerRow<'a>, it;
        "value" [None] Fixed(6), "of the quantity" => own(it.machine, it.quantity, &it.model.answers);
        "error" [None] Plain, "of it" => error(it.model.error);
        "evaluations_per_period" [None] Fixed(1), "of the law of force" => it.model.evaluations_per_period;
        "microseconds_per_period" [None] Fixed(2), "median" => it.model.microseconds_per_period;
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

type Tracked<'a> = (&'a Machine, &'a RegimeStructure<'a>, &'a RegimeTrack<'a>);

/// What is told of the regimes of a model.
fn tracks<'a>() -> [Column<Tracked<'a>>; 7] {
    columns! { Tracked<'a>, it;
        "same_regime" [None] Percent(1), "share" => it.1.agreement(it.2, |regime| regime);
        "same_kind" [None] Percent(1), "share" => it.1.agreement(it.2, kind);
        "grazing_frequency" [Frequency] Fixed(6), "g0" => own(it.0, Quantity::GrazingFrequency, &it.2.entry.answers);
        "flip_frequency" [Frequency] Fixed(6), "s_PD" => own(it.0, Quantity::FlipFrequency, &it.2.entry.answers);
        "fold_frequency" [Frequency] Fixed(6), "s_SN" => own(it.0, Quantity::FoldFrequency, &it.2.entry.answers);
        "sequence_from_rest" [None], "regimes in order of frequency" => json!(it.2.sequence(0));
        "sequence_flung" [None], "the same, flung" => json!(it.2.sequence(1));
    }
}

/// A model by its names.
fn named(name: ModelName) -> Record {
    let named = Record::default().hidden("rung", name.rung.name());
    named.hidden("matched", name.word())
}

/// A model: the machine with its stop, what it settles on, and all quantities of it.
fn model(row: AnswerRow<'_>) -> Record {
    let entry = row.model;
    let mut quantities = Quantity::ALL;
    quantities.sort_by_key(|it| it.name());
    let answers = quantities
        .into_iter()
        .fold(Record::default(), |all, quantity| {
            all.hidden(
                quantity.name(),
                Record::of(&columns()[3..6], &AnswerRow { quantity, ..row }),
            )
        });
    let machine = Machine {
        scene: entry.scene.clone(),
        preload_deflection: None,
        ..row.machine.clone()
    };
    named(entry.name)
        .hidden("is_scene", entry.is_truth)
        .hidden("machine", stated_machine(&machine))
        .and(MotionName::of_regime(entry.answers.regime).figures())
        .and(Record::of(&figures(), &row))
        .hidden("answers", answers)
}

/// Which model to take.
fn advice(arguments: &FidelityArguments, machine: &Machine, study: &ModelComparison) -> String {
    let matched = match study.velocity {
        _ if arguments.predictive => {
            "Matched at the velocity of each model's own motion.".to_owned()
        }
        Some(velocity) => {
            let unit = machine.unit(Dimension::Velocity);
            let matched = format!("Matched at the machine's own {velocity:.6} {unit}");
            matched.trim_end().to_owned() + "."
        }
        None => "The scene's motion has no impact.".to_owned(),
    };
    let tolerance = arguments.tolerance;
    let found = match study.cheapest(tolerance) {
        None => format!("No model is within {tolerance}."),
        Some(ModelEntry { name, is_truth, .. }) if *is_truth => format!(
            "Within {tolerance} nothing costs less than the scene itself ({name}): take it as it is."
        ),
        Some(ModelEntry { name, .. }) => format!("The cheapest model within {tolerance}: {name}."),
    };
    format!("{matched} Costs are per drive period.\n{found}\n")
}

/// All models, the cheapest one within the tolerance, and their regimes over the sweep; and the text of it.
pub(super) fn report(
    arguments: &FidelityArguments,
    (machine, study): (&Machine, &ModelComparison),
    structure: Option<&RegimeStructure<'_>>,
) -> (Record, String) {
    let (quantity, tolerance, units) =
        (arguments.quantity, arguments.tolerance, Units::of(machine));
    let table = |figures: &[Record]| {
        let named = figures.iter().zip(&study.entries).map(|(figures, entry)| {
            let name = Record::default().with("model", "", entry.full_name());
            name.and(figures.clone())
        });
        below(&named.collect::<Vec<_>>(), &units)
    };
    let rows = rows(machine, study).filter(|row| row.quantity == quantity);
    let rows: Vec<AnswerRow<'_>> = rows.collect();
    let value = units.label(quantity.name(), Unit::Of(unit(machine, quantity)));
    let mut text = heading(&format!("Models of {} for its {value}", title(machine)));
    text += &table(&Record::all(&figures(), &rows));
    text += &format!("\n{}", advice(arguments, machine, study));
    for (name, reason) in &study.unmatched {
        text += &format!("Without a model: {name}: {reason}\n");
    }
    let sweep = structure.map(|structure| {
        let tracked = structure.tracks.iter().map(|it| (machine, structure, it));
        let figures = Record::all(&tracks(), &tracked.collect::<Vec<_>>());
        let title = heading("Regimes over the sweep, from rest and from a flung start");
        text += &format!("\n{title}{}", table(&figures));
        let figures = study.entries.iter().zip(figures);
        figures
            .map(|(entry, figures)| named(entry.name).and(figures))
            .collect::<Vec<_>>()
    });
    let cheapest = study.cheapest(tolerance);
    let unmatched = study.unmatched.iter();
    let unmatched = unmatched.map(|it| named(it.0).hidden("reason", it.1.clone()));
    let result = Record::default()
        .hidden("machine", stated_machine(machine))
        .hidden("start", json!(machine.start))
        .hidden("quantity", quantity.name())
        .hidden("unit", unit(machine, quantity))
        .hidden("tolerance", tolerance)
        .hidden("value", own(machine, quantity, &study.truth))
        .hidden("operating_velocity", study.velocity)
        .hidden("predictive", arguments.predictive)
        .hidden("cheapest", cheapest.map(|entry| named(entry.name)))
        .hidden(
            "cheapest_is_scene",
            cheapest.is_some_and(|entry| entry.is_truth),
        )
        .hidden("models", rows.into_iter().map(model).collect::<Vec<_>>())
        .hidden("unmatched", unmatched.collect::<Vec<_>>())
        .hidden("structure", sweep);
    (result, text)
}
