//! What `softstop continue` found.

use softstop::{Machine, MotionError, Parameter};
use softstop_dynamics::Branch;
use softstop_dynamics::continuation::{
    BorderCollision, BranchEnd, CodimensionTwo, Curve, CurveEnd, CurvePoint, SpecialKind,
    SpecialPoint, normal_form_coefficient,
};
use softstop_dynamics::orbit::OrbitError;

use super::curves::{Curves, NotFollowed};
use super::tables::{branch_columns, branch_rows, curve_columns, curve_rows};
use softstop_console::column::{Column, Told, Unit, Units, arrays};
use softstop_console::columns;
use softstop_console::record::{Record, below};
use softstop_console::report::stated_machine;
use softstop_console::table::heading;
use softstop_console::units;

fn branch() -> [Column<Branch>; 5] {
    columns! { Branch, it;
        "periods" [None] Plain, "drive periods n of its orbits" => it.periods;
        "points" [None] Plain, "points" => it.points.len();
        "from" [None] Fixed(10), "value of the parameter at its first point" => it.points.first().map(|it| it.parameter);
        "to" [None] Fixed(10), "at its last" => it.points.last().map(|it| it.parameter);
        "ends" [None] Plain, "why it ends there" => ends([&it.ends.0, &it.ends.1].map(end));
    }
}

/// A special point with the coefficient of its normal form.
type Classified<'a> = (&'a SpecialPoint, Option<f64>);

fn specials<'a>() -> [Column<Classified<'a>>; 9] {
    columns! { Classified<'a>, it;
        "symbol" [None] Plain, "SN, PD, NS, G or PF" => it.0.kind.symbol();
        "name" [None] Plain, "what it is" => describe(it.0);
        "value" [None] Fixed(12), "of the parameter" => it.0.point.parameter;
        "position" [Length], "at time 0, that is at drive angle phi" => it.0.point.position;
        "velocity" [Velocity], "there" => it.0.point.velocity;
        "before_impact_velocities" [Velocity] Fixed(6), "of all impacts" => it.0.point.impacts.clone();
        "trace" [None], "of the monodromy matrix" => it.0.point.monodromy.trace();
        "determinant" [None], "of the same" => it.0.point.monodromy.determinant();
        "coefficient" [None], "of the normal form: a of u + a u^2 at a fold, c of -u + c u^3 at a flip" => it.1;
    }
}

fn curve() -> [Column<Curve>; 6] {
    columns! { Curve, it;
        "symbol" [None] Plain, "SN, PD, NS or G" => it.kind.symbol();
        "periods" [None] Plain, "drive periods n of its orbits" => it.periods;
        "points" [None] Plain, "how many" => it.points.len();
        "from" [None] Fixed(8), "both parameters at its first point" => it.points.first().map(|it| it.parameters);
        "to" [None] Fixed(8), "at its last" => it.points.last().map(|it| it.parameters);
        "ends" [None] Plain, "why it ends there" => ends([&it.ends.0, &it.ends.1].map(curve_end));
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
        "position" [Length], "at time 0, that is at drive angle phi" => it.1.1.position;
        "velocity" [Velocity], "there" => it.1.1.velocity;
    }
}

fn not_followed<'a>() -> [Column<NotFollowed<'a>>; 5] {
    columns! { NotFollowed<'a>, it;
        "symbol" [None] Plain, "SN, PD, NS or G" => it.special.kind.symbol();
        "periods" [None] Plain, "drive periods n of its orbit" => it.periods;
        "name" [None] Plain, "what it is" => describe(it.special);
        "value" [None] Fixed(12), "of the first parameter" => it.special.point.parameter;
        "reason" [None] Plain, "why no curve begins there" => it.error.to_string();
    }
}

/// The special points of a branch with the coefficients of their normal forms; none where one cannot be computed.
fn classified<'a>(
    machine: &Machine,
    parameter: Parameter,
    branch: &'a Branch,
) -> Vec<Classified<'a>> {
    let coefficient = |special: &SpecialPoint| {
        let SpecialKind::Critical(test) = special.kind else {
            return None;
        };
        let mut machine = machine.clone();
        machine.set(parameter, special.point.parameter);
        let (scene, state) = (machine.check(None).ok()?, special.point.state());
        normal_form_coefficient(&scene, branch.periods, test, state).ok()?
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

/// What a special point is, with what becomes of the regime at a grazing, and whether multipliers jump past it there.
fn describe(special: &SpecialPoint) -> String {
    let kind = &special.kind;
    let SpecialKind::Grazing(graze) = kind else {
        return match kind {
            SpecialKind::Critical(test) if test.jumps_at(&special.point.monodromy) => {
                format!("nonsmooth {}", kind.name())
            }
            _ => kind.name().to_owned(),
        };
    };
    let what = if graze.dies {
        "a crossing dies"
    } else {
        "a turning point arrives"
    };
    match graze.is_symmetric {
        true => format!("grazing of clearance and below: {what}"),
        false => format!("grazing of {:?}: {what}", graze.surface).to_lowercase(),
    }
}

fn end(end: &BranchEnd) -> String {
    match end {
        BranchEnd::Range => "the range ends".to_owned(),
        BranchEnd::Points => LIMIT.to_owned(),
        BranchEnd::Closed => "the branch is closed".to_owned(),
        BranchEnd::Grazing => "the orbit grazes".to_owned(),
        BranchEnd::Merged => "it merges into the orbit of half its period".to_owned(),
        BranchEnd::Symmetric => "it merges into a symmetric orbit".to_owned(),
        BranchEnd::Stopped => "stopped".to_owned(),
        BranchEnd::Border(border) => format!("border collision: {}", met(*border)),
        BranchEnd::Unstable => {
            "a change of the orbit grows a million times in a round: too unstable to follow"
                .to_owned()
        }
        BranchEnd::Lost(error) => lost(error),
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
const LIMIT: &str = "stopped at the limit that --points sets";

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
        CurveEnd::Points => LIMIT.to_owned(),
        CurveEnd::Closed => "the curve is closed".to_owned(),
        CurveEnd::Grazing => "the orbit grazes elsewhere".to_owned(),
        CurveEnd::CodimensionTwo(kind) => kind.name().to_owned(),
        CurveEnd::Stopped => "stopped".to_owned(),
        CurveEnd::Lost(error) => lost(error),
    }
}

/// What is found: the branch of the start and doubled ones, and curves in two parameters, if they were asked for; and the
/// text of it.
pub(super) fn report(
    machine: &Machine,
    parameter: Parameter,
    branches: &[Branch],
    curves: Option<&(Parameter, Curves<'_>)>,
) -> serde_json::Result<(Record, String)> {
    let units = Units::of(machine);
    let unit = |parameter| units::of_parameter(machine, parameter);
    let label = |it| units.label(machine.name(it), Unit::Of(unit(it)));
    let (mut text, mut found) = (String::new(), Vec::new());
    for (number, it) in branches.iter().enumerate() {
        let figures = Record::of(&branch(), it);
        let specials = Record::all(&specials(), &classified(machine, parameter, it));
        text += &heading(&format!("Branch along {}", label(parameter)));
        text += &format!("{}\n", figures.text(&units));
        text += &match specials.is_empty() {
            true => "No special points.\n\n".to_owned(),
            false => below(&specials, &units) + "\n",
        };
        let table = arrays(&branch_columns(), branch_rows((number, it)))?;
        found.push(figures.hidden("table", table).hidden("specials", specials));
    }
    let of_curves = curves.map(|(second, curves)| {
        text += &heading(&format!(
            "Curves in {} and {}",
            label(parameter),
            label(*second)
        ));
        let (found, told) = curves_found(&curves.found, &units)?;
        text += &told;
        let not_followed = Record::all(&not_followed(), &curves.not_followed);
        if !not_followed.is_empty() {
            text += &format!("\nNot followed:\n{}", below(&not_followed, &units));
        }
        serde_json::Result::Ok(
            Record::default()
                .hidden("parameter", machine.name(*second))
                .hidden("unit", unit(*second))
                .hidden("curves", found)
                .hidden("not_followed", not_followed),
        )
    });
    let result = Record::default()
        .hidden("machine", stated_machine(machine))
        .hidden("parameter", machine.name(parameter))
        .hidden("unit", unit(parameter))
        .hidden("branches", found)
        .hidden("curves", of_curves.transpose()?);
    Ok((result, text))
}

/// Curves with their points of codimension two, and the text of them.
fn curves_found(curves: &[Curve], units: &Units) -> serde_json::Result<(Vec<Record>, String)> {
    let (mut figures, mut specials, mut found) = (Vec::new(), Vec::new(), Vec::new());
    for (number, it) in curves.iter().enumerate() {
        let own = it.specials.iter().map(|special| (it.kind, special));
        let own = Record::all(&codimension_two(), &own.collect::<Vec<_>>());
        let table = arrays(&curve_columns(), curve_rows((number, it)))?;
        let one = Record::of(&curve(), it);
        figures.push(one.clone());
        specials.extend(own.clone());
        found.push(one.hidden("table", table).hidden("specials", own));
    }
    let mut text = match figures.is_empty() {
        true => "No special points to follow.\n".to_owned(),
        false => below(&figures, units),
    };
    if !specials.is_empty() {
        text += "\nOf codimension two:\n";
        text += &below(&specials, units);
    }
    Ok((found, text))
}
