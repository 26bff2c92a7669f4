//! All quantities of all models: the table of `fidelity`.

use std::ops::Range;

use softstop::Machine;
use softstop_console::column::Column;
use softstop_console::{columns, units};
use softstop_dynamics::models::Quantity;

use super::study::{Entry, Study};
use super::word;

/// A row of `fidelity.csv`: a quantity of a model.
#[derive(Clone, Copy)]
pub(super) struct Row<'a> {
    pub(super) machine: &'a Machine,
    pub(super) study: &'a Study,
    pub(super) model: &'a Entry,
    pub(super) quantity: Quantity,
}

/// The columns of `fidelity.csv`.
pub(super) fn columns<'a>() -> [Column<Row<'a>>; 8] {
    columns! { Row<'a>, it;
        "rung" [None], "the model's law" => it.model.rung.name();
        "matched" [None], "what it shares with the contact, if anything" => it.model.likeness.map(word);
        "quantity" [None], "what is compared" => it.quantity.name();
        "unit" [None], "of its value" => unit(it.machine, it.quantity);
        "value" [Of("unit")], "of the model" => own(it.machine, it.quantity, it.quantity.value(&it.model.answers));
        "error" [None], "relative to the machine's own value" => it.quantity.error(&it.study.truth, &it.model.answers);
        "evaluations_per_period" [None], "of the law of force" => it.model.cost.evaluations_per_period;
        "microseconds_per_period" [Of("us")], "median" => it.model.cost.microseconds_per_period;
    }
}

/// What an answer is of these columns.
pub(super) const ANSWER: Range<usize> = 3..6;

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
pub(super) fn unit(machine: &Machine, quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::Regime => "impacts per period",
        _ => units::name(machine, quantity.dimension()),
    }
}

/// A value of a quantity in the machine's own units.
pub(super) fn own(machine: &Machine, quantity: Quantity, value: Option<f64>) -> Option<f64> {
    value.map(|value| machine.to_own(quantity.dimension(), value))
}
