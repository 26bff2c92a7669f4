//! Machines with a stop on each side: a motion, its mirror image, its energies and an independent method.

mod oracle;

use std::f64::consts::PI;

use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;
use softstop::{Below, Machine, Scene, SceneError, Simulation, Start, Stop, Trajectory};
use softstop_testing::{cases, start_between, two_sided};

use crate::snapshots::through_bytes;

/// The machine seen from the other side.
fn mirrored(scene: &Scene) -> Scene {
    let below = scene.below.clone().expect("a stop below");
    let mut mirrored = Scene {
        clearance: below.clearance,
        stop: below.stop,
        below: Some(Box::new(Below {
            clearance: scene.clearance,
            stop: scene.stop.clone(),
        })),
        ..scene.clone()
    };
    mirrored.excitation.phase += PI;
    mirrored
}

/// Crossings in which a motion is compared with its mirror image, as long as their distance is not magnified.
const COMPARED: usize = 12;

/// Largest difference of a motion from the mirror image of another one.
fn apart(one: &Trajectory, other: &Trajectory) -> f64 {
    let pairs = one.crossings().zip(other.crossings()).take(COMPARED);
    let differs = pairs.map(|(a, b)| {
        assert_eq!(a.kind, b.kind);
        let size = a.velocity.abs().max(a.velocity_after.abs()).max(1.0);
        let position = (a.position + b.position).abs();
        let before = (a.velocity + b.velocity).abs() / size;
        let after = (a.velocity_after + b.velocity_after).abs() / size;
        position.max(before).max(after)
    });
    differs.fold(0.0, f64::max)
}

proptest! {
    #![proptest_config(cases(400))]

    #[test]
    fn a_mirrored_machine_moves_as_the_mirror_image(
        scene in two_sided(),
        share in 0.02..0.98f64,
        velocity in -6.0..6.0f64,
    ) {
        let start = start_between(&scene, share, velocity);
        let image = Start::new(-start.position, -start.velocity);
        let one = scene.trajectory(start, 3).expect("a motion");
        let other = mirrored(&scene).trajectory(image, 3).expect("a motion");
        let apart = apart(&one, &other);
        prop_assert!(apart < 1e-9, "{apart:e}");
    }

    #[test]
    fn what_goes_in_goes_out_or_stays(
        scene in two_sided(),
        share in 0.02..0.98f64,
        velocity in -6.0..6.0f64,
    ) {
        let start = start_between(&scene, share, velocity);
        let motion = scene.trajectory(start, 30).expect("a motion");
        let turnover = 1.0 + motion.work().dissipated.abs();
        prop_assert!(motion.energy_defect().abs() < 1e-9 * turnover, "{:e}", motion.energy_defect());
    }

    #[test]
    fn a_restored_machine_goes_on_bit_for_bit(scene in two_sided(), velocity in -6.0..6.0f64) {
        let start = start_between(&scene, 0.5, velocity);
        let mut machine = Simulation::new(&scene, start).expect("a start");
        for step in 1..60 {
            let end = 0.31 * scene.period() * f64::from(step);
            let mut restored = through_bytes(&machine);
            machine.advance(end).expect("bounded");
            restored.advance(end).expect("bounded");
            prop_assert_eq!(machine.sample(), restored.sample());
            prop_assert_eq!(machine.energy(), restored.energy());
            prop_assert_eq!(machine.impact_count(), restored.impact_count());
            prop_assert_eq!(machine.contacts().expect("told again"), restored.contacts().expect("told again"));
        }
    }
}

#[test]
fn no_impact_is_missed_on_either_side() {
    let mut runner = TestRunner::new(cases(300));
    let (mut impacts, mut below, mut worst) = (0, 0, 0.0f64);
    for _ in 0..300 {
        let random = (two_sided(), 0.02..0.98f64, -6.0..6.0f64).new_tree(&mut runner);
        let (scene, share, velocity) = random.expect("a machine").current();
        let start = start_between(&scene, share, velocity);
        let compared = oracle::compare(&scene, start, 20);
        impacts += compared.impacts;
        below += compared.below;
        assert!(
            compared.error < 1e-8,
            "{:e} {scene:?} {start:?}",
            compared.error
        );
        worst = worst.max(compared.error);
    }
    println!("{impacts} impacts, {below} of them below, error up to {worst:.1e}");
    assert!(impacts > 3000 && below > 1000, "{impacts} {below}");
}

const TEXT: &str = r#"
mass = 2.0
stiffness = 3.0
damping = 0.1
clearance = 0.5
contact.damping = 0.4
excitation = { amplitude = 1.5, frequency = 1.1 }

[stop]
model = "kelvinVoigt"
stiffness = 40.0

[stop.below]
clearance = 0.25
model = "rigid"
restitution = 0.75
"#;

#[test]
fn a_file_states_a_stop_below() {
    let mut machine = Machine::from_toml(TEXT).expect("a machine");
    let below = Below {
        clearance: 0.25,
        stop: Stop::Rigid { restitution: 0.75 },
    };
    assert_eq!(machine.scene.below, Some(below.into()));
    assert_eq!(Machine::from_toml(&machine.to_toml()), Ok(machine.clone()));
    machine
        .apply([
            ("stop.below.model", "preloaded"),
            ("stop.below.stiffness", "2 * stop.stiffness"),
            ("stop.below.preload", "7"),
        ])
        .expect("another stop below");
    let below = machine.scene.below.clone().expect("a stop below");
    let stop = Stop::Preloaded {
        stiffness: 80.0,
        preload: 7.0,
    };
    assert_eq!((below.clearance, below.stop), (0.25, stop));
    assert_eq!(Machine::from_toml(&machine.to_toml()), Ok(machine.clone()));
    machine
        .apply([("stop.below.clearance", "0.125"), ("stop.stiffness", "50")])
        .expect("values");
    assert_eq!(machine.scene.below.expect("a stop below").clearance, 0.125);
}

#[test]
fn what_makes_no_sense_is_refused_by_name() {
    let refused = |from: &str, to: &str| {
        let error = Machine::from_toml(&TEXT.replace(from, to)).expect_err("no machine");
        error.to_string()
    };
    let overlap = refused("clearance = 0.25", "clearance = -0.5");
    assert!(overlap.contains("stop.below.clearance = -0.5"), "{overlap}");
    assert!(overlap.contains("line 14"), "{overlap}");
    let misspelt = refused("restitution =", "restituton =");
    assert!(misspelt.contains("stop.below.restitution"), "{misspelt}");
    let beyond = refused("restitution = 0.75", "restitution = 1.75");
    assert!(beyond.contains("stop.below.restitution = 1.75"), "{beyond}");
    let no_slope = refused(
        "model = \"rigid\"\nrestitution = 0.75",
        "model = \"piecewiseLinear\"\nloading = []",
    );
    assert!(no_slope.contains("of the stop below"), "{no_slope}");
    let scene = Machine::from_toml(TEXT).expect("a machine").scene;
    let past = Simulation::new(&scene, Start::new(-0.26, 0.0)).expect_err("beyond the stop");
    assert!(past.to_string().contains("-0.25"), "{past}");
    assert_eq!(
        Scene {
            clearance: -0.25,
            ..scene
        }
        .validate(),
        Err(SceneError::NoWay {
            clearance: -0.25,
            below: 0.25
        })
    );
}
