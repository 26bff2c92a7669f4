//! Zones of all stable z = 1 motions on a branch, against the search over all frequencies and against differences.

use nalgebra::Vector2;
use proptest::prelude::*;
use softstop::{Excitation, Parameter, Ratios, Release, Scene, Stop};
use softstop_dynamics::continuation::{Direction, SwitchingSurface, TestFunction};
use softstop_dynamics::derivatives::Border;
use softstop_dynamics::monitor::unmonitored;
use softstop_dynamics::zone::{
    Loss, StableRange, ZoneKind, find_zones, hysteresis, loss_of_stability, single_impact,
    stable_ranges,
};
use softstop_dynamics::{StroboscopicMap, Zone, zone};
use softstop_testing::assert_near;
use softstop_testing::random::{self, log_uniform};
use softstop_testing::tolerance::{DIFFERENCED, SOLVED};

/// All frequencies, in rad/s.
const ALL: (f64, f64) = (f64::MIN_POSITIVE, f64::INFINITY);

fn whole(scene: &Scene) -> Zone {
    let mut zones = single_impact(std::slice::from_ref(scene), ALL, &unmonitored);
    zones.remove(0).expect("a zone")
}

/// A ram of 1.2 t on springs above a pile; a negative clearance presses it on.
fn pile_driver(clearance: f64) -> Scene {
    let mut scene = Ratios::unloaded().scene().expect("valid");
    scene.mass = 1200.0;
    scene.stiffness = 3e6;
    scene.damping = 8000.0;
    scene.clearance = clearance;
    scene.contact_damping = 3e4;
    scene.excitation = Excitation {
        amplitude: 9e4,
        frequency: 75.0,
        phase: 0.0,
    };
    scene.stop = Stop::Preloaded {
        stiffness: 1.2e7,
        preload: 6e4,
    };
    scene
}

#[test]
fn it_holds_the_hysteresis_zone() {
    for ratios in [Ratios::unloaded(), Ratios::loaded()] {
        let scene = ratios.scene().expect("valid");
        let (part, whole) = (hysteresis(&scene).expect("a zone"), whole(&scene));
        assert_near(whole.high.frequency, part.high.frequency, 1e-12);
        assert_near(whole.frequency_g0, part.frequency_g0, 1e-12);
        let orbit = part.orbit_at(0.5).expect("an orbit");
        let flip =
            loss_of_stability(&orbit, Direction::Down, TestFunction::Flip).expect("followed");
        let flip = flip.expect("a flip").parameter;
        assert!(whole.low.is_critical(TestFunction::Flip) && flip < part.frequency_g0);
        assert_near(whole.low.frequency, flip, 1e-9);
        for share in [0.1, 0.5, 0.9, 1.0] {
            let place = whole.place_of(part.frequency_at(share)).min(1.0);
            let [one, other] = [part.point_at(share), whole.point_at(place)];
            let [one, other] = [one, other].map(|it| it.expect("on the branch"));
            let size = one.before_impact_velocity();
            assert_near(other.before_impact_velocity(), size, 1e-6 * size);
        }
    }
}

/// Below g0, without g0, and with a flip at its upper end.
#[test]
fn its_ends_are_those_of_the_search_over_all_frequencies() {
    for (clearance, is_hysteresis) in [(0.012, true), (0.004, false), (0.0, false), (-0.02, false)]
    {
        let scene = pile_driver(clearance);
        assert_eq!(zone::hysteresis(&scene).is_ok(), is_hysteresis);
        let whole = whole(&scene);
        let all = stable_ranges(&scene).expect("a scene");
        let hardest = all.iter().max_by(|a, b| {
            let [a, b] = [a, b].map(|it| it.hardest.before_impact_velocity());
            a.total_cmp(&b)
        });
        let hardest = hardest.expect("a stable_range");
        for (own, other) in [(&whole.low, &hardest.low), (&whole.high, &hardest.high)] {
            assert_near(own.frequency, other.frequency, 1e-7 * other.frequency);
            assert_eq!(own.loss, other.loss, "{clearance}");
        }
        assert_eq!(whole.frequency_g0.is_finite(), clearance > 0.0);
    }
}

#[test]
fn its_ends_have_normals() {
    let scene = pile_driver(0.004);
    let zone = whole(&scene);
    let parameters = [
        Parameter::Suspension,
        Parameter::Clearance,
        Parameter::StopStiffness,
        Parameter::Damping,
    ];
    assert_eq!(zone.low.loss, Loss::AnotherImpact);
    assert!(zone.high.is_critical(TestFunction::Flip));
    let ends: [fn(&Zone) -> f64; 2] = [|zone| zone.low.frequency, |zone| zone.high.frequency];
    for (end, frequency) in [&zone.low, &zone.high].into_iter().zip(ends) {
        let border = Border::at_end(&scene, end, &parameters).expect("a normal");
        for (parameter, normal) in parameters.iter().zip(&border.normal) {
            let value = parameter.get(&scene).expect("it has");
            let width = 1e-3 * value;
            let beside = |by: f64| {
                let mut scene = scene.clone();
                parameter.set(&mut scene, value + by);
                frequency(&whole(&scene))
            };
            let found = (beside(width) - beside(-width)) / (2.0 * width);
            let size = frequency(&zone) / value;
            assert!(
                (found + normal).abs() < DIFFERENCED * size,
                "{parameter:?} {:?}: {found} {normal}",
                end.loss
            );
        }
    }
}

/// A hammer of 15 kg on a Kelvin-Voigt stop, whose period doubles in a narrow window of frequency.
fn hammer(clearance: f64, stiffness: f64, contact_damping: f64) -> Scene {
    let mut scene = Ratios::unloaded().scene().expect("valid");
    scene.mass = 15.0;
    scene.stiffness = 3e5;
    scene.damping = 60.0;
    scene.clearance = clearance;
    scene.contact_damping = contact_damping;
    scene.excitation = Excitation {
        amplitude: 800.0,
        frequency: 150.0,
        phase: 0.0,
    };
    scene.stop = Stop::KelvinVoigt {
        stiffness,
        release: Release::Clearance,
    };
    scene
}

/// The flip at which a window of frequency ends in which the motion is unstable is found from wherever the branch is followed,
/// also where both ends of the window lie on one step.
#[test]
fn windows_of_doubled_periods_are_no_part_of_it() {
    for (clearance, stiffness) in [(0.0012, 2e6), (0.001_409, 2e6), (0.004, 5e6)] {
        let scene = hammer(clearance, stiffness, 600.0);
        let all = stable_ranges(&scene).expect("a machine");
        let mut above = all
            .iter()
            .filter(|range| range.low.is_critical(TestFunction::Flip));
        let range = above.next_back().expect("a range above a flip");
        let flip = range.low.frequency;
        for share in 1..30 {
            let frequency = flip + f64::from(share) / 30.0 * (range.high.frequency - flip);
            let zone = single_impact(
                std::slice::from_ref(&scene),
                (frequency, frequency),
                &unmonitored,
            );
            let zone = zone.into_iter().next().expect("one").expect("a zone");
            assert_near(zone.low.frequency, flip, flip * SOLVED);
            let orbit = zone.orbit_at(zone.place_of(frequency)).expect("an orbit");
            let found = loss_of_stability(&orbit, Direction::Down, TestFunction::Flip);
            let found = found.expect("followed").expect("a flip").parameter;
            assert_near(found, flip, flip * SOLVED);
        }
    }
}

/// Where another impact comes up at a rigid stop the multipliers jump past -1: that is no flip.
#[test]
fn a_grazing_past_which_multipliers_jump_is_no_flip() {
    let mut scene = hammer(0.0, 1.0, 0.0);
    scene.mass = 2.0;
    scene.damping = 12.0;
    scene.excitation.amplitude = 190.0;
    scene.stop = Stop::Rigid { restitution: 0.4 };
    for stiffness in [7999.0, 8000.0, 8100.0, 8500.0] {
        scene.stiffness = stiffness;
        let all = stable_ranges(&scene).expect("a machine");
        let range = all
            .iter()
            .find(|range| range.low.loss == Loss::AnotherImpact)
            .expect("a range that another impact ends");
        for share in 1..10 {
            let at = range.low.frequency
                + f64::from(share) / 10.0 * (range.high.frequency - range.low.frequency);
            let zones = single_impact(std::slice::from_ref(&scene), (at, at), &unmonitored);
            let zone = zones.into_iter().next().expect("one").expect("a zone");
            assert_eq!(zone.low.loss, Loss::AnotherImpact, "{stiffness} {at}");
            assert_near(zone.low.frequency, range.low.frequency, at * SOLVED);
            let orbit = zone.orbit_at(zone.place_of(at)).expect("an orbit");
            let flip = loss_of_stability(&orbit, Direction::Down, TestFunction::Flip);
            assert!(!matches!(flip, Ok(Some(_))), "{stiffness} {at}: {flip:?}");
        }
    }
}

proptest! {
    #![proptest_config(random::cases(60))]

    /// No zone of all stable motions reaches over the end of a stable range into another.
    #[test]
    fn it_is_one_stable_range(
        clearance in log_uniform(2e-4, 0.01),
        stiffness in log_uniform(3e5, 3e7),
        contact_damping in log_uniform(60.0, 1500.0),
    ) {
        let scene = hammer(clearance, stiffness, contact_damping);
        let zones = single_impact(std::slice::from_ref(&scene), ALL, &unmonitored);
        if let Some(Ok(zone)) = zones.into_iter().next() {
            let all = stable_ranges(&scene).expect("a machine");
            let inside = |end: f64| {
                zone.low.frequency * (1.0 + DIFFERENCED) < end && end < zone.high.frequency * (1.0 - DIFFERENCED)
            };
            let middle = zone.point_at(0.5).expect("on the branch");
            let checked = scene.check().expect("valid");
            let on = |range: &&StableRange| range.contains_point(&checked, &middle).unwrap_or(false);
            let range = all.iter().find(on).expect("a range with this motion");
            prop_assert!(!inside(range.low.frequency) && !inside(range.high.frequency), "{:?}", scene);
        }
    }
}

#[test]
fn one_frequency_is_enough_to_look_for_it() {
    let scene = pile_driver(0.004);
    let at = 75.0;
    let zones = single_impact(std::slice::from_ref(&scene), (at, at), &unmonitored);
    let found = zones.into_iter().next().expect("one").expect("a zone");
    assert_near(found.low.frequency, whole(&scene).low.frequency, 1e-6);
    assert_ne!(found.low.loss, Loss::FreeGrazing);
    let none = single_impact(std::slice::from_ref(&scene), (400.0, 410.0), &unmonitored);
    let words = none
        .into_iter()
        .next()
        .expect("one")
        .expect_err("none")
        .to_string();
    assert!(
        words.contains("no stable z = 1 motion found between"),
        "{words}"
    );
}

/// For a design a zone ends where `stable_ranges` says that the rigid stop is grazed; `hysteresis` has none, for it has no fold.
#[test]
fn a_rigid_stop_behind_the_other_ends_a_zone() -> Result<(), Box<dyn std::error::Error>> {
    let text = "mass = 1.0\nstiffness = 1.0\ndamping = 0.02\ncontact.damping = 0.02\nclearance = 7.0\n\
                excitation = { amplitude = 1.0, frequency = 1.05 }\n\
                stop = { model = \"kelvinVoigt\", stiffness = 6.0 }\nrigid = { travel = 2.6, restitution = 0.5 }\n";
    let at = |quarter: u32| -> Result<Scene, Box<dyn std::error::Error>> {
        let mut scene = Scene::from_toml(text)?;
        scene.clearance += 0.25 * f64::from(quarter);
        Ok(scene)
    };
    let scenes = (0..=8).map(at).collect::<Result<Vec<Scene>, _>>()?;
    let zones = find_zones(ZoneKind::Hysteresis, &scenes, &unmonitored);
    for (scene, zone) in scenes.iter().zip(zones) {
        assert!(hysteresis(scene).is_err(), "clearance {}", scene.clearance);
        let zone = zone?;
        let grazed = |loss: &Loss| *loss == Loss::Inner(SwitchingSurface::Wall);
        assert!(grazed(&zone.high.loss), "{:?}", zone.high.loss);
        let stable_ranges = stable_ranges(scene)?;
        let mut ends = stable_ranges.iter().filter(|it| grazed(&it.high.loss));
        let end = ends
            .next()
            .ok_or("no stable_range ends there")?
            .high
            .frequency;
        assert!(
            (end - zone.high.frequency).abs() < 1e-9 * end,
            "{end}, {}",
            zone.high.frequency
        );
        let beside = zone.point_at(0.999)?;
        assert!(beside.is_stable() && beside.impacts.len() == 1);
    }
    Ok(())
}

fn wall(clearance: f64, damping: f64, restitution: f64) -> Scene {
    let mut scene = Scene {
        clearance,
        damping,
        ..Scene::of_stop(Stop::Rigid { restitution })
    };
    scene.excitation.frequency = 1.0;
    scene
}

/// A wall that takes all velocity lets the mass go from rest: where the drive pulls it off at once, its zone and stretches are
/// the limit of small restitutions.
#[test]
fn a_wall_without_rebound_has_the_stretches_of_one_with_little() {
    for (clearance, damping) in [(10.0, 0.04), (2.0, 0.1)] {
        let [dead, lively] = [0.0, 1e-9].map(|restitution| {
            let scene = wall(clearance, damping, restitution);
            let zone = hysteresis(&scene).map(|zone| zone.high.frequency);
            (stable_ranges(&scene).expect("a machine"), zone.ok())
        });
        assert!(!dead.0.is_empty() && dead.0.len() == lively.0.len());
        for (one, other) in dead.0.iter().zip(&lively.0) {
            assert_eq!(one.low.loss, other.low.loss);
            assert_eq!(one.high.loss, other.high.loss);
            assert_near(one.low.frequency, other.low.frequency, 1e-7);
            assert_near(one.high.frequency, other.high.frequency, 1e-7);
        }
        assert_near(dead.1.expect("a fold"), lively.1.expect("a fold"), 1e-7);
    }
}

/// A wall without rebound holds the mass, too, until the drive pulls it off: a run from beside such a motion settles on it.
#[test]
fn stretches_at_a_wall_that_holds_the_mass_are_runs_that_settle() {
    let scene = wall(0.5, 0.02, 0.0);
    let all = stable_ranges(&scene).expect("a machine");
    assert!(all.len() >= 3, "{}", all.len());
    for range in &all {
        for share in [0.1, 0.5, 0.9] {
            let [low, high] = [&range.low, &range.high].map(|end| end.frequency);
            let frequency = low + share * (high - low);
            let checked = scene.check().expect("valid");
            let point = range
                .point_at(&checked, frequency)
                .expect("followed")
                .expect("within");
            let scene = scene.at_frequency(frequency).check().expect("valid");
            let beside = point.state() + Vector2::new(-1e-5, 1e-5);
            let settled = StroboscopicMap::new(&scene, 400)
                .image(beside)
                .expect("bounded");
            assert_near((settled - point.state()).norm(), 0.0, 1e-7);
            let period = StroboscopicMap::new(&scene, 1)
                .trajectory(settled)
                .expect("bounded");
            let [impact] = period.impacts().collect::<Vec<_>>()[..] else {
                panic!("{frequency}: {:?}", period.crossings().collect::<Vec<_>>());
            };
            assert_near(
                impact.before_impact_velocity,
                point.before_impact_velocity(),
                1e-7,
            );
        }
    }
}

/// With little damping 1 - tr + det is small all along a branch that goes over a resonance of 200 to 20,000 times the scale of
/// the machine, without a zero of its own: the fold comes beyond.
#[test]
fn the_zone_of_a_lightly_damped_machine_ends_at_a_fold_of_its_branch() {
    for damping in [1e-3, 1e-4, 5e-5, 1e-5] {
        let mut scene = Ratios::unloaded().scene().expect("valid");
        (scene.damping, scene.contact_damping) = (damping, damping);
        let zone = hysteresis(&scene).expect("a zone");
        let [before, after] = [-1e-4, 1e-4].map(|off| {
            let frequency = zone.high.frequency * (1.0 + off);
            let all = stable_ranges(&scene).expect("a machine");
            let holds = |it: &&StableRange| {
                it.high.is_critical(TestFunction::Fold)
                    && (it.low.frequency..=it.high.frequency).contains(&frequency)
            };
            all.iter().filter(holds).count()
        });
        assert_eq!(
            (before, after),
            (1, 0),
            "{damping}: {}",
            zone.high.frequency
        );
        assert_near(zone.high.frequency, 1.4808, 1e-3);
    }
}

/// Above half its natural frequency the paper's machine has a stable range whose distance from there, width and hardest impact
/// shrink as its damping does. Rounding tells its orbits apart ever worse, until it is too narrow.
#[test]
fn a_range_that_shrinks_with_the_damping_is_found() {
    let in_dampings = |damping: f64| {
        let mut scene = Ratios::unloaded().scene().expect("valid");
        (scene.damping, scene.contact_damping) = (2.0 * damping, 2.0 * damping);
        let ranges = stable_ranges(&scene).expect("a scene");
        let range = ranges.first().filter(|range| range.high.frequency < 0.6)?;
        let ends = [&range.low, &range.high].map(|end| (end.frequency - 0.5) / damping);
        Some((ends, range.hardest.before_impact_velocity() / damping))
    };
    let (ends, hardest) = in_dampings(1e-6).expect("a range");
    for damping in [3e-7, 2e-7, 1e-7, 3e-8] {
        let (found, velocity) = in_dampings(damping).expect("a range");
        for (found, expected) in found.into_iter().zip(ends) {
            assert_near(found, expected, 0.01 * (ends[1] - ends[0]));
        }
        assert_near(velocity, hardest, 0.01 * hardest);
    }
    assert!(in_dampings(1e-8).is_none());
}
