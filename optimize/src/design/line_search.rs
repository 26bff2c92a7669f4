//! The best place along one zone: a line search in s with the zone already known.

use std::cell::RefCell;

use argmin::core::{CostFunction, Error, Executor};
use argmin::solver::brent::BrentOpt;
use softstop_dynamics::BranchPoint;

use super::as_required::as_required;
use super::coordinates::keep_best;
use super::problem::Problem;
use super::space::Interval;
use super::zoned::Zoned;
use super::{DISTANT, Design, Infeasible};

/// Places that are looked at before the best one is refined.
const SAMPLES: usize = 9;
/// Share of the window in which the end of the window is tried against its neighbourhood.
const STEP: f64 = 1e-4;
const REFINEMENTS: u64 = 60;
/// Accuracy of a best place inside the window: the velocity is flat there.
const TOLERANCE: f64 = 1e-8;

/// The stable motion that is best by the problem's objective and meets its requirements, in all cases, of the places that
/// margin, frequency bounds and tolerances leave.
///
/// # Errors
/// [`Infeasible`] if none of the motions looked at is found, stable and as required.
pub(super) fn best(zoned: &Zoned<'_>) -> Result<Design, Infeasible> {
    let mut ranges = zoned.ranges();
    if let [_, _, ..] = ranges[..] {
        let (open, closed): (Vec<_>, _) = ranges.into_iter().partition(|it| it.window().is_ok());
        ranges = if open.is_empty() { closed } else { open };
    }
    let found = ranges.iter().map(best_along);
    let better = |one, other| better_of(zoned.problem, one, other);
    found
        .reduce(better)
        .unwrap_or_else(|| Err(Infeasible::unknown("")))
}

/// The better of what two ranges have: the higher score, or what lacks less.
fn better_of(
    problem: &Problem,
    one: Result<Design, Infeasible>,
    other: Result<Design, Infeasible>,
) -> Result<Design, Infeasible> {
    match (one, other) {
        (Ok(one), Ok(other)) => match problem.score(&other) > problem.score(&one) {
            true => Ok(other),
            false => Ok(one),
        },
        (Ok(one), Err(_)) | (Err(_), Ok(one)) => Ok(one),
        (Err(one), Err(other)) => Err(other.nearer(Some(one))),
    }
}

/// The best motion along one range of a zone.
fn best_along(zoned: &Zoned<'_>) -> Result<Design, Infeasible> {
    let window = zoned.window()?;
    let line = Line {
        zoned,
        best: RefCell::default(),
        lack: RefCell::default(),
    };
    if window.is_held() {
        line.cost_at(window.low);
        return line.result();
    }
    let places: [f64; SAMPLES] =
        std::array::from_fn(|index| window.at(index as f64 / (SAMPLES - 1) as f64));
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

/// The motions along a zone.
struct Line<'a> {
    zoned: &'a Zoned<'a>,
    /// The best that was met: its score, its place, and its design unless only the velocity counts.
    best: RefCell<Option<(f64, f64, Option<Design>)>>,
    /// What the one lacks that is nearest to feasible ones.
    lack: RefCell<Option<Infeasible>>,
}

impl Line<'_> {
    /// Minus the score of the stable motion that is as required; for others a finite grade above all of those.
    fn cost_at(&self, place: f64) -> f64 {
        match self.score_at(place) {
            Ok((score, design)) => {
                keep_best(&mut self.best.borrow_mut(), (score, place, design), |it| {
                    it.0
                });
                -score
            }
            Err(found) => {
                let gap = found.gap;
                let known = self.lack.take();
                self.lack.replace(Some(found.nearer(known)));
                gap
            }
        }
    }

    /// The score of the design at a place, and the design; where only the velocity counts, without it, since its orbit would take
    /// a quarter more.
    fn score_at(&self, place: f64) -> Result<(f64, Option<Design>), Infeasible> {
        let problem = self.zoned.problem;
        let point = self.point_at(place)?;
        match problem.is_plain() {
            true => Ok((point.before_impact_velocity(), None)),
            false => {
                let design = self.design_at(place, &point)?;
                Ok((problem.score(&design), Some(design)))
            }
        }
    }

    /// The stable motion at a place.
    fn point_at(&self, place: f64) -> Result<BranchPoint, Infeasible> {
        let point = self.zoned.zone.point_at(place);
        let point = point.map_err(Infeasible::unknown)?;
        // At the fold itself a multiplier is 1: the limit of the stable motions, wanted for M = 0.
        let is_stable = point.is_stable() || place >= 1.0;
        if !is_stable || !point.before_impact_velocity().is_finite() {
            let reason = "the z = 1 motion is not stable there";
            return Err(Infeasible::new(instability(&point), reason));
        }
        Ok(point)
    }

    /// The design at a place with this motion, if it is as required in all cases.
    fn design_at(&self, place: f64, point: &BranchPoint) -> Result<Design, Infeasible> {
        let Zoned {
            problem,
            machine,
            zone,
            cases,
        } = self.zoned;
        let orbit = zone.orbit_of(point).map_err(Infeasible::unknown)?;
        let own = Design::of_orbit(machine.clone(), (zone, place), orbit);
        let frequency = own.drive_frequency();
        let own = as_required(problem, own)?;
        let in_case = |(case, stated): (&Zoned<'_>, _)| {
            let place = case.place_of(frequency);
            let design = case.at(place).ok_or_else(|| {
                let gap = (-place).max(place - 1.0).clamp(0.0, DISTANT);
                Infeasible::new(
                    gap,
                    "there is no stable z = 1 motion of its zone at this frequency",
                )
            });
            let design = design.and_then(|it| as_required(case.problem, it));
            design.map_err(|lack| lack.in_case(stated))
        };
        let cases = cases.iter().zip(&problem.cases).map(in_case);
        Ok(Design {
            cases: cases.collect::<Result<_, _>>()?,
            ..own
        })
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

    fn result(&self) -> Result<Design, Infeasible> {
        match self.best.take() {
            Some((.., Some(design))) => Ok(design),
            Some((_, place, None)) => self.design_at(place, &self.point_at(place)?),
            None => Err(self.lack.take().unwrap_or_else(|| Infeasible::unknown(""))),
        }
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
