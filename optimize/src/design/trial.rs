//! Requirements that take many simulated motions: establishing certainty, run-up from rest, missing strips. They have
//! no derivatives; a design that fails them is moved by linear models (Powell 1994, the crate `cobyla`).

use std::cell::RefCell;

use cobyla::{Func, RhoBeg, StopTols, minimize};
use rayon::prelude::*;
use softstop_console::interrupt;
use softstop_dynamics::Orbit;
use softstop_dynamics::attractors::SurveyError;
use softstop_dynamics::basin::Establishment;
use softstop_dynamics::run_up::RunUp;
use softstop_dynamics::supply::{Reading, outlasts};

use super::Infeasible;
use super::coordinates::{Coordinates, Summit};
use super::figure::Figure;
use super::here::Here;
use super::judge::{Met, conflict, violation};
use super::problem::Problem;
use super::requirement::Requirement;

/// Starts of the box, and drive angles at which the drive is switched on or strips are missing.
const STARTS: usize = 1024;
const ANGLES: usize = 64;
/// Motions that are tried at most, edge of the first simplex, and when to end, in edges of the cube.
const MOST: usize = 60;
const FIRST: f64 = 0.1;
const LAST: f64 = 1e-4;
/// What stands where there is no motion.
const NOWHERE: f64 = 1e3;

impl Problem {
    /// What a motion has of the requirements that take many.
    ///
    /// # Errors
    /// [`SurveyError`] if a motion cannot be computed, or somebody asked to stop.
    pub fn tried(&self, orbit: &Orbit) -> Result<Vec<Met>, SurveyError> {
        let trials = self.requirements.iter().filter(|it| it.figure.is_trial());
        let tried = trials.map(|requirement| {
            Ok(Met {
                requirement: *requirement,
                value: value(requirement, orbit)?,
            })
        });
        tried.collect()
    }

    /// True if a motion must be tried.
    pub fn has_trials(&self) -> bool {
        self.requirements.iter().any(|it| it.figure.is_trial())
    }
}

fn value(requirement: &Requirement, orbit: &Orbit) -> Result<f64, SurveyError> {
    let watcher = &interrupt::watch;
    Ok(match requirement.figure {
        Figure::Certainty => Establishment::of(orbit, STARTS, watcher)?.share,
        Figure::RunUp => RunUp::of(orbit, ANGLES, watcher)?.works().count() as f64,
        Figure::MissingStrips => {
            let most = requirement.least.unwrap_or(0.0) as u32;
            for missing in 1..=most {
                let gaps = outlasts(orbit, missing, Reading::Fixed, ANGLES, watcher)?;
                if gaps.share() < 1.0 {
                    return Ok(f64::from(missing - 1));
                }
            }
            f64::from(most)
        }
        _ => f64::NAN,
    })
}

/// The best design that passes its trials: this one if it does, otherwise one that is sought from it and from places
/// nearer to g0, where motions are established more surely.
///
/// # Errors
/// [`Infeasible`] if none was met: what this design fails.
pub(super) fn pass(problem: &Problem, design: &Summit) -> Result<Summit, Infeasible> {
    let tried = problem
        .tried(&design.design.orbit)
        .map_err(|error| Infeasible {
            gap: NOWHERE,
            reason: error.to_string(),
        })?;
    if tried.iter().all(Met::is_met) {
        return Ok(design.clone());
    }
    let from = |share: &f64| {
        let mut start = design.clone();
        start.design.place *= share;
        settle(problem, &start)
    };
    let settled = NEARER.par_iter().map(from).collect::<Vec<_>>();
    let score = |it: &Summit| problem.objective.score(it.design.value);
    let best = settled
        .into_iter()
        .flatten()
        .max_by(|a, b| score(a).total_cmp(&score(b)));
    best.ok_or_else(|| Infeasible {
        gap: violation(&tried),
        reason: conflict(&design.design.machine, &tried),
    })
}

/// Places from which a design that passes is sought, as shares of that of one that does not.
const NEARER: [f64; 3] = [1.0, 0.6, 0.3];

/// The best design that passes its trials, sought from one that does not; none if none was met.
fn settle(problem: &Problem, from: &Summit) -> Option<Summit> {
    let coordinates = Coordinates::new(problem, &from.unit);
    let score = |value| problem.objective.score(value);
    let unit = score(from.design.value);
    let best: RefCell<Option<Summit>> = RefCell::default();
    let last: RefCell<Option<(Vec<f64>, Vec<f64>)>> = RefCell::default();
    let count = 1 + problem
        .requirements
        .iter()
        .map(|it| it.least.iter().chain(&it.most).count())
        .sum::<usize>();
    // The objective, then the constraints, not negative where they are met.
    let values = |at: &[f64]| -> Vec<f64> {
        if let Some((known, values)) = &*last.borrow()
            && known == at
        {
            return values.clone();
        }
        let values =
            tried_at(problem, &coordinates, at, &best).unwrap_or_else(|| vec![-NOWHERE; count]);
        last.replace(Some((at.to_vec(), values.clone())));
        values
    };
    let part = |index: usize, factor: f64| {
        move |values: Vec<f64>| factor * values.get(index).copied().unwrap_or(0.0)
    };
    let objective = part(0, -unit.recip());
    let objective = |at: &[f64], _: &mut ()| objective(values(at));
    let values = &values;
    let constraints = (1..count).map(|index| {
        let part = part(index, 1.0);
        move |at: &[f64], _: &mut ()| part(values(at))
    });
    let constraints: Vec<_> = constraints.collect();
    let constraints: Vec<&dyn Func<()>> = constraints.iter().map(|it| it as _).collect();
    let start = coordinates.of(from);
    let stop = StopTols {
        xtol_abs: vec![LAST; start.len()],
        ..StopTols::default()
    };
    let bounds = coordinates.bounds(problem);
    let _ = minimize(
        objective,
        &start,
        &bounds,
        &constraints,
        (),
        MOST,
        RhoBeg::All(FIRST),
        Some(stop),
    );
    best.into_inner()
}

/// The score and the constraints at a point; a design that passes is kept if it is the best.
fn tried_at(
    problem: &Problem,
    coordinates: &Coordinates,
    at: &[f64],
    best: &RefCell<Option<Summit>>,
) -> Option<Vec<f64>> {
    let unit = coordinates.unit(at);
    let here = Here::find(problem, &coordinates.at(&unit, at))?;
    let motion = here.judged()?;
    let all = problem
        .met(&motion)
        .into_iter()
        .chain(problem.tried(&here.orbit).ok()?);
    let all: Vec<Met> = all.collect();
    let value = problem.sought(&motion)?;
    let bounds = all.iter().flat_map(|it| {
        let requirement = it.requirement;
        let size = |bound: f64| if bound == 0.0 { 1.0 } else { bound.abs() };
        let least = requirement
            .least
            .map(|least| (it.value - least) / size(least));
        let most = requirement.most.map(|most| (most - it.value) / size(most));
        least.into_iter().chain(most)
    });
    let values: Vec<f64> = [problem.objective.score(value)]
        .into_iter()
        .chain(bounds)
        .collect();
    let mut best = best.borrow_mut();
    let is_better = best.as_ref().is_none_or(|best| {
        problem.objective.score(value) > problem.objective.score(best.design.value)
    });
    if all.iter().all(Met::is_met) && here.is_within(problem) && is_better {
        *best = Some(Summit {
            unit,
            design: here.design(value),
        });
    }
    Some(
        values
            .into_iter()
            .map(|value| value.clamp(-NOWHERE, NOWHERE))
            .collect(),
    )
}
