//! Keeps the whole box of tolerances. A search knows the ends of the zone; what else is lost within the box, a fold inside
//! the zone, a flip, an inner grazing, and which machines leave the bounds of a requirement, is looked for about what it has
//! found. Each such place becomes a constraint, and the design moves until there are no more.

use softstop_console::interrupt;
use softstop_dynamics::zone::Loss;
use softstop_explore::zone::lost_by;

use super::ascent::ascend_from;
use super::conflict::violated_within;
use super::coordinates::{Candidate, best_by, keep_best};
use super::critical::{Criterion, CriticalMachines};
use super::figure::{Figure, Sense};
use super::multipliers::held;
use super::problem::Problem;
use super::{Design, GAIN, Infeasible};
use crate::order::sort_rising;
use crate::robust::{Manifold, Norm, Tolerances, Worst, first_losses, nearest, worst};

/// How often a design is moved.
const ROUNDS: usize = 16;
/// Share of the tolerances that is rounding.
const ROUNDING: f64 = 1e-7;
/// Rate of the score by the edges of the cube, relative, that is none at a maximum.
const STUCK: f64 = 1e-3;
/// Directions that are added at once, at most.
const MOST: usize = 4;
/// Places of the zone from which a design is sought anew.
const PLACES: [f64; 5] = [0.5, 0.3, 0.7, 0.1, 0.9];

/// What is lost of a design within its tolerances.
#[derive(Debug, Clone)]
struct BoxLoss {
    /// In this direction of the box.
    direction: Vec<f64>,
    /// At this share of the way.
    share: f64,
    /// By this, in words.
    by: String,
}

/// A design with its whole box.
#[derive(Debug, Clone)]
pub(super) struct RobustDesign {
    pub candidate: Candidate,
    /// What had to be known for that.
    pub known: CriticalMachines,
}

/// The best design about this one of which no machine within the tolerances loses the motion or violates a requirement.
///
/// # Errors
/// [`Infeasible`] with how much is lacking if there is none.
pub(super) fn enforce_tolerance_box(
    problem: &Problem,
    start: &Candidate,
) -> Result<RobustDesign, Infeasible> {
    enforce(problem, start, CriticalMachines::default())
}

/// [`enforce_tolerance_box`] with the critical machines that are known already.
pub(super) fn enforce(
    problem: &Problem,
    start: &Candidate,
    mut known: CriticalMachines,
) -> Result<RobustDesign, Infeasible> {
    let score = |it: &Candidate| problem.score(&it.design);
    let mut candidate = start.clone();
    let mut best: Option<RobustDesign> = None;
    let mut lack: Option<Infeasible> = None;
    for _ in 0..ROUNDS {
        let BoxCheck { is_new, lack: lost } = look(problem, &mut candidate.design, &mut known);
        match lost {
            Some(lost) => lack = Some(lost.at(&candidate.unit).nearer(lack)),
            None => {
                let found = RobustDesign {
                    candidate: candidate.clone(),
                    known: known.clone(),
                };
                keep_best(&mut best, found, |it| score(&it.candidate));
            }
        }
        let next = match is_new {
            true => again(problem, &known, &candidate).next(),
            false if is_stuck(problem, &candidate, &known) => {
                let others = again(problem, &known, &candidate);
                let better = others.filter(|it| score(it) > (1.0 + GAIN) * score(&candidate));
                best_by(better, score)
            }
            false => None,
        };
        let Some(next) = next else { break };
        candidate = next;
    }
    best.ok_or_else(|| lack.unwrap_or_else(Infeasible::stopped))
}

/// A design as it is, if no machine within the tolerances loses the motion or violates a requirement.
pub(super) fn keep_as_is(problem: &Problem, it: &Candidate) -> Option<RobustDesign> {
    let (mut candidate, mut known) = (it.clone(), CriticalMachines::default());
    let seen = look(problem, &mut candidate.design, &mut known);
    seen.lack
        .is_none()
        .then_some(RobustDesign { candidate, known })
}

/// Whether nothing holds a design back: an end of the zone of all stable z = 1 may leap, and the place in it with that, where an
/// ascent ends.
fn is_stuck(problem: &Problem, it: &Candidate, known: &CriticalMachines) -> bool {
    held(problem, it, known).residue > STUCK
}

/// What is seen of the machines about a design.
#[derive(Default)]
pub(super) struct BoxCheck {
    /// Whether something was not known.
    pub is_new: bool,
    /// How much is lacking if machines lose the motion, violate a requirement or cannot be computed.
    pub lack: Option<Infeasible>,
}

impl BoxCheck {
    /// Takes note of what is lacking, if it is more than what is known.
    fn note(&mut self, lack: Option<Infeasible>) {
        let is_worse = |it: &Infeasible| self.lack.as_ref().is_none_or(|known| it.gap > known.gap);
        self.lack = lack.filter(is_worse).or(self.lack.take());
    }
}

/// Looks all around in every case, takes note of what was not known, and sets what is sought to that of the worst machine, if
/// that counts.
pub(super) fn look(
    problem: &Problem,
    design: &mut Design,
    known: &mut CriticalMachines,
) -> BoxCheck {
    let mut seen = BoxCheck::default();
    let mut values = Vec::new();
    for it in problem.operating_points(design) {
        let (own, value) = look_at_point(&it.problem, it.design, known.for_case_mut(it.case));
        seen.is_new |= own.is_new;
        seen.note(own.lack.map(|lack| lack.in_point(problem, it.case)));
        values.push(value);
    }
    design.set_values(values);
    seen
}

/// Looks all around the operating point of a design, without its cases: with the value of what is sought of the worst machine,
/// if that counts.
fn look_at_point(
    problem: &Problem,
    design: &Design,
    known: &mut CriticalMachines,
) -> (BoxCheck, f64) {
    let mut value = design.value;
    let mut seen = BoxCheck::default();
    let Some(spread) = problem.spread(&design.machine) else {
        return (seen, value);
    };
    let unknown = |lack| {
        let (is_new, lack) = (false, Some(lack));
        (BoxCheck { is_new, lack }, design.value)
    };
    let lost = match lost(&spread, design) {
        Ok(lost) => lost,
        Err(error) => return unknown(error),
    };
    if let Some(first) = lost.first() {
        let reason = format!(
            "within the tolerances the motion is lost ({}): it goes on over {:.4} of them only",
            first.by, first.share
        );
        let lack = Some(Infeasible::new(1.0 - first.share, reason));
        known.losses.extend(lost.into_iter().map(|it| it.direction));
        return (BoxCheck { is_new: true, lack }, value);
    }
    let targets = problem.targets();
    let all = match extremes(problem, (&spread, design), &targets) {
        Ok(all) => all,
        Err(error) => return unknown(error),
    };
    for (target, found) in targets.iter().zip(&all) {
        // What is worst in the drawing's machine is known anyway.
        let is_own = found.at.iter().all(|at| *at == 0.0);
        let is_new = !is_own && known.note(*target, &found.at);
        match target {
            Criterion::Objective => {
                let claimed = problem.objective.score(value);
                value = problem.objective.worse(value, found.value);
                let loss = claimed - problem.objective.score(value);
                seen.is_new |= is_new && loss > GAIN * claimed.abs();
            }
            Criterion::Bound(..) => {
                let required = problem.asked(*target).and_then(|(_, it)| it);
                let broken = required.filter(|it| it.margin(found.value) < 0.0);
                if let Some(requirement) = broken {
                    seen.is_new |= is_new;
                    let reason = violated_within(&design.machine, requirement, found.value);
                    let gap = requirement.violation(found.value);
                    seen.note(Some(Infeasible::new(gap, reason)));
                }
            }
        }
    }
    (seen, value)
}

/// The worst machine of each target.
fn extremes(
    problem: &Problem,
    (spread, design): (&Tolerances, &Design),
    targets: &[Criterion],
) -> Result<Vec<Worst>, Infeasible> {
    if targets.is_empty() {
        return Ok(Vec::new());
    }
    let figures = targets.iter().map(|it| problem.figure_of(*it));
    let figures: Vec<(Figure, Sense)> = figures.collect();
    let found = worst(spread, &design.orbit, &figures, &interrupt::watch);
    found.map_err(Infeasible::unknown)
}

impl Problem {
    /// Whether a design has its whole box, and is as required in all of it.
    ///
    /// # Errors
    /// [`Infeasible`] with how much is lacking.
    pub fn has_box(&self, design: &Design) -> Result<(), Infeasible> {
        let seen = look(self, &mut design.clone(), &mut CriticalMachines::default());
        seen.lack.map_or(Ok(()), Err)
    }

    /// What ends the motion inside the zone where the tolerances of a design touch that, in words.
    pub fn border_within(&self, design: &Design) -> Option<String> {
        let spread = self.spread(&design.machine)?;
        let farthest = 1.0 + ROUNDING;
        let found = nearest(
            &spread,
            &design.orbit,
            Norm::Box,
            farthest,
            &interrupt::watch,
        )
        .ok()?;
        found.into_iter().find_map(|it| match it.manifold {
            Manifold::Motion(loss) => Some(lost_by(&loss)),
            Manifold::Hysteresis => None,
        })
    }

    /// The machines within the tolerances that are worst in each figure that is required of all of them, by the side that is
    /// good, without cases; none if nothing is, or where they cannot be computed.
    pub fn worst_of_required(&self, design: &Design) -> Vec<(Figure, Sense, Worst)> {
        let Some(spread) = self.spread(&design.machine) else {
            return Vec::new();
        };
        let mut targets = self.targets();
        targets.retain(|target| *target != Criterion::Objective);
        let found = extremes(self, (&spread, design), &targets).unwrap_or_default();
        let pairs = targets.into_iter().zip(found);
        let each = pairs.map(|(target, worst)| {
            let (figure, side) = self.figure_of(target);
            (figure, side, worst)
        });
        each.collect()
    }
}

/// The best designs with what is known of the box, from one, and from other places of its zone.
fn again<'a>(
    problem: &'a Problem,
    known: &'a CriticalMachines,
    from: &'a Candidate,
) -> impl Iterator<Item = Candidate> + 'a {
    let places = [from.design.place].into_iter().chain(PLACES);
    places.filter_map(|place| ascend_from(problem, known, (&from.unit, place)))
}

/// The directions of the box in which the motion is lost within it.
fn lost(spread: &Tolerances, design: &Design) -> Result<Vec<BoxLoss>, Infeasible> {
    let found = nearest(spread, &design.orbit, Norm::Box, 1.0, &interrupt::watch);
    let found = found.map_err(Infeasible::unknown)?;
    let nearest = found.into_iter().filter_map(|it| match it.manifold {
        Manifold::Motion(loss) => Some((it.at, loss)),
        Manifold::Hysteresis => None,
    });
    let mut all = losses_within(nearest);
    if all.is_empty() {
        all = losses_within(first_losses(spread, &design.orbit));
    }
    sort_rising(&mut all, |it| it.share);
    all.truncate(MOST);
    Ok(all)
}

/// What is lost at these places of the box, but at its border.
fn losses_within(all: impl IntoIterator<Item = (Vec<f64>, Loss)>) -> Vec<BoxLoss> {
    let lost = all.into_iter().map(|(at, loss)| {
        let share = at
            .iter()
            .fold(f64::MIN_POSITIVE, |most, part| most.max(part.abs()));
        BoxLoss {
            direction: at.iter().map(|part| part / share).collect(),
            share,
            by: lost_by(&loss),
        }
    });
    lost.filter(|it| it.share < 1.0 - ROUNDING).collect()
}
