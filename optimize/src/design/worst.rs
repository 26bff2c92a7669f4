//! The machine within the tolerances of a design that has the least of what is sought.

use softstop_console::interrupt;
use softstop_dynamics::Orbit;
use softstop_dynamics::spread::velocity_slopes;

use super::Design;
use super::judge::Judged;
use super::problem::Problem;
use crate::robust::{Grade, Tolerances, Worst, least};

/// Its place in the box of tolerances, its motion and, as its value, its score; none if that cannot be told.
pub(super) fn worst(problem: &Problem, design: &Design) -> Option<Worst> {
    let spread = problem.spread(&design.machine)?;
    let scored = Scored {
        problem,
        design,
        spread: &spread,
    };
    least(&spread, &design.orbit, &scored, &interrupt::watch).ok()
}

/// The score of what is sought.
struct Scored<'a> {
    problem: &'a Problem,
    design: &'a Design,
    spread: &'a Tolerances,
}

impl Grade for Scored<'_> {
    fn value(&self, at: &[f64], orbit: &Orbit) -> Option<f64> {
        let machine = self.spread.machine(at);
        let Design { zone, place, .. } = self.design;
        let motion = Judged::new(&machine, zone, *place, orbit).ok()?;
        Some(self.problem.objective.score(self.problem.sought(&motion)?))
    }

    fn slopes(&self, at: &[f64], orbit: &Orbit) -> Option<Vec<f64>> {
        let is_velocity = self.problem.objective.is_velocity();
        is_velocity.then(|| velocity_slopes(self.spread, at, orbit).ok())?
    }
}
