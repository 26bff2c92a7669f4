//! What holds a design back, and what the ends of zones are called.

use serde::Serialize;
use softstop::Parameter;
use softstop_dynamics::continuation::TestFunction;
use softstop_dynamics::zone::ZoneEnd;
use softstop_explore::zone::lost_by;

use crate::design::conflict::bound;
use crate::design::constraint::Limit;
use crate::design::figure::Figure;
use crate::design::search::SearchResult;
use crate::design::space::End;
use crate::design::{Design, Problem};

/// A limit that holds a design back, named.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct NamedLimit {
    /// For programs: a key and which of its bounds.
    pub key: String,
    /// For people: a phrase after "held back by".
    pub words: String,
}

impl NamedLimit {
    fn new(key: impl Into<String>, words: impl Into<String>) -> Self {
        Self {
            key: key.into(),
            words: words.into(),
        }
    }
}

/// All that holds a design back.
pub fn at_limits(problem: &Problem, found: &SearchResult) -> Vec<NamedLimit> {
    let points = problem.operating_points(&found.design);
    let named = found.limits.iter().filter_map(|active| {
        let point = points.iter().find(|it| it.case == active.case)?;
        let found = limit(&point.problem, point.design, &active.limit)?;
        let Some(index) = active.case else {
            return Some(found);
        };
        let name = &problem.cases[index].name;
        Some(NamedLimit {
            key: format!("{} in case {name}", found.key),
            words: format!("{} in case {name}", found.words),
        })
    });
    named.collect()
}

fn limit(problem: &Problem, design: &Design, limit: &Limit) -> Option<NamedLimit> {
    let at_end = |parameter: Parameter, end: End| {
        let end = match end {
            End::Lower => "lower",
            End::Upper => "upper",
        };
        let machine = &design.machine;
        let (key, meaning) = (machine.name(parameter), machine.meaning_of(parameter).0);
        let words = format!("the {end} bound of the {meaning}");
        NamedLimit::new(format!("{key}: {end} bound"), words)
    };
    let side = |end| {
        end_name(match end {
            End::Lower => &design.zone.low,
            End::Upper => &design.zone.high,
        })
    };
    Some(match limit {
        Limit::Axis(parameter, end) => at_end(*parameter, *end),
        Limit::Frequency(end) => at_end(Parameter::Frequency, *end),
        Limit::Margin(end) => at_margin(&side(*end)),
        Limit::Required(Figure::Share, _) => match design.place < 0.5 {
            true => at_margin(&side(End::Lower)),
            false => at_margin(&side(End::Upper)),
        },
        Limit::Required(figure, _) => {
            let requirement = problem
                .requirements
                .iter()
                .find(|it| it.figure == *figure)?;
            let (name, meaning) = (figure.name(), figure.meaning());
            let required = bound(&design.machine, requirement);
            NamedLimit::new(
                format!("{name}: {required}"),
                format!("the {meaning} ({name}), {required}"),
            )
        }
        Limit::Tolerances(end) => reached(&side(*end)),
        Limit::Loss => reached(&match problem.border_within(design) {
            Some(by) => format!("a border inside the zone ({by})"),
            None => "a border inside the zone".to_owned(),
        }),
    })
}

fn reached(what: &str) -> NamedLimit {
    NamedLimit::new(
        format!("tolerances: they reach {what}"),
        format!("the tolerances, which reach {what}"),
    )
}

fn at_margin(end: &str) -> NamedLimit {
    let key = format!("margin from {end}");
    let words = format!("the {key}");
    NamedLimit::new(key, words)
}

/// What ends a zone, in words.
pub(crate) fn end_name(end: &ZoneEnd) -> String {
    match &end.loss {
        _ if end.is_critical(TestFunction::Fold) => "s_SN".to_owned(),
        _ if end.is_critical(TestFunction::Flip) => "s_PD".to_owned(),
        loss => lost_by(loss),
    }
}
