//! A sweep as a chain of steps, and where it jumps.

use super::sweep_step::SweepStep;
use crate::direction::Direction;
use crate::motion_kind::MotionKind;
use softstop::Machine;

/// Shares of the largest before-impact velocity that tell a jump of a sweep: the velocity changes from one step to the next by at
/// least the first one, and the changes before and after are below the second one of that change.
const JUMP_SHARES: (f64, f64) = (0.1, 0.2);

/// A sweep of one machine in one direction: a chain of steps, each of which starts where the one before has ended.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Chain {
    /// The machine; its own value of the parameter plays no part.
    pub machine: Machine,
    /// The direction in which the parameter changes.
    pub direction: Direction,
    /// The steps that are complete, in the order in which they were made.
    pub steps: Vec<SweepStep>,
    /// Why the sweep cannot go on, in words.
    pub error: Option<String>,
}

/// A jump in a sweep: the settled motion changes to another one from one step to the next.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Jump {
    /// Parameter value of the last step before the jump.
    pub from: f64,
    /// Parameter value of the first step after the jump.
    pub to: f64,
    /// The motion before the jump.
    pub before: MotionKind,
    /// The motion after the jump.
    pub after: MotionKind,
    /// Largest before-impact velocities in m/s before and after the jump.
    pub velocities: (f64, f64),
}

impl Chain {
    /// A sweep of a machine that has made no step yet.
    pub fn new(machine: impl Into<Machine>, direction: Direction) -> Self {
        Self {
            machine: machine.into(),
            direction,
            steps: Vec::new(),
            error: None,
        }
    }

    /// The steps of the sweep in rising order of the parameter.
    pub fn rising_steps(&self) -> Vec<&SweepStep> {
        let mut steps: Vec<&SweepStep> = self.steps.iter().collect();
        if self.direction == Direction::Down {
            steps.reverse();
        }
        steps
    }

    /// The jumps of the sweep, in its own order: from one settled step to the next settled one, whatever lies between.
    pub fn find_jumps(&self) -> Vec<Jump> {
        let settled: Vec<&SweepStep> = self.steps.iter().filter(|step| step.is_settled()).collect();
        let jump = |pair: &[&SweepStep]| Jump {
            from: pair[0].value,
            to: pair[1].value,
            before: pair[0].motion.clone(),
            after: pair[1].motion.clone(),
            velocities: (pair[0].hardest_impact(), pair[1].hardest_impact()),
        };
        let pairs = settled.windows(2).enumerate();
        let jumps = pairs.filter(|(index, _)| is_jump(&settled, *index));
        jumps.map(|(_, pair)| jump(pair)).collect()
    }
}

/// True if the sweep jumps after the step `index`: to another kind of motion, or to one that is hit much harder or less hard.
fn is_jump(steps: &[&SweepStep], index: usize) -> bool {
    let (before, after) = (steps[index], steps[index + 1]);
    if before.motion != after.motion {
        return true;
    }
    let change = |a: &SweepStep, b: &SweepStep| (b.hardest_impact() - a.hardest_impact()).abs();
    let leap = change(before, after);
    let is_even =
        |a: &SweepStep, b: &SweepStep| a.motion != b.motion || change(a, b) < JUMP_SHARES.1 * leap;
    let earlier = index.checked_sub(1).map(|earlier| steps[earlier]);
    before.differs_from(after, JUMP_SHARES.0)
        && earlier.is_none_or(|earlier| is_even(earlier, before))
        && steps
            .get(index + 2)
            .is_none_or(|later| is_even(after, later))
}
