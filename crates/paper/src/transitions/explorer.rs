//! Several motions side by side, what most of them do, and the values of the parameter for which a periodic one is stable.

use super::Rules;
use serde::{Deserialize, Serialize};
use softstop::Start;
use softstop_dynamics::attractors::{Arrival, SearchOptions, settle_starts};
use softstop_dynamics::continuation::{
    Branch, BranchLimits, BranchPoint, Continuation, Family, SpecialKind, TestFunction,
};
use softstop_dynamics::monitor::{Monitor, OptionalMemory, recall_or_compute, stop_if};
use softstop_dynamics::motion_kind::MotionKind;
use softstop_dynamics::orbit::{LyapunovExponents, Orbit, OrbitError};

/// Relative differences between motions started side by side.
const SPREAD: f64 = 1e-9;
/// Motions that go first, as many as there are lanes: if all of them do the same, so do most. Where half of all
/// would not, and each went its own way, that is a chance of one in 2^15.
pub(super) const FIRST_MOTIONS: usize = 16;

/// Finds transitions of a family's motions.
pub struct Explorer<'a> {
    /// The family.
    pub family: &'a dyn Family,
    /// The range of its parameter.
    pub range: (f64, f64),
    /// How it is decided what follows on what.
    pub rules: Rules,
    /// Is told of the drive periods of one look at motions after the other.
    pub monitor: Monitor<'a>,
    /// What is known already.
    pub kept: OptionalMemory<'a>,
}

/// Where most of several motions are.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(super) struct Gathering {
    /// What they do; none if that cannot be said yet.
    pub motion: Option<MotionKind>,
    /// The orbit, if they repeat.
    pub orbit: Option<Orbit>,
    /// Those that do so.
    pub states: Vec<Start>,
    /// True if it is clear whether more than half do.
    pub is_clear: bool,
}

/// Standard deviations by which more or fewer than half of all motions have to do something for that to be clear.
const CLEAR_DEVIATIONS: f64 = 4.0;

/// True if it is clear whether more or fewer than half of motions do something, by the number of those that do: all or none
/// of however few, or by far more than chance.
pub(super) fn is_clear(those: usize, all: usize) -> bool {
    let lead = (2.0 * those as f64 - all as f64).abs();
    lead >= (CLEAR_DEVIATIONS * (all as f64).sqrt()).min(all as f64)
}

impl Explorer<'_> {
    /// Holds the parameter and lets motions settle.
    pub(super) fn settle_at(
        &self,
        value: f64,
        starts: &[Start],
        periods: u64,
    ) -> Result<Vec<Arrival>, OrbitError> {
        let options = SearchOptions {
            transient: periods,
            ..self.rules.survey
        };
        let scene = self.family.scene([value])?;
        settle_starts(&scene, starts, &options, self.monitor)
    }

    /// What most of them do then.
    pub(super) fn gather(&self, value: f64, starts: &[Start]) -> Result<Gathering, OrbitError> {
        let scene = self.family.scene([value])?;
        recall_or_compute(self.kept, &("gathering", &scene, starts), || {
            let (first, rest) = starts.split_at(starts.len().min(FIRST_MOTIONS));
            let mut arrivals = self.settle_at(value, first, self.rules.patience)?;
            if !are_alike(&arrivals) {
                arrivals.extend(self.settle_at(value, rest, self.rules.patience)?);
            }
            let all = arrivals.len();
            let (settled, wandering): (Vec<Arrival>, Vec<Arrival>) =
                arrivals.into_iter().partition(|it| it.orbit.is_some());
            if settled.len() >= wandering.len() {
                let most = most(settled);
                return Ok(Gathering {
                    is_clear: is_clear(most.states.len(), all),
                    ..most
                });
            }
            // Motions that stay beside an orbit that is not stable have not gone anywhere yet.
            let gone: Vec<Start> = wandering
                .iter()
                .filter(|it| !it.returns)
                .map(|it| it.state)
                .collect();
            let is_chaos = match gone.first() {
                Some(state) if 2 * gone.len() >= wandering.len() => {
                    LyapunovExponents::differences_grow(&scene, (*state).into())?
                }
                _ => false,
            };
            let states: Vec<Start> = wandering.into_iter().map(|it| it.state).collect();
            Ok(Gathering {
                motion: is_chaos.then_some(MotionKind::Chaos),
                orbit: None,
                is_clear: is_clear(states.len(), all),
                states,
            })
        })
    }

    /// As many motions as the rules ask for: the given ones, and others beside them.
    pub(super) fn fill(&self, states: &[Start]) -> Vec<Start> {
        let beside = |(index, state): (usize, &Start)| {
            let round = (index / states.len()) as f64;
            Start::new(
                state.position * (1.0 + SPREAD * round),
                state.velocity * (1.0 + SPREAD * round),
            )
        };
        let all = states.iter().cycle().take(self.rules.motions);
        all.enumerate().map(beside).collect()
    }
}

/// True if all have settled on one motion, or none has settled.
fn are_alike(arrivals: &[Arrival]) -> bool {
    let kind = |arrival: &Arrival| arrival.orbit.as_ref().map(MotionKind::of);
    let Some((first, others)) = arrivals.split_first() else {
        return true;
    };
    let first = kind(first);
    others.iter().all(|other| kind(other) == first)
}

/// The commonest orbit of motions that have settled.
pub(super) fn most(settled: Vec<Arrival>) -> Gathering {
    let mut kinds: Vec<(MotionKind, Orbit, Vec<Start>)> = Vec::new();
    for arrival in settled {
        let Some(orbit) = arrival.orbit else { continue };
        let motion = MotionKind::of(&orbit);
        match kinds.iter_mut().find(|kind| kind.0 == motion) {
            Some(kind) => kind.2.push(arrival.state),
            None => kinds.push((motion, orbit, vec![arrival.state])),
        }
    }
    let most = kinds.into_iter().max_by_key(|kind| kind.2.len());
    let gathering = most.map(|(motion, orbit, states)| Gathering {
        motion: Some(motion),
        orbit: Some(orbit),
        states,
        ..Gathering::default()
    });
    gathering.unwrap_or_default()
}

/// One end.
#[derive(Debug, Clone)]
pub(super) struct WindowEnd {
    /// The grazing, fold or flip that ends the motion; none where it becomes that of half its period, the parameter's range
    /// ends, or it could not be followed any farther.
    pub kind: Option<SpecialKind>,
    /// The orbit there.
    pub point: BranchPoint,
}

/// A periodic motion from one end of its stability to the other.
#[derive(Debug, Clone)]
pub(super) struct Window {
    /// The motion.
    pub motion: MotionKind,
    /// Its lower end and its upper.
    pub ends: [WindowEnd; 2],
}

impl Explorer<'_> {
    /// The window of a stable orbit at a value of the parameter.
    ///
    /// # Errors
    /// [`OrbitError`] if the orbit is none of the family.
    pub(super) fn window(&self, value: f64, orbit: &Orbit) -> Result<Window, OrbitError> {
        let limits = self.limits();
        let continuation = Continuation::new(self.family, orbit.periods);
        // One point beyond a fold or flip is enough to have it located.
        let watch = |point: &BranchPoint| stop_if(!point.is_stable());
        let branch = continuation.branch(value, orbit.state(), &limits, watch)?;
        let start = nearest(&branch, value, orbit);
        let mut ends = [end(&branch, start, true), end(&branch, start, false)];
        if ends[0].point.parameter > ends[1].point.parameter {
            ends.reverse();
        }
        Ok(Window {
            motion: MotionKind::of(orbit),
            ends,
        })
    }

    /// How far branches are followed.
    pub(super) const fn limits(&self) -> BranchLimits {
        BranchLimits {
            range: self.range,
            points: self.rules.points,
        }
    }
}

impl Window {
    /// True if the motion is stable at a value.
    pub fn contains(&self, value: f64) -> bool {
        let [low, high] = &self.ends;
        (low.point.parameter..=high.point.parameter).contains(&value)
    }
}

/// The place of the point from which a branch was followed.
fn nearest(branch: &Branch, value: f64, orbit: &Orbit) -> usize {
    let gap = |point: &BranchPoint| {
        (point.parameter - value).abs() + (point.state() - orbit.state()).norm()
    };
    let gaps = branch.points.iter().map(gap).enumerate();
    gaps.min_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |it| it.0)
}

/// The end of stability on one side of a point of a branch.
fn end(branch: &Branch, start: usize, backwards: bool) -> WindowEnd {
    let points: Vec<&BranchPoint> = match backwards {
        true => branch.points[..=start].iter().rev().collect(),
        false => branch.points[start..].iter().collect(),
    };
    let mut beyond = points.iter().skip(1);
    let special = beyond.find_map(|point| Some((branch.special_at(point)?.kind, *point)));
    let is_told = |kind: &SpecialKind| *kind != SpecialKind::Critical(TestFunction::NeimarkSacker);
    WindowEnd {
        kind: special.map(|(kind, _)| kind).filter(is_told),
        point: special
            .map_or(points[points.len() - 1], |(_, point)| point)
            .clone(),
    }
}
