//! What `softstop continue` found.

use serde::Serialize;
use softstop::{Machine, MotionError, Parameter};
use softstop_dynamics::Branch;
use softstop_dynamics::continuation::{
    BorderCollision, Curve, CurveEnd, End, Special, SpecialKind,
};
use softstop_dynamics::orbit::OrbitError;

use softstop_console::column::{Column, Told, Unit, Units};
use softstop_console::columns;
use softstop_console::export::Report;
use softstop_console::record::{Record, below};
use softstop_console::report::MachineReport;
use softstop_console::table::heading;
use softstop_console::units;

/// Everything that `softstop continue` found.
#[derive(Debug, Serialize)]
pub(super) struct ContinuationReport {
    machine: MachineReport,
    parameter: &'static str,
    /// Of the parameter.
    unit: &'static str,
    /// That of the start, and doubled ones.
    branches: Vec<BranchReport>,
    /// If they were asked for.
    curves: Option<CurvesReport>,
    #[serde(skip)]
    units: Units,
}

/// One branch.
#[derive(Debug, Serialize)]
struct BranchReport {
    #[serde(flatten)]
    figures: Record,
    /// What is special on it, in order.
    specials: Vec<Record>,
}

/// Curves in two parameters.
#[derive(Debug, Serialize)]
struct CurvesReport {
    /// The second parameter.
    parameter: &'static str,
    /// Its unit.
    unit: &'static str,
    curves: Vec<Record>,
}

/// A branch or a curve, and the points that it was followed for at most.
type Followed<'a, T> = (&'a T, usize);

fn branch<'a>() -> [Column<Followed<'a, Branch>>; 5] {
    columns! { Followed<'a, Branch>, it;
        "periods" [None] Plain, "drive periods n of its orbits" => it.0.periods;
        "points" [None] Plain, "points" => it.0.points.len();
        "from" [None] Fixed(10), "value of the parameter at its first point" => it.0.points.first().map(|it| it.parameter);
        "to" [None] Fixed(10), "at its last" => it.0.points.last().map(|it| it.parameter);
        "ends" [None] Plain, "why it ends there" => ends([&it.0.ends.0, &it.0.ends.1].map(|at| end(at, it.1)));
    }
}

fn specials() -> [Column<Special>; 8] {
    columns! { Special, it;
        "symbol" [None] Plain, "SN, PD, NS or G" => it.kind.symbol();
        "name" [None] Plain, "what it is" => describe(&it.kind);
        "value" [None] Fixed(12), "of the parameter" => it.point.parameter;
        "position" [Length], "at drive angle 0 of the scene" => it.point.position;
        "velocity" [Velocity], "there" => it.point.velocity;
        "before_impact_velocities" [Velocity] Fixed(6), "of all impacts" => it.point.impacts.clone();
        "trace" [None], "of the monodromy matrix" => it.point.monodromy.trace();
        "determinant" [None], "of the same" => it.point.monodromy.determinant();
    }
}

fn curve<'a>() -> [Column<Followed<'a, Curve>>; 5] {
    columns! { Followed<'a, Curve>, it;
        "symbol" [None] Plain, "SN, PD, NS or G" => it.0.kind.symbol();
        "points" [None] Plain, "how many" => it.0.points.len();
        "from" [None] Fixed(8), "both parameters at its first point" => it.0.points.first().map(|it| it.parameters);
        "to" [None] Fixed(8), "at its last" => it.0.points.last().map(|it| it.parameters);
        "ends" [None] Plain, "why it ends there" => ends([&it.0.ends.0, &it.0.ends.1].map(|at| curve_end(at, it.1)));
    }
}

fn ends(ends: [String; 2]) -> Told {
    Told {
        words: ends.join("; "),
        value: ends.as_slice().into(),
    }
}

/// What a special point is, with what becomes of the regime at a grazing.
fn describe(kind: &SpecialKind) -> String {
    let SpecialKind::Grazing(graze) = kind else {
        return kind.name().to_owned();
    };
    let what = if graze.dies {
        "a crossing dies"
    } else {
        "a turning point arrives"
    };
    format!("grazing of {:?}: {what}", graze.face).to_lowercase()
}

fn end(end: &End, points: usize) -> String {
    match end {
        End::Range => "the range ends".to_owned(),
        End::Points => limit(points),
        End::Closed => "the branch is closed".to_owned(),
        End::Grazing => "the orbit grazes".to_owned(),
        End::Merged => "it merges into the orbit of half its period".to_owned(),
        End::Stopped => "stopped".to_owned(),
        End::Border(border) => format!("border collision: {}", met(*border)),
        End::Unstable => {
            "a change of the orbit grows a million times in a round: too unstable to follow"
                .to_owned()
        }
        End::Lost(error) => lost(error),
    }
}

/// What an orbit meets at a border collision.
pub fn met(border: BorderCollision) -> &'static str {
    match border {
        BorderCollision::Rest => "beyond, the mass is held once more or once less",
        BorderCollision::Turn => "beyond, the mass turns once more or once less",
        BorderCollision::Surface => "beyond, the mass crosses another number of surfaces",
    }
}

/// Why it stops at the most points that there may be.
fn limit(points: usize) -> String {
    format!("stopped at the limit of {points} points; raise --points")
}

/// Why something cannot be followed any farther.
fn lost(error: &OrbitError) -> String {
    match error {
        OrbitError::Motion(MotionError::Scene(_)) => "no machine is beyond".to_owned(),
        OrbitError::Motion(error) => format!("beyond, {error}"),
        _ => "no step is short enough to follow it any farther".to_owned(),
    }
}

fn curve_end(end: &CurveEnd, points: usize) -> String {
    match end {
        CurveEnd::Range => "a range ends".to_owned(),
        CurveEnd::Points => limit(points),
        CurveEnd::Closed => "the curve is closed".to_owned(),
        CurveEnd::Grazing => "the orbit grazes elsewhere".to_owned(),
        CurveEnd::Stopped => "stopped".to_owned(),
        CurveEnd::Lost(error) => lost(error),
    }
}

impl ContinuationReport {
    pub(super) fn new(
        machine: &Machine,
        parameter: Parameter,
        most: usize,
        branches: &[Branch],
        curves: Option<&(Parameter, Vec<Curve>)>,
    ) -> Self {
        let branches = branches.iter().map(|it| BranchReport {
            figures: Record::of(&branch(), &(it, most)),
            specials: Record::all(&specials(), &it.specials),
        });
        let unit = |parameter| units::of_parameter(machine, parameter);
        Self {
            machine: MachineReport::of(machine),
            parameter: machine.name(parameter),
            unit: unit(parameter),
            branches: branches.collect(),
            curves: curves.map(|(second, curves)| {
                let curves = curves.iter().map(|it| Record::of(&curve(), &(it, most)));
                CurvesReport {
                    parameter: machine.name(*second),
                    unit: unit(*second),
                    curves: curves.collect(),
                }
            }),
            units: Units::of(machine),
        }
    }
}

impl Report for ContinuationReport {
    fn text(&self) -> String {
        let label = |name, unit| self.units.label(name, Unit::Of(unit));
        let parameter = label(self.parameter, self.unit);
        let mut text = String::new();
        for branch in &self.branches {
            text += &heading(&format!("Branch along {parameter}"));
            text += &format!("{}\n", branch.figures.text(&self.units));
            text += &match branch.specials.is_empty() {
                true => "No special points.\n\n".to_owned(),
                false => below(&branch.specials, &self.units) + "\n",
            };
        }
        if let Some(found) = &self.curves {
            let second = label(found.parameter, found.unit);
            text += &heading(&format!("Curves in {parameter} and {second}"));
            text += &below(&found.curves, &self.units);
        }
        text
    }
}
