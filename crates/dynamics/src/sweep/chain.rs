//! The steps of a sweep, where it jumps, and where the sweeps up and down differ.

use serde::{Deserialize, Serialize};

use crate::direction::Direction;
use crate::motion_kind::MotionKind;
use crate::settled::SettledMotion;
use crate::tolerance::SIMILAR;
use softstop::{CheckedScene, Machine, MotionError, Start};

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

/// A step of a sweep: the motion at one value of the parameter.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct SweepStep {
    /// The parameter's value.
    pub value: f64,
    /// The motion that the step has come to: chaos if small differences have grown more than a hundredfold.
    pub motion: MotionKind,
    /// Mean growth of small differences, unless it returns: ln of the tangent's norm per drive period.
    pub growth: Option<f64>,
    /// Mean number of impacts per drive period: p/n of what returns, else over the watched periods.
    pub impacts_per_period: f64,
    /// Before-impact velocities in m/s, ascending: of one period of what returns, else of all watched drive periods.
    pub velocities: Vec<f64>,
    /// Largest position in m meanwhile; not a number where the plan does not ask for it.
    pub max_position: f64,
    /// State at its end, at drive angle phi: the start of the next step.
    pub end: Start,
    /// True if it began at rest on a rigid stop, since the state before it lay beyond that.
    pub is_put_on_wall: bool,
}

impl SweepStep {
    /// The step of a sweep at a value of the parameter, from what its motion has settled on.
    pub(super) fn new(
        value: f64,
        scene: &CheckedScene,
        seen: SettledMotion,
        heights: bool,
    ) -> Result<Self, MotionError> {
        let map = seen.watched_map(scene);
        let (motion, growth) = seen.motion_kind(&map)?;
        Ok(Self {
            value,
            motion,
            growth,
            impacts_per_period: seen.impacts_per_period(),
            max_position: match heights {
                true => seen.max_position(&map)?,
                false => f64::NAN,
            },
            end: seen.end,
            is_put_on_wall: false,
            velocities: seen.velocities,
        })
    }

    /// Largest before-impact velocity in m/s of a step; 0 without impacts.
    pub fn hardest_impact(&self) -> f64 {
        self.velocities.last().copied().unwrap_or(0.0)
    }

    /// True if the motion of the step repeats, or is chaotic.
    pub fn is_settled(&self) -> bool {
        self.motion != MotionKind::Unsettled
    }

    /// True if two steps have motions of different kinds, or hardest impacts that differ by more than `share` of the larger.
    pub(super) fn differs_from(&self, other: &Self, share: f64) -> bool {
        let (one, two) = (self.hardest_impact(), other.hardest_impact());
        let (low, high) = (one.min(two), one.max(two));
        let repeats = self.motion.periods().is_some();
        self.motion != other.motion || (repeats && high - low > share * high)
    }
}

/// A range of the parameter in which the sweeps up and down settle on different motions: a hysteresis.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Coexistence {
    /// Least value of the range.
    pub from: f64,
    /// Largest value of the range.
    pub to: f64,
    /// The motion of the sweep up.
    pub up: MotionKind,
    /// The motion of the sweep down.
    pub down: MotionKind,
}

/// The steps of the sweeps up and down at the same values of the parameter, in rising order.
fn pair_steps<'a>(up: &'a Chain, down: &'a Chain) -> Vec<(&'a SweepStep, &'a SweepStep)> {
    let others = down.rising_steps();
    let other = |value: f64| others.binary_search_by(|step| step.value.total_cmp(&value));
    let ours = up.rising_steps().into_iter();
    ours.filter_map(|step| Some((step, others[other(step.value).ok()?])))
        .collect()
}

/// The ranges of the parameter in which the sweeps of a machine up and down settle on different motions.
pub fn find_coexistences(up: &Chain, down: &Chain) -> Vec<Coexistence> {
    let mut zones: Vec<Coexistence> = Vec::new();
    let mut open = false;
    for (a, b) in pair_steps(up, down) {
        let apart = a.is_settled() && b.is_settled() && a.differs_from(b, SIMILAR);
        let last = zones
            .last_mut()
            .filter(|zone| open && apart && zone.up == a.motion && zone.down == b.motion);
        match last {
            Some(zone) => zone.to = a.value,
            None if apart => zones.push(Coexistence {
                from: a.value,
                to: a.value,
                up: a.motion.clone(),
                down: b.motion.clone(),
            }),
            None => {}
        }
        open = apart;
    }
    zones
}
