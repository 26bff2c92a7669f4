//! Attractors along a parameter keep their numbers from value to value while they last.

use softstop::Scene;
use softstop_dynamics::basin::{BasinOptions, BasinsAt, follow_attractors};
use softstop_dynamics::monitor::unmonitored;
use softstop_dynamics::{Axis, Grid};
use softstop_testing::{assert_near, loaded, with_changes};

use super::{NONE, ONE, on, states};

/// The machine of each value of the frequency, and its basins and attractors.
fn along_frequencies(
    scene: &Scene,
    values: impl Iterator<Item = f64>,
    grid: &Grid,
) -> Vec<BasinsAt> {
    let scenes: Vec<(f64, Scene)> = values.map(|it| (it, scene.at_frequency(it))).collect();
    let options = BasinOptions::default();
    let found = follow_attractors(&scenes, grid, &options, &unmonitored, None).expect("basins");
    assert_eq!(found.len(), scenes.len());
    found
}

/// Where an attractor is, and its regimes there.
fn life(found: &[BasinsAt], attractor: usize) -> (Vec<f64>, Vec<String>) {
    let own = found.iter().filter_map(|at| {
        let index = at.attractors.iter().position(|it| *it == attractor)?;
        Some((at.value, at.basins.classes[index].motion.to_string()))
    });
    let (values, mut motions): (Vec<f64>, Vec<String>) = own.unzip();
    motions.dedup();
    (values, motions)
}

/// The loaded machine at rho = 10: z = 1 lives from its flip s_PD = 1.003035 to its fold s_SN = 1.293034, z = 0 from
/// grazing on, at 1.044440. Each keeps its number where both are.
#[test]
fn attractors_keep_their_numbers_through_the_hysteresis_zone() {
    let scene = loaded();
    let values = (0..36).map(|step| 1.0 + 0.01 * f64::from(step));
    let found = along_frequencies(&scene, values, &states(16));
    let number = |value: f64, regime| {
        let at = found
            .iter()
            .find(|at| (at.value - value).abs() < 1e-9)
            .expect("a value");
        let own = at
            .basins
            .classes
            .iter()
            .position(|it| it.motion.regime() == Some(regime));
        at.attractors[own.expect("its basin")]
    };
    let (with, without) = (number(1.15, ONE), number(1.15, NONE));
    assert_ne!(with, without);
    for (attractor, name, ends) in [
        (with, "z = 1", [1.01, 1.29]),
        (without, "z = 0", [1.05, 1.35]),
    ] {
        let (values, motions) = life(&found, attractor);
        assert_eq!(motions, [name]);
        assert_near(values[0], ends[0], 1e-9);
        assert_near(values[values.len() - 1], ends[1], 1e-9);
        assert_eq!(
            values.len() as f64,
            (100.0 * (ends[1] - ends[0])).round() + 1.0
        );
    }
    // The shares are those of the basins at the value alone.
    let at = &found[20];
    let alone = on(&scene.at_frequency(at.value), &states(16));
    for (class, own) in alone.classes.iter().zip(&at.basins.classes) {
        assert_eq!((&class.motion, class.starts), (&own.motion, own.starts));
    }
    assert!(at.entropy.basin > 0.0 && at.entropy.boundary > Some(at.entropy.basin));
    let last = &found[found.len() - 1];
    assert_eq!((last.entropy.basin, last.entropy.boundary), (0.0, None));
}

/// An elastic stop at the point of rest: at 2.651807 z = 1 doubles its period softly and stays the same attractor.
#[test]
fn a_soft_flip_makes_no_new_attractor() {
    let scene = with_changes("unloaded", "rho=0 beta1=0.1 stop.model=rigid R=1");
    let values = (0..9).map(|step| 2.648 + 0.001 * f64::from(step));
    let found = along_frequencies(&scene, values, &states(8));
    let last = &found[found.len() - 1];
    let doubled = last
        .basins
        .classes
        .iter()
        .position(|it| it.motion.to_string() == "z = 2/2");
    let (values, motions) = life(&found, last.attractors[doubled.expect("z = 2/2")]);
    assert_eq!(motions, ["z = 1", "z = 2/2"]);
    assert_eq!(values.len(), 9);
}

/// A rigid stop that comes nearer stands before states of the motions at the value before.
#[test]
fn attractors_are_followed_before_a_wall_that_comes_nearer() {
    let scene = with_changes("unloaded", "rho=2 eta=0.9 stop.model=rigid R=0.6");
    let at = |step: i32| {
        let clearance = 2.0 - 0.5 * f64::from(step);
        let clearance_changed = Scene {
            clearance,
            ..scene.clone()
        };
        (clearance, clearance_changed)
    };
    let scenes: Vec<(f64, Scene)> = (0..5).map(at).collect();
    let grid = Grid::of_states(
        Axis::position(-5.0, 0.0, 8),
        Axis::velocity(-5.0, 5.0, 8),
        0.0,
    );
    let options = BasinOptions::default();
    let found = follow_attractors(&scenes, &grid, &options, &unmonitored, None).expect("basins");
    assert_eq!(found.len(), 5);
}
