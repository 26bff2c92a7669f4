//! Contacts that are missed, miscounted or without end.

use super::*;
use softstop_testing::assert_near;
use softstop_testing::tolerance::{MOTION, ROUNDING};

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
        assert_near(found.impacts[0].time, 0.9999_f64.asin(), 10.0 * ROUNDING);
        let speed = (1.0 - 0.9999_f64.powi(2)).sqrt();
        assert_near(found.impacts[0].velocity, speed, 10.0 * ROUNDING);
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
        assert_near(impact.time, time, 10.0 * ROUNDING);
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
        assert_near(impact.time, time, 10.0 * MOTION);
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
