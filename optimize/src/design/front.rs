//! Trade-offs: the best designs with a bound of one figure that is moved step by step, each from the one before it
//! (epsilon-constraint continuation).

use softstop::Parameter;
use softstop_dynamics::parallel;

use super::ascent::{ascend, ascend_from};
use super::certain::{ShareGoal, certain};
use super::coordinates::{Candidate, best_by};
use super::critical::CriticalMachines;
use super::figure::{Figure, Sense};
use super::non_dominated::non_dominated;
use super::problem::{Objective, Problem};
use super::requirement::{Scope, sign};
use super::robustify::{enforce, keep_as_is};
use super::search::SearchResult;
use super::trial::{ROUGH, STARTS};
use super::trial_search::TrialSearch;
use super::{Design, GAIN};
use crate::order::sort_rising;

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
/// Why certainty is not traded where motions of all designs settle slowly.
const SLOW: &str = "motions settle so slowly that the starts of as many designs are not counted";
/// Change of what is sought, relative, below which the bound no longer holds the design.
const FREE: f64 = 1e-6;

/// What a figure costs of what is sought, around a design. The others are sought without requirements that take many motions;
/// those that fail them give way to ones near them, and are left out if there is none. With the best design on the way that solves
/// the problem itself better than the design, if there is one: then the search can go on from there.
///
/// # Errors
/// Why there is no other design, in words; none if the design has no such figure.
pub fn front(
    problem: &Problem,
    found: &SearchResult,
    figure: Figure,
) -> Result<(Front, Option<Candidate>), Option<&'static str>> {
    let start = found.candidate();
    let known = &found.known;
    let shares = (figure == Figure::Certainty).then(|| shares(problem, &start));
    let shares = shares.transpose()?;
    let own = place(problem, figure, &start).ok_or(None)?;
    let is_held = |parameter| problem.axes.iter().all(|axis| axis.parameter != parameter);
    let is_of_force = figure == Figure::DriveForce && is_held(Parameter::Amplitude);
    let others = match figure {
        Figure::Share => margins(problem, start),
        Figure::Certainty => shares.unwrap_or_default(),
        _ if is_of_force => forces(problem, (&start, known)),
        _ => both_ways((&start, known), own.0, |bound| {
            bounded(problem, figure, bound)
        }),
    };
    let tried: Vec<FrontPoint> = parallel::filter_map(&others, |it| tried(figure, it, found));
    // Another drive amplitude is another problem.
    let score = |it: &Candidate| problem.score(&it.design);
    let is_above = |it: &FrontPoint| {
        !is_of_force
            && score(&it.candidate) > (1.0 + GAIN) * problem.score(&found.design)
            && problem.is_allowed(&it.candidate.design)
            && problem.has_box(&it.candidate.design).is_ok()
    };
    let (above, mut tried): (Vec<_>, Vec<_>) = tried.into_iter().partition(is_above);
    let passing = parallel::filter_map(&above, |FrontPoint { candidate, .. }| {
        let trials = problem.pass_trials(&candidate.design, &mut CriticalMachines::default());
        trials.is_ok().then(|| candidate.clone())
    });
    let better = best_by(passing, score);
    tried.push(FrontPoint {
        place: own,
        is_moved: false,
        candidate: found.candidate(),
    });
    // At a bound of the problem itself rounding makes no point better.
    tried.retain(|it| !beats(problem, figure, it.place, own));
    let left_out = others.len() + 1 - tried.len();
    let best = undominated(problem, figure, &tried);
    let front = Front {
        figure,
        design: own,
        points: best.iter().map(|it| it.place).collect(),
        moved: best.iter().filter(|it| it.is_moved).count(),
        left_out,
    };
    Ok((front, better))
}

/// Whether a figure and what is sought are both better at one place than at another.
pub(super) fn beats(problem: &Problem, figure: Figure, one: (f64, f64), other: (f64, f64)) -> bool {
    let score = |value| problem.objective.score(value);
    sign(figure.sense()) * (one.0 - other.0) > 0.0 && score(one.1) > score(other.1)
}

/// Those that no other one is as good as in both quantities and better in one, in rising order of the figure.
fn undominated<'a>(
    problem: &Problem,
    figure: Figure,
    tried: &'a [FrontPoint],
) -> Vec<&'a FrontPoint> {
    let sign = sign(figure.sense());
    let places = tried.iter().map(|it| it.place);
    let goods = places.map(|(value, sought)| vec![sign * value, problem.objective.score(sought)]);
    let members = non_dominated(&Vec::from_iter(goods)).members;
    let mut best: Vec<&FrontPoint> = members.into_iter().map(|index| &tried[index]).collect();
    sort_rising(&mut best, |it| it.place.0);
    best
}

/// A design on the way, and the task that it solves.
type Bounded = (Problem, Candidate);

/// A design that passes its trials and keeps its box.
struct FrontPoint {
    /// Its figure, and what is sought.
    place: (f64, f64),
    /// Whether it had to give way for that.
    is_moved: bool,
    candidate: Candidate,
}

/// A design on the way from one that was found, or one near it that passes; none if there is none.
fn tried(
    figure: Figure,
    (problem, candidate): &Bounded,
    found: &SearchResult,
) -> Option<FrontPoint> {
    let (known, is_of_share) = (&found.known, figure == Figure::Certainty);
    // A share has no derivative: an ascent may lead back to the design, where to count starts may take minutes.
    let as_is = is_of_share.then(|| keep_as_is(problem, candidate));
    let held = match as_is.flatten() {
        Some(held) => held,
        None if is_of_share && found.design.relative_decay() < 1.0 => return None,
        None => enforce(problem, candidate, known.clone()).ok()?,
    };
    let is_moved = !problem.passes(&held.candidate.design, known, ROUGH);
    let candidate = match is_moved {
        true => TrialSearch::new(problem, &held.known).nearby(&held.candidate)?,
        false => held.candidate,
    };
    let place = place(problem, figure, &candidate)?;
    Some(FrontPoint {
        place,
        is_moved,
        candidate,
    })
}

/// Value of a figure, of the worst machine within the tolerances if that is bounded and of the worst case, and of what is sought.
fn place(problem: &Problem, figure: Figure, at: &Candidate) -> Option<(f64, f64)> {
    let points = problem.operating_points(&at.design);
    let values = points
        .iter()
        .map(|it| value(&it.problem, figure, it.design));
    let worst = values.collect::<Option<Vec<f64>>>()?.into_iter();
    let worst = worst.reduce(match figure.sense() {
        Sense::Least => f64::min,
        Sense::Most => f64::max,
    })?;
    Some((worst, problem.sought_of(&at.design)))
}

/// Value of a figure in one operating point.
fn value(problem: &Problem, figure: Figure, design: &Design) -> Option<f64> {
    let within = problem.worst_of_required(design);
    let within = within
        .iter()
        .find(|(of, side, _)| (*of, *side) == (figure, figure.sense()));
    let value = match (within, figure) {
        (Some((.., worst)), _) => worst.value,
        (None, Figure::Certainty) => problem.established(&design.orbit, STARTS).ok()?.share,
        (None, _) => problem.value(&design.judged().ok()?, figure),
    };
    Some(value).filter(|it| it.is_finite())
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

/// Over the share of starts that lead to the motion, from that of the design towards all of them; where that settles slowly, from
/// that of the best one that does not.
///
/// # Errors
/// Why there is none, if that is known.
fn shares(problem: &Problem, start: &Candidate) -> Result<Vec<Bounded>, Option<&'static str>> {
    let known = &CriticalMachines::default();
    let with_share = |from: &Candidate, share: f64| {
        let goal = ShareGoal {
            share,
            known,
            leaves_out_slow: true,
        };
        certain(problem, from, goal)
    };
    let is_slow = start.design.relative_decay() < 1.0;
    let (mut from, mut all) = (start.clone(), Vec::new());
    if is_slow {
        from = with_share(start, 0.0).ok_or(Some(SLOW))?;
        all.push((problem.clone(), from.clone()));
    }
    let (own, _) = place(problem, Figure::Certainty, &from).ok_or(None)?;
    let shares = (1..=SHARES).map(|step| own + (1.0 - own) * step as f64 / (SHARES + 1) as f64);
    all.extend(shares.map_while(|share| {
        from = with_share(&from, share)?;
        Some((problem.clone(), from.clone()))
    }));
    Ok(all)
}

/// Over the drive's amplitude that the task holds.
fn forces(problem: &Problem, start: (&Candidate, &CriticalMachines)) -> Vec<Bounded> {
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

/// Step by step from the design on, down and up, until there is no design or its bound no longer holds it.
fn both_ways(
    (start, known): (&Candidate, &CriticalMachines),
    own: f64,
    with_bound: impl Fn(f64) -> Problem,
) -> Vec<Bounded> {
    let mut all = Vec::new();
    for change in [-STEP, STEP] {
        let (mut from, mut bound) = (start.clone(), own);
        for _ in 0..STEPS {
            bound *= 1.0 + change;
            let problem = with_bound(bound);
            let place = (&from.unit[..], from.design.place);
            let Some(candidate) = ascend_from(&problem, known, place) else {
                break;
            };
            let [before, after] = [&from, &candidate].map(|it| problem.sought_of(&it.design));
            if (after - before).abs() <= FREE * before.abs() {
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
    let mut required = problem.requirements.iter();
    let known = required.find(|it| it.figure == figure);
    let traded = Objective {
        scope: known.map_or(Scope::Drawing, |it| it.scope),
        ..Objective::new(figure, figure.sense())
    };
    without(problem, figure).bounded(&traded, bound)
}
