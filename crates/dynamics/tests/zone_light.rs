//! Zones of lightly damped machines: long branches that meet surfaces at drive angle phi, and motions with small basins.

use approx::assert_abs_diff_eq;
use softstop::{Piercing, Ratios, Scene};
use softstop_dynamics::orbit::find;
use softstop_dynamics::zone::{Zone, hysteresis};
use softstop_testing::tolerance::printed;

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// Frequencies of all folds, in order along the branch.
fn folds(zone: &Zone) -> Vec<f64> {
    let folds = zone.branch.iter();
    let folds = folds.filter(|point| point.fold_test().abs() < 1e-7);
    folds.map(|point| point.parameter).collect()
}

fn assert_folds(zone: &Zone, expected: &[f64], decimals: i32) {
    let found = folds(zone);
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for (found, expected) in found.iter().zip(expected) {
        assert_abs_diff_eq!(found, expected, epsilon = printed(decimals));
    }
}

fn at(scene: &Scene, frequency: f64) -> Scene {
    let mut scene = scene.clone();
    scene.excitation.frequency = frequency;
    scene
}

#[test]
fn a_branch_with_three_folds() -> Outcome {
    let ratios = Ratios {
        clearance: 5.067,
        stiffness: 1.191,
        preload: 42.24,
        damping: 0.007599,
        contact_damping: 0.007592,
        ..Ratios::unloaded()
    };
    let scene = ratios.scene()?;
    assert_folds(&hysteresis(&scene)?, &[1.408618, 1.306632, 1.461022], 6);
    let velocity = find(&at(&scene, 1.3))?.before_impact_velocity();
    assert_abs_diff_eq!(velocity, 7.5128, epsilon = printed(4));
    Ok(())
}

#[test]
fn a_loaded_branch_with_three_folds() -> Outcome {
    let strip = Piercing {
        stiffness: 2.463,
        friction: 3.382,
        thickness: 0.3585,
        travel: 0.2899,
    };
    let ratios = Ratios {
        clearance: 1.812,
        stiffness: 3.384,
        preload: 70.97,
        damping: 0.004497,
        contact_damping: 0.01686,
        piercing: Some(strip),
        ..Ratios::unloaded()
    };
    let scene = ratios.scene()?;
    let zone = hysteresis(&scene)?;
    assert_folds(&zone, &[1.601, 1.473, 1.664], 3);
    let hardest = find(&at(&scene, 1.495))?.before_impact_velocity();
    assert_abs_diff_eq!(hardest, 60.0, epsilon = printed(0));
    let share = (1.495 - zone.frequency_g0) / (zone.frequency_sn - zone.frequency_g0);
    let on_branch = zone.orbit_at(share)?.before_impact_velocity();
    assert_abs_diff_eq!(on_branch, hardest, epsilon = printed(6));
    Ok(())
}

#[test]
fn a_motion_with_a_small_basin() -> Outcome {
    let ratios = Ratios {
        clearance: 1.623,
        stiffness: 28.61,
        preload: 41.86,
        damping: 0.005203,
        contact_damping: 0.004971,
        ..Ratios::unloaded()
    };
    let scene = ratios.scene()?;
    let mut last = 0.0;
    for frequency in [1.2712202506698, 1.272, 1.28, 1.28182] {
        let velocity = find(&at(&scene, frequency))?.before_impact_velocity();
        assert!(velocity > last, "{velocity} at {frequency}");
        last = velocity;
    }
    let zone = hysteresis(&scene)?;
    assert_abs_diff_eq!(zone.frequency_g0, 1.2712202506698, epsilon = printed(13));
    assert_folds(&zone, &[1.703048], 6);
    Ok(())
}
