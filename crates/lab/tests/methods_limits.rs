//! What the classical methods are known to do and to fail at: limits of stability, gain and loss of
//! energy, contacts that they step over, and tasks that they refuse.

mod contacts;
mod stability;

use softstop::{Excitation, Ratios, Scene, Start, Stop};
use softstop_lab::methods::{
    Events, Exact, FixedStep, Integrator, MethodError, Moreau, Scheme, Solution, Task,
};
use softstop_testing::is_near;

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
    let method = FixedStep::new(scheme, step, Events::Ignored);
    method.integrate(&Task {
        scene: scene.clone(),
        start: Start::new(1.0, 0.0),
        periods: f64::from(count) * step / scene.period(),
        most_steps: u64::from(count) + 1,
    })
}

fn refusal(method: &dyn Integrator, change: impl Fn(&mut Task)) -> String {
    let mut task = Task::new(
        Ratios::unloaded().scene().expect("valid"),
        Start::new(0.0, 14.0),
        1.0,
        10_000,
    );
    change(&mut task);
    method.integrate(&task).expect_err("refused").to_string()
}

#[test]
fn what_makes_no_sense_is_named() {
    for events in Events::ALL {
        let rk4 = |step| FixedStep::new(Scheme::RungeKutta4, step, events);
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
        assert_eq!(text, "mass = 0: must be finite and > 0, at most 1e24");
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
            let method = FixedStep::new(scheme, 0.01, events);
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
    let method = FixedStep::new(Scheme::RungeKutta4, 0.01, Events::Located);
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
        let method = FixedStep::new(
            Scheme::RungeKutta4,
            share * duration / 50.0,
            Events::Located,
        );
        let found = method
            .integrate(&Task::new(scene.clone(), Start::new(1.0, 0.0), 0.37, 1000))
            .expect("bounded");
        let count = (50.0 / share).ceil();
        assert_eq!(found.work.steps as f64, count);
        assert_eq!(found.work.evaluations as f64, 4.0 * count);
        let tolerance = (duration / count).powi(5) * count;
        assert!(is_near(found.end.0, duration.cos(), tolerance), "{share}");
    }
}
