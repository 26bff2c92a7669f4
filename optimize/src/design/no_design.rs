//! Why a search has no design: what was looked for, and what the nearest try lacks.

use std::collections::HashSet;

use softstop::internals::plain_number;
use softstop_dynamics::zone::ZoneKind;

use super::conflict::stated;
use super::found::SearchResult;
use super::improve_catalogue::Catalogues;
use super::space::{Axis, Interval};
use super::{Infeasible, Problem};
use crate::order::sort_falling;

/// Why a search has no design to show.
#[derive(Debug, thiserror::Error)]
pub enum SearchError {
    /// Nothing that was met within the bounds is feasible.
    #[error("{found}; nearest try{place}: {reason}")]
    NoDesign {
        /// What was looked for and where, in words.
        found: String,
        /// The least infeasible point: names and values.
        place: String,
        /// What is wrong there.
        reason: String,
    },
    /// The watcher said stop; the best design until then, if there was one that is as asked as far as was looked at.
    #[error("stopped")]
    Stopped(Option<Box<SearchResult>>),
    /// The survey and the ascents from it cost more than they may.
    #[error("over its budget")]
    OverBudget,
}

impl SearchError {
    /// Nothing feasible was met of a problem whose survey saw so many machines, if it was that which met nothing, and of which
    /// trials were made with so many of all choices from catalogues: more is not said than that.
    pub(super) fn no_design(
        problem: &Problem,
        surveyed: Option<usize>,
        choices: Option<[usize; 2]>,
        lack: Infeasible,
    ) -> Self {
        let zone = match problem.zone {
            ZoneKind::Hysteresis => " in a hysteresis zone",
            ZoneKind::SingleImpact { .. } => "",
        };
        let sought = format!("stable z = 1 motion{zone}");
        let found = match (surveyed.zip(widest(problem)), choices) {
            (Some((surveyed, widest)), _) => format!(
                "found no {sought} that is as the task asks; the survey saw {surveyed} machines on a logarithmic lattice: narrow {widest}"
            ),
            (None, Some([tried, all])) => format!(
                "found no {sought} that is as the task asks; what takes many motions was tried with {tried} of {all} choices from \
                 catalogues"
            ),
            (None, None) => format!("no {sought} is as the task asks within the bounds"),
        };
        let values = lack.unit.map(|unit| problem.axis_values(&unit));
        let axes = problem.axes.iter().zip(values.unwrap_or_default());
        let at = axes.map(|(axis, value)| stated(&problem.machine, axis.parameter, value));
        let at = at.collect::<Vec<_>>().join(", ");
        Self::NoDesign {
            found,
            place: match at.is_empty() {
                true => at,
                false => format!(", at {at}"),
            },
            reason: lack.reason,
        }
    }

    /// No design passes its trials: what the first lacks, or, of several choices from catalogues, the one that lacks least.
    pub(super) fn none_passes(problem: &Problem, surveyed: usize, failed: Vec<Infeasible>) -> Self {
        let catalogues = Catalogues::of(problem);
        let units = failed.iter().flat_map(|it| &it.unit);
        let tried: HashSet<_> = units.map(|unit| catalogues.places(unit)).collect();
        let choices = [tried.len(), catalogues.count()];
        let has_choices = choices[1] > 1 && !failed.is_empty();
        let least = failed.into_iter().reduce(|one, other| match has_choices {
            true => other.nearer(Some(one)),
            false => one,
        });
        let lack = least.unwrap_or_else(Infeasible::stopped);
        Self::no_design(
            problem,
            Some(surveyed),
            has_choices.then_some(choices),
            lack,
        )
    }
}

/// The axes that are searched by their logarithms, the widest first; none if there are none.
fn widest(problem: &Problem) -> Option<String> {
    let axes = problem.axes.iter();
    let wide = axes.filter_map(|axis| Some((axis, axis.decades()?)));
    let mut wide: Vec<(&Axis, f64)> = wide.collect();
    sort_falling(&mut wide, |it| it.1);
    let stated = |(axis, _): &(&Axis, f64)| {
        let Interval { low, high } = axis.range;
        let name = problem.machine.name(axis.parameter);
        format!("{name} = [{}, {}]", plain_number(low), plain_number(high))
    };
    let stated: Vec<String> = wide.iter().map(stated).collect();
    (!stated.is_empty()).then(|| stated.join(", "))
}

#[cfg(test)]
mod tests {
    use softstop::{Machine, Parameter};

    use super::{Axis, Infeasible, Problem, SearchError};

    #[test]
    fn of_catalogues_and_trials_no_more_is_said_than_what_was_tried() {
        let machine = Machine::named("unloaded").expect("the paper's machine");
        let axis = Axis::of_catalogue(Parameter::Damping, vec![1e-6, 0.02]);
        let problem = Problem::of(machine, vec![axis]);
        let lack = |gap, unit: f64| Infeasible::new(gap, gap.to_string()).at(&[unit]);
        let untried = SearchError::no_design(&problem, Some(9), None, lack(1.0, 0.0)).to_string();
        assert!(untried.starts_with("no stable z = 1 motion"));
        let tried = |failed| SearchError::none_passes(&problem, 9, failed).to_string();
        let one = tried(vec![lack(2.0, 0.1)]);
        assert!(one.starts_with("found no"), "{one}");
        assert!(one.contains("tried with 1 of 2 choices from catalogues"));
        let both = tried(vec![lack(2.0, 0.1), lack(0.5, 0.9)]);
        assert!(both.contains("tried with 2 of 2 choices"), "{both}");
        assert!(
            both.ends_with("nearest try, at damping = 0.02: 0.5"),
            "{both}"
        );
    }
}
