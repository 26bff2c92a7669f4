//! What the failures atlas says: limits of stability in contact lie where theory has them, every failure that it
//! names really happens, and the exact method does not share them. What is true is known from closed forms.

use std::f64::consts::TAU;

use softstop::scene::{Release, Stop};
use softstop::{Excitation, Scene, Start};
use softstop_lab::methods::{
    Events, Exact, FixedStep, Integrator, Judge, MethodError, Scheme, Solution, Task, Verdict,
};

/// m = k1 = 1, no damping, no drive, w = 1; a Kelvin-Voigt stop.
fn undriven(clearance: f64, stiffness: f64) -> Scene {
    Scene {
        mass: 1.0,
        stiffness: 1.0,
        damping: 0.0,
        excitation: Excitation {
            amplitude: 0.0,
            frequency: 1.0,
            phase: 0.0,
        },
        clearance,
        contact_damping: 0.0,
        stop: Stop::KelvinVoigt {
            stiffness,
            release: Release::Clearance,
        },
        piercing: None,
        rigid: None,
    }
}

fn task(scene: Scene, position: f64, velocity: f64, duration: f64) -> Task {
    Task {
        periods: duration / scene.period(),
        scene,
        start: Start { position, velocity },
        most_steps: 10_000_000,
    }
}

fn fixed(scheme: Scheme, events: Events, step: f64) -> FixedStep {
    FixedStep {
        scheme,
        step,
        events,
    }
}

fn exact(task: &Task) -> Solution {
    Exact.integrate(task).expect("the exact method goes on")
}

/// The verdict on a method by the exact one, which the caller has checked.
fn verdict(method: &impl Integrator, task: &Task) -> Verdict {
    let truth = exact(task);
    Judge::new(task, &truth, 0.01).verdict(&method.integrate(task))
}

#[track_caller]
fn near(found: f64, expected: f64, tolerance: f64) {
    assert!(
        (found - expected).abs() <= tolerance,
        "{found} is not {expected} +- {tolerance}"
    );
}

mod stability {
    use super::*;

    /// Share of the depth at rest by which the mass starts off its rest: so little that no stage of a step leaves
    /// the stop unless the motion grows.
    const SWING: f64 = 1e-3;
    /// Share of the depth at rest that a motion reaches only if it grows.
    const GROWN: f64 = 0.2;

    /// A machine that is pressed onto its stop, with a damping of this ratio in contact; its frequency and its depth
    /// at rest.
    fn pressed(stiffness: f64, ratio: f64) -> (Scene, f64, f64) {
        let frequency = (1.0 + stiffness).sqrt();
        let scene = Scene {
            contact_damping: 2.0 * ratio * frequency,
            ..undriven(-10.0, stiffness)
        };
        (scene, frequency, 10.0 / (1.0 + stiffness))
    }

    /// Whether so many steps of w h = `z` make the motion grow.
    fn grows(scheme: Scheme, stiffness: f64, ratio: f64, z: f64, steps: u32) -> bool {
        let (scene, frequency, depth) = pressed(stiffness, ratio);
        let step = z / frequency;
        let start = scene.clearance + (1.0 - SWING) * depth;
        let task = task(scene, start, 0.0, f64::from(steps) * step);
        match fixed(scheme, Events::Ignored, step).integrate(&task) {
            Ok(found) => {
                let off = found.end.0 - (task.scene.clearance + depth);
                let size = off.hypot(found.end.1 / frequency);
                !found.impacts.is_empty() || size > GROWN * depth
            }
            Err(MethodError::BlownUp { .. }) => true,
            Err(other) => panic!("{other}"),
        }
    }

    /// The limit found by runs in contact, by bisection.
    fn measured(scheme: Scheme, stiffness: f64, ratio: f64, steps: u32) -> f64 {
        let (mut low, mut high) = (1e-3, 4.0);
        assert!(!grows(scheme, stiffness, ratio, low, steps));
        assert!(grows(scheme, stiffness, ratio, high, steps));
        while high - low > 1e-4 * high {
            let middle = f64::midpoint(low, high);
            if grows(scheme, stiffness, ratio, middle, steps) {
                high = middle;
            } else {
                low = middle;
            }
        }
        f64::midpoint(low, high)
    }

    /// |1 + u + u^2/2 + u^3/6 + u^4/24| with u = z (-ratio + i sqrt(1 - ratio^2)), by Horner's rule.
    fn growth_of_rk4(z: f64, ratio: f64) -> f64 {
        let u = (-z * ratio, z * (1.0 - ratio * ratio).sqrt());
        let mut sum = (1.0, 0.0);
        for divisor in [4.0, 3.0, 2.0, 1.0] {
            let (re, im) = (
                (u.0 * sum.0 - u.1 * sum.1) / divisor,
                (u.0 * sum.1 + u.1 * sum.0) / divisor,
            );
            sum = (1.0 + re, im);
        }
        sum.0.hypot(sum.1)
    }

    fn limit_of_rk4(ratio: f64) -> f64 {
        let (mut low, mut high) = (1.0, 4.0);
        for _ in 0..60 {
            let middle = f64::midpoint(low, high);
            if growth_of_rk4(middle, ratio) > 1.0 {
                high = middle;
            } else {
                low = middle;
            }
        }
        low
    }

    const DECADES: [f64; 5] = [1.0, 1e2, 1e4, 1e6, 1e8];

    /// Holds theory and runs in contact to a limit, and prints a row of the table in docs/failures.md.
    fn check(scheme: Scheme, ratio: f64, limit: f64, steps: u32) {
        let theory = scheme.stability_limit(ratio).expect("there is a limit");
        near(theory, limit, 1e-6);
        let mut row = format!("| {} | {ratio} | {limit:.4} |", scheme.name());
        for stiffness in DECADES {
            let found = measured(scheme, stiffness, ratio, steps);
            near(found, limit, 1e-3 * limit);
            row += &format!(" {found:.4} |");
        }
        println!("{row}");
    }

    #[test]
    fn explicit_ones_without_damping() {
        check(Scheme::SemiImplicitEuler, 0.0, 2.0, 5_000);
        check(Scheme::RungeKutta4, 0.0, 8.0_f64.sqrt(), 5_000);
        for stiffness in DECADES {
            assert!(grows(Scheme::ExplicitEuler, stiffness, 0.0, 0.02, 50_000));
        }
    }

    #[test]
    fn explicit_ones_with_damping() {
        for ratio in [0.05, 0.3_f64] {
            let limit = 2.0 * ((1.0 + ratio * ratio).sqrt() - ratio);
            check(Scheme::SemiImplicitEuler, ratio, limit, 5_000);
            check(Scheme::RungeKutta4, ratio, limit_of_rk4(ratio), 5_000);
        }
    }

    /// Its amplification matrix has the determinant 1 - 2 ratio z + z^2.
    #[test]
    fn explicit_euler_lives_on_damping_alone() {
        check(Scheme::ExplicitEuler, 0.1, 0.2, 400_000);
    }

    #[test]
    fn implicit_ones_have_no_limit() {
        for scheme in [Scheme::ImplicitMidpoint, Scheme::NEWMARK] {
            assert_eq!(scheme.stability_limit(0.0), None);
            for stiffness in DECADES {
                assert!(!grows(scheme, stiffness, 0.0, 1e3, 5_000), "{scheme:?}");
            }
        }
    }

    /// Far beyond the limit the numbers leave all bounds; the exact motion is that of an oscillator about its rest.
    #[test]
    fn explicit_ones_blow_up_in_contact() {
        let stiffness = 1e8;
        let (scene, frequency, depth) = pressed(stiffness, 0.0);
        let rest = scene.clearance + depth;
        let start = rest - 0.5 * depth;
        let task = task(scene, start, 0.0, 2.0 * TAU);
        let truth = exact(&task);
        let angle = frequency * task.duration();
        // An angle of 1e5 rad is rounded to 1e-11, a position of 10 m to 2e-15 m.
        near(truth.end.0, rest - 0.5 * depth * angle.cos(), 1e-14);
        near(truth.end.1, 0.5 * depth * frequency * angle.sin(), 1e-13);
        assert!(truth.impacts.is_empty());
        for scheme in [
            Scheme::ExplicitEuler,
            Scheme::SemiImplicitEuler,
            Scheme::RungeKutta4,
        ] {
            let method = fixed(scheme, Events::Ignored, TAU / 20.0);
            assert_eq!(verdict(&method, &task), Verdict::BlownUp, "{scheme:?}");
        }
        for scheme in [Scheme::ImplicitMidpoint, Scheme::NEWMARK] {
            let method = fixed(scheme, Events::Ignored, TAU / 20.0);
            assert_eq!(verdict(&method, &task), Verdict::Converged, "{scheme:?}");
        }
    }
}

mod energy {
    use super::*;

    /// A mass of 50 J between its suspension and a stop at 1 m: free swings of x = 10 cos, contacts about the
    /// centre of both springs. State after a time that covers two contacts at most, and the times of impacts.
    fn bounce(stiffness: f64, time: f64) -> ((f64, f64), Vec<f64>) {
        let (r, speed) = (1.0, 99.0_f64.sqrt());
        let frequency = (1.0 + stiffness).sqrt();
        let lead = r / (1.0 + stiffness);
        let contact = 2.0 * (speed / frequency).atan2(lead) / frequency;
        let swing = TAU - 2.0 * 0.1_f64.acos();
        let first = 0.1_f64.asin();
        let second = first + contact + swing;
        let impacts: Vec<f64> = [first, second].into_iter().filter(|t| *t < time).collect();
        let since = time - impacts[impacts.len() - 1];
        let state = if since < contact {
            let angle = frequency * since;
            (
                r - lead + lead * angle.cos() + speed / frequency * angle.sin(),
                speed * angle.cos() - frequency * lead * angle.sin(),
            )
        } else {
            let angle = 0.1_f64.acos() + since - contact;
            (10.0 * angle.cos(), -10.0 * angle.sin())
        };
        (state, impacts)
    }

    #[test]
    fn the_exact_method_bounces_as_the_closed_form_does() {
        for stiffness in [1.0, 1e2, 1e4, 1e6, 1e8] {
            let task = task(undriven(1.0, stiffness), 0.0, 10.0, TAU);
            let found = exact(&task);
            let (end, impacts) = bounce(stiffness, TAU);
            near(found.end.0, end.0, 1e-12);
            near(found.end.1, end.1, 1e-11);
            assert_eq!(found.impacts.len(), impacts.len());
            for (impact, time) in found.impacts.iter().zip(impacts) {
                near(impact.time, time, 1e-14);
                near(impact.velocity, 99.0_f64.sqrt(), 1e-12);
            }
        }
    }

    /// A free flight multiplies the energy by 1 + h^2 in every step of explicit Euler, whatever the stop does.
    #[test]
    fn explicit_euler_gains_energy() {
        let step = TAU / 1000.0;
        for events in Events::ALL {
            let task = task(undriven(1.0, 100.0), 0.0, 10.0, TAU);
            let method = fixed(Scheme::ExplicitEuler, events, step);
            assert_eq!(verdict(&method, &task), Verdict::EnergyGain, "{events:?}");
            let (x, v) = method.integrate(&task).expect("bounded").end;
            let gain = 0.5 * (x * x + v * v) / 50.0;
            assert!(gain > (1.0 + step * step).powi(800), "{gain}");
        }
    }

    /// Without location an implicit method penetrates a stiff stop by up to a step's way and is thrown back harder,
    /// stable as it is; with location it is not.
    #[test]
    fn stable_methods_gain_energy_where_events_are_ignored() {
        let task = task(undriven(1.0, 1e6), 0.0, 10.0, TAU);
        let gains = |events| {
            let steps = (0..20).map(|extra| TAU / (300.0 + 7.0 * f64::from(extra)));
            let method = |step| fixed(Scheme::ImplicitMidpoint, events, step);
            let judged = steps.map(|step| verdict(&method(step), &task));
            judged.filter(|is| *is == Verdict::EnergyGain).count()
        };
        assert!(gains(Events::Ignored) > 5, "{}", gains(Events::Ignored));
        assert_eq!(gains(Events::Located), 0);
    }
}

mod contacts {
    use super::*;

    /// x = sin t passes 0.9999 by 0.1 mm around t = pi/2 and 5 pi/2, for 28 ms.
    fn graze(stiffness: f64) -> Task {
        task(undriven(0.9999, stiffness), 0.0, 1.0, 2.0 * TAU)
    }

    /// 102 steps to a period leave both grazes in the middle of a step.
    #[test]
    fn a_located_method_misses_a_graze_within_one_step() {
        for stiffness in [1.0, 1e4] {
            let task = graze(stiffness);
            let found = exact(&task);
            assert_eq!(found.impacts.len(), 2);
            near(found.impacts[0].time, 0.9999_f64.asin(), 1e-13);
            let speed = (1.0 - 0.9999_f64.powi(2)).sqrt();
            near(found.impacts[0].velocity, speed, 1e-13);
            for scheme in [Scheme::RungeKutta4, Scheme::NEWMARK] {
                let coarse = fixed(scheme, Events::Located, TAU / 102.0);
                assert_eq!(verdict(&coarse, &task), Verdict::MissedContact);
                assert!(coarse.integrate(&task).expect("bounded").impacts.is_empty());
            }
            let fine = fixed(Scheme::RungeKutta4, Events::Located, TAU / 2002.0);
            assert_eq!(verdict(&fine, &task), Verdict::Converged);
        }
    }

    /// The suspension throws the mass onto a rigid stop at -10 m, with `speed` m/s the first time.
    fn thrown(restitution: f64, speed: f64, duration: f64) -> Task {
        let scene = Scene {
            stop: Stop::Rigid { restitution },
            ..undriven(-10.0, 0.0)
        };
        task(scene, -10.0_f64.hypot(speed), 0.0, duration)
    }

    /// When it strikes: after a swing of x = -hypot(10, speed) cos t, and from then on after swings that begin
    /// and end at -10 m with a speed of w, each of 2 atan(w/10).
    fn strikes(restitution: f64, speed: f64) -> impl Iterator<Item = f64> {
        let first = (speed / 10.0).atan();
        let swings = (1..).map(move |n| 2.0 * (speed / 10.0 * restitution.powi(n)).atan());
        swings.scan(first, |time, swing| {
            let strike = *time;
            *time += swing;
            Some(strike)
        })
    }

    /// Of bounces with R = 0.8 from 2 m/s on the first 13 fall into 1.7 s, the last swing of them takes 28 ms.
    #[test]
    fn ignored_events_miscount() {
        let task = thrown(0.8, 2.0, 1.7);
        let found = exact(&task);
        let times: Vec<f64> = strikes(0.8, 2.0).take_while(|time| *time < 1.7).collect();
        assert_eq!(times.len(), 13);
        assert_eq!(found.impacts.len(), 13);
        for (impact, time) in found.impacts.iter().zip(times) {
            near(impact.time, time, 1e-13);
        }
        for scheme in [
            Scheme::SemiImplicitEuler,
            Scheme::RungeKutta4,
            Scheme::NEWMARK,
        ] {
            let method = fixed(scheme, Events::Ignored, 0.05);
            let count = method.integrate(&task).expect("bounded").impacts.len();
            assert_ne!(count, 13, "{scheme:?}");
            let outcome = verdict(&method, &task);
            let miscounts = [Verdict::WrongCount, Verdict::MissedContact];
            assert!(miscounts.contains(&outcome), "{scheme:?}: {outcome:?}");
        }
        let located = fixed(Scheme::RungeKutta4, Events::Located, 0.01);
        assert_eq!(verdict(&located, &task), Verdict::Converged);
    }

    /// With R = 0.99 from 0.1 m/s on endlessly many bounces end at 1.99 s; a method that takes them one by one has
    /// spent its steps before. The exact one rests from then on.
    #[test]
    fn a_located_method_is_stuck_in_chatter() {
        let mut task = thrown(0.99, 0.1, 2.5);
        let found = exact(&task);
        assert_eq!(found.end, (-10.0, 0.0));
        for (impact, time) in found.impacts.iter().zip(strikes(0.99, 0.1)) {
            near(impact.time, time, 1e-11);
        }
        let last = found.impacts[found.impacts.len() - 1].time;
        let rest = strikes(0.99, 0.1).nth(5_000).expect("endless");
        assert!(last < rest && rest - last < 1e-6, "{last} {rest}");
        let steps = 250;
        task.most_steps = steps + 1000;
        for scheme in [
            Scheme::RungeKutta4,
            Scheme::ImplicitMidpoint,
            Scheme::NEWMARK,
        ] {
            let method = fixed(scheme, Events::Located, 2.5 / steps as f64);
            match method.integrate(&task) {
                Err(MethodError::Stuck { time, .. }) => assert!(time < rest, "{time}"),
                other => panic!("{scheme:?}: {other:?}"),
            }
            assert_eq!(verdict(&method, &task), Verdict::Stuck);
        }
    }
}
