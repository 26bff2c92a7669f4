//! Zones of lightly damped machines: long branches that meet surfaces at drive angle phi, and motions with small basins.

use approx::assert_abs_diff_eq;
use softstop::{Machine, Piercing, Ratios, Scene, SceneError, Stop};
use softstop_dynamics::Zone;
use softstop_dynamics::orbit::find;
use softstop_dynamics::zone::{
    Loss, Stretch, ZoneError, grazing_frequencies, hysteresis, stretches,
};
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

/// A lightly damped machine whose branch of z = 1 has three folds.
fn three_folds() -> Result<Scene, SceneError> {
    let ratios = Ratios {
        clearance: 5.067,
        stiffness: 1.191,
        preload: 42.24,
        damping: 0.007599,
        contact_damping: 0.007592,
        ..Ratios::unloaded()
    };
    ratios.scene()
}

#[test]
fn a_branch_with_three_folds() -> Outcome {
    let scene = three_folds()?;
    assert_folds(&hysteresis(&scene)?, &[1.408618, 1.306632, 1.461022], 6);
    let velocity = find(&scene.at_frequency(1.3))?.before_impact_velocity();
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
    let hardest = find(&scene.at_frequency(1.495))?.before_impact_velocity();
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
        let velocity = find(&scene.at_frequency(frequency))?.before_impact_velocity();
        assert!(velocity > last, "{velocity} at {frequency}");
        last = velocity;
    }
    let zone = hysteresis(&scene)?;
    assert_abs_diff_eq!(zone.frequency_g0, 1.2712202506698, epsilon = printed(13));
    assert_folds(&zone, &[1.703048], 6);
    Ok(())
}

/// The stretches between folds alone, and which of them belong to a zone.
fn between_folds(found: &[Stretch], zone: Option<&Zone>) -> Vec<(f64, f64, bool)> {
    let ends_fold = |stretch: &&Stretch| stretch.high.loss == Loss::Fold;
    let ends = |stretch: &Stretch| {
        let in_zone = zone.is_some_and(|zone| stretch.is_part_of(zone));
        (stretch.low.frequency, stretch.high.frequency, in_zone)
    };
    found.iter().filter(ends_fold).map(ends).collect()
}

#[test]
fn stretches_between_several_folds() -> Outcome {
    let scene = three_folds()?;
    let found = stretches(&scene)?;
    let zone = hysteresis(&scene)?;
    let [(_, first, true), (low, high, true)] = between_folds(&found, Some(&zone))[..] else {
        panic!("{found:?}");
    };
    for (found, expected) in [(first, 1.408618), (low, 1.306632), (high, 1.461022)] {
        assert_abs_diff_eq!(found, expected, epsilon = printed(6));
    }
    assert!(found.iter().any(|one| one.low.loss == Loss::Flip));
    assert!(found.iter().any(|one| one.high.loss == Loss::AnotherImpact));
    Ok(())
}

/// All of it lies above g0, where there is no z = 1.
#[test]
fn an_isola() -> Outcome {
    let strip = Piercing {
        stiffness: 2.2530448386935893,
        friction: 23.91485155268388,
        thickness: 0.8282795600642743,
        travel: 0.7915560771078273,
    };
    let ratios = Ratios {
        clearance: 4.966953067590672,
        stiffness: 1.4398692936028583,
        preload: 262.9190348246658,
        damping: 0.005802743231567894,
        contact_damping: 0.002011340630926028,
        piercing: Some(strip),
        ..Ratios::unloaded()
    };
    let scene = ratios.scene()?;
    let none = hysteresis(&scene);
    assert!(matches!(none, Err(ZoneError::NoOrbit { .. })), "{none:?}");
    let (_, g0) = grazing_frequencies(&scene)?;
    let found = stretches(&scene)?;
    let isola: Vec<_> = found.iter().filter(|one| one.low.frequency > g0).collect();
    let [first, second] = isola[..] else {
        panic!("{isola:?}");
    };
    assert_abs_diff_eq!(g0, 1.0959, epsilon = printed(4));
    assert_abs_diff_eq!(first.low.frequency, 1.1630, epsilon = printed(4));
    assert_abs_diff_eq!(second.high.frequency, 1.6786, epsilon = printed(4));
    assert!(second.low.frequency < first.high.frequency);
    for end in [&first.low, &first.high, &second.low, &second.high] {
        assert_eq!(end.loss, Loss::Fold);
    }
    Ok(())
}

/// No motion without impacts grazes a stop that the mass is pressed against, or just touches.
#[test]
fn without_a_grazing_boundary_there_are_stretches() -> Outcome {
    for clearance in [-0.5, 0.0] {
        let stop = Stop::Rigid { restitution: 0.7 };
        let scene = Scene {
            clearance,
            stop,
            ..Ratios::unloaded().scene()?
        };
        assert!(matches!(
            hysteresis(&scene),
            Err(ZoneError::NoGrazing { .. })
        ));
        let found = stretches(&scene)?;
        assert!(!found.is_empty(), "{clearance}");
        for one in &found {
            let middle = 0.5 * (one.low.frequency + one.high.frequency);
            let point = one.point_at(&scene, middle)?.ok_or("no motion")?;
            assert!(point.is_stable() && point.impacts.len() == 1);
        }
    }
    Ok(())
}

/// Stretches of one or two per cent of a frequency, on branches of their own between grazings: machine, frequency,
/// before-impact velocity.
const NARROW: [(&str, f64, f64); 3] = [
    (
        r#"
        mass = 1.0
        stiffness = 1.0
        damping = 0.003862551974606898
        clearance = 0.7016076302217213
        contact.damping = 0.2839427710865639
        excitation = { amplitude = 1.0, frequency = 1.0 }
        stop = { model = "kelvin-voigt", stiffness = 6.756288262259929, release = "zero-force" }
        "#,
        0.2843706146148979,
        0.11687658940728711,
    ),
    (
        r#"
        mass = 1.0
        stiffness = 1.0
        damping = 0.019785236634088547
        clearance = 0.6101458396162416
        contact.damping = 0.048701862915056085
        excitation = { amplitude = 1.0, frequency = 1.0 }
        stop = { model = "preloaded", stiffness = 171.47717082033913, preload = 13.057579315427644 }
        [piercing]
        stiffness = 10.551918701107407
        friction = 9.740012643262677
        thickness = 0.06750529764880632
        travel = 0.15694637880660617
        "#,
        0.48621723167722525,
        0.5767556438024368,
    ),
    (
        r#"
        mass = 1.0
        stiffness = 1.0
        damping = 0.004077571953411345
        clearance = 1.7460711077969326
        contact.damping = 0.006877124392319086
        excitation = { amplitude = 1.0, frequency = 1.0 }
        [stop]
        model = "piecewise-linear"
        loading = [
            { from = 0.0, stiffness = 2.416523876931542 },
            { from = 0.5933147929749587, stiffness = 93.74135094551133 },
        ]
        "#,
        0.6725767278627006,
        0.3565644788748065,
    ),
];

/// A machine where a branch is lost at a motion that a change of 1e-6 throws by 1.
const WILD: (&str, f64, f64) = (
    r#"
    mass = 1.0
    stiffness = 1.0
    damping = 0.025503965738481488
    clearance = 7.281197916762066
    contact.damping = 0.003909202263016358
    excitation = { amplitude = 1.0, frequency = 1.0 }
    stop = { model = "preloaded", stiffness = 24.502085405537247, preload = 0.0 }
    [piercing]
    stiffness = 11.460328884998217
    friction = 29.524175272473425
    thickness = 0.6006342449307971
    travel = 0.5786930156852612
    "#,
    1.0651877658600444,
    7.46620327648116,
);

/// Motions that starts settle on there, found by brute force.
#[test]
fn narrow_stretches_between_grazings() {
    assert_none_missed(&NARROW);
}

/// What Newton's method runs off to from there is no motion of that branch, and hides none of the others.
#[test]
fn a_branch_does_not_run_off() {
    assert_none_missed(&[WILD]);
}

fn assert_none_missed(all: &[(&str, f64, f64)]) {
    let missed = all.iter().filter(|(machine, frequency, velocity)| {
        let scene = Machine::from_toml(machine).expect("a machine").scene;
        let on = |one: &Stretch| {
            let there = one.point_at(&scene, *frequency).ok().flatten();
            there.is_some_and(|point| (point.impacts[0] - velocity).abs() < 1e-6)
        };
        !stretches(&scene).expect("a machine").iter().any(on)
    });
    let missed: Vec<_> = missed.map(|(_, frequency, _)| frequency).collect();
    assert!(missed.is_empty(), "{missed:?}");
}

/// Branches that are lost near the same motion may have parts in common.
#[test]
fn no_part_is_listed_twice() -> Outcome {
    let scene = Machine::from_toml(NARROW[1].0)?.scene;
    let found = stretches(&scene)?;
    for (index, one) in found.iter().enumerate() {
        for other in &found[..index] {
            let low = one.low.frequency.max(other.low.frequency);
            let high = one.high.frequency.min(other.high.frequency);
            if (1.0 + 1e-6) * low < high {
                let middle = 0.5 * (low + high);
                let [one, other] = [one, other].map(|of| of.point_at(&scene, middle));
                let (one, other) = (one?.ok_or("no motion")?, other?.ok_or("no motion")?);
                assert!((one.state() - other.state()).norm() > 1e-6, "{middle}");
            }
        }
    }
    Ok(())
}
