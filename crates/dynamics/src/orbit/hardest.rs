//! The z = 1 motion with the hardest impact at one frequency.

use std::cell::Cell;

use super::scan::{NEAR_IMPACT, RATIO, Singles, TIMES, apart, between, guesses, speeds};
use super::{Orbit, OrbitError};
use crate::monitor::Monitor;
use softstop::Scene;

/// Difference of times, in units of the period, and ratio of velocities, up to which Newton's method is followed from a cell to
/// the hardest motion: some cells, each of which is looked at from its own middle.
const REACH: (f64, f64) = (4.0 / TIMES as f64, 4.0);

/// The stable z = 1 motion with the hardest impact of those that are harder than this, in m/s; none if there is none. Impacts
/// are looked at from the hardest ones down, and Newton's method is followed no farther than some cells.
///
/// # Errors
/// As [`all_single`](super::scan::all_single).
pub(crate) fn hardest_single(
    scene: &Scene,
    least: f64,
    monitor: Monitor<'_>,
) -> Result<Option<Orbit>, OrbitError> {
    scene.validate()?;
    let Some(mut singles) = Singles::new(scene) else {
        return Ok(None);
    };
    let mut speeds = speeds(scene);
    speeds.retain(|speed| RATIO * speed > least);
    let mut guesses = guesses(&singles.shooting, (singles.period, &speeds), monitor)?;
    guesses.sort_by(|a, b| b.1.total_cmp(&a.1));
    let mut hardest: Option<Orbit> = None;
    for guess in guesses {
        let known = hardest
            .as_ref()
            .map_or(least, Orbit::before_impact_velocity);
        if RATIO.sqrt() * guess.1 < known {
            break;
        }
        singles.look_within(guess, monitor)?;
        let stable = singles.found.iter().filter(|orbit| orbit.is_stable());
        hardest = stable.max_by(|a, b| a.compare_velocity(b)).cloned();
    }
    Ok(hardest.filter(|orbit| orbit.before_impact_velocity() > least))
}

impl Singles<'_> {
    /// Follows Newton's method from a guess as long as it stays near, and from there to another motion that may lie beside the
    /// one that it leads to.
    fn look_within(&mut self, guess: (f64, f64), monitor: Monitor<'_>) -> Result<(), OrbitError> {
        OrbitError::ask(monitor)?;
        let (period, impacts) = (self.period, self.impacts());
        let is_near = |at: (f64, f64)| {
            impacts
                .iter()
                .any(|it| apart(*it, at, period) < NEAR_IMPACT)
        };
        let leaves = |at: (f64, f64)| {
            let ratio = (at.1 / guess.1).max(guess.1 / at.1);
            ratio > REACH.1 || between(at.0, guess.0, period) > REACH.0
        };
        let has_left = Cell::new(false);
        let ends = |at: &[f64]| {
            let at = (at[0], at[1]);
            has_left.set(leaves(at));
            has_left.get() || is_near(at)
        };
        let settled = self.shooting.settle_new(&[guess], ends);
        let is_new = match settled {
            Err(_) => return Ok(()),
            Ok(None) => !has_left.get(),
            Ok(Some(orbit)) => self.keep(orbit),
        };
        if is_new && let Ok(orbit) = self.shooting.settle_apart(guess, &self.impacts()) {
            self.keep(orbit);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::{Orbit, hardest_single};
    use crate::monitor::unmonitored;
    use crate::orbit::scan::all_single;
    use softstop::{Machine, Parameter};

    #[test]
    fn the_hardest_is_that_of_all() {
        for (name, clearance) in [
            ("unloaded", -2.0),
            ("unloaded", 8.0),
            ("loaded", 15.0),
            ("loaded", 21.2),
        ] {
            let mut machine = Machine::named(name).expect("the paper's machine");
            machine.set(Parameter::Clearance, clearance);
            for step in 0..40 {
                let scene = machine.scene.at_frequency(0.4 * 1.06_f64.powi(step));
                let mut all = all_single(&scene, &unmonitored).expect("a scene");
                all.retain(Orbit::is_stable);
                let hardest = all.last().map(Orbit::before_impact_velocity);
                let above = |least| {
                    let found = hardest_single(&scene, least, &unmonitored).expect("a scene");
                    found.map(|orbit| orbit.before_impact_velocity())
                };
                let Some(hardest) = hardest else {
                    assert_eq!(above(0.0), None);
                    continue;
                };
                for share in [0.0, 0.9] {
                    let found = above(share * hardest).expect("the hardest");
                    assert!(
                        (found / hardest - 1.0).abs() < 1e-9,
                        "{name} {clearance} {step}: {found} {hardest}"
                    );
                }
                assert_eq!(above(1.001 * hardest), None);
            }
        }
    }
}
