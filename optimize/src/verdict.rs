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
use crate::design::judge::RequirementValue;
use crate::design::{Design, Problem};

type Required<'a> = (&'a Machine, &'a RequirementValue);

fn columns<'a>() -> [Column<Required<'a>>; 10] {
    columns! { Required<'a>, (machine, met);
        "name" [None] Plain, "as in the task" => met.requirement.figure.name();
        "required" [None] Plain, "what is required" => bound(machine, &met.requirement);
        "value" [None] Seven, "what the design has" => own_of(machine, met, met.value);
        "worst" [None] Seven, "what the worst machine within the tolerances has" => met.worst.and_then(|worst| own_of(machine, met, worst));
        "violating" [None] Plain, "share of the machines within the tolerances that violate it" => met.violating;
        "margin" [None] Seven, "distance to the bound, of the worst machine if there are tolerances; negative beyond it" => own_of(machine, met, met.margin());
        "unit" [None] Plain, "unit of value and margin" => machine.unit(met.requirement.figure.dimension());
        "met" [None] Plain, "whether it is met" => met.is_met();
        "meaning" [None] Plain, "what it is" => met.requirement.figure.meaning();
        "note" [None] Plain, "why there is no value, or from which starts it was counted" => met.note(machine);
    }
}

/// A requirement and what a design of this machine has of it; in which operating point, if there are cases.
pub(crate) fn required(problem: &Problem, machine: &Machine, met: &RequirementValue) -> Record {
    let own = Record::of(&columns(), &(machine, met));
    let case = met.case.map_or(DRAWING, |index| &problem.cases[index].name);
    match problem.cases.is_empty() {
        true => own,
        false => Record::default().with("case", "", case).and(own),
    }
}

/// A value of a requirement in the machine's own units; none where nothing bounds it.
fn own_of(machine: &Machine, met: &RequirementValue, value: f64) -> Option<f64> {
    let dimension = met.requirement.figure.dimension();
    value.is_finite().then(|| machine.to_own(dimension, value))
}

/// A design beside the best one: where it is, and what it has of what is sought.
pub(crate) fn rival(problem: &Problem, design: &Design) -> Record {
    let axes = problem.axes.iter().map(|axis| axis.parameter);
    let axes = axes.chain([Parameter::Frequency]);
    let head = axes.fold(Record::default(), |record, it| {
        let label = design.machine.label_of(it);
        record.with(design.machine.name(it), &label, design.machine.value(it))
    });
    let figure = problem.objective.figure;
    let value = design
        .machine
        .to_own(figure.dimension(), problem.sought_of(design));
    head.with(figure.name(), figure.meaning(), value)
}

type TradedRow<'a> = (&'a Problem, &'a Front);

fn trades<'a>() -> [Column<TradedRow<'a>>; 6] {
    columns! { TradedRow<'a>, (problem, front);
        "figure" [None], "what is traded" => front.figure.name();
        "unit" [None], "its unit" => problem.machine.unit(front.figure.dimension());
        "left_out" [None], "designs that fail a trial or lose machines" => front.left_out;
        "note" [None], "how it was found" => front.note();
        "design" [None], "its value at the design, and what is sought" => place(problem, front, &front.design);
        "points" [None], "its values, and the best of what is sought" => points(problem, front);
    }
}

/// A point of a front in the machine's own units.
fn place(problem: &Problem, front: &Front, (x, y): &(f64, f64)) -> [f64; 2] {
    let own = |figure: Figure, value| problem.machine.to_own(figure.dimension(), value);
    [own(front.figure, *x), own(problem.objective.figure, *y)]
}

fn points(problem: &Problem, front: &Front) -> Told {
    let points = front.points.iter();
    let points: Vec<[f64; 2]> = points.map(|it| place(problem, front, it)).collect();
    Told {
        words: format!("{} designs", points.len()),
        value: json!(points),
    }
}

/// What more of one good costs of another.
pub(crate) fn traded(problem: &Problem, front: &Front) -> Record {
    Record::of(&trades(), &(problem, front))
}
