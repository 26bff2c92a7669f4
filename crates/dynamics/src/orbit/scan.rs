//! All motions with one impact per drive period, stable or not: every impact that such a motion may have is looked at.
//!
//! A motion of z = 1 is known from the time t and the before-impact velocity v of its impact. What the next impact is
//! off by ([`Legs`]) is smooth in both, so a lattice over one drive period and all velocities that the drive can keep
//! up shows the cells in which it may vanish, and Newton's method from there finds where it does. How small the basin
//! of a motion is plays no part.

use super::legs::Legs;
use super::{Orbit, OrbitError};
use crate::watch::Watcher;
use softstop::Scene;

/// Times in a drive period, and velocities, each so many times the one before.
const TIMES: usize = 20;
const RATIO: f64 = 1.25;
/// The slowest impact that is looked for, in units of the motion's speed.
const SLOWEST: f64 = 0.005;
/// Below that, in the same units, an impact is no more than rounding about grazing.
pub(crate) const FAINTEST: f64 = 1e-6;
/// The fastest, in units of the speed at which free damping takes all that the drive gives to a harmonic motion.
const FASTEST: f64 = 1.5;
/// The same in units of the motion's speed, for machines with little damping or none.
const UTMOST: f64 = 2000.0;
/// Difference of times, in units of the period, and of velocities, in units of themselves, within which impacts are
/// the same.
const SAME: f64 = 1e-6;

/// All z = 1 motions, those with the hardest impacts last.
///
/// # Errors
/// [`OrbitError::Motion`] if the scene is none; [`OrbitError::Stopped`].
pub(crate) fn all_single(scene: &Scene, watcher: Watcher<'_>) -> Result<Vec<Orbit>, OrbitError> {
    scene.validate()?;
    OrbitError::ask(watcher)?;
    let Some(legs) = Legs::new(scene, 1) else {
        return Ok(Vec::new());
    };
    let period = scene.clock().period();
    let unit = scene.motion_scales().speed();
    let mut found: Vec<Orbit> = Vec::new();
    for guess in guesses(scene, &legs, period, watcher)? {
        OrbitError::ask(watcher)?;
        let Ok(orbit) = legs.settle(&[guess]) else {
            continue;
        };
        let real = orbit.before_impact_velocity() > FAINTEST * unit;
        if real && !found.iter().any(|known| same(known, &orbit, period)) {
            found.push(orbit);
        }
    }
    found.sort_by(|a, b| {
        let [a, b] = [a, b].map(Orbit::before_impact_velocity);
        a.total_cmp(&b)
    });
    Ok(found)
}

/// True if two orbits have the same impact.
fn same(a: &Orbit, b: &Orbit, period: f64) -> bool {
    let [(t, v), (u, w)] = [a, b].map(|orbit| orbit.timed_impacts()[0]);
    let apart = (t - u).abs();
    apart.min(period - apart) < SAME * period && (v - w).abs() < SAME * v.max(w)
}

/// The middles of the cells in which the residual may vanish.
fn guesses(
    scene: &Scene,
    legs: &Legs<'_>,
    period: f64,
    watcher: Watcher<'_>,
) -> Result<Vec<(f64, f64)>, OrbitError> {
    let speeds = speeds(scene);
    let times: Vec<f64> = (0..TIMES)
        .map(|index| period * index as f64 / TIMES as f64)
        .collect();
    let column = |time: &f64| -> Result<Vec<Option<[f64; 2]>>, OrbitError> {
        let gap = |speed: &f64| {
            OrbitError::ask(watcher)?;
            Ok(legs.gap(*time, *speed))
        };
        speeds.iter().map(gap).collect()
    };
    let lattice: Vec<_> = times.iter().map(column).collect::<Result<_, _>>()?;
    let mut guesses = Vec::new();
    for (index, time) in times.iter().enumerate() {
        let pair = [&lattice[index], &lattice[(index + 1) % TIMES]];
        for (row, speed) in speeds.iter().enumerate().skip(1) {
            let corners = pair.iter().flat_map(|column| &column[row - 1..=row]);
            if may_vanish(corners) {
                let middle = time + 0.5 * period / TIMES as f64;
                guesses.push((middle, speed / RATIO.sqrt()));
            }
        }
    }
    Ok(guesses)
}

/// True if both parts change their sign between corners, or may do so beyond those where there is no such motion.
fn may_vanish<'a>(corners: impl Iterator<Item = &'a Option<[f64; 2]>>) -> bool {
    let (mut low, mut high, mut known, mut all) = ([f64::MAX; 2], [f64::MIN; 2], 0, 0);
    for corner in corners {
        all += 1;
        let Some(gap) = corner else { continue };
        known += 1;
        for part in 0..2 {
            low[part] = low[part].min(gap[part]);
            high[part] = high[part].max(gap[part]);
        }
    }
    let changes = |part: usize| low[part] <= 0.0 && high[part] >= 0.0;
    let both = known == all;
    known > 0 && [0, 1].into_iter().filter(|part| changes(*part)).count() > usize::from(both)
}

/// Before-impact velocities in m/s, in rising order.
fn speeds(scene: &Scene) -> Vec<f64> {
    let scales = scene.motion_scales();
    let unit = scales.speed();
    let damping = scene.damping.min(scene.contact_damping);
    let most = FASTEST * scene.excitation.amplitude / damping;
    let highest = most.clamp(4.0 * unit, UTMOST * unit);
    let count = (highest / (SLOWEST * unit)).ln() / RATIO.ln();
    let speed = |index: usize| SLOWEST * unit * RATIO.powi(index as i32);
    (0..=count.ceil() as usize).map(speed).collect()
}
