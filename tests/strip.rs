//! The strip: half pierced it is met again, pierced it counts once per stroke.

use softstop::{
    Crossing, CrossingKind, InitialConditions, PhaseKind, Ratios, Scene, Simulation, Start, Strip,
    Trajectory,
};
use softstop_testing::tolerance::MOTION;
use softstop_testing::{assert_near, loaded, piercing};

fn machine(frequency: f64, clearance: f64, strip: Strip) -> Scene {
    let ratios = Ratios {
        frequency,
        clearance,
        piercing: Some(strip),
        ..Ratios::unloaded()
    };
    ratios.scene().expect("valid")
}

fn passes(trajectory: &Trajectory, position: f64) -> Vec<&Crossing> {
    let rises = |crossing: &&Crossing| {
        matches!(crossing.kind, CrossingKind::Surface { forward: true, .. })
            && crossing.position == position
    };
    trajectory.crossings().filter(rises).collect()
}

/// A weak stroke turns back in phase I; the next one meets the same force from the clearance on.
#[test]
fn a_half_pierced_strip_is_met_again() {
    let scene = machine(0.3, 0.8, Strip::PAPER);
    let start = Start::new(0.0, 0.5);
    let trajectory = scene.trajectory(start, 6).expect("bounded");
    let strokes = passes(&trajectory, scene.clearance);
    assert!(strokes.len() >= 2, "only {} strokes", strokes.len());
    assert!(trajectory.crossings().all(|crossing| !crossing.pierces()));
    let mut machine = Simulation::new(&scene, start).expect("valid");
    for stroke in strokes {
        let time = trajectory.clock.time(stroke.instant) + 1e-3;
        machine.advance(time).expect("bounded");
        let sample = machine.sample();
        assert_eq!(sample.phase, PhaseKind::Pierce);
        let deflection = sample.position - scene.clearance;
        let damper = (scene.contact_damping - scene.damping) * sample.velocity;
        // Peterka 2003, eq. 1, with sign x' = 1.
        let expected = (21.0 + 23.0) * deflection + damper;
        assert_near(sample.contact_force, expected, MOTION);
    }
    assert_eq!(machine.pierce_count(), 0);
}

/// A mass that stays beyond the clearance passes the far side of its strip again and again: one strip.
#[test]
fn a_strip_is_pierced_once_per_stroke() {
    let soft = piercing(0.01, 0.01, 2.5, 5.0);
    let scene = machine(0.7, -3.0, soft);
    let start = Start::new(-3.2, 0.0);
    let trajectory = scene.trajectory(start, 12).expect("bounded");
    let met = passes(&trajectory, scene.clearance).len();
    let far_side = passes(&trajectory, scene.clearance + 2.5);
    let pierced = far_side
        .iter()
        .filter(|crossing| crossing.pierces())
        .count();
    assert!(far_side.len() > met + 1, "{} of {met}", far_side.len());
    assert!(pierced <= met && pierced >= 1);
}

/// Every strong stroke of point B pierces one strip.
#[test]
fn a_strong_stroke_pierces() {
    let scene = loaded();
    let start = Start::new(
        softstop::internals::samples::LOADED.position,
        softstop::internals::samples::LOADED.velocity,
    );
    let mut machine = Simulation::new(&scene, start).expect("valid");
    machine.advance(50.0 * scene.period()).expect("bounded");
    assert_eq!(machine.pierce_count(), 50);
    assert_eq!(machine.impact_count(), 50);
}

/// Without material a machine that starts beyond the clearance meets nothing there.
#[test]
fn a_start_without_material_meets_no_strip() {
    let scene = loaded();
    let start = Start::new(scene.clearance + 0.2, 0.5);
    for (fed, phase) in [(true, PhaseKind::Pierce), (false, PhaseKind::Gap)] {
        let mut machine =
            Simulation::new(&scene, InitialConditions::from(start).fed(fed)).expect("valid");
        assert_eq!(machine.sample().phase, phase);
        machine.advance(20.0 * scene.period()).expect("bounded");
        assert_eq!(machine.pierce_count() > 0, fed);
    }
}
