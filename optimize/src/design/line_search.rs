//! The best place along one zone: a line search in s with the zone already known.

use std::cell::RefCell;

use argmin::core::{CostFunction, Error, Executor};
use argmin::solver::brent::BrentOpt;
use softstop_dynamics::BranchPoint;

use super::conflict::{conflict, short};
use super::coordinates::keep_best;
use super::figure::Figure;
use super::judge::violation;
use super::problem::Problem;
use super::space::Interval;
use super::zoned::ZonedMachine;
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
pub(super) fn best(zoned: &ZonedMachine<'_>) -> Result<Design, Infeasible> {
    let window = zoned.window()?;
    let line = ZoneLine {
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
struct ZoneLine<'a> {
    zoned: &'a ZonedMachine<'a>,
    /// The best that was met: its score, its place, and its design unless only the velocity counts.
    best: RefCell<Option<(f64, f64, Option<Design>)>>,
    /// What the one lacks that is nearest to feasible ones.
    lack: RefCell<Option<Infeasible>>,
}

impl ZoneLine<'_> {
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
        let ZonedMachine {
            problem,
            machine,
            zone,
            cases,
        } = self.zoned;
        let orbit = zone.orbit_of(point).map_err(Infeasible::unknown)?;
        let own = Design::of_orbit(machine.clone(), (zone, place), orbit);
        let frequency = own.drive_frequency();
        let own = as_required(problem, own)?;
        let in_case = |(case, stated): (&ZonedMachine<'_>, _)| {
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

    /// Brent's search between two places. What it finds is kept by [`ZoneLine::cost_at`], so its
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

/// A design with the value of what is sought, if it is as required.
fn as_required(problem: &Problem, design: Design) -> Result<Design, Infeasible> {
    let motion = design.judged().map_err(Infeasible::unknown)?;
    let met = problem.met(&motion);
    let gap = violation(&met);
    if gap != 0.0 {
        return Err(Infeasible::new(gap, conflict(motion.machine, &met)));
    }
    let value = problem.sought(&motion).ok_or_else(|| {
        let figure = problem.objective.figure;
        let name = figure.name();
        Infeasible::unknown(match problem.value(&motion, figure) {
            value if value.is_finite() => {
                let value = short(value);
                format!("{name} is {value}: what is sought must be positive")
            }
            _ => match &problem.cost {
                Some(cost) if figure == Figure::Cost => {
                    format!("objective.cost = {cost:?} has no finite value")
                }
                _ => format!("{name} has no value"),
            },
        })
    })?;
    Ok(Design { value, ..design })
}

impl CostFunction for &ZoneLine<'_> {
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
