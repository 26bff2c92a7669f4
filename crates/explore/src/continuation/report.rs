//! The results as tables and JSON.

use serde::Serialize;
use softstop::MotionError;
use softstop_dynamics::continuation::{
    Branch, BranchPoint, Curve, CurveEnd, CurvePoint, End, Special, SpecialKind,
};
use softstop_dynamics::orbit::{OrbitError, multipliers};

/// Everything that `softstop continue` found.
#[derive(Debug, Serialize)]
pub struct ContinuationReport {
    /// The parameter.
    pub parameter: &'static str,
    /// The branches: that of the start, and doubled ones.
    pub branches: Vec<BranchReport>,
    /// The second parameter and the curves, if they were asked for.
    pub curves: Option<CurvesReport>,
    /// The files.
    pub files: Vec<String>,
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
    /// The parameter.
    pub parameter: f64,
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

fn end(end: &End) -> String {
    match end {
        End::Range => "the range ends".to_owned(),
        End::Points => "there are --points of them".to_owned(),
        End::Closed => "the branch is closed".to_owned(),
        End::Grazing => "the orbit grazes".to_owned(),
        End::Merged => "it merges into the orbit of half its period".to_owned(),
        End::Stopped => "stopped".to_owned(),
        End::Lost(error) => lost(error),
    }
}

/// Why something cannot be followed any farther.
fn lost(error: &OrbitError) -> String {
    match error {
        OrbitError::Motion(MotionError::Scene(_)) => "no machine is beyond".to_owned(),
        OrbitError::Motion(error) => format!("beyond, {error}"),
        _ => "no step is short enough to follow it any farther".to_owned(),
    }
}

fn curve_end(end: &CurveEnd) -> String {
    match end {
        CurveEnd::Range => "a range ends".to_owned(),
        CurveEnd::Points => "there are --points of them".to_owned(),
        CurveEnd::Closed => "the curve is closed".to_owned(),
        CurveEnd::Grazing => "the orbit grazes elsewhere".to_owned(),
        CurveEnd::Stopped => "stopped".to_owned(),
        CurveEnd::Lost(error) => lost(error),
    }
}

impl BranchReport {
    /// That of a branch.
    pub fn new(branch: &Branch) -> Self {
        let parameter =
            |point: Option<&BranchPoint>| point.map_or(f64::NAN, |point| point.parameter);
        Self {
            periods: branch.periods,
            points: branch.points.len(),
            from: parameter(branch.points.first()),
            to: parameter(branch.points.last()),
            ends: [end(&branch.ends.0), end(&branch.ends.1)],
            specials: branch.specials.iter().map(SpecialReport::new).collect(),
        }
    }
}

impl SpecialReport {
    fn new(Special { kind, point }: &Special) -> Self {
        Self {
            symbol: kind.symbol(),
            name: describe(kind),
            parameter: point.parameter,
            position: point.position,
            velocity: point.velocity,
            before_impact_velocities: point.impacts.clone(),
            trace: point.monodromy.trace(),
            determinant: point.monodromy.determinant(),
        }
    }
}

impl CurveReport {
    /// That of a curve.
    pub fn new(curve: &Curve) -> Self {
        let parameters =
            |point: Option<&CurvePoint>| point.map_or([f64::NAN; 2], |it| it.parameters);
        Self {
            symbol: curve.kind.symbol(),
            points: curve.points.len(),
            from: parameters(curve.points.first()),
            to: parameters(curve.points.last()),
            ends: [curve_end(&curve.ends.0), curve_end(&curve.ends.1)],
        }
    }
}

/// Columns of the table of branches.
pub const BRANCH_COLUMNS: [&str; 13] = [
    "branch",
    "periods",
    "parameter",
    "position",
    "velocity",
    "impacts",
    "before_impact_velocity",
    "multiplier1_real",
    "multiplier1_imaginary",
    "multiplier2_real",
    "multiplier2_imaginary",
    "stable",
    "special",
];

/// One row of it.
#[derive(Debug, Serialize)]
pub struct BranchRow(
    usize,
    u64,
    f64,
    f64,
    f64,
    usize,
    f64,
    f64,
    f64,
    f64,
    f64,
    bool,
    &'static str,
);

/// The rows of a branch.
pub fn branch_rows(number: usize, branch: &Branch) -> impl Iterator<Item = BranchRow> + '_ {
    branch.points.iter().map(move |point| {
        let [one, other] = multipliers(&point.monodromy);
        BranchRow(
            number,
            branch.periods,
            point.parameter,
            point.position,
            point.velocity,
            point.impacts.len(),
            point.before_impact_velocity(),
            one.re,
            one.im,
            other.re,
            other.im,
            point.is_stable(),
            symbol_at(branch, point),
        )
    })
}

fn symbol_at(branch: &Branch, point: &BranchPoint) -> &'static str {
    let here = |special: &&Special| {
        special.point.parameter == point.parameter && special.point.state() == point.state()
    };
    branch
        .specials
        .iter()
        .find(here)
        .map_or("", |special| special.kind.symbol())
}

/// Columns of the table of curves.
pub const CURVE_COLUMNS: [&str; 9] = [
    "curve",
    "kind",
    "parameter",
    "second",
    "position",
    "velocity",
    "before_impact_velocity",
    "trace",
    "determinant",
];

/// One row of it.
#[derive(Debug, Serialize)]
pub struct CurveRow(usize, &'static str, f64, f64, f64, f64, f64, f64, f64);

/// The rows of a curve.
pub fn curve_rows(number: usize, curve: &Curve) -> impl Iterator<Item = CurveRow> + '_ {
    curve.points.iter().map(move |point| {
        CurveRow(
            number,
            curve.kind.symbol(),
            point.parameters[0],
            point.parameters[1],
            point.position,
            point.velocity,
            point.impacts.iter().copied().fold(0.0, f64::max),
            point.monodromy.trace(),
            point.monodromy.determinant(),
        )
    })
}
