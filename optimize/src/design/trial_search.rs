//! The search for the best design that passes its trials. They have no derivatives and count motions, so that what is sought
//! with them is a search among zones: a lattice of them and the border of machines that have none, then those around the best
//! (`direct_search`). Of each zone only places that are better than the best so far are tried.

use std::cell::RefCell;

use serde::Serialize;
use softstop_dynamics::parallel;

use super::ascent::ascend_from;
use super::certain::{ShareGoal, certain};
use super::coordinates::{Candidate, Coordinates, best_by};
use super::critical::CriticalMachines;
use super::direct_search::direct_search;
use super::improve_catalogue::Catalogues;
use super::problem::Problem;
use super::space::digits;
use super::trial::FULL;
use super::zoned::ZonedMachine;
use super::{Design, GAIN};

/// Zones of the lattice, at most.
const LATTICE: usize = 32;
/// Distances of the zones beside the design that fails, in edges of the cube: its hill may be narrower than the lattice.
const BESIDE: [f64; 2] = [0.05, 0.1];
/// Choices from catalogues that are all looked at, at most.
const MAX_CHOICES: usize = 64;
/// Last distance of the zones around the best, in edges of the cube.
const LAST: f64 = 6e-4;
/// Last distance where none passes, lack within which a zone may hold a design that does, and relative gain on the way there.
const LAST_MISS: f64 = 5e-3;
const NEAR_MISS: f64 = 0.1;
const LEAST_APPROACH: f64 = 1e-2;
/// Relative gain of a score that is none where trials hold the design back: one start more or less of those that are counted
/// changes it by more.
pub(super) const COUNTED_GAIN: f64 = 1e-4;
/// Places of a zone, and halvings between the best that passes and the next.
pub(super) const PLACES: usize = 24;
pub(super) const HALVINGS: u32 = 9;
/// Places of a zone that are tried to find one that passes, if one is known elsewhere, or beyond the last.
pub(super) const FEW_TRIES: usize = 3;
/// Margins with which a design is sought that passes: motions are established the more surely, the farther from the fold.
const MARGINS: [f64; 2] = [0.2, 0.4];

/// How fine a search with trials has looked.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Resolution {
    /// Step of each axis, as a share of its range.
    pub axes: f64,
    /// Step along a zone, as a share of it at most.
    pub place: f64,
}

/// That of [`TrialSearch`].
pub(super) const RESOLUTION: Resolution = Resolution {
    axes: LAST,
    place: 1.0 / (PLACES << HALVINGS) as f64,
};

/// The search for a design that passes its trials.
pub(super) struct TrialSearch<'a> {
    pub(super) problem: &'a Problem,
    pub(super) known: &'a CriticalMachines,
}

impl<'a> TrialSearch<'a> {
    /// The search with machines within the tolerances on which trials are made.
    pub(super) const fn new(problem: &'a Problem, known: &'a CriticalMachines) -> Self {
        Self { problem, known }
    }

    /// A design near one that does not pass its trials and passes them with its whole box, good to a per cent or so: the best along
    /// the zones of the design and of some with wider margins, improved by linear models; where these lead to none, they start
    /// from each.
    pub(super) fn nearby(&self, from: &Candidate) -> Option<Candidate> {
        let starts = self.starts(from);
        let boxed = |known| {
            let mut all = self.improve(&starts, known);
            all.retain(|it| self.problem.has_box(&it.design).is_ok());
            all
        };
        let mut found = boxed(None);
        if found.len() < 2 {
            let led_to = self.best_led_to(&starts);
            found.extend(led_to.map(|it| boxed(Some(it))).unwrap_or_default());
        }
        self.better_of(found)
    }

    pub(super) fn score(&self, design: &Design) -> f64 {
        self.problem.score(design)
    }

    /// The best design that passes, sought from one that does not: from the first ones on among the zones of a lattice, those at
    /// the border between its points that have none and others, those beside the design and those of other choices from catalogues,
    /// then by a direct search and further choices in turn.
    pub(super) fn best(&self, from: &Candidate) -> Option<Candidate> {
        let coordinates = Coordinates::new(self.problem, &from.unit);
        let (lattice, step) = lattice(coordinates.axes().len());
        let mut zones: Vec<_> = lattice.iter().map(|at| coordinates.unit(at)).collect();
        zones.extend(self.problem.border_between(&zones, 1.1 * step));
        let beside = BESIDE.into_iter();
        zones.extend(beside.flat_map(|step| coordinates.around(step, 0)));
        let first = self.first(from);
        let best = self.best_of(&zones, first.as_ref()).or(first);
        let others = self.best_of(&self.other_choices(from), None);
        let best = self.better_of(best.into_iter().chain(others).collect());
        let mut best = best.or_else(|| self.nearest_passing(&zones))?;
        loop {
            best = self.improve_around(best);
            match self.best_of(&self.other_choices(&best), Some(&best)) {
                Some(better) => best = better,
                None => break,
            }
        }
        let further = self.led_to(&best);
        self.better_of(further.into_iter().chain([best]).collect())
    }

    /// The points of other choices from catalogues, if these are few: the best motions are not those that pass.
    fn other_choices(&self, from: &Candidate) -> Vec<Vec<f64>> {
        let catalogues = Catalogues::of(self.problem);
        match catalogues.count() {
            2..=MAX_CHOICES => catalogues.units(&from.unit),
            _ => Vec::new(),
        }
    }

    /// The best design that passes, sought near one that does not: by a direct search without a lattice.
    pub(super) fn best_near(&self, from: &Candidate) -> Option<Candidate> {
        Some(self.improve_around(self.first(from)?))
    }

    /// A design that passes, where the zones that were looked at have none: a direct search from that which lacks least, until
    /// one has it.
    fn nearest_passing(&self, zones: &[Vec<f64>]) -> Option<Candidate> {
        let passing = RefCell::new(None);
        let better = |units: &[Vec<f64>], least: f64| {
            if passing.borrow().is_some() {
                return None;
            }
            let misses = parallel::filter_map(units, |unit| {
                Some((unit.clone(), self.least_violation(unit)?))
            });
            let nearest = misses.into_iter().min_by(|a, b| a.1.total_cmp(&b.1));
            let (unit, lack) = nearest.filter(|(_, lack)| *lack < least)?;
            if lack < NEAR_MISS {
                let design = self.along(&unit, 0.0);
                passing.replace(design.map(|design| Candidate {
                    unit: unit.clone(),
                    design,
                }));
            }
            Some((unit, lack))
        };
        let nearest = better(zones, f64::INFINITY)?;
        direct_search(
            self.problem,
            nearest,
            LAST_MISS,
            |(unit, _)| unit,
            |units, (_, lack)| Some((better(units, (1.0 - LEAST_APPROACH) * lack)?, true)),
        );
        passing.into_inner()
    }

    /// How far the best of a few motions along the zone of a point of the unit cube is from passing.
    fn least_violation(&self, unit: &[f64]) -> Option<f64> {
        let cases = self.problem.in_cases();
        let zoned = ZonedMachine::find(self.problem, &cases, &self.problem.axis_values(unit))?;
        let window = zoned.window().ok()?;
        let places = (0..FEW_TRIES).map(|index| index as f64 / (FEW_TRIES - 1) as f64);
        let lacks = places.filter_map(|place| {
            let design = self
                .known
                .design(self.problem, zoned.at(window.at(place))?)?;
            self.problem.trial_violation(&design)
        });
        lacks.min_by(f64::total_cmp)
    }

    /// A direct search from a design.
    fn improve_around(&self, best: Candidate) -> Candidate {
        let better = |units: &[Vec<f64>], best: &Candidate| {
            let border = self.problem.border_along(&best.unit, units);
            let better = self
                .best_of(&border, Some(best))
                .or_else(|| self.best_of(units, Some(best)))?;
            let least = (1.0 + COUNTED_GAIN) * self.score(&best.design);
            let gains = self.score(&better.design) > least;
            Some((better, gains))
        };
        direct_search(self.problem, best, LAST, |it| &it.unit, better)
    }

    /// As [`TrialSearch::nearby`], but from what linear models lead to from each first.
    fn first(&self, from: &Candidate) -> Option<Candidate> {
        let starts = self.starts(from);
        self.better_of(self.improve(&starts, self.best_led_to(&starts)))
    }

    /// A design, and those with wider margins to which the search leads from it.
    fn starts(&self, from: &Candidate) -> Vec<Candidate> {
        let wider = parallel::filter_map(&MARGINS, |margin| {
            let wider = Problem {
                margin: margin.max(self.problem.margin),
                ..self.problem.clone()
            };
            let place = (&from.unit[..], from.design.place);
            ascend_from(&wider, self.known, place)
        });
        [from.clone()].into_iter().chain(wider).collect()
    }

    /// The design that passes to which linear models of the share of starts lead from another, if that is required.
    fn led_to(&self, start: &Candidate) -> Option<Candidate> {
        let share = self.problem.least_share()?;
        let goal = ShareGoal {
            share,
            known: self.known,
            leaves_out_slow: false,
        };
        certain(self.problem, start, goal).filter(|it| self.passes(it))
    }

    /// The best of the designs to which linear models of the share of starts lead from some, if that is required.
    fn best_led_to(&self, starts: &[Candidate]) -> Option<Candidate> {
        self.better_of(parallel::filter_map(starts, |it| self.led_to(it)))
    }

    /// The best of a known design and of those along the zones of some, and what linear models lead to from it.
    fn improve(&self, starts: &[Candidate], known: Option<Candidate>) -> Vec<Candidate> {
        let units: Vec<_> = starts.iter().map(|it| it.unit.clone()).collect();
        let best = self.best_of(&units, known.as_ref()).or(known);
        let further = best.as_ref().and_then(|best| self.led_to(best));
        best.into_iter().chain(further).collect()
    }

    /// Whether a design keeps what is known of its box, and passes.
    fn passes(&self, it: &Candidate) -> bool {
        let kept = self.known.design(self.problem, it.design.clone());
        kept.is_some() && self.is_passed(&it.design)
    }

    pub(super) fn is_passed(&self, design: &Design) -> bool {
        self.problem.passes(design, self.known, FULL)
    }

    /// The best of some zones that is better than one that is known.
    fn best_of(&self, units: &[Vec<f64>], known: Option<&Candidate>) -> Option<Candidate> {
        let least = known.map_or(0.0, |it| (1.0 + GAIN) * self.score(&it.design));
        let found = parallel::filter_map(units, |unit| {
            Some(Candidate {
                unit: unit.clone(),
                design: self.along(unit, least)?,
            })
        });
        self.better_of(found)
    }

    /// The best of some designs, the first of several.
    fn better_of(&self, found: Vec<Candidate>) -> Option<Candidate> {
        best_by(found.into_iter().rev(), |it| self.score(&it.design))
    }
}

/// Points of a lattice over the cube, each in the middle of an equal part, and the distance of neighbours.
fn lattice(dimensions: usize) -> (Vec<Vec<f64>>, f64) {
    let edge = (LATTICE as f64).powf(1.0 / dimensions.max(1) as f64) as usize;
    let count = edge.checked_pow(dimensions as u32).unwrap_or(0);
    let middle = |digit: usize| (digit as f64 + 0.5) / edge as f64;
    let point = |index| digits(index, edge, dimensions).map(middle).collect();
    ((0..count).map(point).collect(), 1.0 / edge as f64)
}
