//! What is sought and what must hold at one point of the search, with derivatives.

use softstop::Dimension;

use super::Design;
use super::box_window::BoxWindow;
use super::constraint::{Constraint, Limit};
use super::critical::CriticalMachines;
use super::differences::differences;
use super::exact::Linearization;
use super::figure::{Figure, Sense};
use super::judge::ZoneMotion;
use super::operating_point::SearchPoint;
use super::problem::{Objective, Problem};
use super::reach::inside;
use super::requirement::sign;
use super::slope::Slope;
use super::space::End;

/// What is known at a point: what is sought as scores, and constraints.
#[derive(Debug, Clone)]
pub struct LocalModel {
    /// The scores of the drawing, and of each case that has a weight.
    pub scores: Vec<Scores>,
    /// The constraints.
    pub constraints: Vec<Constraint>,
    /// The design there, if it is as required.
    pub design: Option<Design>,
}

/// The scores of one operating point.
#[derive(Debug, Clone)]
pub struct Scores {
    /// Its weight.
    pub weight: f64,
    /// The score of its own machine.
    pub own: Slope,
    /// The scores of the machines that are known as the worst within the tolerances, if the worst counts.
    pub worst: Vec<Slope>,
}

impl Scores {
    /// All of them.
    pub fn all(&self) -> impl Iterator<Item = &Slope> {
        [&self.own].into_iter().chain(&self.worst)
    }

    /// The score that counts: the worst.
    pub fn least(&self) -> &Slope {
        let worst = self.worst.iter();
        worst.fold(&self.own, |least, it| match it.value < least.value {
            true => it,
            false => least,
        })
    }
}

impl LocalModel {
    /// The score of the weighted mean of what the own machines have.
    pub fn objective(&self, objective: &Objective) -> Slope {
        let scores = self.scores.iter();
        let own: Vec<_> = scores.map(|it| (it.weight, it.own.clone())).collect();
        objective.mean(&own)
    }

    /// The score of the weighted mean of what the worst machines have, which counts, with its derivatives by the scores of these.
    pub fn score(&self, objective: &Objective) -> Slope {
        let scores = self.scores.iter();
        let least: Vec<_> = scores.map(|it| (it.weight, it.least().value)).collect();
        objective.mean_of(&least)
    }
}

/// What is known at a point, with what is known of the machines within the tolerances; none if there is no stable motion.
pub fn local(
    problem: &Problem,
    at: &SearchPoint<'_>,
    known: &CriticalMachines,
) -> Option<LocalModel> {
    let here = Design::find(problem, at)?;
    let exact = Linearization::of(problem, at, (&here, None));
    let mut all = of_point(problem, at, (&here, exact.as_ref()), known)?;
    let cases = problem.in_cases();
    for (index, (case, point)) in cases.iter().zip(&here.cases).enumerate() {
        let given = exact.as_ref().map(|it| &it.frequency[..]);
        let exact = given.and_then(|given| Linearization::of(case, at, (point, Some(given))));
        let own = of_point(
            case,
            at,
            (point, exact.as_ref()),
            known.for_case(Some(index)),
        )?;
        all.add(own, (index, problem.cases[index].weight));
    }
    Some(all)
}

impl LocalModel {
    /// Adds what is known of a case.
    fn add(&mut self, other: Self, (index, weight): (usize, f64)) {
        let scores = other.scores.into_iter();
        let scores = scores.filter(|_| weight > 0.0);
        self.scores.extend(scores.map(|it| Scores { weight, ..it }));
        for mut constraint in other.constraints {
            constraint.limit.case = Some(index);
            self.constraints.push(constraint);
        }
        let both = self.design.take().zip(other.design);
        self.design = both.map(|(mut design, case)| {
            design.cases.push(case);
            design
        });
    }
}

/// What is known of one operating point, without its cases.
fn of_point(
    problem: &Problem,
    at: &SearchPoint<'_>,
    (here, exact): (&Design, Option<&Linearization<'_>>),
    known: &CriticalMachines,
) -> Option<LocalModel> {
    let motion = here.judged().ok()?;
    let slopes = slopes(problem, at, exact, (here, &motion))?;
    let (frequency, figures) = slopes.split_last()?;
    let (sought, required) = figures.split_first()?;
    let mut constraints = Vec::new();
    let mut keep = |limit: Limit, slope| {
        let limit = limit.into();
        constraints.push(Constraint { limit, slope });
    };
    for (it, slope) in problem.single().zip(required) {
        for (side, bound) in it.sides() {
            let inside = slope.beyond(bound, sign(side));
            keep(Limit::Required(it.figure, side), inside);
        }
    }
    let si = |end: f64| problem.machine.to_si(Dimension::Frequency, end);
    match required.get(problem.single().count()) {
        Some(share) => keep(
            Limit::Required(Figure::Share, Sense::Least),
            share.beyond(problem.margin, 1.0),
        ),
        None => {
            let ends = [
                (End::Lower, problem.frequency.low, 1.0),
                (End::Upper, problem.frequency.high, -1.0),
            ];
            for (end, bound, sign) in ends {
                if bound.is_finite() && bound > f64::MIN_POSITIVE {
                    keep(Limit::Frequency(end), frequency.beyond(si(bound), sign));
                }
            }
        }
    }
    let edges = BoxWindow::of(problem, &here.machine, &here.zone).ok()?;
    if let Some(edges) = &edges {
        let exact = exact?;
        let none = || Slope::free(exact.frequency.len());
        let inside = |edge| inside(exact, edge);
        let ends = [(End::Lower, &edges.low)].into_iter();
        let ends = ends.chain(edges.high.iter().map(|edge| (End::Upper, edge)));
        for (end, edge) in ends {
            let slope = edge.as_ref().map_or_else(|| Some(none()), inside)?;
            keep(Limit::Tolerances(end), slope);
        }
    }
    let critical = known.slopes(exact)?;
    let mut is_kept = true;
    for (limit, slope) in critical.bounds {
        let least = if limit == Limit::Loss { -ROUNDING } else { 0.0 };
        is_kept &= slope.value >= least;
        keep(limit, slope);
    }
    // What rounding puts beyond a bound is at it elsewhere; here nobody is led there.
    let mut required = constraints.iter().take(2 * problem.single().count());
    let is_met =
        required.all(|it| !matches!(it.limit.limit, Limit::Required(..)) || it.slope.value >= 0.0);
    let scores = Scores {
        weight: 1.0,
        own: problem.objective.slope(sought.clone()),
        worst: critical.scores,
    };
    let score = scores.least().value;
    let window = problem.window_within(&here.zone, edges.as_ref());
    let is_good = is_met
        && is_kept
        && window.is_ok_and(|it| it.contains(here.place))
        && score > 0.0
        && score.is_finite();
    let value = match scores.worst.is_empty() {
        true => sought.value,
        false => problem.objective.value_of(score),
    };
    Some(LocalModel {
        scores: vec![scores],
        constraints,
        design: is_good.then(|| Design {
            value,
            cases: Vec::new(),
            ..here.clone()
        }),
    })
}

/// How far outside a bound the solver may leave what it holds.
const ROUNDING: f64 = 1e-9;

/// The figures of a point with their derivatives: what is sought, what is required, the share of the zone if the frequency is
/// given, and the drive's frequency. Exact derivatives where the motion has them, differences for the rest.
fn slopes(
    problem: &Problem,
    at: &SearchPoint<'_>,
    exact: Option<&Linearization<'_>>,
    (here, motion): (&Design, &ZoneMotion<'_>),
) -> Option<Vec<Slope>> {
    let required = problem.single().map(|it| it.figure);
    let share = problem.has_given_frequency().then_some(Figure::Share);
    let sought = [problem.objective.figure].into_iter();
    let figures: Vec<Figure> = sought.chain(required).chain(share).collect();
    let derivative = |figure: &Figure| exact.and_then(|it| it.by(*figure, motion));
    let mut all: Vec<Option<Vec<f64>>> = figures.iter().map(derivative).collect();
    all.push(exact.map(|it| it.frequency.clone()));
    let value = |here: &Design| {
        let motion = &here.judged().ok()?;
        let sought = problem.sought(motion)?;
        let mut all = vec![sought];
        all.extend(figures[1..].iter().map(|it| problem.value(motion, *it)));
        all.push(motion.orbit.scene.excitation.frequency);
        Some(all)
    };
    let values = value(here)?;
    if all.iter().any(Option::is_none) {
        let differences = differences(problem, at, &value)?;
        for (index, by) in all.iter_mut().enumerate() {
            by.get_or_insert_with(|| differences.iter().map(|row| row[index]).collect());
        }
    }
    let pairs = values.into_iter().zip(all);
    let slopes = pairs.map(|(value, by)| Some(Slope { value, by: by? }));
    slopes.collect()
}
