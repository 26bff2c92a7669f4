//! Bad input gives an error that names the parameter and its value; nothing panics or hangs.

use proptest::prelude::*;
use softstop::{Excitation, MotionError, Ratios, Scene, Simulation, Start, Stop, Strip};
use softstop_testing::tolerance::MOTION;
use softstop_testing::{assert_near, cases, hertz, loaded, preloaded};

fn machine() -> Scene {
    loaded()
}

#[test]
fn errors_name_parameter_and_value() {
    type Spoil = fn(&mut Scene);
    let cases: [(&str, Spoil); 9] = [
        ("mass = -1", |s| s.mass = -1.0),
        ("mass = NaN", |s| s.mass = f64::NAN),
        ("stiffness = -2", |s| s.stiffness = -2.0),
        ("damping = inf", |s| s.damping = f64::INFINITY),
        ("excitation.frequency = 0", |s| s.excitation.frequency = 0.0),
        ("clearance = NaN", |s| s.clearance = f64::NAN),
        ("contact.damping = -0.1", |s| s.contact_damping = -0.1),
        ("stop.preload = -5", |s| s.stop = preloaded(1.0, -5.0)),
        ("piercing.friction = -3", |s| {
            if let Some(strip) = &mut s.piercing {
                strip.friction = -3.0;
            }
        }),
    ];
    for (expected, spoil) in cases {
        let mut scene = machine();
        spoil(&mut scene);
        let message = scene.validate().expect_err(expected).to_string();
        assert!(
            message.starts_with(expected) && message.contains("must be"),
            "{message}"
        );
    }
}

#[test]
fn time_does_not_run_backwards() {
    let mut machine = Simulation::new(&machine(), Start::new(0.0, 0.0)).expect("valid");
    machine.advance(3.0).expect("bounded");
    for until in [2.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let error = machine.advance(until).expect_err("refused");
        assert!(matches!(error, MotionError::TimeBackwards { .. }));
        assert_eq!(machine.time(), 3.0);
    }
    machine.advance(3.0).expect("no step is no error");
    assert!(machine.set_force(&[f64::NAN, 0.0]).is_err());
    assert!(Simulation::new(machine.scene(), Start::new(f64::NAN, 0.0)).is_err());
}

#[test]
fn an_unbounded_motion_is_an_error() {
    let scene = Scene {
        stiffness: 0.0,
        ..Scene::of_stop(Stop::None)
    };
    let mut machine = Simulation::new(&scene, Start::new(1e308, 1e308)).expect("finite");
    let error = machine.advance(1e3).expect_err("beyond all numbers");
    assert!(matches!(error, MotionError::Unbounded { .. }), "{error}");
}

/// The law is of the eleventh power: the first step from so deep takes 1e-61 s, and time does not go on.
#[test]
fn a_contact_shorter_than_any_time_is_an_error() {
    let scene = Scene::of_stop(hertz(150.0, 11.0, 0.0));
    let mut machine = Simulation::new(&scene, Start::new(1e10, -0.5)).expect("finite");
    let error = machine.advance(1.0).expect_err("time stands still");
    assert!(matches!(error, MotionError::Stalled { .. }), "{error}");
}

fn any_number() -> impl Strategy<Value = f64> {
    prop_oneof![
        Just(0.0),
        Just(f64::MIN_POSITIVE),
        Just(f64::MAX),
        Just(f64::NAN),
        -10.0..10.0f64,
        (-12.0..12.0f64).prop_map(|e| 10f64.powf(e)),
    ]
}

proptest! {
    #![proptest_config(cases(2000))]

    #[test]
    fn no_scene_panics(values in proptest::array::uniform14(any_number())) {
        let [mass, stiffness, damping, amplitude, frequency, clearance, contact_damping, k, p,
            k2, k3, thickness, position, velocity] = values;
        let scene = Scene {
            mass,
            stiffness,
            damping,
            excitation: Excitation { amplitude, frequency, phase: 0.0 },
            clearance,
            contact_damping,
            rigid: None,
            below: None,
            stop: Stop::Preloaded { stiffness: k, preload: p },
            piercing: Some(Strip { stiffness: k2, friction: k3, thickness, travel: 0.1 }),
            followers: softstop::Ties::NONE,
        };
        if let Ok(mut motion) = scene.motion(Start::new(position, velocity)) {
            // Some ten turns of the fastest mode, however fast that is.
            let turn = motion
                .phases()
                .phases
                .iter()
                .map(|phase| (mass / phase.law.stiffness.abs()).sqrt())
                .fold(scene.period(), f64::min);
            let small = motion.clock().after(motion.now(), 10.0 * turn);
            let _ = motion.advance(small, &mut ());
        }
    }
}

/// A machine in which nothing moves, or everything balances exactly, ends its run all the same.
#[test]
fn exact_balance_does_not_hang() {
    let levels = [0.0, 1.0, 3.8];
    for (&clearance, &amplitude) in levels
        .iter()
        .zip(&levels)
        .chain([(&0.0, &1.0), (&3.8, &0.0)])
    {
        for loaded in [false, true] {
            for (preload, stiffness, suspension) in [
                (0.0, 7.4, 1.1),
                (70.0, 7.0, 1.0),
                (0.0, 0.0, 0.0),
                (5.0, 7.0, 0.0),
            ] {
                let base = if loaded {
                    Ratios::loaded()
                } else {
                    Ratios::unloaded()
                };
                let mut scene = Ratios { clearance, ..base }.scene().expect("valid");
                scene.mass = 0.7;
                scene.stiffness = suspension;
                scene.excitation.amplitude = amplitude;
                scene.stop = Stop::Preloaded { stiffness, preload };
                let start = Start::new(clearance, 0.0);
                let mut machine = Simulation::new(&scene, start).expect("valid");
                machine
                    .set_force(&[suspension * clearance, 0.0])
                    .expect("finite");
                machine.advance(5.0 * scene.period()).expect("gets on");
                assert!(machine.sample().position.is_finite());
                assert!(machine.energy().dissipated.is_finite());
            }
        }
    }
}

/// What is fed is latched at the clearance: taking the strip away while it is pierced changes
/// nothing before the next stroke, whatever else is set.
#[test]
fn the_strip_stays_until_the_stroke_is_over() {
    let scene = machine();
    let start = Start::new(9.0, 9.0);
    let mut with = Simulation::new(&scene, start).expect("valid");
    let mut without = with.clone();
    let mut time = 0.0;
    while with.sample().phase != softstop::PhaseKind::Pierce {
        time += 0.01;
        with.advance(time).expect("bounded");
        without.advance(time).expect("bounded");
    }
    without.feed_strip(false);
    without.set_force(&[1e-300, 0.0]).expect("finite");
    while with.sample().phase != softstop::PhaseKind::Free {
        time += 0.01;
        with.advance(time).expect("bounded");
        without.advance(time).expect("bounded");
        let (a, b) = (with.sample(), without.sample());
        assert_eq!(a.phase, b.phase);
        assert_near(a.position, b.position, MOTION);
    }
    with.advance(time + scene.period()).expect("bounded");
    without.advance(time + scene.period()).expect("bounded");
    assert_eq!((with.pierce_count(), without.pierce_count()), (2, 1));
}
