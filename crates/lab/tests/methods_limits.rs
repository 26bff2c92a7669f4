//! What the classical methods are known to do and to fail at: limits of stability, gain and loss of
//! energy, contacts that they step over, and tasks that they refuse.

use softstop::scene::Release;
use softstop::{Excitation, Ratios, Scene, Start, Stop};
use softstop_lab::methods::{
    Events, Exact, FixedStep, Integrator, MethodError, Moreau, Scheme, Solution, Task,
};

/// x'' + 2 zeta x' + x = 0.
fn free(zeta: f64) -> Scene {
    let base = Ratios::unloaded().scene().expect("valid");
    Scene {
        damping: 2.0 * zeta,
        stop: Stop::None,
        excitation: Excitation {
            amplitude: 0.0,
            ..base.excitation
        },
        ..base
    }
}

/// A number of steps of a length from (1, 0).
fn steps(scene: &Scene, scheme: Scheme, step: f64, count: u32) -> Result<Solution, MethodError> {
    let method = FixedStep {
        scheme,
        step,
        events: Events::Ignored,
    };
    method.integrate(&Task {
        scene: scene.clone(),
        start: Start {
            position: 1.0,
            velocity: 0.0,
        },
        periods: f64::from(count) * step / scene.period(),
        most_steps: u64::from(count) + 1,
    })
}

fn energy(found: &Solution) -> f64 {
    0.5 * (found.end.0.powi(2) + found.end.1.powi(2))
}

fn grows(scene: &Scene, scheme: Scheme, step: f64) -> bool {
    match steps(scene, scheme, step, 200_000) {
        Ok(found) => energy(&found) > 1e4,
        Err(MethodError::BlownUp { .. }) => true,
        Err(other) => panic!("{other}"),
    }
}

/// The step at which a free motion begins to grow, by running, lies where theory has it.
#[test]
fn measured_limits_are_those_of_theory() {
    let linear_acceleration = Scheme::Newmark {
        beta: 1.0 / 6.0,
        gamma: 0.5,
    };
    for scheme in Scheme::ALL.into_iter().chain([linear_acceleration]) {
        for zeta in [0.0, 0.05, 0.4] {
            let scene = free(zeta);
            match scheme.stability_limit(zeta) {
                Some(0.0) => assert!(grows(&scene, scheme, 0.02), "{scheme:?} {zeta}"),
                Some(limit) => {
                    assert!(!grows(&scene, scheme, 0.99 * limit), "{scheme:?} {zeta}");
                    assert!(grows(&scene, scheme, 1.01 * limit), "{scheme:?} {zeta}");
                }
                None => assert!(!grows(&scene, scheme, 1e3), "{scheme:?} {zeta}"),
            }
        }
    }
}

/// Pressed onto a damped stop by a force that hardly changes, a mass comes to rest. Its frequency is that of the
/// stop; a step beyond the limit that belongs to it keeps it from resting.
#[test]
fn a_stiff_stop_sets_the_limit() {
    let base = Ratios::unloaded().scene().expect("valid");
    let scene = Scene {
        clearance: 0.0,
        contact_damping: 20.0,
        stop: Stop::KelvinVoigt {
            stiffness: 1e6,
            release: Release::Clearance,
        },
        excitation: Excitation {
            frequency: 1e-3,
            ..base.excitation
        },
        ..base
    };
    let rate = (1e6 + scene.stiffness).sqrt();
    let zeta = scene.contact_damping / (2.0 * rate);
    for scheme in [Scheme::SemiImplicitEuler, Scheme::RungeKutta4] {
        let limit = scheme.stability_limit(zeta).expect("a limit") / rate;
        let end = |share: f64| {
            let step = share * limit;
            let method = FixedStep {
                scheme,
                step,
                events: Events::Ignored,
            };
            let task = Task {
                periods: 10_000.0 * step / scene.period(),
                scene: scene.clone(),
                start: Start {
                    position: 1.001e-6,
                    velocity: 0.0,
                },
                most_steps: 100_000,
            };
            method.integrate(&task).expect("bounded")
        };
        let below = end(0.99);
        assert!((below.end.0 - 1e-6).abs() < 1e-9 && below.impacts.is_empty());
        assert!((end(1.01).end.0 - 1e-6).abs() > 1e-7);
    }
}

#[test]
fn energies_of_the_free_oscillator() {
    let scene = free(0.0);
    let run = |scheme, step: f64, count| energy(&steps(&scene, scheme, step, count).expect("ok"));
    // Explicit Euler multiplies the energy by 1 + h^2 in every step.
    let gained = run(Scheme::ExplicitEuler, 0.01, 10_000);
    let expected = 0.5 * (1.0f64 + 1e-4).powi(10_000);
    assert!((gained / expected - 1.0).abs() < 1e-10, "{gained}");
    // The semi-implicit one keeps x^2 + v^2 - h x v.
    for count in [10_001, 50_000, 99_999] {
        let kept = run(Scheme::SemiImplicitEuler, 0.2, count);
        assert!((kept - 0.5).abs() < 0.06, "{kept}");
    }
    // Implicit midpoint and average acceleration keep quadratic energies at any step.
    for scheme in [
        Scheme::ImplicitMidpoint,
        Scheme::NEWMARK,
        Scheme::GeneralisedAlpha { rho_inf: 1.0 },
    ] {
        for step in [0.1, 1.0, 30.0] {
            let kept = run(scheme, step, 10_000);
            assert!((kept - 0.5).abs() < 1e-10, "{scheme:?} {step}: {kept}");
        }
    }
    // Generalised-alpha with numerical damping, and RK4 below its limit, lose some.
    for scheme in [
        Scheme::GeneralisedAlpha { rho_inf: 0.5 },
        Scheme::RungeKutta4,
    ] {
        let left = run(scheme, 0.5, 10_000);
        assert!(left < 0.25, "{scheme:?}: {left}");
    }
}

/// The paper's machine from rest with a velocity at which it just reaches the stop within the first period.
fn grazing() -> Task {
    let task = |velocity| Task {
        scene: Ratios::unloaded().scene().expect("valid"),
        start: Start {
            position: 0.0,
            velocity,
        },
        periods: 0.5,
        most_steps: 1_000_000,
    };
    let strikes = |velocity| {
        !Exact
            .integrate(&task(velocity))
            .expect("exact")
            .impacts
            .is_empty()
    };
    let (mut misses, mut hits) = (5.0, 14.0);
    assert!(!strikes(misses) && strikes(hits));
    while hits - misses > 1e-9 {
        let middle = 0.5 * (misses + hits);
        if strikes(middle) {
            hits = middle;
        } else {
            misses = middle;
        }
    }
    task(hits + 1e-6)
}

/// Two crossings within one step cancel: every method of fixed steps misses a graze that is shorter than its
/// step, events located or not; and sees it with steps that are short enough. The exact one needs none.
#[test]
fn a_graze_is_stepped_over() {
    let task = grazing();
    assert_eq!(Exact.integrate(&task).expect("exact").impacts.len(), 1);
    // The errors of first-order schemes decide for themselves whether these reach the stop.
    let accurate = |method: &FixedStep| method.scheme.order() > 1;
    for method in FixedStep::all(0.01).into_iter().filter(accurate) {
        let found = method.integrate(&task).expect("bounded");
        assert!(found.impacts.is_empty(), "{}", method.name());
    }
    let fine = FixedStep {
        scheme: Scheme::RungeKutta4,
        step: 1e-4,
        events: Events::Located,
    };
    assert_eq!(fine.integrate(&task).expect("bounded").impacts.len(), 1);
}

/// Bounces that come to rest on a stop that the mass is pressed onto: located steps of second order and higher
/// follow them down to the rounding of a position, those of Moreau come to rest after the few that they see, all
/// others bounce on the grid for ever or stick too early. (Explicit Euler's shortest flights are straight,
/// semi-implicit Euler's come back without speed.)
#[test]
fn chatter_is_counted_by_location_only() {
    let base = Ratios::unloaded().scene().expect("valid");
    let scene = Scene {
        clearance: -0.5,
        stop: Stop::Rigid { restitution: 0.6 },
        excitation: Excitation {
            amplitude: 0.2,
            ..base.excitation
        },
        ..base
    };
    let task = Task {
        scene,
        start: Start {
            position: -0.6,
            velocity: 1.0,
        },
        periods: 3.0,
        most_steps: 1_000_000,
    };
    let exact = Exact.integrate(&task).expect("exact");
    assert_eq!(exact.end, (-0.5, 0.0));
    for method in FixedStep::all(1e-3) {
        let found = method.integrate(&task).expect("bounded");
        let apart = found.impacts.len().abs_diff(exact.impacts.len());
        let agrees = apart <= 3 && found.end == exact.end;
        let sees = method.events == Events::Located && method.scheme.order() > 1;
        assert_eq!(agrees, sees, "{}: {apart}", method.name());
    }
    let moreau = Moreau {
        step: 1e-3,
        theta: 0.5,
    };
    let found = moreau.integrate(&task).expect("bounded");
    assert!((found.end.0 + 0.5).abs() < 1e-3 && found.end.1.abs() < 1e-9);
    assert!((3..exact.impacts.len()).contains(&found.impacts.len()));
}

/// On a preloaded face, pressed with less than the preload, bounces shrink by viscous damping alone: their number
/// has no end, but that of steps has.
#[test]
fn bounces_without_end_are_stuck() {
    let base = Ratios::unloaded().scene().expect("valid");
    let task = Task {
        scene: Scene {
            clearance: -2.0,
            ..base
        },
        start: Start {
            position: -2.000_001,
            velocity: 0.0,
        },
        periods: 20.0,
        most_steps: 20_000,
    };
    Exact.integrate(&task).expect("exact");
    for method in FixedStep::all(1e-2) {
        let found = method.integrate(&task);
        println!(
            "{} {:?}",
            method.name(),
            found.map(|f| (f.impacts.len(), f.end, f.work))
        );
    }
}

fn refusal(method: &dyn Integrator, change: impl Fn(&mut Task)) -> String {
    let mut task = Task {
        scene: Ratios::unloaded().scene().expect("valid"),
        start: Start {
            position: 0.0,
            velocity: 14.0,
        },
        periods: 1.0,
        most_steps: 10_000,
    };
    change(&mut task);
    method.integrate(&task).expect_err("refused").to_string()
}

#[test]
fn what_makes_no_sense_is_named() {
    for events in Events::ALL {
        let rk4 = |step| FixedStep {
            scheme: Scheme::RungeKutta4,
            step,
            events,
        };
        for step in [0.0, -0.1, f64::NAN, f64::INFINITY] {
            let text = refusal(&rk4(step), |_| ());
            assert_eq!(text, format!("step = {step}: must be finite and > 0"));
        }
        let text = refusal(&rk4(1e-9), |_| ());
        assert!(
            text.contains("5463639398 steps are needed, 10000 are allowed"),
            "{text}"
        );
        let text = refusal(&rk4(0.01), |task| task.periods = -1.0);
        assert!(text.starts_with("until = -5.46"), "{text}");
        let text = refusal(&rk4(0.01), |task| task.start.velocity = f64::NAN);
        assert_eq!(text, "velocity = NaN: must be finite");
        let text = refusal(&rk4(0.01), |task| task.scene.mass = 0.0);
        assert_eq!(text, "mass = 0: must be finite and > 0");
        let text = refusal(&rk4(0.01), |task| {
            task.scene.stop = Stop::Rigid { restitution: 0.5 };
            task.start.position = 11.0;
        });
        assert!(text.contains("must be <= 10 m"), "{text}");
        let (beta, rho_inf) = (0.25, 1.5);
        for (scheme, name) in [
            (Scheme::Newmark { beta, gamma: -0.5 }, "gamma = -0.5"),
            (Scheme::GeneralisedAlpha { rho_inf }, "rhoInf = 1.5"),
        ] {
            let method = FixedStep {
                scheme,
                step: 0.01,
                events,
            };
            let text = refusal(&method, |_| ());
            assert_eq!(text, format!("{name}: must be in [0, 1]"));
        }
    }
    let moreau = |theta| Moreau { step: 0.01, theta };
    assert_eq!(
        refusal(&moreau(2.0), |_| ()),
        "theta = 2: must be in [0, 1]"
    );
    let text = refusal(&moreau(0.5), |_| ());
    assert!(
        text.contains("cannot do this: the scene has no rigid stop"),
        "{text}"
    );
}

/// No more steps are made than are allowed, those for location included.
#[test]
fn steps_for_location_count() {
    let method = FixedStep {
        scheme: Scheme::RungeKutta4,
        step: 0.01,
        events: Events::Located,
    };
    let text = refusal(&method, |task| task.most_steps = 547);
    assert!(
        text.contains("after 547 steps: more steps are needed than are allowed"),
        "{text}"
    );
}

/// The end is that of the task, whatever the step.
#[test]
fn the_last_step_ends_with_the_task() {
    let scene = free(0.0);
    for share in [0.9, 1.0, 1.1, 7.3, 1000.0] {
        let duration = 0.37 * scene.period();
        let method = FixedStep {
            scheme: Scheme::RungeKutta4,
            step: share * duration / 50.0,
            events: Events::Located,
        };
        let found = method
            .integrate(&Task {
                scene: scene.clone(),
                start: Start {
                    position: 1.0,
                    velocity: 0.0,
                },
                periods: 0.37,
                most_steps: 1000,
            })
            .expect("bounded");
        let count = (50.0 / share).ceil();
        assert_eq!(found.work.steps as f64, count);
        assert_eq!(found.work.evaluations as f64, 4.0 * count);
        let tolerance = (duration / count).powi(5) * count;
        assert!((found.end.0 - duration.cos()).abs() < tolerance, "{share}");
    }
}
