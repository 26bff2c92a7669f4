//! How a design meets what was required, and which others are nearly as good, as records.

use serde_json::json;
use softstop::{Machine, Parameter};
use softstop_console::column::{Column, Told};
use softstop_console::columns;
use softstop_console::record::Record;

use crate::design::case::DRAWING;
use crate::design::conflict::bound;
use crate::design::figure::Figure;
use crate::design::front::Front;
use crate::design::judge::Met;
use crate::design::{Design, Problem};

type Required<'a> = (&'a Machine, &'a Met);

fn columns<'a>() -> [Column<Required<'a>>; 10] {
    columns! { Required<'a>, it;
        "name" [None] Plain, "as in the task" => it.1.requirement.figure.name();
        "required" [None] Plain, "what is required" => bound(it.0, &it.1.requirement);
        "value" [None] Seven, "what the design has" => own_of(it, it.1.value);
        "worst" [None] Seven, "what the worst machine within the tolerances has" => it.1.worst.and_then(|worst| own_of(it, worst));
        "violating" [None] Plain, "share of the machines within the tolerances that violate it" => it.1.violating;
        "margin" [None] Seven, "distance to the bound, of the worst machine if there are tolerances; negative beyond it" => own_of(it, it.1.margin());
        "unit" [None] Plain, "unit of value and margin" => it.0.unit(it.1.requirement.figure.dimension());
        "met" [None] Plain, "whether it is met" => it.1.is_met();
        "meaning" [None] Plain, "what it is" => it.1.requirement.figure.meaning();
        "note" [None] Plain, "why there is no value, or from which starts it was counted" => it.1.note(it.0);
    }
}

/// A requirement and what a design of this machine has of it; in which operating point, if there are cases.
pub(crate) fn required(problem: &Problem, machine: &Machine, met: &Met) -> Record {
    let own = Record::of(&columns(), &(machine, met));
    let case = met.case.map_or(DRAWING, |index| &problem.cases[index].name);
    match problem.cases.is_empty() {
        true => own,
        false => Record::default().with("case", "", case).and(own),
    }
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
    let value = design
        .machine
        .to_own(figure.dimension(), problem.sought_of(design));
    head.with(figure.name(), figure.meaning(), value)
}

type Traded<'a> = (&'a Problem, &'a Front);

fn trades<'a>() -> [Column<Traded<'a>>; 6] {
    columns! { Traded<'a>, it;
        "figure" [None], "what is traded" => it.1.figure.name();
        "unit" [None], "its unit" => it.0.machine.unit(it.1.figure.dimension());
        "left_out" [None], "designs that fail a trial or lose machines" => it.1.left_out;
        "note" [None], "how it was found" => it.1.note();
        "design" [None], "its value at the design, and what is sought" => place(it, &it.1.design);
        "points" [None], "its values, and the best of what is sought" => points(it);
    }
}

/// A point of a front in the machine's own units.
fn place((problem, front): &Traded<'_>, (x, y): &(f64, f64)) -> [f64; 2] {
    let own = |figure: Figure, value| problem.machine.to_own(figure.dimension(), value);
    [own(front.figure, *x), own(problem.objective.figure, *y)]
}

fn points(traded: &Traded<'_>) -> Told {
    let points = traded.1.points.iter();
    let points: Vec<[f64; 2]> = points.map(|it| place(traded, it)).collect();
    Told {
        words: format!("{} designs", points.len()),
        value: json!(points),
    }
}

/// What more of one good costs of another.
pub(crate) fn traded(problem: &Problem, front: &Front) -> Record {
    Record::of(&trades(), &(problem, front))
}
