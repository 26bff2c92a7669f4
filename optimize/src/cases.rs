//! A design in each case, as records.

use softstop_console::column::Column;
use softstop_console::columns;
use softstop_console::record::Record;

use crate::design::case::{Case, DRAWING};
use crate::design::conflict::stated;
use crate::design::operating_point::OperatingPoint;
use crate::design::{Design, Problem};
use crate::limits::end_name;
use crate::optimize::study::ToleranceStudy;
use crate::robust::CaseVerdict;

/// A design in one operating point, and its machines within the tolerances in all of them.
struct CaseRow<'a> {
    problem: &'a Problem,
    point: &'a OperatingPoint<'a>,
    study: Option<&'a ToleranceStudy>,
}

impl<'a> CaseRow<'a> {
    /// None of the drawing.
    fn case(&self) -> Option<&'a Case> {
        Some(&self.problem.cases[self.point.case?])
    }

    /// What its machines have shown.
    fn verdict(&self) -> Option<&'a CaseVerdict> {
        Some(self.study?.verdict.for_case(self.point.case))
    }
}

fn columns<'a>() -> [Column<CaseRow<'a>>; 15] {
    columns! { CaseRow<'a>, it;
        "case" [None] Plain, "which" => it.case().map_or(DRAWING, |it| &it.name);
        "changes" [None] Plain, "what differs from the drawing" => changes(it);
        "weight" [None] Six, "weight in what is sought" => it.case().map_or(1.0, |it| it.weight);
        "value" [None] Seven, "what it has of what is sought" => it.point.design.machine.to_own(it.problem.objective.figure.dimension(), it.point.design.value);
        "unit" [None] Plain, "unit of that" => it.point.design.machine.unit(it.problem.objective.figure.dimension());
        "velocity" [Velocity] Six, "before-impact velocity" => it.point.design.before_impact_velocity();
        "frequency" [Frequency] Six, "drive frequency" => it.point.design.frequency();
        "s" [None] Six, "place in its zone" => it.point.design.place;
        "zone_from" [Frequency] Six, "lower end of its zone" => it.point.design.own_frequency(it.point.design.zone.low.frequency);
        "zone_from_by" [None], "what ends it there" => end_name(&it.point.design.zone.low);
        "zone_to" [Frequency] Six, "upper end of its zone" => it.point.design.own_frequency(it.point.design.zone.high.frequency);
        "zone_to_by" [None], "what ends it there" => end_name(&it.point.design.zone.high);
        "lost" [None] Plain, "machines within the tolerances that lose the motion" => it.verdict().map(|it| it.lost);
        "worst" [Velocity] Six, "least velocity of the others" => it.study.map(|study| study.slowest(it.point.case));
        "factor" [None] Six, "factor by which all tolerances may grow" => it.study.and_then(|study| study.factor(it.point.case));
    }
}

fn changes(row: &CaseRow<'_>) -> String {
    let machine = &row.point.design.machine;
    let changes = row.case().map_or(&[][..], |it| &it.changes).iter();
    let changes = changes.map(|(parameter, value)| stated(machine, *parameter, *value));
    changes.collect::<Vec<_>>().join(", ")
}

/// A design in the drawing's operating point and in each case; nothing if there are no cases.
pub(crate) fn records(
    problem: &Problem,
    design: &Design,
    study: Option<&ToleranceStudy>,
) -> Vec<Record> {
    if problem.cases.is_empty() {
        return Vec::new();
    }
    let points = problem.operating_points(design);
    let row = |point| CaseRow {
        problem,
        point,
        study,
    };
    points
        .iter()
        .map(|it| Record::of(&columns(), &row(it)))
        .collect()
}
