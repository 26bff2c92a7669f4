//! Places within the tolerances that a search has come to know: ways out on which the motion would be lost, and machines
//! whose value counts; each with its derivatives.

use softstop::Parameter;
use softstop_dynamics::continuation::Test;
use softstop_dynamics::slopes::{self, Border};
use softstop_dynamics::spread::{Reached, Settled, Spread, along};
use softstop_dynamics::zone::Loss;
use softstop_dynamics::{BranchPoint, Orbit};

use super::box_window::Edge;
use super::differences::differences;
use super::exact::Exact;
use super::here::{At, Here};
use super::judge::Met;
use super::problem::Problem;
use super::rates::rates;
use super::slope::Slope;
use super::within::Rows;
use crate::robust::{Tolerances, is_loss, motion};

/// Share of the box up to which a way is followed.
const FARTHEST: f64 = 1.25;

/// Places of the box of tolerances, in its coordinates.
#[derive(Debug, Clone, Default)]
pub struct Known {
    /// To their ends the motion has to go on.
    pub ways: Vec<Vec<f64>>,
    /// Machines of which the worst counts, and their motions in a design that is near.
    pub machines: Vec<(Vec<f64>, Orbit)>,
}

/// What is known of a design's machines.
#[derive(Debug, Default)]
pub(super) struct Machines {
    /// How much of the tolerances more than all of them each way takes until the motion is lost.
    pub kept: Vec<Slope>,
    /// The scores of the machines.
    pub scores: Vec<Slope>,
}

impl Known {
    /// The value of a motion that meets its requirements, of the worst machine that is known if that counts; none if one of
    /// the ways is lost.
    pub(super) fn value(&self, problem: &Problem, here: &Here) -> Option<f64> {
        let motion = here.judged()?;
        let is_met = problem.met(&motion).iter().all(Met::is_met);
        let value = problem.sought(&motion).filter(|_| is_met)?;
        let Some(spread) = problem.spread(here.machine()) else {
            return Some(value);
        };
        for way in &self.ways {
            end(&spread, here, way).filter(|(share, _)| *share >= 1.0)?;
        }
        let scores = self.machines.iter();
        let scores = scores.map(|machine| score_of(problem, (&spread, here), machine));
        let scores: Option<Vec<f64>> = scores.collect();
        let worst = scores?.into_iter().reduce(f64::min);
        Some(worst.map_or(value, |score| problem.objective.value(score)))
    }

    /// The machines about a point of the search; none if there is nothing to tell of one.
    pub(super) fn machines(
        &self,
        problem: &Problem,
        (at, here): (&At<'_>, &Here),
        exact: Option<&Exact>,
    ) -> Option<Machines> {
        if self.ways.is_empty() && self.machines.is_empty() {
            return Some(Machines::default());
        }
        let about = About {
            problem,
            at,
            here,
            exact: exact?,
            spread: problem.spread(here.machine())?,
        };
        let kept = self.ways.iter().map(|way| about.kept(way));
        let scores = self.machines.iter().map(|machine| about.score(machine));
        Some(Machines {
            kept: kept.collect::<Option<_>>()?,
            scores: scores.collect::<Option<_>>()?,
        })
    }
}

/// How far inside an end of the zone the machine at its corner of the box is, as a share of the frequency.
pub(super) fn inside(
    problem: &Problem,
    (at, here): (&At<'_>, &Here),
    exact: &Exact,
    edge: &Edge,
) -> Option<Slope> {
    let rows = Rows::at(problem, (at, here), exact, &edge.corner)?;
    let scene = problem.spread(here.machine())?.scene(&edge.corner);
    let (border, sign) = match &edge.fold {
        None => (Border::free(&scene, true, rows.parameters()).ok()?, 1.0),
        Some(fold) => {
            let fold = (Test::Fold, fold);
            let border = Border::critical(&scene, 1, fold, rows.parameters()).ok()?;
            (border, -1.0)
        }
    };
    let unit = sign / border.frequency();
    let (by, _) = rows.across(&border);
    Some(Slope {
        value: unit * (scene.excitation.frequency - border.frequency()),
        by: by.iter().map(|by| unit * by).collect(),
    })
}

/// Where a way out ends: its share, and what ends it there.
fn end(
    spread: &Tolerances,
    here: &Here,
    way: &[f64],
) -> Option<(f64, Option<(Loss, BranchPoint)>)> {
    let reached = along(spread, &here.orbit, way, FARTHEST).ok()?;
    let Reached {
        share, loss, point, ..
    } = reached;
    match loss.filter(is_loss) {
        Some(loss) => Some((share, Some((loss, point)))),
        None => Some((FARTHEST, None)),
    }
}

/// The motion of a machine within the tolerances: near one that is known, or else followed from the nominal one.
fn motion_of(
    (spread, here): (&Tolerances, &Here),
    (machine, near): &(Vec<f64>, Orbit),
) -> Option<Orbit> {
    let scene = spread.scene(machine);
    let settled = Settled::near(&scene, near.state());
    let found = settled.and_then(|it| Orbit::near(&scene, it.state).ok());
    found.or_else(|| motion(spread, &here.orbit, machine))
}

/// The score of a machine within the tolerances.
fn score_of(
    problem: &Problem,
    (spread, here): (&Tolerances, &Here),
    known: &(Vec<f64>, Orbit),
) -> Option<f64> {
    let orbit = motion_of((spread, here), known)?;
    let machine = spread.machine(&known.0);
    let motion = here.beside(&machine, &orbit)?;
    Some(problem.objective.score(problem.sought(&motion)?))
}

struct About<'a> {
    problem: &'a Problem,
    at: &'a At<'a>,
    here: &'a Here,
    exact: &'a Exact,
    spread: Tolerances,
}

impl About<'_> {
    /// By how much of the tolerances the motion goes on beyond them on a way.
    fn kept(&self, way: &[f64]) -> Option<Slope> {
        let (share, lost) = end(&self.spread, self.here, way)?;
        let value = share - 1.0;
        let Some((loss, point)) = lost else {
            let by = vec![0.0; self.exact.frequency.len()];
            return Some(Slope { value, by });
        };
        let test = match loss {
            Loss::Fold => Some(Test::Fold),
            Loss::Flip => Some(Test::Flip),
            _ => None,
        };
        let by = test.and_then(|test| self.by_normal(way, share, (test, &point)));
        let share = |here: &Here| {
            let spread = self.problem.spread(here.machine())?;
            Some(vec![end(&spread, here, way)?.0])
        };
        let by = by.or_else(|| self.differenced(&share))?;
        Some(Slope { value, by })
    }

    /// How the share changes at which a way meets a border.
    fn by_normal(
        &self,
        way: &[f64],
        share: f64,
        (test, point): (Test, &BranchPoint),
    ) -> Option<Vec<f64>> {
        let end: Vec<f64> = way.iter().map(|part| share * part).collect();
        let rows = Rows::at(self.problem, (self.at, self.here), self.exact, &end)?;
        let scene = self.spread.scene(&end);
        let point = BranchPoint {
            parameter: scene.excitation.frequency,
            ..point.clone()
        };
        let border = Border::critical(&scene, 1, (test, &point), rows.parameters()).ok()?;
        let (by, outwards) = rows.across(&border);
        Some(by.iter().map(|by| -share * by / outwards).collect())
    }

    /// The score of a machine.
    fn score(&self, known: &(Vec<f64>, Orbit)) -> Option<Slope> {
        let orbit = motion_of((&self.spread, self.here), known)?;
        let machine = &known.0;
        let own = self.spread.machine(machine);
        let judged = self.here.beside(&own, &orbit)?;
        let value = self.problem.sought(&judged)?;
        let exact = || {
            let rows = Rows::at(self.problem, (self.at, self.here), self.exact, machine)?;
            let all = [rows.parameters(), &[Parameter::Frequency]].concat();
            let slopes = slopes::of(&orbit, &all).ok()?;
            let by = rates(self.problem.objective.figure, &slopes, &judged)?;
            let by = rows.total(&all, &by);
            Some(self.problem.objective.slope(Slope { value, by }))
        };
        let score = |here: &Here| {
            let spread = self.problem.spread(here.machine())?;
            Some(vec![score_of(self.problem, (&spread, here), known)?])
        };
        exact().or_else(|| {
            Some(Slope {
                value: self.problem.objective.score(value),
                by: self.differenced(&score)?,
            })
        })
    }

    fn differenced(&self, value: &impl Fn(&Here) -> Option<Vec<f64>>) -> Option<Vec<f64>> {
        let rows = differences(self.problem, self.at, value)?;
        Some(rows.concat())
    }
}
