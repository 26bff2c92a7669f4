//! Contacts under power laws, with and without dissipation.

use super::*;
use softstop_testing::hertz;

/// A machine with a power law for a stop: behind a strip, far, near, or pressed for good.
fn power(index: usize) -> Scene {
    let mut scene = scene(index);
    scene.rigid = None;
    scene.stop = hertz(
        10f64.powf(between(0.0, 4.0, spread(index, 7))),
        [1.5, 2.0, 2.5][index / 2 % 3],
        match index % 2 {
            0 => 0.0,
            _ => between(0.0, 0.1, spread(index, 6)),
        },
    );
    if index.is_multiple_of(5) {
        scene.piercing = None;
        scene.clearance = between(-1.0, 1.0, spread(index, 6));
    }
    scene
}

fn is_for_lanes(scene: &Scene) -> bool {
    LoweredMachine::new(&scene.check().expect("valid")).is_for_lanes()
}

#[test]
fn power_laws_are_followed_in_lanes() {
    let (fast, slow): (Vec<Scene>, Vec<Scene>) = (0..4000).map(power).partition(is_for_lanes);
    let handed = compare(batch_of(fast));
    assert!(handed < 0.01, "{handed} of the periods handed over");
    // What lies before the stop is too soft or resonant.
    assert!(slow.len() < 80, "{}", slow.len());
    for mut scene in slow {
        scene.stop = Stop::None;
        assert!(!is_for_lanes(&scene), "{scene:?}");
    }
}

#[test]
fn lanes_under_a_power_law_and_a_linear_one_go_together() {
    let mixed = |index: usize| match index % 2 {
        0 => power(index / 2),
        _ => scene(index / 2),
    };
    compare(batch_of((0..2000).map(mixed).collect()));
}

/// A motion in a lane that stops at each period has the safe engine's impacts and end, unless it is chaotic.
fn assert_close_or_chaotic(index: usize, scene: &Scene, start: Start) {
    let (end, impacts) = scalar(scene, start);
    let lanes = single::one_by_one(scene, start, PERIODS, &mut single::Periods);
    let off = distance(lanes.0, end);
    let chaotic = growth(scene, start, end, PERIODS) > 1e4;
    assert!(
        chaotic || (lanes.1, off < 1e-8) == (impacts, true),
        "{index}: {off:e}"
    );
}

#[test]
fn a_contact_across_the_end_of_a_period_is_one() {
    for index in 0..200 {
        let mut scene = power(10 * index);
        scene.clearance = between(2.0, 8.0, spread(index, 1));
        let start = start(index, &scene);
        assert_close_or_chaotic(index, &scene, start);
    }
}

#[test]
fn a_mass_that_the_stop_would_pull_is_pressed_again() {
    for index in 0..200 {
        let mut scene = power(2 * index + 1);
        scene.piercing = None;
        scene.stop = hertz(100.0, [1.5, 2.0, 2.5][index % 3], 0.07);
        let position = scene.clearance + between(0.5, 1.5, spread(index, 4));
        let start = Start::new(position, between(-1.01, -1.0, spread(index, 5)) / 0.07);
        assert_close_or_chaotic(index, &scene, start);
    }
}
