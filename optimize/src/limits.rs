//! What holds a design back.

use softstop::Parameter;

use crate::design::Problem;
use crate::design::conflict::bound;
use crate::design::figure::Figure;
use crate::design::judge::Met;
use crate::optimize::outcome::Outcome;

/// One thing that does.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Limit {
    /// For programs: a key and which of its bounds.
    pub key: String,
    /// For people: a phrase after "held back by".
    pub words: String,
}

impl Limit {
    fn new(key: impl Into<String>, words: impl Into<String>) -> Self {
        Self {
            key: key.into(),
            words: words.into(),
        }
    }
}

/// The key of a parameter in JSON: the last word of its name, as the paper's ratios are called.
pub fn key(parameter: Parameter) -> String {
    match parameter {
        Parameter::StopStiffness => "stiffness".to_owned(),
        Parameter::Suspension => "suspension_stiffness".to_owned(),
        Parameter::Frequency => "frequency".to_owned(),
        other => other.name().replace('.', "_"),
    }
}

/// Distance in s within which a design stands at the end of the allowed window.
const AT_MARGIN: f64 = 1e-9;
/// Share of a bound within which it holds a design back.
const AT_BOUND: f64 = 1e-6;

/// All that holds a design back.
pub fn at_limits(problem: &Problem, found: &Outcome) -> Vec<Limit> {
    let design = &found.design;
    let at_end = |parameter: Parameter, end: &str| {
        let words = format!("the {end} bound of the {}", parameter.about().meaning);
        Limit::new(format!("{}: {end} bound", key(parameter)), words)
    };
    let axes = problem.axes.iter().filter_map(|axis| {
        let end = axis.range.end(design.machine.value(axis.parameter)?)?;
        Some(at_end(axis.parameter, end))
    });
    let mut limits: Vec<Limit> = axes.collect();
    limits.extend(found.met.iter().filter(is_bound).map(|it| {
        let (machine, requirement) = (&design.machine, &it.requirement);
        let (name, meaning) = (requirement.figure.name(), requirement.figure.meaning());
        let required = bound(machine, requirement);
        Limit::new(
            format!("{name}: {required}"),
            format!("the {meaning} ({name}), {required}"),
        )
    }));
    limits.extend(problem.edge_at(design).map(|edge| {
        let words = edge.replace("tolerances: they reach", "the tolerances, which reach");
        Limit::new(&edge, words)
    }));
    if design.place <= problem.margin + AT_MARGIN {
        limits.push(at_margin("g0"));
    }
    if design.place >= 1.0 - problem.margin - AT_MARGIN {
        limits.push(at_margin("s_SN"));
    } else if let Some(end) = near_end(problem, design.frequency()) {
        limits.push(at_end(Parameter::Frequency, end));
    }
    limits
}

/// True if a requirement holds a design back. Trials count, and are not counted on beyond what is required; the margin
/// from the ends of the zone is told with its end.
fn is_bound(met: &&Met) -> bool {
    let figure = met.requirement.figure;
    let size = (met.value - met.margin()).abs();
    !figure.is_trial() && figure != Figure::Share && met.margin() <= AT_BOUND * size
}

fn at_margin(end: &str) -> Limit {
    let key = format!("margin from {end}");
    let words = format!("the {key}");
    Limit::new(key, words)
}

/// Frequencies pass through the place in the zone and back, so an end is met to rounding only.
fn near_end(problem: &Problem, frequency: f64) -> Option<&'static str> {
    let near = |end: f64| end.is_finite() && (frequency - end).abs() <= 1e-12 * end.abs();
    let range = &problem.frequency;
    match (range.is_held(), near(range.low), near(range.high)) {
        (false, true, _) => Some("lower"),
        (false, _, true) => Some("upper"),
        _ => None,
    }
}
