//! The z = 1 motion with the hardest impact at one frequency.

use std::cell::Cell;

use super::impact_lattice::{
    LATTICE_SPEED_RATIO, LATTICE_TIMES, guess_impacts_from_lattice, lattice_speeds,
};
use super::single_impact_search::{SingleImpactSearch, impact_distance, time_distance};
use super::{Orbit, OrbitError, TimedImpact};
use crate::monitor::Monitor;
use crate::tolerance::NEAR;
use softstop::CheckedScene;

/// Difference of times, in units of the period, and ratio of velocities, up to which Newton's method is followed from a
/// cell to the hardest motion: some cells, each of which is searched from its own middle.
const NEWTON_REACH: (f64, f64) = (4.0 / LATTICE_TIMES as f64, 4.0);

/// The stable z = 1 orbit with the hardest impact above this one, in m/s, if any: impacts are tried from the hardest
/// ones down, and Newton's method is followed no farther than some cells.
///
/// # Errors
/// As [`single_impact_orbits`](super::all_single_impact_orbits::single_impact_orbits).
pub(crate) fn harder_single_impact_orbit(
    scene: &CheckedScene,
    least: f64,
    monitor: Monitor<'_>,
) -> Result<Option<Orbit>, OrbitError> {
    let Some(mut singles) = SingleImpactSearch::new(scene) else {
        return Ok(None);
    };
    let mut speeds = lattice_speeds(scene);
    speeds.retain(|speed| LATTICE_SPEED_RATIO * speed > least);
    let mut guesses =
        guess_impacts_from_lattice(&singles.shooting, (singles.period, &speeds), monitor)?;
    guesses.sort_by(|a, b| b.1.total_cmp(&a.1));
    let mut hardest: Option<Orbit> = None;
    for guess in guesses {
        let known = hardest
            .as_ref()
            .map_or(least, Orbit::before_impact_velocity);
        if LATTICE_SPEED_RATIO.sqrt() * guess.1 < known {
            break;
        }
        singles.search_while_near(guess, monitor)?;
        let stable = singles.found.iter().filter(|orbit| orbit.is_stable());
        hardest = stable.max_by(|a, b| a.compare_velocity(b)).cloned();
    }
    Ok(hardest.filter(|orbit| orbit.before_impact_velocity() > least))
}

impl SingleImpactSearch {
    /// Searches an orbit by Newton's method as long as it stays near a guess, and another one beside what it finds.
    fn search_while_near(
        &mut self,
        guess: TimedImpact,
        monitor: Monitor<'_>,
    ) -> Result<(), OrbitError> {
        OrbitError::ask_monitor(monitor)?;
        let (period, impacts) = (self.period, self.found_impacts());
        let is_near = |at: TimedImpact| {
            impacts
                .iter()
                .any(|it| impact_distance(*it, at, period) < NEAR)
        };
        let leaves = |at: TimedImpact| {
            let ratio = (at.1 / guess.1).max(guess.1 / at.1);
            ratio > NEWTON_REACH.1 || time_distance(at.0, guess.0, period) > NEWTON_REACH.0
        };
        let has_left = Cell::new(false);
        let ends = |at: &[f64]| {
            let at = (at[0], at[1]);
            has_left.set(leaves(at));
            has_left.get() || is_near(at)
        };
        let Some(begin) = self.shooting.evaluate_guess(&[guess]) else {
            return Ok(());
        };
        let settled = self.shooting.solve_unless_known(begin.clone(), ends, &[]);
        let is_new = match settled {
            Err(_) => return Ok(()),
            Ok(None) => !has_left.get(),
            Ok(Some(orbit)) => self.keep_if_new(orbit),
        };
        if is_new && let Ok(orbit) = self.shooting.solve(begin, &self.found_impacts()) {
            self.keep_if_new(orbit);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::{Orbit, harder_single_impact_orbit};
    use crate::monitor::unmonitored;
    use crate::orbit::all_single_impact_orbits::single_impact_orbits;
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
                let scene = scene.check().expect("a scene");
                let mut all = single_impact_orbits(&scene, &unmonitored).expect("a scene");
                all.retain(Orbit::is_stable);
                let hardest = all.last().map(Orbit::before_impact_velocity);
                let above = |least| {
                    let found =
                        harder_single_impact_orbit(&scene, least, &unmonitored).expect("a scene");
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
