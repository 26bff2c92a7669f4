//! Motions and bifurcations proven, and what is not.

use std::cell::Cell;
use std::ops::ControlFlow;

use proptest::test_runner::TestRunner;
use softstop::nalgebra::Vector2;
use softstop::{Parameter, Ratios, Scene, Start, Stop};
use softstop_dynamics::continuation::{SpecialKind, TestFunction};
use softstop_dynamics::{BranchLimits, Continuation, Orbit, ParameterFamily, orbit};
use softstop_prove::arcs::Enclosed;
use softstop_prove::motion::Motion;
use softstop_prove::{Certificate, Claim, Interval, ProofError, Touch};
use softstop_testing::machines::machines;
use softstop_testing::random::cases;

fn point(ratios: Ratios) -> (Scene, Orbit) {
    let scene = ratios.scene().expect("a scene");
    let orbit = orbit::find(&scene).expect("an orbit");
    (scene, orbit)
}

fn holds(interval: Interval, value: f64) -> bool {
    interval.contains(value) && interval.width() < 1e-8 * (1.0 + value.abs())
}

/// From another program with intervals of more digits.
#[test]
fn point_a_has_the_known_figures() {
    let (scene, orbit) = point(Ratios::unloaded());
    let proof = Certificate::new(&scene, orbit.state(), 1, Claim::Orbit).expect("a proof");
    let velocity = proof.enclosure[2];
    assert!(velocity.low() <= 6.494627429363037 && 6.494_627_429_363_038 <= velocity.high());
    assert!(velocity.width() < 1e-12, "{velocity:?}");
    assert!((proof.trace.middle() - 1.1998473947).abs() < 1e-10);
    assert!((proof.determinant.middle() - 0.7858235026).abs() < 1e-10);
    assert_eq!(
        (proof.stability, proof.impacts, proof.events.len()),
        ("stable", 1, 2)
    );
}

#[test]
fn point_b_agrees_with_its_orbit() {
    let (scene, orbit) = point(Ratios::loaded());
    let proof = Certificate::new(&scene, orbit.state(), 1, Claim::Orbit).expect("a proof");
    assert!(holds(proof.enclosure[2], orbit.before_impact_velocity()));
    assert!(holds(proof.trace, orbit.monodromy.trace()));
    assert!(holds(proof.determinant, orbit.monodromy.determinant()));
    assert_eq!(
        (proof.stability, proof.impacts, proof.events.len()),
        ("stable", 1, 6)
    );
}

/// The special points of the z = 1 branches, located by another method.
#[test]
fn bifurcations_are_where_continuation_finds_them() {
    let mut proven = Vec::new();
    for ratios in [Ratios::unloaded(), Ratios::loaded()] {
        let (scene, orbit) = point(ratios);
        let family = ParameterFamily::new(scene.clone(), [Parameter::Frequency]).expect("a family");
        let limits = BranchLimits {
            range: (0.9, 1.7),
            points: 2000,
        };
        let follower = Continuation::new(&family, 1);
        let branch = follower.branch(1.15, orbit.state(), &limits, |_| ControlFlow::Continue(()));
        for special in branch.expect("a branch").specials {
            let claim = match special.kind {
                SpecialKind::Critical(TestFunction::Fold) => Claim::Fold,
                SpecialKind::Critical(TestFunction::Flip) => Claim::Flip,
                SpecialKind::Grazing(graze) => Claim::Grazing(Touch {
                    angle: graze.angle,
                    position: graze.surface.surface_position(&scene).expect("a face"),
                }),
                SpecialKind::Critical(TestFunction::NeimarkSacker) | SpecialKind::Pitchfork => {
                    continue;
                }
            };
            let at = special.point.parameter;
            let near = scene.at_frequency(at);
            let Ok(proof) = Certificate::new(&near, special.point.state(), 1, claim) else {
                // With dry friction the mass turns on the very surface that it grazes.
                assert!(
                    matches!(claim, Claim::Grazing(_)) && scene.piercing.is_some(),
                    "{special:?}"
                );
                continue;
            };
            assert!(
                (proof.frequency.middle() - at).abs() < 1e-9 && proof.frequency.width() < 1e-12
            );
            let (trace, determinant) = (proof.trace, proof.determinant);
            let test = |sign: f64| {
                (Interval::ONE + determinant - trace * Interval::point(sign)).contains(0.0)
            };
            assert!(test(1.0) == (claim == Claim::Fold) && test(-1.0) == (claim == Claim::Flip));
            proven.push(proof.claim);
        }
    }
    let expected = ["grazing", "flip", "fold", "grazing", "flip", "fold"];
    assert_eq!(proven, expected);
}

/// Motions on which random machines settle, of every law: proven if they are z = p/n with linear laws and no rest. The mass may
/// not start from rest under dry friction, as it does after a blow without restitution.
#[test]
fn random_machines_are_proven() {
    let (proven, with_impacts) = (Cell::new(0), Cell::new(0));
    let case = |scene: &Scene, start: Start| {
        let settled = scene.trajectory(start, 400).ok()?.end;
        let state = Vector2::new(settled.position, settled.velocity);
        let orbit = Orbit::find_periodic(scene, state, 4).ok()?;
        let is_settled =
            orbit.monodromy.multipliers()[0].norm() < 0.99 && (orbit.state() - state).norm() < 1e-6;
        if !orbit.rests.is_empty() || !is_settled {
            return None;
        }
        match Certificate::new(scene, orbit.state(), orbit.periods, Claim::Orbit) {
            Ok(proof) => {
                assert_eq!(
                    (proof.stability, proof.impacts),
                    ("stable", orbit.impacts.len())
                );
                assert!((proof.trace.middle() - orbit.monodromy.trace()).abs() < 1e-9);
                proven.set(proven.get() + 1);
                with_impacts.set(with_impacts.get() + usize::from(proof.impacts > 0));
            }
            Err(ProofError::Unsupported(_)) => {}
            Err(error) => {
                let stops_dead = scene.wall().is_some_and(|wall| wall.restitution == 0.0);
                assert!(stops_dead && scene.piercing.is_some(), "{error}: {scene:?}");
            }
        }
        Some(())
    };
    let mut runner = TestRunner::new(cases(300));
    let done = runner.run(&machines(), |scene| {
        case(&scene, Start::REST);
        case(&scene, Start::new(0.0, 15.0));
        Ok(())
    });
    assert_eq!(done, Ok(()));
    let counted = (proven.get(), with_impacts.get());
    assert!(counted.0 > 300 && counted.1 > 100, "{counted:?}");
}

#[test]
fn what_is_not_treated_is_named() {
    let hertz = Scene::of_stop(Stop::Hertz {
        stiffness: 10.0,
        exponent: 1.5,
        dissipation: 0.0,
    });
    let refused = Certificate::new(&hertz, Vector2::zeros(), 1, Claim::Orbit);
    let refused = refused.expect_err("a power law").to_string();
    assert!(refused.contains("hertz"), "{refused}");
    let free = Scene::of_stop(Stop::None);
    assert!(Certificate::new(&free, Vector2::zeros(), 1, Claim::Orbit).is_err());
}

/// A motion without impacts repeats after one drive period.
#[test]
fn a_shorter_period_is_refused() {
    let scene = Ratios::unloaded().scene().expect("a scene");
    let scene = scene.at_frequency(1.05);
    let orbit = Orbit::find_periodic(&scene, Vector2::new(-8.35, 3.59), 1).expect("an orbit");
    let proof = |periods| Certificate::new(&scene, orbit.state(), periods, Claim::Orbit);
    let proven = proof(1).expect("a proof");
    assert_eq!((proven.impacts, proven.stability), (0, "stable"));
    assert_eq!(proof(2).err(), Some(ProofError::ShorterPeriod));
}

/// The motion z = 0 of point A's machine grazes its stop; a guard that weighs the velocity, too, is crossed there.
#[test]
fn a_graze_of_a_guard_of_the_velocity_is_refused() {
    let frequency = 1.044_440_043_9_f64;
    let scene = Ratios::unloaded().scene().expect("a scene");
    let scene = scene.at_frequency(frequency);
    let lag = (0.04 * frequency).atan2(1.0 - frequency * frequency);
    let state = Vector2::new(10.0 * lag.cos(), 10.0 * frequency * lag.sin());
    let touch = Touch {
        angle: lag,
        position: 10.0,
    };
    let proof = Certificate::new(&scene, state, 1, Claim::Grazing(touch)).expect("a proof");
    let divisions = |velocity: f64| {
        let mut machine = proof.laws.clone();
        machine.phases[0].guards[0].velocity = velocity;
        let motion = Motion {
            machine,
            periods: 1,
            events: proof.events.iter().map(|it| it.event).collect(),
        };
        let enclosed = Enclosed {
            motion: &motion,
            unknowns: &proof.enclosure[..3],
            frequency: proof.frequency,
        };
        enclosed.divisions()
    };
    assert_eq!(divisions(0.0), Ok(vec![proof.events[0].division.clone()]));
    assert_eq!(divisions(0.1), Err(ProofError::NotClear { arc: 0 }));
}

/// A state that leads to no periodic motion near.
#[test]
fn what_is_not_there_is_not_proven() {
    let (scene, _) = point(Ratios::unloaded());
    let proof = Certificate::new(&scene, Vector2::new(0.0, 25.0), 3, Claim::Orbit);
    assert!(proof.is_err(), "{proof:?}");
}
