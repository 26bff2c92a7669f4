//! The best place along one zone: a line search in s with the zone already known.

use std::cell::RefCell;

use argmin::core::{CostFunction, Error, Executor};
use argmin::solver::brent::BrentOpt;
use softstop::Machine;
use softstop_dynamics::{BranchPoint, Orbit, Zone};

use super::conflict::{conflict, short};
use super::judge::{Judged, violation};
use super::problem::Problem;
use super::space::Interval;
use super::{DISTANT, Infeasible};

/// Places that are looked at before the best one is refined.
const SAMPLES: usize = 9;
/// Share of the window in which the end of the window is tried against its neighbourhood.
const STEP: f64 = 1e-4;
const REFINEMENTS: u64 = 60;
/// Accuracy of a best place inside the window: the velocity is flat there.
const TOLERANCE: f64 = 1e-8;

/// The stable motion in the window of places that is best by the problem's objective and meets its requirements.
///
/// # Errors
/// [`Infeasible`] if none of the motions looked at is found, stable and as required.
pub fn best(
    problem: &Problem,
    machine: &Machine,
    zone: &Zone,
    window: Interval,
) -> Result<Best, Infeasible> {
    let line = Line {
        problem,
        machine,
        zone,
        best: RefCell::new(None),
        reason: RefCell::default(),
    };
    if window.is_held() {
        line.cost_at(window.low);
        return line.result();
    }
    let places = samples(window);
    let costs = places.map(|place| line.cost_at(place));
    let least = (0..SAMPLES)
        .min_by(|&a, &b| costs[a].total_cmp(&costs[b]))
        .unwrap_or(0);
    if !line.rises_to_end(window, least, costs[least]) {
        let bracket = (
            places[least.saturating_sub(1)],
            places[(least + 1).min(SAMPLES - 1)],
        );
        line.refine(bracket);
    }
    line.result()
}

fn samples(window: Interval) -> [f64; SAMPLES] {
    std::array::from_fn(|index| window.at(index as f64 / (SAMPLES - 1) as f64))
}

/// The best motion along a zone.
#[derive(Debug, Clone)]
pub struct Best {
    /// Its place.
    pub place: f64,
    /// The motion.
    pub orbit: Orbit,
    /// What is sought, in SI units.
    pub value: f64,
}

/// The motions along a zone and the best that was met.
struct Line<'zone> {
    problem: &'zone Problem,
    machine: &'zone Machine,
    zone: &'zone Zone,
    best: RefCell<Option<Met>>,
    /// The least gap to feasible ones, and why.
    reason: RefCell<(f64, String)>,
}

/// The best so far.
struct Met {
    place: f64,
    point: BranchPoint,
    value: f64,
    cost: f64,
}

impl Line<'_> {
    /// Minus the score of the stable motion that is as required; for others a finite grade above all of those.
    fn cost_at(&self, place: f64) -> f64 {
        let point = match self.zone.point_at(place) {
            Ok(point) => point,
            Err(error) => return self.fails(DISTANT, || error.to_string()),
        };
        let velocity = point.before_impact_velocity();
        // At the fold itself a multiplier is 1: the limit of the stable motions, wanted for M = 0.
        if !(point.is_stable() || place >= 1.0) || !velocity.is_finite() {
            return self.fails(instability(&point), || {
                "the z = 1 motion is not stable there".to_owned()
            });
        }
        let value = match self.problem.is_plain() {
            true => Ok(velocity),
            false => self.judged(place, &point),
        };
        let value = match value {
            Ok(value) => value,
            Err(Infeasible { gap, reason }) => return self.fails(gap, || reason),
        };
        let cost = -self.problem.objective.score(value);
        let mut best = self.best.borrow_mut();
        if best.as_ref().is_none_or(|known| cost < known.cost) {
            *best = Some(Met {
                place,
                point,
                value,
                cost,
            });
        }
        cost
    }

    /// What is sought, of a motion that is as required.
    fn judged(&self, place: f64, point: &BranchPoint) -> Result<f64, Infeasible> {
        let orbit = self.zone.orbit(point).map_err(Infeasible::unknown)?;
        let motion = Judged::new(self.machine, self.zone, place, &orbit);
        let motion = motion.map_err(Infeasible::unknown)?;
        let met = self.problem.met(&motion);
        match violation(&met) {
            0.0 => self.problem.sought(&motion).ok_or_else(|| {
                let figure = self.problem.objective.figure;
                let name = figure.name();
                Infeasible::unknown(match self.problem.value(&motion, figure) {
                    value if value.is_finite() => {
                        format!(
                            "{name} is {}: what is sought must be positive",
                            short(value)
                        )
                    }
                    _ => format!("{name} has no value"),
                })
            }),
            gap => Err(Infeasible {
                gap,
                reason: conflict(self.machine, &met),
            }),
        }
    }

    /// Notes why a motion is none to take.
    fn fails(&self, gap: f64, reason: impl FnOnce() -> String) -> f64 {
        let mut known = self.reason.borrow_mut();
        if known.1.is_empty() || gap < known.0 {
            *known = (gap, reason());
        }
        gap
    }

    /// Whether the best sample is an end of the window with the velocity rising right to it.
    fn rises_to_end(&self, window: Interval, least: usize, cost: f64) -> bool {
        match least {
            0 => self.cost_at(window.at(STEP)) >= cost,
            last if last == SAMPLES - 1 => self.cost_at(window.at(1.0 - STEP)) >= cost,
            _ => false,
        }
    }

    /// Brent's search between two places. What it finds is kept by [`Line::cost_at`], so its
    /// own verdict is not needed: a search that fails leaves the best sample standing.
    fn refine(&self, (low, high): (f64, f64)) {
        let solver = BrentOpt::new(low, high).set_tolerance(f64::EPSILON.sqrt(), TOLERANCE);
        let _ = Executor::new(self, solver)
            .configure(|state| state.max_iters(REFINEMENTS))
            .timer(false)
            .run();
    }

    fn result(&self) -> Result<Best, Infeasible> {
        let Some(best) = self.best.take() else {
            let (gap, reason) = self.reason.take();
            return Err(Infeasible { gap, reason });
        };
        let orbit = self.zone.orbit(&best.point);
        let orbit = orbit.map_err(Infeasible::unknown)?;
        Ok(Best {
            place: best.place,
            orbit,
            value: best.value,
        })
    }
}

impl CostFunction for &Line<'_> {
    type Param = f64;
    type Output = f64;

    fn cost(&self, place: &f64) -> Result<f64, Error> {
        Ok(self.cost_at(*place))
    }
}

/// The grade of an unstable motion: how far its largest multiplier is outside the unit circle.
fn instability(point: &BranchPoint) -> f64 {
    let largest = point
        .monodromy
        .multipliers()
        .iter()
        .map(|multiplier| multiplier.norm())
        .fold(0.0, f64::max);
    if largest.is_finite() {
        (largest - 1.0).clamp(0.0, DISTANT)
    } else {
        DISTANT
    }
}
