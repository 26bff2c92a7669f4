//! Machines with a stop on each side.

use super::*;
use softstop::Below;
use softstop_testing::hertz;

/// A stop of any kind that lanes follow.
fn stop(index: usize) -> Stop {
    let stiffness = 10f64.powf(between(0.5, 4.0, spread(index, 7)));
    match index % 7 {
        0 => Stop::None,
        1 => hertz(stiffness, [1.5, 2.0, 2.5][index / 7 % 3], 0.0),
        2 => hertz(stiffness, [1.5, 2.0, 2.5][index / 7 % 3], 0.05),
        3 => Stop::Rigid { restitution: 0.7 },
        _ => scene(9 * index + 1).stop,
    }
}

/// A machine with stops on both sides, of any two kinds.
fn two_sided(index: usize) -> Scene {
    let mut scene = Ratios::unloaded()
        .at_frequency(between(0.5, 2.0, spread(index, 1)))
        .scene()
        .expect("valid");
    scene.clearance = between(-0.4, 3.0, spread(index, 2));
    scene.damping = between(0.02, 0.3, spread(index, 8));
    scene.contact_damping = between(0.02, 1.0, spread(index, 3));
    scene.stop = stop(index / 7);
    scene.below = Some(Box::new(Below {
        clearance: between(0.3, 5.0, spread(index, 6)) - scene.clearance,
        stop: stop(index),
    }));
    scene
}

fn is_for_lanes(scene: &Scene) -> bool {
    LoweredMachine::new(&scene.check().expect("valid")).is_for_lanes()
}

/// A motion of each machine from a position between its clearances.
fn between_stops(scenes: Vec<Scene>) -> Batch {
    let mut batch = batch_of(scenes);
    for (index, (job, scene)) in batch.jobs.iter_mut().zip(&batch.scenes).enumerate() {
        let below = -scene.below.as_ref().expect("a stop below").clearance;
        job.start.position = between(
            below,
            scene.clearance,
            between(0.01, 0.99, spread(index, 8)),
        );
    }
    batch
}

#[test]
fn lanes_find_the_impacts_on_both_sides() {
    let (fast, slow): (Vec<Scene>, Vec<Scene>) = (0..8000).map(two_sided).partition(is_for_lanes);
    let handed = compare(between_stops(fast));
    assert!(handed < 0.06, "{handed} of the periods handed over");
    // One of the stops is not for lanes by itself.
    assert!(slow.len() < 400, "{}", slow.len());
    for scene in slow {
        let above = Scene {
            below: None,
            ..scene.clone()
        };
        let below = Scene {
            stop: Stop::None,
            ..scene
        };
        assert!(!is_for_lanes(&above) || !is_for_lanes(&below), "{below:?}");
    }
}

#[test]
fn what_settles_between_two_stops_ends_where_the_scalar_engine_ends() {
    let scenes = (0..1500).map(two_sided).filter(is_for_lanes).collect();
    let mut batch = between_stops(scenes);
    for job in &mut batch.jobs {
        job.periods = 400;
    }
    let leapt = leaps::compare_settled(&batch);
    assert!(leapt > 0.35, "{leapt} of the periods leapt over");
}

#[test]
fn the_watcher_hears_of_the_impacts_on_both_sides() {
    for index in [2, 3, 11, 38] {
        let mut scene = two_sided(index);
        scene.clearance = 1.0;
        scene.below = Some(Box::new(Below {
            clearance: 0.5,
            stop: stop(index),
        }));
        scene.damping = 0.1;
        assert!(is_for_lanes(&scene), "{scene:?}");
        let velocity = |index| Start::new(0.2, between(-3.0, 3.0, spread(index, 5)));
        compare_told(&scene, (0..20).map(velocity).collect());
    }
}
