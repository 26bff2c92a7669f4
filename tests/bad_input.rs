//! Bad input gives an error that names the parameter and its value; nothing panics or hangs.

use proptest::prelude::*;
use softstop::{Excitation, MotionError, Piercing, Ratios, Scene, Simulation, Start, Stop};

fn machine() -> Scene {
    Ratios::loaded().scene().expect("valid")
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
        ("contact_damping = -0.1", |s| s.contact_damping = -0.1),
        ("stop.preload = -5", |s| {
            s.stop = Stop::Preloaded {
                stiffness: 1.0,
                preload: -5.0,
            }
        }),
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
    let mut machine = Simulation::new(
        &machine(),
        Start {
            position: 0.0,
            velocity: 0.0,
        },
    )
    .expect("valid");
    machine.advance(3.0).expect("bounded");
    for until in [2.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let error = machine.advance(until).expect_err("refused");
        assert!(matches!(error, MotionError::TimeBackwards { .. }));
        assert_eq!(machine.time(), 3.0);
    }
    machine.advance(3.0).expect("no step is no error");
    assert!(machine.set_force(f64::NAN, 0.0).is_err());
    assert!(
        Simulation::new(
            machine.scene(),
            Start {
                position: f64::NAN,
                velocity: 0.0
            }
        )
        .is_err()
    );
}

#[test]
fn an_unbounded_motion_is_an_error() {
    // Friction stiffer than the strip: phase I pushes back with growing force when nothing stops it.
    let scene = Scene {
        mass: 1.0,
        stiffness: 0.0,
        damping: 0.0,
        excitation: Excitation {
            amplitude: 1.0,
            frequency: 1.0,
            phase: 0.0,
        },
        clearance: 0.0,
        contact_damping: 0.0,
        stop: Stop::None,
        piercing: None,
    };
    let mut machine = Simulation::new(
        &scene,
        Start {
            position: 1e308,
            velocity: 1e308,
        },
    )
    .expect("finite");
    let error = machine.advance(1e3).expect_err("beyond all numbers");
    assert!(matches!(error, MotionError::Unbounded { .. }), "{error}");
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
    #![proptest_config(ProptestConfig::with_cases(2000))]

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
            stop: Stop::Preloaded { stiffness: k, preload: p },
            piercing: Some(Piercing { stiffness: k2, friction: k3, thickness, travel: 0.1 }),
        };
        if let Ok(mut motion) = scene.motion(Start { position, velocity }) {
            let small = motion.clock().after(motion.now(), 1e-3 * scene.period());
            let _ = motion.advance(small, &mut ());
        }
    }
}
