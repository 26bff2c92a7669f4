//! What `softstop continue` found.

use serde::Serialize;
use softstop::{Machine, MotionError, Parameter};
use softstop_dynamics::Branch;
use softstop_dynamics::continuation::{
    BorderCollision, CodimensionTwo, Curve, CurveEnd, CurvePoint, End, Special, SpecialKind,
    normal_form_coefficient,
};
use softstop_dynamics::orbit::OrbitError;

use super::tables::{branch_columns, curve_columns, rows_of_branch, rows_of_curve};
use softstop_console::column::{Column, Told, Unit, Units, arrays};
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
    curves: Vec<CurveReport>,
}

/// One curve.
#[derive(Debug, Serialize)]
struct CurveReport {
    #[serde(flatten)]
    figures: Record,
    /// Its points of codimension two, in order.
    specials: Vec<Record>,
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

/// A special point with the coefficient of its normal form.
type Classified<'a> = (&'a Special, Option<f64>);

fn specials<'a>() -> [Column<Classified<'a>>; 9] {
    columns! { Classified<'a>, it;
        "symbol" [None] Plain, "SN, PD, NS, G or PF" => it.0.kind.symbol();
        "name" [None] Plain, "what it is" => describe(&it.0.kind);
        "value" [None] Fixed(12), "of the parameter" => it.0.point.parameter;
        "position" [Length], "at drive angle 0 of the scene" => it.0.point.position;
        "velocity" [Velocity], "there" => it.0.point.velocity;
        "before_impact_velocities" [Velocity] Fixed(6), "of all impacts" => it.0.point.impacts.clone();
        "trace" [None], "of the monodromy matrix" => it.0.point.monodromy.trace();
        "determinant" [None], "of the same" => it.0.point.monodromy.determinant();
        "coefficient" [None], "of the normal form: a of u + a u^2 at a fold, c of -u + c u^3 at a flip" => it.1;
    }
}

fn curve<'a>() -> [Column<Followed<'a, Curve>>; 6] {
    columns! { Followed<'a, Curve>, it;
        "symbol" [None] Plain, "SN, PD, NS or G" => it.0.kind.symbol();
        "periods" [None] Plain, "drive periods n of its orbits" => it.0.periods;
        "points" [None] Plain, "how many" => it.0.points.len();
        "from" [None] Fixed(8), "both parameters at its first point" => it.0.points.first().map(|it| it.parameters);
        "to" [None] Fixed(8), "at its last" => it.0.points.last().map(|it| it.parameters);
        "ends" [None] Plain, "why it ends there" => ends([&it.0.ends.0, &it.0.ends.1].map(|at| curve_end(at, it.1)));
    }
}

/// A point of codimension two, with the kind of its curve.
type OnCurve<'a> = (SpecialKind, &'a (CodimensionTwo, CurvePoint));

fn codimension_two<'a>() -> [Column<OnCurve<'a>>; 6] {
    columns! { OnCurve<'a>, it;
        "symbol" [None] Plain, "CP, GPD or RG" => it.1.0.symbol();
        "name" [None] Plain, "what it is" => it.1.0.name();
        "on" [None] Plain, "kind of the curve" => it.0.symbol();
        "values" [None] Fixed(12), "of both parameters" => it.1.1.parameters;
        "position" [Length], "at drive angle 0 of the scene" => it.1.1.position;
        "velocity" [Velocity], "there" => it.1.1.velocity;
    }
}

/// The special points of a branch with the coefficients of their normal forms; none where one cannot be computed.
fn classified<'a>(
    machine: &Machine,
    parameter: Parameter,
    branch: &'a Branch,
) -> Vec<Classified<'a>> {
    let coefficient = |special: &Special| {
        let SpecialKind::Critical(test) = special.kind else {
            return None;
        };
        let mut machine = machine.clone();
        machine.set(parameter, special.point.parameter);
        let state = special.point.state();
        normal_form_coefficient(&machine.scene, branch.periods, test, state).ok()?
    };
    let all = branch.specials.iter();
    all.map(|it| (it, coefficient(it))).collect()
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
        End::Symmetric => "it merges into a symmetric orbit".to_owned(),
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
        CurveEnd::CodimensionTwo(kind) => kind.name().to_owned(),
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
    ) -> serde_json::Result<Self> {
        let branches = branches.iter().enumerate().map(|(number, it)| {
            let table = arrays(&branch_columns(), rows_of_branch(number, it))?;
            Ok(BranchReport {
                figures: Record::of(&branch(), &(it, most)).hidden("table", table),
                specials: Record::all(&specials(), &classified(machine, parameter, it)),
            })
        });
        let curve_report = |(number, it): (usize, &Curve)| {
            let table = arrays(&curve_columns(), rows_of_curve(number, it))?;
            let specials = it.specials.iter().map(|special| (it.kind, special));
            Ok(CurveReport {
                figures: Record::of(&curve(), &(it, most)).hidden("table", table),
                specials: Record::all(&codimension_two(), &specials.collect::<Vec<_>>()),
            })
        };
        let unit = |parameter| units::of_parameter(machine, parameter);
        let curves = curves.map(|(second, curves)| {
            serde_json::Result::Ok(CurvesReport {
                parameter: machine.name(*second),
                unit: unit(*second),
                curves: curves
                    .iter()
                    .enumerate()
                    .map(curve_report)
                    .collect::<Result<_, _>>()?,
            })
        });
        Ok(Self {
            machine: MachineReport::of(machine),
            parameter: machine.name(parameter),
            unit: unit(parameter),
            branches: branches.collect::<serde_json::Result<_>>()?,
            curves: curves.transpose()?,
            units: Units::of(machine),
        })
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
            let figures: Vec<_> = found.curves.iter().map(|it| it.figures.clone()).collect();
            text += &match figures.is_empty() {
                true => "No special points to follow.\n".to_owned(),
                false => below(&figures, &self.units),
            };
            let specials = found.curves.iter().flat_map(|it| &it.specials);
            let specials: Vec<_> = specials.cloned().collect();
            if !specials.is_empty() {
                text += "\nOf codimension two:\n";
                text += &below(&specials, &self.units);
            }
        }
        text
    }
}
