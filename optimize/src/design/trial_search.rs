//! The search for the best design that passes its trials. They have no derivatives and count motions, so that what is sought
//! with them is a search among zones: a lattice of them, then those around the best (`direct_search`). Of each zone only places that
//! are better than the best so far are tried.

use std::cell::RefCell;

use serde::Serialize;
use softstop_dynamics::parallel;

use super::ascent::ascend_from;
use super::certain::{ShareGoal, certain};
use super::coordinates::{Candidate, Coordinates, best_by};
use super::critical::CriticalMachines;
use super::direct_search::direct_search;
use super::improve_catalogue::Catalogues;
use super::problem::{Objective, Problem};
use super::space::digits;
use super::trial::FULL;
use super::zoned::Zoned;
use super::{Design, GAIN};
use crate::order::sort_rising;

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
const PLACES: usize = 24;
const HALVINGS: u32 = 9;
/// Relative distance from a score at which another is just above it, and steps to find that.
const JUST: f64 = 1e-4;
const SECANTS: usize = 4;
/// Places of a zone that are tried to find one that passes, if none is known elsewhere, and if one is, or beyond the last.
const TRIES: usize = 8;
const FEW_TRIES: usize = 3;
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

/// That of [`Trials`].
pub(super) const RESOLUTION: Resolution = Resolution {
    axes: LAST,
    place: 1.0 / (PLACES << HALVINGS) as f64,
};

/// The search for a design that passes its trials.
pub(super) struct Trials<'a> {
    problem: &'a Problem,
    known: &'a CriticalMachines,
}

impl<'a> Trials<'a> {
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

    fn score(&self, design: &Design) -> f64 {
        self.problem.score(design)
    }

    /// The best design that passes, sought from one that does not: from the first ones on among the zones of a lattice, those
    /// beside the design and those of other choices from catalogues, then by a direct search and further choices in turn.
    pub(super) fn best(&self, from: &Candidate) -> Option<Candidate> {
        let coordinates = Coordinates::new(self.problem, &from.unit);
        let lattice = lattice(coordinates.axes().len());
        let lattice = lattice.iter().map(|at| coordinates.unit(at));
        let beside = BESIDE
            .into_iter()
            .flat_map(|step| coordinates.around(step, 0));
        let zones: Vec<_> = lattice.chain(beside).collect();
        let first = self.first(from);
        let best = self.best_of(&zones, first.as_ref()).or(first);
        let others = self.best_of(&self.other_choices(from), None);
        let best = self.better_of(best.into_iter().chain(others).collect());
        let mut best = best.or_else(|| self.nearest_passing(&zones))?;
        loop {
            best = self.improve_around(best)?;
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
        self.improve_around(self.first(from)?)
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
        let zoned = Zoned::find(self.problem, &cases, &self.problem.axis_values(unit))?;
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
    fn improve_around(&self, best: Candidate) -> Option<Candidate> {
        let better = |units: &[Vec<f64>], best: &Candidate| {
            let better = self.best_of(units, Some(best))?;
            let least = (1.0 + COUNTED_GAIN) * self.score(&best.design);
            let gains = self.score(&better.design) > least;
            Some((better, gains))
        };
        Some(direct_search(
            self.problem,
            best,
            LAST,
            |it| &it.unit,
            better,
        ))
    }

    /// As [`Trials::nearby`], but from what linear models lead to from each first.
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

    fn is_passed(&self, design: &Design) -> bool {
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

    /// The best motion along the zone of a point of the unit cube that passes and is better than that.
    fn along(&self, unit: &[f64], least: f64) -> Option<Design> {
        let problem = self.problem;
        let cases = problem.in_cases();
        let zoned = Zoned::find(problem, &cases, &problem.axis_values(unit))?;
        let window = zoned.window().ok()?;
        let design = |place: f64| self.known.design(problem, zoned.at(place)?);
        let places = (0..=PLACES).map(|index| window.at(index as f64 / PLACES as f64));
        let motions: Vec<Option<Design>> = places.map(|place| zoned.at(place)).collect();
        let sampled = self.designs_above(least, motions);
        let pairs = sampled.windows(2);
        let pairs = pairs.filter_map(|pair| pair[0].as_ref().zip(pair[1].as_ref()));
        let crossings = pairs.filter_map(|pair| self.just_above(least, pair, design));
        let mut all: Vec<Design> = crossings.collect();
        let better = sampled.into_iter().flatten();
        all.extend(better.filter(|it| self.score(it) > least));
        sort_rising(&mut all, |it| self.score(it));
        let last = all.len().checked_sub(1)?;
        // The least of them pass most easily, but what is counted scatters; the best ends the search.
        let spread: Vec<usize> = match least > 0.0 {
            true => (0..=last).take(FEW_TRIES).collect(),
            false => (0..TRIES).map(|index| index * last / (TRIES - 1)).collect(),
        };
        let mut ascending = spread.into_iter();
        let mut low = ascending.rfind(|index| self.is_passed(&all[*index]))?;
        let mut high = all.len();
        while high - low > 1 {
            let middle = low.midpoint(high);
            match self.is_passed(&all[middle]) {
                true => low = middle,
                false => high = middle,
            }
        }
        // What is counted scatters: some of the next may pass again.
        let beyond = |low: usize| {
            let mut next = (low + 2..all.len()).take(FEW_TRIES);
            next.find(|index| self.is_passed(&all[*index]))
        };
        while let Some(next) = beyond(low) {
            (low, high) = (next, next + 1);
        }
        let next = all.get(high).cloned();
        let mut best = all.swap_remove(low);
        let Some(mut failing) = next else {
            return Some(best);
        };
        for _ in 0..HALVINGS {
            match design(0.5 * (best.place + failing.place)) {
                Some(middle) if self.score(&middle) <= self.score(&best) => break,
                Some(middle) if self.is_passed(&middle) => best = middle,
                Some(middle) => failing = middle,
                None => break,
            }
        }
        Some(best)
    }

    /// The designs of the motions along a zone whose own machine scores above `least`, and of those beside them, between which
    /// the zone crosses `least`. No other one can: a tolerance never raises a score.
    fn designs_above(&self, least: f64, motions: Vec<Option<Design>>) -> Vec<Option<Design>> {
        let Objective { figure, .. } = self.problem.objective;
        let is_above = |motion: &Option<Design>| {
            let motion = motion.as_ref();
            motion.is_some_and(|motion| {
                let own = self.problem.nominal_of(figure, motion);
                own.is_none_or(|own| self.problem.objective.score(own) > least)
            })
        };
        let above: Vec<bool> = motions.iter().map(is_above).collect();
        let is_beside = |index: usize| above[index.saturating_sub(1)..].iter().take(3);
        let all = motions.into_iter().enumerate();
        let designs = all.map(|(index, motion)| match is_beside(index).any(|it| *it) {
            true => self.known.design(self.problem, motion?),
            false => None,
        });
        designs.collect()
    }

    /// Between two motions of a zone, one whose score is above a bound by very little; none if both are on one side of it.
    fn just_above(
        &self,
        bound: f64,
        (one, other): (&Design, &Design),
        design: impl Fn(f64) -> Option<Design>,
    ) -> Option<Design> {
        let above = |it: &Design| self.score(it) - bound;
        let [mut low, mut high] = [one, other].map(|it| (it.place, above(it)));
        let mut found = None;
        for _ in 0..SECANTS {
            if low.1 > high.1 {
                (low, high) = (high, low);
            }
            if low.1 > 0.0 || high.1 <= JUST * bound {
                break;
            }
            let aim = 0.5 * JUST * bound;
            let share = (aim - low.1) / (high.1 - low.1);
            let middle = design(low.0 + share * (high.0 - low.0))?;
            let end = (middle.place, above(&middle));
            if end.1 > 0.0 {
                (high, found) = (end, Some(middle));
            } else {
                low = end;
            }
        }
        found
    }
}

/// Points of a lattice over the cube, each in the middle of an equal part.
fn lattice(dimensions: usize) -> Vec<Vec<f64>> {
    let edge = (LATTICE as f64).powf(1.0 / dimensions.max(1) as f64) as usize;
    let count = edge.checked_pow(dimensions as u32).unwrap_or(0);
    let middle = |digit: usize| (digit as f64 + 0.5) / edge as f64;
    let point = |index| digits(index, edge, dimensions).map(middle).collect();
    (0..count).map(point).collect()
}
