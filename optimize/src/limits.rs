//! What holds a design back.

use serde::Serialize;
use softstop::Parameter;

use crate::design::Problem;
use crate::design::conflict::bound;
use crate::design::figure::Figure;
use crate::design::judge::Met;
use crate::design::space::Interval;
use crate::optimize::outcome::Outcome;

/// One thing that does.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
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

/// Distance in s within which a design stands at the end of the allowed window.
const AT_MARGIN: f64 = 1e-9;
/// Share of a bound within which it holds a design back.
const AT_BOUND: f64 = 1e-6;

/// All that holds a design back.
pub fn at_limits(problem: &Problem, found: &Outcome) -> Vec<Limit> {
    let design = &found.design;
    let at_end = |parameter: Parameter, range: Interval| {
        let end = end(range, design.machine.value(parameter)?)?;
        let machine = &design.machine;
        let (key, meaning) = (machine.name(parameter), machine.meaning_of(parameter).0);
        let words = format!("the {end} bound of the {meaning}");
        Some(Limit::new(format!("{key}: {end} bound"), words))
    };
    let axes = problem.axes.iter();
    let axes = axes.filter_map(|axis| at_end(axis.parameter, axis.range));
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
    } else {
        limits.extend(at_end(Parameter::Frequency, problem.frequency));
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

/// The end of a searched range at which a value stands, to rounding: frequencies pass through the place in the zone, and
/// other values through the optimiser's unit cube.
fn end(range: Interval, value: f64) -> Option<&'static str> {
    let width = range.high - range.low;
    let rounding = AT_BOUND
        * if width.is_finite() {
            width
        } else {
            value.abs()
        };
    let is_near = |end: f64| end.is_finite() && (value - end).abs() <= rounding;
    match (range.is_held(), is_near(range.low), is_near(range.high)) {
        (false, true, _) => Some("lower"),
        (false, _, true) => Some("upper"),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::{Interval, end};

    #[test]
    fn a_bound_is_met_to_rounding() {
        let range = |low, high| Interval { low, high };
        let clearance = range(0.005, 0.04);
        assert_eq!(end(clearance, 0.005_000_000_011_588_867), Some("lower"));
        assert_eq!(end(clearance, 0.04), Some("upper"));
        assert_eq!(end(clearance, 0.0051), None);
        assert_eq!(end(range(f64::MIN_POSITIVE, f64::INFINITY), 1.2), None);
        assert_eq!(end(Interval::held(2.0), 2.0), None);
    }
}
