//! The z = 1 motion on a straight way out from the nominal machine.

use nalgebra::Vector2;
use softstop::{CheckedScene, MotionError};
use softstop_dynamics::continuation::{BranchPoint, Continuation, Direction, Family};
use softstop_dynamics::internals::{FrequencyFamily, LONGEST_BRANCH, find_end};
use softstop_dynamics::monitor::stop_if;
use softstop_dynamics::orbit::{Orbit, OrbitError};
use softstop_dynamics::zone::Loss;

use super::{StableMotion, Tolerances};

/// Typical change of the share of the way, the unit of steps.
const TYPICAL: f64 = 2.0;

/// How far the motion goes on.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct HomotopyEnd {
    /// Share of the way: 1 is all of it.
    pub share: f64,
    /// The motion there.
    pub point: BranchPoint,
    /// What ends it there; nothing if that is as far as was asked.
    pub loss: Option<Loss>,
}

/// Follows the nominal motion towards the machine at some coordinates, and beyond it up to a share `farthest` of the way.
///
/// # Errors
/// [`OrbitError`] if the nominal motion is not one to start from.
pub fn along(
    spread: &Tolerances,
    nominal: &Orbit,
    to: &[f64],
    farthest: f64,
) -> Result<HomotopyEnd, OrbitError> {
    let family = Homotopy {
        spread,
        to,
        state_scales: FrequencyFamily(&nominal.scene).state_scales(),
    };
    let continuation = Continuation::new(&family, 1);
    let mut points =
        continuation.follow_points(nominal, 0.0, Direction::Up, LONGEST_BRANCH, |point| {
            let inside = (0.0..farthest).contains(&point.parameter);
            stop_if(!inside || !point.is_stable())
        })?;
    let end = find_end(&continuation, &mut points, Direction::Up, (0.0, farthest))?;
    Ok(HomotopyEnd {
        share: end.frequency,
        loss: Some(end.loss).filter(|loss| *loss != Loss::Range),
        point: end.point,
    })
}

/// The motion of the machine at some coordinates that goes on from the nominal one: by Newton's method from a state near which it
/// should be, no farther from that than a reach, and where that is in any doubt, or there is no such state, by following it there.
/// None if it is lost on the way.
pub fn motion_of(
    spread: &Tolerances,
    nominal: &Orbit,
    at: &[f64],
    guess: Option<(Vector2<f64>, f64)>,
) -> Option<StableMotion> {
    let near = guess.and_then(|(state, reach)| StableMotion::near(&spread.scene(at), state, reach));
    near.or_else(|| {
        let reached = along(spread, nominal, at, 1.0).ok()?;
        reached
            .loss
            .is_none()
            .then(|| StableMotion::of(&reached.point))
    })
}

/// The machines on a way.
#[derive(Debug)]
struct Homotopy<'a> {
    spread: &'a Tolerances,
    to: &'a [f64],
    state_scales: [f64; 2],
}

impl Family for Homotopy<'_> {
    fn scene(&self, [share]: [f64; 1]) -> Result<CheckedScene, MotionError> {
        let at: Vec<f64> = self.to.iter().map(|to| share * to).collect();
        Ok(self.spread.scene(&at).check()?)
    }

    fn state_scales(&self) -> [f64; 2] {
        self.state_scales
    }

    fn parameter_scales(&self) -> [f64; 1] {
        [TYPICAL]
    }
}
