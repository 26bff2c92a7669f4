//! The z = 1 motion on a straight way out from the nominal machine.

use crate::continuation::{BranchPoint, End, Family, Follower, Heading, Limits, Test};
use crate::orbit::{Orbit, OrbitError};
use crate::watch::stop_if;
use crate::zone::{Loss, first_end};
use softstop::internals::Scales;
use softstop::{MotionError, Scene};

use super::Spread;

/// Points after which a way is given up.
const POINTS: usize = 2000;
/// Typical change of the share of the way, the unit of steps.
const TYPICAL: f64 = 2.0;

/// How far the motion goes on.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Reached {
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
    spread: &dyn Spread,
    nominal: &Orbit,
    to: &[f64],
    farthest: f64,
) -> Result<Reached, OrbitError> {
    let family = Ray {
        spread,
        to,
        scales: nominal.scene.scales(),
        clearance: nominal.scene.clearance,
    };
    let follower = Follower::new(&family, 1);
    let mut points = follower.follow(nominal, 0.0, Heading::Up, POINTS, |point| {
        let inside = (0.0..farthest).contains(&point.parameter);
        stop_if(!inside || !point.is_stable())
    })?;
    let last = points.pop().ok_or(OrbitError::NotIsolated)?;
    let Some(before) = points.pop() else {
        return by_branch(&follower, nominal, farthest);
    };
    let end = match lost_by(&last) {
        Some(test) => follower
            .critical_between(&before, &last, test)
            .map_or((last, None), |point| (point, Some(test))),
        None => (last, None),
    };
    match end {
        (point, Some(test)) if point.parameter <= farthest => Ok(Reached {
            share: point.parameter,
            point,
            loss: Some(Loss::from(test)),
        }),
        (point, None) if !point.is_stable() => by_branch(&follower, nominal, farthest),
        (point, _) if point.parameter >= farthest => Ok(Reached {
            share: farthest,
            point: follower.between(&before, &point, farthest)?,
            loss: None,
        }),
        _ => by_branch(&follower, nominal, farthest),
    }
}

/// The test that an unstable motion fails.
fn lost_by(point: &BranchPoint) -> Option<Test> {
    let fails = |test: &Test| test.value(&point.monodromy) <= 0.0;
    let test = Test::ALL.into_iter().find(fails);
    test.filter(|_| !point.is_stable())
}

/// The same with a look at every special point: for ways on which the motion grazes something.
fn by_branch<F: Family>(
    follower: &Follower<'_, F>,
    nominal: &Orbit,
    farthest: f64,
) -> Result<Reached, OrbitError> {
    let limits = Limits {
        range: (0.0, farthest),
        points: POINTS,
    };
    let branch = follower.branch(0.0, nominal.state(), &limits, |point| {
        stop_if(!point.is_stable())
    })?;
    let points = branch.points.iter().filter(|point| point.parameter > 0.0);
    if let Some((point, kind)) = first_end(&branch, points) {
        return Ok(Reached {
            share: point.parameter,
            point: point.clone(),
            loss: kind.loss(),
        });
    }
    let last = branch.points.last().ok_or(OrbitError::NotIsolated)?;
    Ok(Reached {
        share: last.parameter,
        point: last.clone(),
        loss: match branch.ends.1 {
            End::Range => None,
            ref end => Some(Loss::of(end)),
        },
    })
}

/// The machines on a way.
struct Ray<'a> {
    spread: &'a dyn Spread,
    to: &'a [f64],
    scales: Scales,
    clearance: f64,
}

impl Family for Ray<'_> {
    fn scene(&self, [share]: [f64; 1]) -> Result<Scene, MotionError> {
        let at: Vec<f64> = self.to.iter().map(|to| share * to).collect();
        let scene = self.spread.scene(&at);
        scene.validate()?;
        Ok(scene)
    }

    fn state_scales(&self) -> [f64; 2] {
        let length = self.clearance.abs().max(self.scales.length);
        [length, length * self.scales.rate]
    }

    fn parameter_scales(&self) -> [f64; 1] {
        [TYPICAL]
    }
}
