//! The order of every classical method: on smooth motion, and through a contact with events ignored and
//! located; and its agreement with the exact method on random machines.
//!
//! The table of docs/methods.md is printed by
//! `cargo test --release -p softstop-lab --test lab methods::orders -- --nocapture`.

use proptest::prelude::*;
use softstop::{Crossing, CrossingKind, Observer, Ratios, Release, Scene, Start, Stop};
use softstop_lab::methods::{
    Events, Exact, FixedStep, Integrator, MethodError, Moreau, Scheme, Solution, Task,
};
use softstop_testing::{cases, hertz, is_near, kelvin_voigt, machines, preloaded, start_below};

/// Starts whose errors are averaged: they differ in where in a step the impact falls.
const STARTS: u32 = 64;
/// Half a drive period: one impact, and the way back from it.
const PERIODS: f64 = 0.5;
/// The coarsest division of it.
const COARSEST: f64 = 400.0;
/// Halvings of the step.
const LEVELS: i32 = 4;

fn task(scene: &Scene, velocity: f64) -> Task {
    Task::new(scene.clone(), Start::new(0.0, velocity), PERIODS, 1_000_000)
}

fn error(found: &Solution, exact: &Solution) -> f64 {
    (found.end.0 - exact.end.0).hypot(found.end.1 - exact.end.1)
}

/// The slope of log(root mean square of the errors over all starts) over log(step).
fn observed_order<M: Integrator>(scene: &Scene, method: &impl Fn(f64) -> M) -> f64 {
    let tasks: Vec<Task> = (0..STARTS)
        .map(|start| task(scene, 13.0 + 0.0317 * f64::from(start)))
        .collect();
    let exact: Vec<Solution> = tasks
        .iter()
        .map(|task| Exact.integrate(task).expect("exact"))
        .collect();
    let points: Vec<(f64, f64)> = (0..LEVELS)
        .map(|level| {
            let step = PERIODS * scene.period() / (COARSEST * f64::from(1 << level));
            let method = method(step);
            let square = |(task, exact): (&Task, &Solution)| {
                let found = method.integrate(task).expect("bounded");
                assert_eq!(
                    found.impacts.len(),
                    exact.impacts.len(),
                    "{}",
                    method.name()
                );
                error(&found, exact).powi(2)
            };
            let sum: f64 = tasks.iter().zip(&exact).map(square).sum();
            (step.ln(), 0.5 * (sum / f64::from(STARTS)).ln())
        })
        .collect();
    slope(&points)
}

fn slope(points: &[(f64, f64)]) -> f64 {
    let count = points.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / count;
    let (x, y) = (mean(|point| point.0), mean(|point| point.1));
    let shared: f64 = points
        .iter()
        .map(|point| (point.0 - x) * (point.1 - y))
        .sum();
    shared
        / points
            .iter()
            .map(|point| (point.0 - x).powi(2))
            .sum::<f64>()
}

/// Compares the orders that a contact leaves with the least of the scheme's own and that of the contact, for
/// events ignored and located.
fn assert_orders(name: &str, stop: Stop, contact_damping: f64, left: (f64, f64)) {
    let base = Ratios::unloaded().scene().expect("valid");
    let scene = Scene {
        stop,
        contact_damping,
        ..base
    };
    for scheme in Scheme::ALL {
        for (events, most) in [(Events::Ignored, left.0), (Events::Located, left.1)] {
            let method = |step| FixedStep::new(scheme, step, events);
            let expected = f64::from(scheme.order()).min(most);
            let observed = observed_order(&scene, &method);
            let (title, events) = (scheme.name(), events.name());
            println!("{name:22} {title:20} {events:15} {observed:.2} (theory {expected})");
            assert!(
                is_near(observed, expected, 0.1),
                "{name}, {title}, {events}"
            );
        }
    }
}

#[test]
fn orders_through_contacts() {
    const SMOOTH: f64 = f64::INFINITY;
    // The suspension's damping, which continues in contact.
    const SAME: f64 = 0.04;
    let sprung = kelvin_voigt(50.0, Release::Clearance);
    let rigid = Stop::Rigid { restitution: 0.7 };
    let sphere = hertz(50.0, 1.5, 0.0);
    for (name, stop, damping, left) in [
        ("no stop", Stop::None, SAME, (SMOOTH, SMOOTH)),
        // The mass is put back from where it was at the end of the step.
        ("rigid", rigid, SAME, (1.0, SMOOTH)),
        // A jump of the force within a step takes O(h) from the velocity.
        ("preloaded", preloaded(7.0, 70.0), SAME, (1.0, SMOOTH)),
        // The damper's force jumps at touch.
        ("Kelvin-Voigt, damped", sprung.clone(), 0.4, (1.0, SMOOTH)),
        // A kink of the force within a step takes O(h^2).
        ("Kelvin-Voigt, undamped", sprung, SAME, (2.0, SMOOTH)),
        // A power law of exponent n is not smooth at its face: wherever steps end, one next to it errs by h^(n + 1).
        ("Hertz, n = 3/2", sphere, SAME, (2.5, 2.5)),
    ] {
        assert_orders(name, stop, damping, left);
    }
}

#[test]
fn orders_of_moreau() {
    let scene = |clearance| Scene {
        stop: Stop::Rigid { restitution: 0.7 },
        clearance,
        ..Ratios::unloaded().scene().expect("valid")
    };
    for (name, clearance, theta, expected) in [
        ("rigid, not reached", 100.0, 0.5, 2.0),
        ("rigid, not reached", 100.0, 0.75, 1.0),
        ("rigid", 10.0, 0.5, 1.0),
    ] {
        let observed = observed_order(&scene(clearance), &|step| Moreau { step, theta });
        println!("{name:22} Moreau, theta = {theta:4} {observed:22.2} (theory {expected})");
        assert!(is_near(observed, expected, 0.1), "{name} {theta}");
    }
}

/// Whether a motion comes near the limits of what steps of fixed length can see.
#[derive(Default)]
struct Delicate(bool);

impl Observer for Delicate {
    fn crossing(&mut self, crossing: &Crossing) {
        let slow = crossing.velocity.abs() < 0.3;
        let surface = matches!(
            crossing.kind,
            CrossingKind::Surface { .. } | CrossingKind::Rebound { .. }
        );
        let rest = crossing.kind == CrossingKind::Rest;
        self.0 |= rest || surface && slow;
    }
}

fn is_delicate(task: &Task) -> bool {
    let mut watch = Delicate::default();
    let mut motion = task.scene.motion(task.start).expect("valid");
    let until = motion.clock().instant(task.duration());
    motion.advance(until, &mut watch).expect("bounded");
    watch.0
}

proptest! {
    #![proptest_config(cases(150))]

    #[test]
    fn located_methods_agree_with_the_exact_one(
        scene in machines(),
        depth in 0.5..6.0f64,
        velocity in -6.0..6.0f64,
    ) {
        let start = start_below(&scene, depth, velocity);
        let task = Task::new(scene, start, 1.5, 1_000_000);
        prop_assume!(!is_delicate(&task));
        let exact = Exact.integrate(&task).expect("exact");
        for scheme in Scheme::ALL {
            let (division, tolerance) = match scheme.order() {
                1 => (20_000.0, 0.3),
                2 => (2_000.0, 1e-2),
                _ => (2_000.0, 1e-5),
            };
            let step = task.scene.period() / division;
            let method = FixedStep::new(scheme, step, Events::Located);
            let found = method.integrate(&task).expect("bounded");
            prop_assert_eq!(found.impacts.len(), exact.impacts.len(), "{:?}", scheme);
            prop_assert!(error(&found, &exact) < tolerance, "{:?}", scheme);
        }
    }
}

proptest! {
    #![proptest_config(cases(300))]

    /// Grazes, friction, chatter and rest included: an end, or a reason why not.
    #[test]
    fn every_method_comes_to_an_end(
        scene in machines(),
        depth in 0.0..6.0f64,
        velocity in -6.0..6.0f64,
        division in 5.0..500.0f64,
    ) {
        let start = start_below(&scene, depth, velocity);
        let step = scene.period() / division;
        let task = Task::new(scene, start, 4.0, 100_000);
        for method in FixedStep::all(step) {
            match method.integrate(&task) {
                Ok(found) => {
                    prop_assert!(found.end.0.is_finite() && found.end.1.is_finite());
                    prop_assert!(found.work.steps <= task.most_steps);
                    prop_assert!(found.impacts.is_sorted_by_key(|impact| impact.time));
                }
                Err(error) => {
                    let own = matches!(
                        error,
                        MethodError::BlownUp { .. } | MethodError::Stuck { .. }
                    );
                    prop_assert!(own && method.scheme != Scheme::RungeKutta4, "{}", error);
                }
            }
        }
    }
}
