//! How a design meets what was required, and which others are nearly as good, as records.

use serde_json::json;
use softstop::{Machine, Parameter};
use softstop_console::column::{Column, Told};
use softstop_console::columns;
use softstop_console::record::Record;

use crate::design::conflict::bound;
use crate::design::figure::Figure;
use crate::design::front::Front;
use crate::design::judge::Met;
use crate::design::{Design, Problem};

type Required<'a> = (&'a Machine, &'a Met);

fn columns<'a>() -> [Column<Required<'a>>; 8] {
    columns! { Required<'a>, it;
        "name" [None] Plain, "as in the task" => it.1.requirement.figure.name();
        "required" [None] Plain, "what is required" => bound(it.0, &it.1.requirement);
        "value" [None] Seven, "what the design has" => own_of(it, it.1.value);
        "margin" [None] Seven, "distance to the bound, negative beyond it" => own_of(it, it.1.margin());
        "unit" [None] Plain, "unit of value and margin" => it.0.unit(it.1.requirement.figure.dimension());
        "met" [None] Plain, "whether it is met" => it.1.is_met();
        "meaning" [None] Plain, "what it is" => it.1.requirement.figure.meaning();
        "note" [None] Plain, "why there is no value, or from which starts it was counted" => it.1.note(it.0);
    }
}

/// A requirement and what a design of this machine has of it.
pub(crate) fn required(machine: &Machine, met: &Met) -> Record {
    Record::of(&columns(), &(machine, met))
}

/// A value of a requirement in the machine's own units; none where nothing bounds it.
fn own_of((machine, met): &Required<'_>, value: f64) -> Option<f64> {
    let dimension = met.requirement.figure.dimension();
    value.is_finite().then(|| machine.to_own(dimension, value))
}

/// A design beside the best one: where it is, and what it has of what is sought.
pub(crate) fn rival(problem: &Problem, design: &Design) -> Record {
    let axes = problem.axes.iter().map(|axis| axis.parameter);
    let axes = axes.chain([Parameter::Frequency]);
    let head = axes.fold(Record::default(), |record, it| {
        let label = design.machine.label_of(it);
        record.with(it.name(), &label, design.machine.value(it))
    });
    let figure = problem.objective.figure;
    let value = design.machine.to_own(figure.dimension(), design.value);
    head.with(figure.name(), figure.meaning(), value)
}

/// What more of one good costs of another.
pub(crate) fn traded(problem: &Problem, front: &Front) -> Record {
    let machine = &problem.machine;
    let (figure, sought) = (front.figure, problem.objective.figure);
    let own = |figure: Figure, value: f64| machine.to_own(figure.dimension(), value);
    let place = |(x, y): &(f64, f64)| [own(figure, *x), own(sought, *y)];
    let points: Vec<[f64; 2]> = front.points.iter().map(place).collect();
    let words = format!("{} designs", points.len());
    Record::default()
        .with("figure", "what is traded", figure.name())
        .with("unit", "its unit", machine.unit(figure.dimension()))
        .with(
            "left_out",
            "designs that fail a trial or lose machines",
            front.left_out,
        )
        .with("note", "how it was found", front.note())
        .with(
            "design",
            "its value at the design, and what is sought",
            place(&front.design),
        )
        .with(
            "points",
            "its values, and the best of what is sought",
            Told {
                value: json!(points),
                words,
            },
        )
}
