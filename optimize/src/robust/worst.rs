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
/// Share of a grade that is nothing to gain.
const GAIN: f64 = 1e-10;
/// Change of a coordinate over which a grade without exact derivatives is differenced.
const DIFFERENCE: f64 = 1e-3;
/// Corners that are looked at, at most, and from how many of the worst of them steps are taken.
const CORNERS: usize = 16;
const STARTS: usize = 3;

/// The machine with the slowest impact, or the least of another grade.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Worst {
    /// Its coordinates.
    pub at: Vec<f64>,
    /// Its motion.
    pub orbit: Orbit,
    /// Its before-impact velocity in m/s, or its grade.
    pub value: f64,
    /// d(value)/d(coordinate) there; zeros at a fold, where it has none.
    pub slopes: Vec<f64>,
}

/// What machines are graded by: the worst has the least.
pub(crate) trait Grade: Sync {
    /// Of the motion at some coordinates.
    fn value(&self, at: &[f64], orbit: &Orbit) -> Option<f64>;
    /// Its derivatives by the coordinates, where there are exact ones.
    fn slopes(&self, at: &[f64], orbit: &Orbit) -> Option<Vec<f64>>;
}

/// The before-impact velocity.
pub(super) struct Velocity<'a>(pub &'a dyn Spread);

impl Grade for Velocity<'_> {
    fn value(&self, _: &[f64], orbit: &Orbit) -> Option<f64> {
        Some(orbit.before_impact_velocity())
    }

    fn slopes(&self, at: &[f64], orbit: &Orbit) -> Option<Vec<f64>> {
        velocity_slopes(self.0, at, orbit).ok()
    }
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
    least(spread, nominal, &Velocity(spread), watcher)
}

/// The same by any grade.
pub(crate) fn least(
    spread: &dyn Spread,
    nominal: &Orbit,
    grade: &impl Grade,
    watcher: Watcher<'_>,
) -> Result<Worst, OrbitError> {
    let dimensions = spread.dimensions();
    let search = Search {
        spread,
        nominal,
        grade,
        watcher,
    };
    let mut best = search.descend(&vec![0.0; dimensions], nominal.clone())?;
    let tried = |at: &Vec<f64>| {
        let (orbit, value) = search.graded(at)?;
        Some((at.clone(), orbit, value))
    };
    let corners = corners(dimensions, CORNERS);
    let mut starts: Vec<_> = corners.par_iter().filter_map(tried).collect();
    starts.sort_by(|a, b| a.2.total_cmp(&b.2));
    for (at, orbit, _) in starts.into_iter().take(STARTS) {
        let found = search.descend(&at, orbit)?;
        if found.value < best.value {
            best = found;
        }
    }
    let flipped = |best: &Worst| {
        (0..2 * dimensions).find_map(|index| {
            let mut at = best.at.clone();
            at[index / 2] = if index.is_multiple_of(2) { 1.0 } else { -1.0 };
            let (orbit, value) = search.graded(&at)?;
            (value < best.value - GAIN * best.value.abs()).then_some((at, orbit))
        })
    };
    while let Some((at, orbit)) = flipped(&best) {
        best = search.descend(&at, orbit)?;
    }
    Ok(best)
}

struct Search<'a, G> {
    spread: &'a dyn Spread,
    nominal: &'a Orbit,
    grade: &'a G,
    watcher: Watcher<'a>,
}

impl<G: Grade> Search<'_, G> {
    /// The motion at some coordinates that goes on from the nominal one, and its grade.
    fn graded(&self, at: &[f64]) -> Option<(Orbit, f64)> {
        let orbit = motion(self.spread, self.nominal, at)?;
        let value = self.grade.value(at, &orbit)?;
        Some((orbit, value))
    }

    /// The derivatives of the grade of a motion: exact, or by differences where it has no exact ones.
    fn slopes(&self, at: &[f64], orbit: &Orbit) -> Option<Vec<f64>> {
        let differenced = || {
            let value = |index: usize, change: f64| {
                let mut at = at.to_vec();
                at[index] += change;
                self.graded(&at).map(|(_, value)| value)
            };
            let slope = |index| {
                let sides = value(index, -DIFFERENCE).zip(value(index, DIFFERENCE));
                sides.map(|(below, above)| (above - below) / (2.0 * DIFFERENCE))
            };
            (0..at.len()).map(slope).collect()
        };
        self.grade.slopes(at, orbit).or_else(differenced)
    }

    /// The same, but none of them at a fold, where no step leads on.
    fn slopes_or_none(&self, at: &[f64], orbit: &Orbit) -> Vec<f64> {
        let slopes = self.slopes(at, orbit);
        slopes.unwrap_or_else(|| vec![0.0; at.len()])
    }

    /// Steps down from a machine.
    fn descend(&self, at: &[f64], orbit: Orbit) -> Result<Worst, OrbitError> {
        let value = self
            .grade
            .value(at, &orbit)
            .ok_or(OrbitError::NotIsolated)?;
        let mut here = Worst {
            slopes: self.slopes_or_none(at, &orbit),
            at: at.to_vec(),
            orbit,
            value,
        };
        for _ in 0..STEPS {
            let Some((at, orbit, value)) = self.step(&here)? else {
                break;
            };
            here = Worst {
                slopes: self.slopes_or_none(&at, &orbit),
                at,
                orbit,
                value,
            };
        }
        Ok(here)
    }

    /// A machine down the gradient with a smaller grade, if there is one.
    fn step(&self, here: &Worst) -> Result<Option<(Vec<f64>, Orbit, f64)>, OrbitError> {
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
            let tried = self.graded(&at);
            if let Some((orbit, value)) = tried.filter(|(_, value)| *value < here.value) {
                return Ok(Some((at, orbit, value)));
            }
            length *= 0.5;
        }
        Ok(None)
    }
}

/// The motion at some coordinates that goes on from the nominal one.
pub(crate) fn motion(spread: &dyn Spread, nominal: &Orbit, at: &[f64]) -> Option<Orbit> {
    let reached = along(spread, nominal, at, 1.0).ok()?;
    let orbit = Orbit::near(&spread.scene(at), reached.point.state());
    orbit.ok().filter(|_| reached.loss.is_none())
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
        grade: &Velocity(spread),
        watcher,
    };
    let slopes = search.slopes(&vec![0.0; spread.dimensions()], nominal);
    slopes.ok_or(OrbitError::NotIsolated)
}
