//! Trade-offs: the best designs with a bound of one figure that is moved step by step, each from the one before it
//! (epsilon-constraint continuation).

use rayon::prelude::*;
use softstop::Parameter;

use super::Design;
use super::ascent::{ascend, ascend_from};
use super::certain::certain;
use super::check_trials::nearby;
use super::coordinates::Candidate;
use super::figure::{Figure, Sense};
use super::problem::Problem;
use super::reach::LossDirections;
use super::requirement::Requirement;
use super::robustify::is_at_edge;
use super::trial::{ROUGH, certainty};
use crate::robust::first_losses;

/// What is given up for more of what is sought.
#[derive(Debug, Clone)]
pub struct Front {
    /// What is traded for what is sought.
    pub figure: Figure,
    /// Its value at the design, in SI units, and what is sought there.
    pub design: (f64, f64),
    /// Its values and the best of what is sought, in rising order of the first.
    pub points: Vec<(f64, f64)>,
    /// How many of them had to give way to requirements that take many motions.
    pub moved: usize,
    /// Designs on the way that are not among them: they fail a requirement that takes many motions, or lose the motion
    /// within the tolerances.
    pub left_out: usize,
}

impl Front {
    /// How it was found, as far as its axes do not tell; may be empty.
    pub fn note(&self) -> String {
        let found = match self.figure {
            Figure::Certainty => {
                "Shares have no derivative: these designs are good to a per cent or so. "
            }
            Figure::DriveForce => "For each amplitude of the drive the task was solved anew. ",
            _ => "",
        };
        let left_out = match self.left_out {
            0 => String::new(),
            count => format!(
                "Left out, for they fail a requirement that takes many motions (counted on a quarter of them) or lose the \
                 motion within the tolerances: {count} of the best designs on the way."
            ),
        };
        let moved = match self.moved {
            0 => String::new(),
            count => format!(
                "Of these {count} had to give way to a requirement that takes many motions: they are good to a per cent or so. "
            ),
        };
        format!("{found}{moved}{left_out}").trim_end().to_owned()
    }
}

/// Steps to either side of the design.
const STEPS: usize = 3;
/// Share of a bound by which it is moved.
const STEP: f64 = 0.16;
/// Largest margin M, and the step to it.
const WIDEST: f64 = 0.5;
const WIDENING: f64 = 0.1;
/// Shares of starts between that of the design and all of them.
const SHARES: usize = 4;
/// Change of what is sought, relative, below which the bound no longer holds the design.
const FREE: f64 = 1e-6;

/// What a figure costs of what is sought, around a design at a point of the unit cube; none if the design has no such
/// figure. The others are sought without requirements that take many motions; those that fail them give way to ones near
/// them, and are left out if there is none.
pub fn front(
    problem: &Problem,
    (unit, design): (&[f64], &Design),
    figure: Figure,
) -> Option<Front> {
    let start = Candidate {
        unit: unit.to_vec(),
        design: design.clone(),
    };
    let own = place(figure, &start)?;
    let is_held = |parameter| problem.axes.iter().all(|axis| axis.parameter != parameter);
    let others = match figure {
        Figure::Share => margins(problem, start),
        Figure::Certainty => shares(problem, &start, own.0),
        Figure::DriveForce if is_held(Parameter::Amplitude) => forces(problem, &start),
        _ => bounds(problem, &start, figure, own.0),
    };
    let mut tried: Vec<Tried> = others
        .par_iter()
        .filter_map(|it| tried(figure, it))
        .collect();
    let left_out = others.len() - tried.len();
    tried.push(Tried {
        place: own,
        is_moved: false,
    });
    let mut best = undominated(problem, figure, &tried);
    best.sort_by(|a, b| a.place.0.total_cmp(&b.place.0));
    best.dedup_by(|a, b| a.place == b.place);
    Some(Front {
        figure,
        design: own,
        points: best.iter().map(|it| it.place).collect(),
        moved: best.iter().filter(|it| it.is_moved).count(),
        left_out,
    })
}

/// Those that no other one beats in both quantities.
fn undominated<'a>(problem: &Problem, figure: Figure, tried: &'a [Tried]) -> Vec<&'a Tried> {
    let is_better = |it: f64, than: f64| match figure.sense() {
        Sense::Least => it > than,
        Sense::Most => it < than,
    };
    let score = |value| problem.objective.score(value);
    let beats = |a: (f64, f64), b: (f64, f64)| is_better(a.0, b.0) && score(a.1) > score(b.1);
    let is_beaten = |it: &&Tried| tried.iter().any(|other| beats(other.place, it.place));
    tried.iter().filter(|it| !is_beaten(it)).collect()
}

/// A design on the way, and the task that it solves.
type Bounded = (Problem, Candidate);

/// A design that passes its trials and keeps its box.
struct Tried {
    /// Its figure, and what is sought.
    place: (f64, f64),
    /// Whether it had to give way for that.
    is_moved: bool,
}

/// A design on the way, or one near it that passes; none if there is none.
fn tried(figure: Figure, (problem, candidate): &Bounded) -> Option<Tried> {
    let is_moved = !problem.passes(&candidate.design.orbit, ROUGH);
    let candidate = match is_moved {
        true => nearby(problem, candidate)?,
        false => candidate.clone(),
    };
    if !keeps_box(problem, &candidate.design) {
        return None;
    }
    let place = place(figure, &candidate)?;
    Some(Tried { place, is_moved })
}

/// Whether a design keeps its motion at corners of its box of tolerances and at places all over it.
fn keeps_box(problem: &Problem, design: &Design) -> bool {
    let spread = problem.spread(&design.machine);
    spread.is_none_or(|spread| {
        let lost = first_losses(&spread, &design.orbit);
        lost.iter().all(|(at, _)| is_at_edge(at))
    })
}

/// Value of a figure, and of what is sought.
fn place(figure: Figure, at: &Candidate) -> Option<(f64, f64)> {
    let value = match figure {
        Figure::Certainty => certainty(&at.design.orbit).ok()?,
        _ => at.design.judged().ok()?.value(figure),
    };
    value.is_finite().then_some((value, at.design.value))
}

/// Over the margin M from both ends of the zone.
fn margins(problem: &Problem, mut from: Candidate) -> Vec<Bounded> {
    let steps = 0..=(WIDEST / WIDENING) as usize;
    let steps = steps.filter_map(|step| {
        let wider = Problem {
            margin: step as f64 * WIDENING,
            ..problem.clone()
        };
        from = ascend(&wider, &from.unit)?;
        Some((wider, from.clone()))
    });
    steps.collect()
}

/// Over the share of starts that lead to the motion, from that of the design towards all of them.
fn shares(problem: &Problem, start: &Candidate, own: f64) -> Vec<Bounded> {
    let mut from = start.clone();
    let shares = (1..=SHARES).map(|step| own + (1.0 - own) * step as f64 / (SHARES + 1) as f64);
    let all = shares.map_while(|share| {
        from = certain(problem, &from, share)?;
        Some((problem.clone(), from.clone()))
    });
    all.collect()
}

/// Over the drive's amplitude that the task holds.
fn forces(problem: &Problem, start: &Candidate) -> Vec<Bounded> {
    let Some(held) = problem.machine.value(Parameter::Amplitude) else {
        return Vec::new();
    };
    let of = |bound: f64| {
        let mut other = without(problem, Figure::DriveForce);
        other.machine.set(Parameter::Amplitude, bound);
        other
    };
    both_ways(start, held, of)
}

/// Over a bound of a figure, tighter and looser.
fn bounds(problem: &Problem, start: &Candidate, figure: Figure, own: f64) -> Vec<Bounded> {
    both_ways(start, own, |bound| bounded(problem, figure, bound))
}

/// Step by step from the design on, down and up, until there is no design or its bound no longer holds it.
fn both_ways(start: &Candidate, own: f64, with_bound: impl Fn(f64) -> Problem) -> Vec<Bounded> {
    let mut all = Vec::new();
    for change in [-STEP, STEP] {
        let (mut from, mut bound) = (start.clone(), own);
        for _ in 0..STEPS {
            bound *= 1.0 + change;
            let problem = with_bound(bound);
            let Some(candidate) = ascend_from(
                &problem,
                &LossDirections::default(),
                (&from.unit, from.design.place),
            ) else {
                break;
            };
            let gain = (candidate.design.value - from.design.value).abs();
            if gain <= FREE * from.design.value.abs() {
                break;
            }
            from = candidate;
            all.push((problem, from.clone()));
        }
    }
    all
}

/// The problem without the bounds of a figure.
fn without(problem: &Problem, figure: Figure) -> Problem {
    let mut free = problem.clone();
    free.requirements.retain(|it| it.figure != figure);
    free
}

/// The problem with another bound of a figure.
fn bounded(problem: &Problem, figure: Figure, bound: f64) -> Problem {
    let mut bounded = without(problem, figure);
    let is_least = figure.sense() == Sense::Least;
    bounded.requirements.push(Requirement {
        figure,
        least: is_least.then_some(bound),
        most: (!is_least).then_some(bound),
    });
    bounded
}
