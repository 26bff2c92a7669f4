//! Zones of lightly damped machines: long branches that meet surfaces at drive angle phi, and motions with small basins.

use serde::Deserialize;
use softstop::internals::turning_points;
use softstop::{Ratios, Scene, Start, Stop};
use softstop_dynamics::Zone;
use softstop_dynamics::continuation::{Direction, TestFunction};
use softstop_dynamics::orbit::find;
use softstop_dynamics::zone::{
    Loss, StableRange, ZoneError, grazing_frequencies, hysteresis, loss_of_stability, stable_ranges,
};
use softstop_testing::tolerance::printed;
use softstop_testing::{assert_near, is_near, with_changes};

use super::zone_denied::scene;

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
        assert_near(found, expected, printed(decimals));
    }
}

/// A lightly damped machine whose branch of z = 1 has three folds.
fn three_folds() -> Scene {
    with_changes(
        "unloaded",
        "rho=5.067 k4=1.191 Fp=42.24 beta1=0.007599 beta=0.007592",
    )
}

#[test]
fn a_branch_with_three_folds() -> Outcome {
    let scene = three_folds();
    assert_folds(&hysteresis(&scene)?, &[1.408618, 1.306632, 1.461022], 6);
    let velocity = find(&scene.at_frequency(1.3))?.before_impact_velocity();
    assert_near(velocity, 7.5128, printed(4));
    Ok(())
}

/// A loaded machine whose branch of z = 1 has three folds.
fn three_folds_loaded() -> Scene {
    with_changes(
        "loaded",
        "rho=1.812 k4=3.384 Fp=70.97 beta1=0.004497 beta=0.01686 k2=2.463 k3=3.382 \
         sigma=0.3585 nu=0.2899",
    )
}

/// Of two motions at one frequency each ends at the folds of its own range: where it ends when it is followed from its orbit.
#[test]
fn a_motion_ends_at_its_own_folds() -> Outcome {
    for scene in [three_folds(), three_folds_loaded()] {
        let zone = hysteresis(&scene)?;
        let ranges = zone.ranges();
        assert_eq!(ranges.len(), 2);
        assert!(ranges[1].low.frequency < ranges[0].high.frequency);
        assert_near(ranges[1].high.frequency, zone.high.frequency, printed(12));
        for range in &ranges {
            for place in (1..20).map(|it| f64::from(it) / 20.0) {
                let orbit = range.orbit_at(place)?;
                let held = zone.range_holding(&orbit).ok_or("a range")?;
                assert_near(held.high.frequency, range.high.frequency, printed(12));
                let followed = |direction| loss_of_stability(&orbit, direction, TestFunction::Fold);
                let above = followed(Direction::Up)?.ok_or("a fold")?;
                assert_near(range.high.frequency, above.parameter, printed(9));
                let below = followed(Direction::Down)?.map_or(0.0, |fold| fold.parameter);
                let low = below.max(zone.frequency_g0);
                assert_near(range.low.frequency, low, printed(9));
            }
        }
    }
    Ok(())
}

#[test]
fn a_loaded_branch_with_three_folds() -> Outcome {
    let zone = hysteresis(&three_folds_loaded())?;
    assert_folds(&zone, &[1.601, 1.473, 1.664], 3);
    let hardest = find(&zone.scene.at_frequency(1.495))?.before_impact_velocity();
    assert_near(hardest, 60.0, printed(0));
    let share = (1.495 - zone.frequency_g0) / (zone.high.frequency - zone.frequency_g0);
    let on_branch = zone.orbit_at(share)?.before_impact_velocity();
    assert_near(on_branch, hardest, printed(6));
    Ok(())
}

#[test]
fn a_motion_with_a_small_basin() -> Outcome {
    let scene = with_changes(
        "unloaded",
        "rho=1.623 k4=28.61 Fp=41.86 beta1=0.005203 beta=0.004971",
    );
    let mut last = 0.0;
    for frequency in [1.2712202506698, 1.272, 1.28, 1.28182] {
        let velocity = find(&scene.at_frequency(frequency))?.before_impact_velocity();
        assert!(velocity > last, "{velocity} at {frequency}");
        last = velocity;
    }
    let zone = hysteresis(&scene)?;
    assert_near(zone.frequency_g0, 1.2712202506698, printed(13));
    assert_folds(&zone, &[1.703048], 6);
    Ok(())
}

/// The stretches between folds alone, and which of them belong to a zone.
fn between_folds(found: &[StableRange], zone: Option<&Zone>) -> Vec<(f64, f64, bool)> {
    let ends_fold = |stable_range: &&StableRange| stable_range.high.loss == Loss::Fold;
    let ends = |stable_range: &StableRange| {
        let in_zone = zone.is_some_and(|zone| stable_range.is_part_of(zone));
        (
            stable_range.low.frequency,
            stable_range.high.frequency,
            in_zone,
        )
    };
    found.iter().filter(ends_fold).map(ends).collect()
}

#[test]
fn stretches_between_several_folds() -> Outcome {
    let scene = three_folds();
    let found = stable_ranges(&scene)?;
    let zone = hysteresis(&scene)?;
    let [(_, first, true), (low, high, true)] = between_folds(&found, Some(&zone))[..] else {
        panic!("{found:?}");
    };
    for (found, expected) in [(first, 1.408618), (low, 1.306632), (high, 1.461022)] {
        assert_near(found, expected, printed(6));
    }
    assert!(found.iter().any(|one| one.low.loss == Loss::Flip));
    assert!(found.iter().any(|one| one.high.loss == Loss::AnotherImpact));
    Ok(())
}

/// All of it lies above g0, where there is no z = 1.
#[test]
fn an_isola() -> Outcome {
    let scene = with_changes(
        "loaded",
        "rho=4.966953067590672 k4=1.4398692936028583 Fp=262.9190348246658 \
         beta1=0.005802743231567894 beta=0.002011340630926028 k2=2.2530448386935893 \
         k3=23.91485155268388 sigma=0.8282795600642743 nu=0.7915560771078273",
    );
    let none = hysteresis(&scene);
    let Err(why @ ZoneError::NoOrbit { .. }) = none else {
        panic!("{none:?}");
    };
    assert!(why.to_string().contains("no stable z = 1 motion"), "{why}");
    let (_, g0) = grazing_frequencies(&scene)?;
    let found = stable_ranges(&scene)?;
    let isola: Vec<_> = found.iter().filter(|one| one.low.frequency > g0).collect();
    let [first, second] = isola[..] else {
        panic!("{isola:?}");
    };
    assert_near(g0, 1.0959, printed(4));
    assert_near(first.low.frequency, 1.1630, printed(4));
    assert_near(second.high.frequency, 1.6786, printed(4));
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
        let found = stable_ranges(&scene)?;
        assert!(!found.is_empty(), "{clearance}");
        for one in &found {
            let middle = 0.5 * (one.low.frequency + one.high.frequency);
            let point = one.point_at(&scene.check()?, middle)?.ok_or("no motion")?;
            assert!(point.is_stable() && point.impacts.len() == 1);
        }
    }
    Ok(())
}

/// With hardly any damping there are motions with one impact at resonances whose ranges are narrower than rounding: none is told.
#[test]
fn ranges_narrower_than_rounding_are_left_out() -> Outcome {
    for damping in [1e-8, 1e-9, 0.0] {
        let scene = Scene {
            damping,
            ..Ratios::unloaded().scene()?
        };
        let found = stable_ranges(&scene)?;
        assert_eq!(found.len(), 1, "{damping}");
        assert_near(found[0].high.frequency, 1.465_137, 1e-6);
    }
    Ok(())
}

/// With hardly any damping a motion with a weak impact at a resonance ends where it turns once more at the stop.
#[test]
fn a_weak_impact_at_a_resonance_ends_in_another_touch() -> Outcome {
    let changes = "rho=2 beta1=1e-6 beta=1e-6 stop.model=rigid R=0.9999";
    let scene = with_changes("unloaded", changes);
    let found = stable_ranges(&scene)?;
    let range = found
        .iter()
        .find(|it| is_near(it.high.frequency, 0.5, 1e-5));
    let range = range.expect("a range");
    assert_eq!(range.high.loss, Loss::AnotherImpact);
    let last = &range.hardest;
    assert_near(last.parameter, range.high.frequency, 1e-13);
    let start = Start::new(last.position, last.velocity);
    let motion = scene.at_frequency(last.parameter).trajectory(start, 1)?;
    let turns = motion.arc_views().flat_map(|(arc, elapsed)| {
        turning_points(arc.course, elapsed, arc.course.departure.velocity > 0.0)
    });
    let highest = turns.map(|turn| turn.position).fold(0.0, f64::max);
    // At a resonance the last digit of the frequency moves it by 1e-9.
    assert_near(highest, scene.clearance, 1e-7);
    Ok(())
}

#[derive(Deserialize)]
struct Light {
    narrow: Vec<Settled>,
    wild: Vec<Settled>,
}

/// A motion of z = 1 on which starts settle.
#[derive(Deserialize)]
struct Settled {
    frequency: f64,
    velocity: f64,
    machine: toml::Table,
}

fn light() -> Light {
    toml::from_str(include_str!("zone_light.toml")).expect("a list")
}

/// Motions that starts settle on there, found by brute force.
#[test]
fn narrow_stretches_between_grazings() {
    assert_none_missed(&light().narrow);
}

/// What Newton's method runs off to from there is no motion of that branch, and hides none of the others.
#[test]
fn a_branch_does_not_run_off() {
    assert_none_missed(&light().wild);
}

fn assert_none_missed(all: &[Settled]) {
    for one in all {
        let scene = scene(&one.machine).check().expect("valid");
        let on = |stable_range: &StableRange| {
            let there = stable_range.point_at(&scene, one.frequency).ok().flatten();
            there.is_some_and(|point| is_near(point.impacts[0], one.velocity, 1e-6))
        };
        let found = stable_ranges(&scene).expect("a machine");
        assert!(found.iter().any(on), "{}", one.frequency);
    }
}

/// Branches that are lost near the same motion may have parts in common.
#[test]
fn no_part_is_listed_twice() -> Outcome {
    let scene = scene(&light().narrow[1].machine).check()?;
    let found = stable_ranges(&scene)?;
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
