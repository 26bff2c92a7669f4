//! A step of a sweep.

use serde::{Deserialize, Serialize};

use crate::motion_kind::MotionKind;
use crate::settled::SettledMotion;
use softstop::{CheckedScene, MotionError, Start};

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
