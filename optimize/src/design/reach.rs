//! Places within the tolerances that a search has come to know: ways out on which the motion would be lost, with
//! derivatives.

use softstop_dynamics::BranchPoint;
use softstop_dynamics::continuation::Test;
use softstop_dynamics::slopes::Border;
use softstop_dynamics::spread::{Reached, Spread, along};
use softstop_dynamics::zone::Loss;

use super::box_window::Edge;
use super::differences::differences;
use super::exact::Exact;
use super::judge::Met;
use super::operating_point::{At, OperatingPoint};
use super::problem::Problem;
use super::slope::Slope;
use super::within::Rows;
use crate::robust::{Tolerances, is_loss};

/// Share of the box up to which a way is followed.
const FARTHEST: f64 = 1.25;

/// Places of the box of tolerances, in its coordinates.
#[derive(Debug, Clone, Default)]
pub struct Known {
    /// To their ends the motion has to go on.
    pub ways: Vec<Vec<f64>>,
}

impl Known {
    /// The value of a motion that meets its requirements; none if one of the ways is lost.
    pub(super) fn value(&self, problem: &Problem, here: &OperatingPoint) -> Option<f64> {
        let motion = here.judged()?;
        let is_met = problem.met(&motion).iter().all(Met::is_met);
        let value = problem.sought(&motion).filter(|_| is_met)?;
        let Some(spread) = problem.spread(here.machine()) else {
            return Some(value);
        };
        for way in &self.ways {
            end(&spread, here, way).filter(|(share, _)| *share >= 1.0)?;
        }
        Some(value)
    }

    /// How much of the tolerances more than all of them each way takes until the motion is lost; none if one cannot be told.
    pub(super) fn kept(
        &self,
        problem: &Problem,
        (at, here): (&At<'_>, &OperatingPoint),
        exact: Option<&Exact>,
    ) -> Option<Vec<Slope>> {
        if self.ways.is_empty() {
            return Some(Vec::new());
        }
        let about = About {
            problem,
            at,
            here,
            exact: exact?,
            spread: problem.spread(here.machine())?,
        };
        self.ways.iter().map(|way| about.kept(way)).collect()
    }
}

/// How far inside an end of the zone the machine at its corner of the box is, as a share of the frequency.
pub(super) fn inside(
    problem: &Problem,
    (at, here): (&At<'_>, &OperatingPoint),
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
    let unit = sign / problem.machine.scene.excitation.frequency;
    let (by, _) = rows.across(&border);
    Some(Slope {
        value: unit * (scene.excitation.frequency - border.frequency()),
        by: by.iter().map(|by| unit * by).collect(),
    })
}

/// Where a way out ends: its share, and what ends it there.
fn end(
    spread: &Tolerances,
    here: &OperatingPoint,
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

struct About<'a> {
    problem: &'a Problem,
    at: &'a At<'a>,
    here: &'a OperatingPoint,
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
        let share = |here: &OperatingPoint| {
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

    fn differenced(
        &self,
        value: &impl Fn(&OperatingPoint) -> Option<Vec<f64>>,
    ) -> Option<Vec<f64>> {
        let rows = differences(self.problem, self.at, value)?;
        Some(rows.concat())
    }
}
