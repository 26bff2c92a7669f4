//! The worst machine between the bounds.

use rayon::prelude::*;
use softstop_dynamics::Orbit;
use softstop_dynamics::orbit::OrbitError;
use softstop_dynamics::spread::{Spread, along, velocity_slopes};
use softstop_dynamics::watch::Watcher;

use super::corners::corners;

/// Steps towards the worst machine, and halvings of one.
const STEPS: usize = 60;
const HALVINGS: usize = 40;
/// Share of a velocity that is nothing to gain.
const GAIN: f64 = 1e-10;
/// Change of a coordinate over which a velocity without exact derivatives is differenced.
const DIFFERENCE: f64 = 1e-3;
/// Corners that are looked at, at most, and from how many of the worst of them steps are taken.
const CORNERS: usize = 16;
const STARTS: usize = 3;

/// The machine with the slowest impact.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Worst {
    /// Its coordinates.
    pub at: Vec<f64>,
    /// Its motion.
    pub orbit: Orbit,
    /// Its before-impact velocity in m/s.
    pub value: f64,
    /// d(value)/d(coordinate) there; zeros at a fold, where it has none.
    pub slopes: Vec<f64>,
}

/// The slowest impact between the bounds: by steps down the velocity's gradient that end at the bounds, from the nominal
/// machine and from the slowest corners, until no coordinate at its other bound is slower. Where machines between the
/// bounds lose the motion, it is that of the machines on this side of the loss.
///
/// # Errors
/// [`OrbitError::Stopped`]; [`OrbitError`] if the nominal motion is not one to start from.
pub fn worst(
    spread: &dyn Spread,
    nominal: &Orbit,
    watcher: Watcher<'_>,
) -> Result<Worst, OrbitError> {
    let dimensions = spread.dimensions();
    let search = Search {
        spread,
        nominal,
        watcher,
    };
    let mut best = search.descend(&vec![0.0; dimensions], nominal.clone())?;
    let corners = corners(dimensions, CORNERS).into_par_iter();
    let tried = corners.filter_map(|at| Some((search.motion(&at)?, at)));
    let mut starts: Vec<(Orbit, Vec<f64>)> = tried.collect();
    let velocity = |start: &(Orbit, _)| start.0.before_impact_velocity();
    starts.sort_by(|a, b| velocity(a).total_cmp(&velocity(b)));
    for (orbit, at) in starts.into_iter().take(STARTS) {
        let found = search.descend(&at, orbit)?;
        if found.value < best.value {
            best = found;
        }
    }
    let flipped = |best: &Worst| {
        (0..2 * dimensions).find_map(|index| {
            let mut at = best.at.clone();
            at[index / 2] = if index.is_multiple_of(2) { 1.0 } else { -1.0 };
            let orbit = search.motion(&at)?;
            let is_slower = orbit.before_impact_velocity() < best.value * (1.0 - GAIN);
            is_slower.then_some((at, orbit))
        })
    };
    while let Some((at, orbit)) = flipped(&best) {
        best = search.descend(&at, orbit)?;
    }
    Ok(best)
}

struct Search<'a> {
    spread: &'a dyn Spread,
    nominal: &'a Orbit,
    watcher: Watcher<'a>,
}

impl Search<'_> {
    /// The motion at some coordinates that goes on from the nominal one.
    fn motion(&self, at: &[f64]) -> Option<Orbit> {
        let reached = along(self.spread, self.nominal, at, 1.0).ok()?;
        let orbit = Orbit::near(&self.spread.scene(at), reached.point.state());
        orbit.ok().filter(|_| reached.loss.is_none())
    }

    /// The derivatives of a motion's velocity: exact, or by differences where it has no exact ones.
    fn slopes(&self, at: &[f64], orbit: &Orbit) -> Option<Vec<f64>> {
        let velocity = |index: usize, change: f64| {
            let mut at = at.to_vec();
            at[index] += change;
            self.motion(&at).map(|it| it.before_impact_velocity())
        };
        let slope = |index| {
            let (below, above) = (velocity(index, -DIFFERENCE)?, velocity(index, DIFFERENCE)?);
            Some((above - below) / (2.0 * DIFFERENCE))
        };
        let exact = velocity_slopes(self.spread, at, orbit).ok();
        exact.or_else(|| (0..at.len()).map(slope).collect())
    }

    /// A machine and its motion; without derivatives at a fold, where no step leads on.
    fn point(&self, at: Vec<f64>, orbit: Orbit) -> Worst {
        let slopes = self.slopes(&at, &orbit);
        Worst {
            slopes: slopes.unwrap_or_else(|| vec![0.0; at.len()]),
            value: orbit.before_impact_velocity(),
            at,
            orbit,
        }
    }

    /// Steps down from a machine.
    fn descend(&self, at: &[f64], orbit: Orbit) -> Result<Worst, OrbitError> {
        let mut here = self.point(at.to_vec(), orbit);
        for _ in 0..STEPS {
            let Some((at, orbit)) = self.step(&here)? else {
                break;
            };
            here = self.point(at, orbit);
        }
        Ok(here)
    }

    /// A machine down the gradient with a slower impact, if there is one.
    fn step(&self, here: &Worst) -> Result<Option<(Vec<f64>, Orbit)>, OrbitError> {
        let sizes = here.slopes.iter().map(|slope| slope.abs());
        let flattest = sizes.filter(|slope| *slope > 0.0).min_by(f64::total_cmp);
        let Some(flattest) = flattest else {
            return Ok(None);
        };
        // Far enough for all coordinates to come to their bounds.
        let mut length = 2.0 / flattest;
        for _ in 0..HALVINGS {
            if (self.watcher)(0, 0).is_break() {
                return Err(OrbitError::Stopped);
            }
            let down = here.at.iter().zip(&here.slopes);
            let at: Vec<f64> = down
                .map(|(at, slope)| (at - length * slope).clamp(-1.0, 1.0))
                .collect();
            let ways = at.iter().zip(&here.at).zip(&here.slopes);
            let gain: f64 = ways.map(|((to, from), slope)| slope * (from - to)).sum();
            if gain <= GAIN * here.value.abs() {
                break;
            }
            let tried = self.motion(&at);
            if let Some(orbit) = tried.filter(|it| it.before_impact_velocity() < here.value) {
                return Ok(Some((at, orbit)));
            }
            length *= 0.5;
        }
        Ok(None)
    }
}

/// d(before-impact velocity)/d(coordinate) in m/s of the nominal motion.
pub(super) fn nominal_slopes(
    spread: &dyn Spread,
    nominal: &Orbit,
    watcher: Watcher<'_>,
) -> Result<Vec<f64>, OrbitError> {
    let search = Search {
        spread,
        nominal,
        watcher,
    };
    let slopes = search.slopes(&vec![0.0; spread.dimensions()], nominal);
    slopes.ok_or(OrbitError::NotIsolated)
}
