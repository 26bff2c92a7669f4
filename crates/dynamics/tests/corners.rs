//! Branches on which the state at drive angle phi comes to lie on a surface, against the same branches seen at other
//! drive angles: where the section lies has no part in what an orbit is.

use crate::branches;
use softstop::{Machine, Parameter, Ratios, Scene, Stop};
use softstop_dynamics::continuation::{BranchEnd, TestFunction};
use softstop_dynamics::orbit::find;
use softstop_dynamics::{Branch, BranchPoint, Orbit, ParameterFamily, StroboscopicMap};
use softstop_testing::is_near;
use softstop_testing::tolerance::SOLVED;

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// The branch of z = 1 over the frequency, seen at a drive angle.
fn branch(
    scene: &Scene,
    angle: f64,
    range: (f64, f64),
) -> Result<Branch, Box<dyn std::error::Error>> {
    let mut scene = scene.clone();
    scene.excitation.phase += angle;
    let orbit: Orbit = find(&scene)?;
    let eta = scene.excitation.frequency;
    let family = ParameterFamily::new(scene, [Parameter::Frequency])?;
    Ok(branches::follow(
        &family,
        1,
        (eta, orbit.state()),
        range,
        2000,
    )?)
}

/// Symbols and frequencies of all special points.
fn specials(branch: &Branch) -> Vec<(&'static str, f64)> {
    let mut found: Vec<(&'static str, f64)> = branch
        .specials
        .iter()
        .map(|special| (special.kind.symbol(), special.point.parameter))
        .collect();
    found.sort_by(|a, b| a.1.total_cmp(&b.1));
    found
}

fn assert_section_does_not_matter(scene: &Scene, range: (f64, f64)) -> Outcome {
    let expected = specials(&branch(scene, 0.0, range)?);
    assert!(!expected.is_empty());
    for angle in [1.0, 2.5, 4.0, 5.5] {
        let found = specials(&branch(scene, angle, range)?);
        let same = found.len() == expected.len()
            && found
                .iter()
                .zip(&expected)
                .all(|(a, b)| a.0 == b.0 && is_near(a.1, b.1, 10.0 * SOLVED));
        assert!(same, "at {angle}: {found:?} and {expected:?}");
    }
    Ok(())
}

fn loaded(clearance: f64) -> Result<Scene, softstop::SceneError> {
    let ratios = Ratios {
        clearance,
        ..Ratios::loaded()
    };
    ratios.scene()
}

#[test]
fn a_strip_met_at_drive_angle_phi() -> Outcome {
    for clearance in [1.5, 2.0, 3.0] {
        assert_section_does_not_matter(&loaded(clearance)?, (0.8, 1.4))?;
    }
    Ok(())
}

#[test]
fn a_preloaded_stop_met_at_drive_angle_phi() -> Outcome {
    for clearance in [1.0, 1.5] {
        let ratios = Ratios {
            clearance,
            ..Ratios::unloaded()
        };
        assert_section_does_not_matter(&ratios.scene()?, (0.7, 1.5))?;
    }
    Ok(())
}

#[test]
fn a_rigid_stop_met_at_drive_angle_phi() -> Outcome {
    let ratios = Ratios {
        clearance: 2.0,
        frequency: 1.2,
        ..Ratios::unloaded()
    };
    let scene = Scene {
        stop: Stop::Rigid { restitution: 0.7 },
        ..ratios.scene()?
    };
    assert_section_does_not_matter(&scene, (0.6, 2.0))
}

/// The deepest point passes the kinks of loading and unloading, at 10.3 and 10.4.
#[test]
fn turning_points_pass_kinks() -> Outcome {
    let file = include_str!("../../../docs/scenes/piecewise-linear-unloading.toml");
    let scene = Machine::from_toml(file)?.scene;
    let branch = branch(&scene, 0.0, (0.9, 1.6))?;
    assert!(
        matches!(branch.ends, (BranchEnd::Range, BranchEnd::Range)),
        "{:?}",
        branch.ends
    );
    let symbols: Vec<&str> = specials(&branch).iter().map(|special| special.0).collect();
    assert_eq!(symbols, ["G", "SN", "G", "SN"]);
    let deepest = |point: &&BranchPoint| {
        let mut scene = scene.clone();
        scene.excitation.frequency = point.parameter;
        StroboscopicMap::new(&scene.check().expect("valid"), 1)
            .max_position(point.state())
            .is_ok_and(|position| position > 10.4)
    };
    let stable = branch.points.iter().filter(|point| point.is_stable());
    assert!(stable.clone().any(|point| deepest(&point)));
    assert!(
        stable
            .clone()
            .any(|point| point.impacts.len() == 1 && !deepest(&point))
    );
    Ok(())
}

/// The damper of a stop that lets go where its force vanishes sets in with a touch: the multipliers jump past 1 there, and the
/// branch turns back as at a fold. Where it turns back farther on, they pass 1.
#[test]
fn a_fold_at_a_touch_is_told_from_one_that_multipliers_pass() -> Outcome {
    let file = "
        mass = 1.0
        stiffness = 1.0
        damping = 0.1
        clearance = 1.0
        contact.damping = 3.0
        excitation = { amplitude = 1.0, frequency = 1.1 }
        stop = { model = 'kelvinVoigt', stiffness = 50.0, release = 'zeroForce' }
        initial = { position = 0.0, velocity = 1.0 }
    ";
    let scene = Machine::from_toml(file)?.scene;
    let state = find(&scene)?.state();
    let family = ParameterFamily::new(scene, [Parameter::Amplitude])?;
    let branch = branches::follow(&family, 1, (1.0, state), (0.01, 3.0), 2000)?;
    let touch = 0.21f64.hypot(0.11);
    let folds = branch.critical_points(TestFunction::Fold);
    let folds = folds.map(|fold| {
        let jumps = TestFunction::Fold.jumps_at(&fold.monodromy);
        (jumps, is_near(fold.parameter, touch, SOLVED))
    });
    let mut folds: Vec<(bool, bool)> = folds.collect();
    folds.sort();
    assert_eq!(folds, [(false, false), (true, true)]);
    Ok(())
}
