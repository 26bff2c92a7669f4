//! The runs of an atlas: every method at every step and stiffness, judged by the true motion.

use crate::methods::{Exact, Integrator, Judge, MethodError, Solution, Task, Verdict};
use anyhow::Context;
use rayon::prelude::*;

use super::machines::{contact_mode, shortest_contact};
use super::stepped_method::SteppedMethod;
use crate::precision::truth::OTHER;
use crate::scenes::Case;
use softstop_console::failure::Failure;
use softstop_console::progress::Progress;

/// Steps that events may cost a run beyond those that its duration needs. To locate one crossing takes some ten.
const SPARE_STEPS: u64 = 1000;

/// Steps of the method that bears the exact one out.
const MOST_STEPS: u64 = 200_000;

/// Where the atlas looks: both axes are logarithmic and in rising order.
#[derive(Debug, Clone, PartialEq)]
pub struct Axes {
    /// Stiffness of the stop in N/m.
    pub stiffness: Vec<f64>,
    /// Step as a share of the drive period.
    pub step: Vec<f64>,
}

/// The machine with a stop of one stiffness, its true motion and the limits that theory sets.
#[derive(Debug, Clone)]
pub struct StiffnessCase {
    /// The task, with this machine.
    pub task: Task,
    /// The true motion: stored, or else the exact method's own.
    pub truth: Solution,
    /// Angular frequency in rad/s and damping ratio of the linear contact, if it is linear.
    pub mode: Option<(f64, f64)>,
    /// Shortest whole contact as a share of the drive period, if there is one.
    pub contact: Option<f64>,
    /// The exact method, judged as all others are, by the stored motion or by another method.
    pub exact: Option<Cell>,
}

/// One run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cell {
    /// What became of it.
    pub verdict: Verdict,
    /// Error of the state at the end over the motion's size, if it got there.
    pub error: Option<f64>,
    /// Impacts that it found, if it got there.
    pub impacts: Option<usize>,
}

/// All runs of one method on one machine.
#[derive(Debug, Clone)]
pub struct Map {
    /// The method.
    pub family: SteppedMethod,
    /// One column for each stiffness, one cell in it for each step.
    pub columns: Vec<Vec<Cell>>,
    /// For each stiffness the longest stable step in contact as a share of the drive period; none where there is no such limit.
    pub limit: Vec<Option<f64>>,
}

/// One machine, whose stop's stiffness is swept, with all its maps.
#[derive(Debug, Clone)]
pub struct Atlas {
    /// The machine.
    pub case: Case,
    /// Where it was looked at.
    pub axes: Axes,
    /// What stands above each stiffness.
    pub columns: Vec<StiffnessCase>,
    /// Error at the end over the motion's size up to which a run has converged.
    pub tolerance: f64,
    /// A map for each method.
    pub maps: Vec<Map>,
}

impl Axes {
    /// So many points on both axes: stiffness 1 to 1e8 N/m, step 1e-5 to 0.3 of the drive period.
    pub fn new(points: usize) -> Self {
        Self {
            stiffness: logarithmic(1.0, 1e8, points),
            step: logarithmic(1e-5, 0.3, points),
        }
    }
}

fn logarithmic(low: f64, high: f64, points: usize) -> Vec<f64> {
    let last = points.saturating_sub(1).max(1) as f64;
    let value = |index: f64| low * (high / low).powf(index / last);
    (0..points).map(|index| value(index as f64)).collect()
}

impl Atlas {
    /// Runs everything; a method that is unsuited for all of it has no map. An error at the end of up to `tolerance` times the motion's size counts as none.
    ///
    /// # Errors
    /// [`Failure::Run`] if the true motion cannot be computed, [`Failure::Interrupted`] after Ctrl-C.
    pub fn new(
        case: Case,
        axes: Axes,
        families: &[SteppedMethod],
        tolerance: f64,
        progress: &Progress,
    ) -> Result<Self, Failure> {
        let columns = axes.stiffness.par_iter();
        let columns =
            columns.map(|&stiffness| StiffnessCase::new(&case, stiffness, tolerance, progress));
        let columns = columns.collect::<Result<Vec<_>, _>>()?;
        let mut maps = Vec::new();
        for &family in families {
            let cells = columns.par_iter();
            let cells = cells.map(|column| column.judge(family, &axes.step, tolerance, progress));
            let cells = cells.collect::<Result<Vec<_>, _>>()?;
            // A method that is made for none of the machines has no map.
            let mut all = cells.iter().flatten();
            if all.any(|cell| cell.verdict != Verdict::Unsuited) {
                maps.push(Map {
                    family,
                    columns: cells,
                    limit: columns.iter().map(|column| column.limit(family)).collect(),
                });
            }
        }
        Ok(Self {
            case,
            axes,
            columns,
            tolerance,
            maps,
        })
    }
}

impl Cell {
    fn new(judge: &Judge<'_>, outcome: Result<Solution, MethodError>) -> Self {
        let verdict = judge.verdict(&outcome);
        let solution = outcome.ok();
        let error = solution.as_ref().map(|solution| judge.error(solution));
        Self {
            verdict,
            error: error.filter(|error| error.is_finite()),
            impacts: solution.map(|solution| solution.impacts.len()),
        }
    }
}

impl StiffnessCase {
    fn new(
        case: &Case,
        stiffness: f64,
        tolerance: f64,
        progress: &Progress,
    ) -> Result<Self, Failure> {
        let task = case.with_stiffness(stiffness);
        let lost = || format!("no true motion at a stiffness of {stiffness} N/m");
        let own = Exact.integrate(&task).with_context(lost)?;
        let contact = shortest_contact(&task).with_context(lost)?;
        let stored = case.stored(Some(stiffness)).map(|stored| stored.solution);
        let judged =
            |truth: &Solution| Cell::new(&Judge::new(&task, truth, tolerance), Ok(own.clone()));
        let known = stored.clone().or_else(|| borne_out(&task, &own));
        let exact = known.as_ref().map(judged);
        let truth = stored.unwrap_or(own);
        progress.step()?;
        Ok(Self {
            contact: contact.map(|contact| contact / task.scene.period()),
            mode: contact_mode(&task.scene),
            task,
            truth,
            exact,
        })
    }

    /// One method with each step.
    fn judge(
        &self,
        family: SteppedMethod,
        steps: &[f64],
        tolerance: f64,
        progress: &Progress,
    ) -> Result<Vec<Cell>, Failure> {
        let judge = Judge::new(&self.task, &self.truth, tolerance);
        let period = self.task.scene.period();
        let cell = |step: &f64| {
            progress.step()?;
            let task = Task {
                most_steps: (self.task.periods / step).ceil() as u64 + SPARE_STEPS,
                ..self.task.clone()
            };
            let outcome = family.method(step * period).integrate(&task);
            Ok(Cell::new(&judge, outcome))
        };
        steps.iter().map(cell).collect()
    }

    /// Longest stable step in contact as a share of the drive period.
    fn limit(&self, family: SteppedMethod) -> Option<f64> {
        let (frequency, ratio) = self.mode?;
        let limit = family.limit(ratio)?;
        Some(limit / frequency / self.task.scene.period())
    }
}

/// The motion by a method that shares no code with the exact one, if it sees as many impacts: it may pass over contacts that
/// are shorter than its steps.
fn borne_out(task: &Task, own: &Solution) -> Option<Solution> {
    let task = Task {
        most_steps: MOST_STEPS,
        ..task.clone()
    };
    let other = OTHER.integrate(&task).ok()?;
    (other.impacts.len() == own.impacts.len()).then_some(other)
}
