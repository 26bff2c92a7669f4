//! The slowest impact between the bounds.

use softstop_dynamics::Orbit;
use softstop_dynamics::orbit::OrbitError;
use softstop_dynamics::spread::{Spread, along, velocity_slopes};
use softstop_dynamics::watch::Watcher;

/// Steps towards the slowest impact, and halvings of one.
const STEPS: usize = 60;
const HALVINGS: usize = 40;
/// Share of a velocity that is nothing to gain.
const GAIN: f64 = 1e-10;
/// Change of a coordinate over which the velocity of a motion without exact derivatives is differenced.
const DIFFERENCE: f64 = 1e-3;

/// The machine with the slowest impact.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Worst {
    /// Its coordinates.
    pub at: Vec<f64>,
    /// Its motion.
    pub orbit: Orbit,
    /// d(before-impact velocity)/d(coordinate) there, in m/s.
    pub slopes: Vec<f64>,
}

/// The slowest impact between the bounds, by steps down the velocity's gradient that end at the bounds: a corner, or a
/// place within a side. Where machines between the bounds lose the motion, it is that of the machines on this side of
/// the loss.
///
/// # Errors
/// [`OrbitError::Stopped`]; [`OrbitError`] if the nominal motion is not one to start from.
pub fn worst(
    spread: &(impl Spread + ?Sized),
    nominal: &Orbit,
    watcher: Watcher<'_>,
) -> Result<Worst, OrbitError> {
    let mut here = Worst {
        at: vec![0.0; spread.dimensions()],
        slopes: slopes(spread, nominal, &vec![0.0; spread.dimensions()], nominal)?,
        orbit: nominal.clone(),
    };
    for _ in 0..STEPS {
        let steepest = here
            .slopes
            .iter()
            .fold(0.0, |most: f64, slope| most.max(slope.abs()));
        let flattest = here
            .slopes
            .iter()
            .map(|slope| slope.abs())
            .filter(|slope| *slope > 0.0);
        let flattest = flattest.fold(steepest, f64::min);
        if steepest == 0.0 {
            break;
        }
        // Far enough for all coordinates to come to their bounds.
        let mut length = 2.0 / flattest;
        let velocity = here.orbit.before_impact_velocity();
        let mut next = None;
        for _ in 0..HALVINGS {
            if watcher(0, 0).is_break() {
                return Err(OrbitError::Stopped);
            }
            let down = here.at.iter().zip(&here.slopes);
            let at: Vec<f64> = down
                .map(|(at, slope)| (at - length * slope).clamp(-1.0, 1.0))
                .collect();
            let ways = at.iter().zip(&here.at).zip(&here.slopes);
            let gain: f64 = ways.map(|((to, from), slope)| slope * (from - to)).sum();
            if gain <= GAIN * velocity {
                break;
            }
            let tried = motion(spread, nominal, &at);
            if let Some(orbit) = tried.filter(|orbit| orbit.before_impact_velocity() < velocity) {
                next = Some((at, orbit));
                break;
            }
            length *= 0.5;
        }
        let Some((at, orbit)) = next else { break };
        here = Worst {
            slopes: slopes(spread, nominal, &at, &orbit)?,
            at,
            orbit,
        };
    }
    Ok(here)
}

/// The motion at some coordinates that goes on from the nominal one.
fn motion(spread: &(impl Spread + ?Sized), nominal: &Orbit, at: &[f64]) -> Option<Orbit> {
    let reached = along(spread, nominal, at, 1.0).ok()?;
    let orbit = Orbit::near(&spread.scene(at), reached.point.state());
    orbit.ok().filter(|_| reached.loss.is_none())
}

/// d(before-impact velocity)/d(coordinate) in m/s of the motion at some coordinates: exact, or by differences where it has
/// no exact derivatives.
pub(super) fn slopes(
    spread: &(impl Spread + ?Sized),
    nominal: &Orbit,
    at: &[f64],
    orbit: &Orbit,
) -> Result<Vec<f64>, OrbitError> {
    velocity_slopes(spread, at, orbit).or_else(|error| {
        let velocity = |index: usize, change: f64| {
            let mut at = at.to_vec();
            at[index] += change;
            motion(spread, nominal, &at).map(|orbit| orbit.before_impact_velocity())
        };
        let slope = |index| {
            let sides = velocity(index, -DIFFERENCE).zip(velocity(index, DIFFERENCE));
            sides.map(|(below, above)| (above - below) / (2.0 * DIFFERENCE))
        };
        let all: Option<Vec<f64>> = (0..at.len()).map(slope).collect();
        all.ok_or(error)
    })
}
