//! A design in each case, as records.

use softstop_console::column::Column;
use softstop_console::columns;
use softstop_console::record::Record;

use crate::design::case::{Case, DRAWING};
use crate::design::conflict::stated;
use crate::design::{Design, Problem};
use crate::limits::end_name;
use crate::optimize::study::Study;

/// A design in one operating point.
struct Row<'a> {
    problem: &'a Problem,
    /// None of the drawing.
    case: Option<&'a Case>,
    design: &'a Design,
    machines: Option<Machines>,
}

/// Its machines within the tolerances.
struct Machines {
    lost: usize,
    /// The slowest impact of the others in m/s.
    slowest: f64,
    /// Factor by which all tolerances may grow, if that was found.
    factor: Option<f64>,
}

fn columns<'a>() -> [Column<Row<'a>>; 15] {
    columns! { Row<'a>, it;
        "case" [None] Plain, "which" => it.case.map_or(DRAWING, |it| &it.name);
        "changes" [None] Plain, "what differs from the drawing" => changes(it);
        "weight" [None] Six, "weight in what is sought" => it.case.map_or(1.0, |it| it.weight);
        "value" [None] Seven, "what it has of what is sought" => it.design.machine.to_own(it.problem.objective.figure.dimension(), it.design.value);
        "unit" [None] Plain, "unit of that" => it.design.machine.unit(it.problem.objective.figure.dimension());
        "velocity" [Velocity] Six, "before-impact velocity" => it.design.before_impact_velocity();
        "frequency" [Frequency] Six, "drive frequency" => it.design.frequency();
        "s" [None] Six, "place in its zone" => it.design.place;
        "zone_from" [Frequency] Six, "lower end of its zone" => it.design.own_frequency(it.design.zone.low.frequency);
        "zone_from_by" [None], "what ends it there" => end_name(&it.design.zone.low);
        "zone_to" [Frequency] Six, "upper end of its zone" => it.design.own_frequency(it.design.zone.high.frequency);
        "zone_to_by" [None], "what ends it there" => end_name(&it.design.zone.high);
        "lost" [None] Plain, "machines within the tolerances that lose the motion" => it.machines.as_ref().map(|it| it.lost);
        "worst" [Velocity] Six, "least velocity of the others" => it.machines.as_ref().map(|it| it.slowest);
        "factor" [None] Six, "factor by which all tolerances may grow" => it.machines.as_ref().and_then(|it| it.factor);
    }
}

fn changes(row: &Row<'_>) -> String {
    let machine = &row.design.machine;
    let changes = row.case.map_or(&[][..], |it| &it.changes).iter();
    let changes = changes.map(|(parameter, value)| stated(machine, *parameter, *value));
    changes.collect::<Vec<_>>().join(", ")
}

/// A design in the drawing's operating point and in each case; nothing if there are no cases.
pub(crate) fn records(problem: &Problem, design: &Design, study: Option<&Study>) -> Vec<Record> {
    if problem.cases.is_empty() {
        return Vec::new();
    }
    let drawing = Row {
        problem,
        case: None,
        design,
        machines: study.map(|it| Machines {
            lost: it.verdict.lost,
            slowest: it.slowest(),
            factor: it.nearest_box.first().map(|it| it.distance),
        }),
    };
    let machines = |index: usize| {
        let study = study?;
        let verdict = &study.verdict.cases[index];
        Some(Machines {
            lost: verdict.lost,
            slowest: verdict.slowest,
            factor: study.factors[index],
        })
    };
    let cases = problem.cases.iter().zip(&design.cases).enumerate();
    let cases = cases.map(|(index, (case, design))| Row {
        problem,
        case: Some(case),
        design,
        machines: machines(index),
    });
    let all = [drawing].into_iter().chain(cases);
    all.map(|it| Record::of(&columns(), &it)).collect()
}
