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

use super::conflict::conflict;
use super::coordinates::{Coordinates, Summit};
use super::figure::Figure;
use super::gradient::ascend_from;
use super::here::Here;
use super::judge::{Met, violation};
use super::problem::Problem;
use super::requirement::Requirement;
use super::space::Space;
use super::{Design, Infeasible};

/// Starts of the box, and drive angles at which the drive is switched on or strips are missing.
const STARTS: usize = 1024;
const ANGLES: usize = 64;
/// Zones that are tried at most, edge of the first simplex, and when to end, in edges of the cube.
const MOST: usize = 16;
const FIRST: f64 = 0.1;
const LAST: f64 = 1e-4;
/// Places of a zone that are tried, and halvings between the last that passes and the next.
const PLACES: usize = 8;
const HALVINGS: usize = 6;
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
            let (value, starts) = value(requirement, orbit)?;
            Ok(Met {
                requirement: *requirement,
                value,
                starts,
            })
        });
        tried.collect()
    }

    /// True if a motion must be tried.
    pub fn has_trials(&self) -> bool {
        self.requirements.iter().any(|it| it.figure.is_trial())
    }
}

/// The share of starts that lead to a motion.
///
/// # Errors
/// As [`Problem::tried`].
pub(super) fn certainty(orbit: &Orbit) -> Result<f64, SurveyError> {
    Ok(Establishment::of(orbit, STARTS, &interrupt::watch)?.share)
}

/// What a motion has of a figure, and the starts that tell it.
fn value(
    requirement: &Requirement,
    orbit: &Orbit,
) -> Result<(f64, Option<Establishment>), SurveyError> {
    let watcher = &interrupt::watch;
    let value = match requirement.figure {
        Figure::Certainty => {
            let starts = Establishment::of(orbit, STARTS, watcher)?;
            return Ok((starts.share, Some(starts)));
        }
        Figure::Integrity => {
            let (starts, radius) = Establishment::with_ball(orbit, STARTS, watcher)?;
            return Ok((radius, Some(starts)));
        }
        Figure::RunUp => RunUp::of(orbit, ANGLES, watcher)?.works().count() as f64,
        Figure::MissingStrips => f64::from(survived(requirement, orbit)?),
        _ => f64::NAN,
    };
    Ok((value, None))
}

/// Strips in a row that may be missing, as many as are asked for at most.
fn survived(requirement: &Requirement, orbit: &Orbit) -> Result<u32, SurveyError> {
    let most = requirement.least.unwrap_or(0.0) as u32;
    for missing in 1..=most {
        let gaps = outlasts(orbit, missing, Reading::Fixed, ANGLES, &interrupt::watch)?;
        if gaps.share() < 1.0 {
            return Ok(missing - 1);
        }
    }
    Ok(most)
}

/// The best design that passes its trials: this one if it does, otherwise one that is sought from it and from the best
/// ones with wider margins.
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
    let from = |margin: &f64| {
        let wider = Problem {
            margin: margin.max(problem.margin),
            ..problem.clone()
        };
        let start = ascend_from(&wider, &design.unit, design.design.place)?;
        settle(problem, &start.unit)
    };
    let starts = [settle(problem, &design.unit)]
        .into_iter()
        .chain(MARGINS.par_iter().map(from).collect::<Vec<_>>());
    let score = |it: &Summit| problem.objective.score(it.design.value);
    let best = starts
        .flatten()
        .max_by(|a, b| score(a).total_cmp(&score(b)));
    best.ok_or_else(|| Infeasible {
        gap: violation(&tried),
        reason: conflict(&design.design.machine, &tried),
    })
}

/// Margins with which a design is sought that passes: motions are established the more surely, the farther from the fold.
const MARGINS: [f64; 2] = [0.2, 0.4];

/// The best design that passes its trials, sought over the axes from a point of the unit cube by linear models of the best
/// that passes along each zone; none if none was met.
fn settle(problem: &Problem, unit: &[f64]) -> Option<Summit> {
    let coordinates = Coordinates::new(problem, unit);
    let score = |it: &Summit| problem.objective.score(it.design.value);
    let best: RefCell<Option<Summit>> = RefCell::default();
    let objective = |at: &[f64], _: &mut ()| {
        let found = pass_along(problem, &coordinates.unit(at));
        let Some(found) = found else { return NOWHERE };
        let cost = -score(&found);
        let mut best = best.borrow_mut();
        if best.as_ref().is_none_or(|best| score(&found) > score(best)) {
            *best = Some(found);
        }
        cost
    };
    let start = coordinates.axes();
    if start.is_empty() {
        return pass_along(problem, unit);
    }
    let stop = StopTols {
        xtol_abs: vec![LAST; start.len()],
        ..StopTols::default()
    };
    let bounds = vec![(0.0, 1.0); start.len()];
    let none: [&dyn Func<()>; 0] = [];
    let _ = minimize(
        objective,
        &start,
        &bounds,
        &none,
        (),
        MOST,
        RhoBeg::All(FIRST),
        Some(stop),
    );
    best.into_inner()
}

/// The best motion along the zone of a point of the unit cube that passes: the places are tried from the best score down,
/// then the end of those that pass is narrowed.
fn pass_along(problem: &Problem, unit: &[f64]) -> Option<Summit> {
    let values = Space(&problem.axes).values(unit);
    let machine = problem.machine_at(&values);
    machine.validate().ok()?;
    let zone = problem.zone(&machine).ok()?;
    let window = problem.window(&machine, &zone).ok()?;
    let design = |place: f64| {
        let here = Here::on(machine.clone(), &zone, place)?;
        let motion = here.judged()?;
        let is_met = problem.met(&motion).iter().all(Met::is_met);
        let value = problem.sought(&motion).filter(|_| is_met)?;
        Some(here.design(value))
    };
    let passes = |design: &Design| {
        let tried = problem.tried(&design.orbit);
        tried.is_ok_and(|all| all.iter().all(Met::is_met))
    };
    let score = |it: &Design| problem.objective.score(it.value);
    let places = (0..=PLACES).map(|index| window.at(index as f64 / PLACES as f64));
    let mut all: Vec<Design> = places.filter_map(design).collect();
    all.sort_by(|a, b| score(b).total_cmp(&score(a)));
    let first = all.iter().position(&passes)?;
    let mut best = all[first].clone();
    if let Some(better) = first.checked_sub(1) {
        let mut failing = all[better].place;
        for _ in 0..HALVINGS {
            match design(0.5 * (best.place + failing)) {
                Some(middle) if score(&middle) > score(&best) && passes(&middle) => best = middle,
                Some(middle) => failing = middle.place,
                None => break,
            }
        }
    }
    Some(Summit {
        unit: unit.to_vec(),
        design: best,
    })
}
