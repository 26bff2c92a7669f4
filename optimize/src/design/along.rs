//! The best place along one zone: a line search in s with the zone already known.

use std::cell::RefCell;

use argmin::core::{CostFunction, Error, Executor};
use argmin::solver::brent::BrentOpt;
use softstop_dynamics::orbit::multipliers;
use softstop_dynamics::{BranchPoint, Orbit, Zone};

use super::Infeasible;
use super::space::Interval;

/// Places that are looked at before the best one is refined.
const SAMPLES: usize = 9;
/// Share of the window in which the end of the window is tried against its neighbourhood.
const STEP: f64 = 1e-4;
const REFINEMENTS: u64 = 60;
/// Accuracy of a best place inside the window: the velocity is flat there.
const TOLERANCE: f64 = 1e-8;

/// The stable motion with the highest before-impact velocity in the window of places.
///
/// # Errors
/// [`Infeasible`] if none of the motions looked at is found and stable.
pub fn best(zone: &Zone, window: Interval) -> Result<(f64, Orbit), Infeasible> {
    let line = Line {
        zone,
        best: RefCell::new(None),
        reason: RefCell::new(None),
    };
    if window.is_held() {
        return line.result(line.cost_at(window.low));
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
    line.result(costs[least])
}

fn samples(window: Interval) -> [f64; SAMPLES] {
    std::array::from_fn(|index| window.at(index as f64 / (SAMPLES - 1) as f64))
}

/// The motions along a zone and the best that was met.
struct Line<'zone> {
    zone: &'zone Zone,
    best: RefCell<Option<(f64, BranchPoint)>>,
    reason: RefCell<Option<String>>,
}

impl Line<'_> {
    /// Minus the velocity of the stable motion; for others a finite grade above all of those.
    fn cost_at(&self, place: f64) -> f64 {
        let point = match self.zone.point_at(place) {
            Ok(point) => point,
            Err(error) => {
                self.reason.replace(Some(error.to_string()));
                return LOST;
            }
        };
        let velocity = point.before_impact_velocity();
        // At the fold itself a multiplier is 1: the limit of the stable motions, wanted for M = 0.
        if !(point.is_stable() || place >= 1.0) || !velocity.is_finite() {
            self.reason
                .replace(Some("the z = 1 motion is not stable there".to_owned()));
            return instability(&point);
        }
        let mut best = self.best.borrow_mut();
        if best
            .as_ref()
            .is_none_or(|(_, known)| velocity > known.before_impact_velocity())
        {
            *best = Some((place, point));
        }
        -velocity
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

    fn result(&self, gap: f64) -> Result<(f64, Orbit), Infeasible> {
        let lost = |reason| Infeasible {
            gap: gap.max(0.0),
            reason,
        };
        let best = self.best.take();
        let (place, point) = best.ok_or_else(|| lost(self.reason.take().unwrap_or_default()))?;
        let orbit = self.zone.orbit(&point);
        Ok((place, orbit.map_err(|error| lost(error.to_string()))?))
    }
}

impl CostFunction for &Line<'_> {
    type Param = f64;
    type Output = f64;

    fn cost(&self, place: &f64) -> Result<f64, Error> {
        Ok(self.cost_at(*place))
    }
}

/// The grade where no motion was found.
const LOST: f64 = 10.0;

/// The grade of an unstable motion: how far its largest multiplier is outside the unit circle.
fn instability(point: &BranchPoint) -> f64 {
    let largest = multipliers(&point.monodromy)
        .iter()
        .map(|multiplier| multiplier.norm())
        .fold(0.0, f64::max);
    if largest.is_finite() {
        (largest - 1.0).clamp(0.0, LOST)
    } else {
        LOST
    }
}
