//! What `softstop continue` found.

use serde::Serialize;
use softstop::{Machine, MotionError, Parameter};
use softstop_dynamics::continuation::{
    Branch, BranchPoint, Curve, CurveEnd, CurvePoint, End, Special, SpecialKind,
};
use softstop_dynamics::orbit::OrbitError;

use softstop_console::column::{self, Column, Unit, Units};
use softstop_console::columns;
use softstop_console::export::Report;
use softstop_console::report::MachineReport;
use softstop_console::table::heading;
use softstop_console::units;

/// Everything that `softstop continue` found.
#[derive(Debug, Serialize)]
pub struct ContinuationReport {
    /// The machine.
    pub machine: MachineReport,
    /// The parameter.
    pub parameter: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// The branches: that of the start, and doubled ones.
    pub branches: Vec<BranchReport>,
    /// The second parameter and the curves, if they were asked for.
    pub curves: Option<CurvesReport>,
    #[serde(skip)]
    units: Units,
}

/// One branch.
#[derive(Debug, Serialize)]
pub struct BranchReport {
    /// Drive periods of its orbits.
    pub periods: u64,
    /// Points.
    pub points: usize,
    /// Values of the parameter at its first point and its last.
    pub from: f64,
    /// See `from`.
    pub to: f64,
    /// Why it ends there.
    pub ends: [String; 2],
    /// What is special on it, in order.
    pub specials: Vec<SpecialReport>,
}

/// A special point.
#[derive(Debug, Serialize)]
pub struct SpecialReport {
    /// SN, PD, NS or G.
    pub symbol: &'static str,
    /// In words.
    pub name: String,
    /// Value of the parameter.
    pub value: f64,
    /// Position at drive angle 0 of the scene.
    pub position: f64,
    /// Velocity there.
    pub velocity: f64,
    /// Before-impact velocities.
    pub before_impact_velocities: Vec<f64>,
    /// Trace of the monodromy matrix.
    pub trace: f64,
    /// Its determinant.
    pub determinant: f64,
}

/// Curves in two parameters.
#[derive(Debug, Serialize)]
pub struct CurvesReport {
    /// The second parameter.
    pub parameter: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// The curves.
    pub curves: Vec<CurveReport>,
}

/// One curve.
#[derive(Debug, Serialize)]
pub struct CurveReport {
    /// SN, PD, NS or G.
    pub symbol: &'static str,
    /// Points.
    pub points: usize,
    /// Both parameters at its first point and its last.
    pub from: [f64; 2],
    /// See `from`.
    pub to: [f64; 2],
    /// Why it ends there.
    pub ends: [String; 2],
}

/// What a special point is, with what becomes of the regime at a grazing.
pub fn describe(kind: &SpecialKind) -> String {
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
        End::Lost(error) => lost(error),
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
        let branch = |branch| BranchReport::new(branch, most);
        let curve = |curve| CurveReport::new(curve, most);
        let unit = |parameter| units::of_parameter(machine, parameter);
        Self {
            machine: MachineReport::of(machine),
            parameter: machine.name(parameter),
            unit: unit(parameter),
            branches: branches.iter().map(branch).collect(),
            curves: curves.map(|(second, curves)| CurvesReport {
                parameter: machine.name(*second),
                unit: unit(*second),
                curves: curves.iter().map(curve).collect(),
            }),
            units: Units::of(machine),
        }
    }
}

impl BranchReport {
    /// That of a branch, followed for so many points at most.
    pub fn new(branch: &Branch, most: usize) -> Self {
        let parameter =
            |point: Option<&BranchPoint>| point.map_or(f64::NAN, |point| point.parameter);
        Self {
            periods: branch.periods,
            points: branch.points.len(),
            from: parameter(branch.points.first()),
            to: parameter(branch.points.last()),
            ends: [end(&branch.ends.0, most), end(&branch.ends.1, most)],
            specials: branch.specials.iter().map(SpecialReport::new).collect(),
        }
    }
}

impl SpecialReport {
    fn new(Special { kind, point, .. }: &Special) -> Self {
        Self {
            symbol: kind.symbol(),
            name: describe(kind),
            value: point.parameter,
            position: point.position,
            velocity: point.velocity,
            before_impact_velocities: point.impacts.clone(),
            trace: point.monodromy.trace(),
            determinant: point.monodromy.determinant(),
        }
    }
}

impl CurveReport {
    /// That of a curve, followed for so many points at most.
    pub fn new(curve: &Curve, most: usize) -> Self {
        let parameters =
            |point: Option<&CurvePoint>| point.map_or([f64::NAN; 2], |it| it.parameters);
        Self {
            symbol: curve.kind.symbol(),
            points: curve.points.len(),
            from: parameters(curve.points.first()),
            to: parameters(curve.points.last()),
            ends: [
                curve_end(&curve.ends.0, most),
                curve_end(&curve.ends.1, most),
            ],
        }
    }
}

impl Report for ContinuationReport {
    fn text(&self) -> String {
        let parameter = self.units.label(self.parameter, Unit::Of(self.unit));
        let branches = self.branches.iter();
        let mut text: Vec<String> = branches
            .map(|branch| branch.text(&parameter, &self.units))
            .collect();
        if let Some(curves) = &self.curves {
            let second = self.units.label(curves.parameter, Unit::Of(curves.unit));
            let title = heading(&format!("Curves in {parameter} and {second}"));
            text.push(title + &column::text(&curve_table(), &curves.curves, &self.units));
        }
        text.join("\n")
    }
}

impl BranchReport {
    fn text(&self, parameter: &str, units: &Units) -> String {
        let title = format!(
            "Branch of period {}: {parameter} from {:.10} to {:.10}, {} points",
            self.periods, self.from, self.to, self.points
        );
        let table = if self.specials.is_empty() {
            "No special points.\n".to_owned()
        } else {
            column::text(&special_table(), &self.specials, units)
        };
        let [first, last] = &self.ends;
        heading(&title) + &table + &format!("Ends: {first}; {last}.\n")
    }
}

fn special_table() -> [Column<SpecialReport>; 4] {
    columns! { SpecialReport, special;
        "special" [None] Plain, "symbol" => special.symbol;
        "point" [None] Plain, "what it is" => special.name.as_str();
        "value" [None] Fixed(12), "of the parameter" => special.value;
        "before_impact_velocities" [Velocity] Plain, "of all impacts" => special.velocities();
    }
}

impl SpecialReport {
    fn velocities(&self) -> String {
        let velocities = self.before_impact_velocities.iter();
        let written: Vec<String> = velocities
            .map(|velocity| format!("{velocity:.6}"))
            .collect();
        if written.is_empty() {
            "none".to_owned()
        } else {
            written.join(" ")
        }
    }
}

fn curve_table() -> [Column<CurveReport>; 6] {
    columns! { CurveReport, curve;
        "special" [None] Plain, "symbol" => curve.symbol;
        "from" [None] Fixed(8), "first parameter" => curve.from[0];
        "and" [None] Fixed(8), "second parameter" => curve.from[1];
        "to" [None] Fixed(8), "first parameter" => curve.to[0];
        "and" [None] Fixed(8), "second parameter" => curve.to[1];
        "ends" [None] Plain, "why" => curve.ends.join("; ");
    }
}
