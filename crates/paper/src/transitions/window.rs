//! The values of the parameter for which a periodic motion is stable.

use super::Explorer;
use softstop_dynamics::continuation::{
    Branch, BranchPoint, Continuation, Limits, SpecialKind, TestFunction,
};
use softstop_dynamics::monitor::stop_if;
use softstop_dynamics::motion::MotionKind;
use softstop_dynamics::orbit::{Orbit, OrbitError};

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
    pub(super) const fn limits(&self) -> Limits {
        Limits {
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
