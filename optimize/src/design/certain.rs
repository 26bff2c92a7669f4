//! The best design with at least some share of starts that lead to its motion: the share has no derivative, so axes and
//! place are moved by linear models (Powell 1994, the crate `cobyla`).

use std::cell::RefCell;

use cobyla::{Func, RhoBeg, StopTols, minimize};

use super::Design;
use super::coordinates::{Candidate, Coordinates, keep_best};
use super::critical::CriticalMachines;
use super::problem::Problem;

/// Designs that are looked at, at most; edge of the first simplex, and when to end, in edges of the cube.
const MOST: usize = 40;
const FIRST: f64 = 0.15;
const LAST: f64 = 1e-3;
/// Share that is none: of less than the starts that are counted.
const LEAST: f64 = 1e-9;
/// What stands where there is no motion: far from every score, which are about 1, and from every share.
const NOWHERE: f64 = 10.0;

/// Which share of starts is sought.
#[derive(Debug, Clone, Copy)]
pub(super) struct ShareGoal<'a> {
    /// The least share.
    pub share: f64,
    /// Machines within the tolerances that have it too.
    pub known: &'a CriticalMachines,
    /// Whether designs are left out about which motions settle so slowly that to count their starts takes minutes, and those to
    /// whose motion none leads.
    pub leaves_out_slow: bool,
}

/// What is known of a point: the score, in units of that at the start, the share of starts beyond what is asked for, negative also
/// where that is left out, and how far it is within all else, which is negative beyond that.
#[derive(Debug, Clone, Copy)]
struct ShareSample {
    score: f64,
    share: f64,
    within: f64,
}

/// From a design on, by its own score; none if no design has so large a share, in its own machine and in all that are known.
pub(super) fn certain(
    problem: &Problem,
    from: &Candidate,
    goal: ShareGoal<'_>,
) -> Option<Candidate> {
    let coordinates = Coordinates::new(problem, &from.unit);
    let unit = problem.score(&from.design);
    let best: RefCell<Option<Candidate>> = RefCell::default();
    let last: RefCell<Option<(Vec<f64>, ShareSample)>> = RefCell::default();
    let look = |at: &[f64]| -> Option<ShareSample> {
        let unit_cube = coordinates.unit(at);
        let design = Design::find(problem, &coordinates.at(&unit_cube, at))?;
        let (design, violation) = goal.known.assess(problem, design, f64::INFINITY)?;
        let (score, outside) = (
            problem.score(&design),
            violation + design.outside_window(problem)?,
        );
        let decay = design.relative_decay();
        let share = match goal.leaves_out_slow {
            true if decay < 1.0 => decay.max(0.0).ln().max(-NOWHERE) - 1.0,
            _ => match problem.least_certainty(&design, goal.known)? {
                // Faster decay leads to where some do.
                none if goal.leaves_out_slow && none < LEAST => -decay.recip(),
                share => share,
            },
        };
        let known = ShareSample {
            score: score / unit,
            share: share - goal.share,
            within: -outside,
        };
        if known.share >= 0.0 && outside == 0.0 {
            let unit = unit_cube.clone();
            let candidate = Candidate { unit, design };
            keep_best(&mut best.borrow_mut(), candidate, |it| {
                problem.score(&it.design)
            });
        }
        Some(known)
    };
    let known = |at: &[f64]| {
        let is_last = matches!(&*last.borrow(), Some((other, _)) if other == at);
        if !is_last {
            let found = look(at).unwrap_or(ShareSample {
                score: 0.0,
                share: -NOWHERE,
                within: -NOWHERE,
            });
            last.replace(Some((at.to_vec(), found)));
        }
        last.borrow().as_ref().map(|(_, known)| *known)
    };
    let objective = |at: &[f64], _: &mut ()| known(at).map_or(0.0, |it| -it.score);
    let enough = |at: &[f64], _: &mut ()| known(at).map_or(0.0, |it| it.share);
    let within = |at: &[f64], _: &mut ()| known(at).map_or(0.0, |it| it.within);
    let constraints: [&dyn Func<()>; 2] = [&enough, &within];
    let start = coordinates.start(from.design.place);
    if start.is_empty() {
        // Nothing can be moved; the crate would read beyond its arrays.
        known(&start);
        return best.into_inner();
    }
    let stop = StopTols {
        xtol_abs: vec![LAST; start.len()],
        ..StopTols::default()
    };
    let _ = minimize(
        objective,
        &start,
        &coordinates.bounds(problem),
        &constraints,
        (),
        MOST,
        RhoBeg::All(FIRST),
        Some(stop),
    );
    best.into_inner()
}
