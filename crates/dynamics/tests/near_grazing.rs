//! Branches that flip and fold so near to a grazing that no step of a continuation falls between, against first order in a weak
//! preload.
//!
//! A mass that touches a stop of preload P with a small velocity v, at which its acceleration is a, gets the impulse 2 P v / a.
//! Where M is the Jacobian of the period from the touch on, that of the touching orbit is M (1, 0; -2 P / v, 1), of trace
//! tr M - 2 P M12 / v and of the same determinant: it flips and folds at one v each, which shrinks with P. The clearance of an
//! orbit that touches with v is that of grazing less v^2 / (2 a) + 2 P v M12 / (a (1 - tr M + det M)): the depth, and by how much
//! the impulse moves the fixed point.

use crate::branches;
use nalgebra::Vector2;
use softstop::internals::turning_points;
use softstop::{Below, CheckedScene, Parameter, Scene, Start, Stop};
use softstop_dynamics::continuation::BranchEnd;
use softstop_dynamics::orbit::find;
use softstop_dynamics::{Branch, ParameterFamily, StroboscopicMap};
use softstop_testing::assert_near;
use softstop_testing::scenes::preloaded;
use softstop_testing::tolerance::ROUNDING;

/// The branch of period 1 of a scene along a parameter, from a state near it.
fn branch(scene: &Scene, along: Parameter, state: Vector2<f64>, range: (f64, f64)) -> Branch {
    let from = along.get(scene).expect("it has one");
    let family = ParameterFamily::new(scene.clone(), [along]).expect("a family");
    branches::follow(&family, 1, (from, state), range, 4000).expect("a branch")
}

/// Where in its period the mass is lowest, in s, and its position there.
fn lowest(scene: &CheckedScene, state: Vector2<f64>) -> (f64, f64) {
    let motion = scene.trajectory(state.into(), 1).expect("a motion");
    let turns = motion.arc_views().flat_map(|(arc, elapsed)| {
        let turns = [true, false].map(|back| turning_points(arc.course, elapsed, back));
        turns
            .into_iter()
            .flatten()
            .map(move |turn| (arc.begin() + turn.elapsed, turn.position))
    });
    turns.min_by(|a, b| a.1.total_cmp(&b.1)).expect("it turns")
}

/// Adds weak stops below the lowest point of an orbit and compares what the branch over their clearance flips and folds at.
#[track_caller]
fn flips_and_folds_where_first_order_says(
    scene: &Scene,
    state: Vector2<f64>,
    symbols: &[&str],
    preloads: &[f64],
) {
    let (time, low) = lowest(&scene.check().expect("a scene"), state);
    let mut turned = scene.clone();
    turned.excitation.phase += turned.excitation.frequency * time;
    let map = StroboscopicMap::new(&turned.check().expect("a scene"), 1);
    let passage = map.apply(Vector2::new(low, 0.0)).expect("a motion");
    let acceleration = turned.excitation.phase.cos() - low;
    let m12 = passage.monodromy.matrix[(0, 1)];
    let (trace, determinant) = (
        passage.monodromy.matrix.trace(),
        passage.monodromy.determinant(),
    );
    for preload in preloads.iter().copied() {
        let (clearance, stop) = (-low - 0.05, preloaded(0.0, preload));
        let below = Some(Box::new(Below { clearance, stop }));
        let with_stop = Scene {
            below,
            ..scene.clone()
        };
        let range = (-low - 0.06, -low + 0.05);
        let found = branch(&with_stop, Parameter::BelowClearance, state, range);
        let told = found.specials.iter().map(|special| special.kind.symbol());
        assert_eq!(
            told.collect::<Vec<_>>(),
            symbols,
            "{preload}: {:?}",
            found.ends
        );
        assert!(
            matches!(found.ends.1, BranchEnd::Grazing),
            "{preload}: {:?}",
            found.ends
        );
        for special in &found.specials {
            let at_trace = match special.kind.symbol() {
                "PD" => -(1.0 + determinant),
                "SN" => 1.0 + determinant,
                _ => f64::INFINITY,
            };
            let velocity = 2.0 * preload * m12 / (trace - at_trace);
            let moved = 2.0 * preload * m12 / (1.0 - trace + determinant);
            let [depth, moved] = [0.5 * velocity, moved].map(|part| velocity / acceleration * part);
            let distance = special.point.parameter + low;
            // What first order leaves out, and rounding of the clearance.
            let tolerance = 10.0 * preload * (depth.abs() + moved.abs()) + ROUNDING;
            let expected = -depth - moved;
            assert_near(distance, expected, tolerance);
        }
    }
}

/// A free motion that reaches a weak stop flips at once where the drive is faster than twice the suspension, and folds where it is
/// slower.
#[test]
fn a_free_motion_flips_or_folds_right_beside_the_touch() {
    for (frequency, symbol) in [(3.0, "PD"), (2.2, "PD"), (1.4, "SN"), (1.2, "SN")] {
        let (damping, clearance) = (0.1, 50.0);
        let rigid = Stop::Rigid { restitution: 0.5 };
        let mut scene = Scene {
            damping,
            clearance,
            ..Scene::of_stop(rigid)
        };
        (scene.excitation.amplitude, scene.excitation.frequency) = (1.0, frequency);
        let settled = scene.trajectory(Start::new(0.0, 0.0), 400);
        let state = settled.expect("a motion").end.into();
        flips_and_folds_where_first_order_says(&scene, state, &[symbol, "G"], &[1e-2, 1e-3]);
    }
}

/// Beyond its flip, a motion between a rigid stop and a weak one is stable once more before the weak touch dies.
#[test]
fn a_flipped_motion_comes_back_through_a_flip_and_a_fold() {
    for (restitution, damping, frequency) in [
        (0.3, 0.05, 2.84),
        (0.3, 0.05, 3.8),
        (0.6, 0.2, 3.0),
        (0.8, 0.2, 3.5),
    ] {
        let mut scene = Scene {
            damping,
            clearance: 0.0,
            ..Scene::of_stop(Stop::Rigid { restitution })
        };
        (scene.excitation.amplitude, scene.excitation.frequency) = (1.0, 2.0);
        let settled = find(&scene).expect("a motion");
        let along = branch(
            &scene,
            Parameter::Frequency,
            settled.state(),
            (1.9, frequency),
        );
        scene.excitation.frequency = frequency;
        let state = along.points.last().expect("a point").state();
        flips_and_folds_where_first_order_says(
            &scene,
            state,
            &["PD", "SN", "G"],
            &[1e-2, 1e-3, 1e-4],
        );
    }
}
