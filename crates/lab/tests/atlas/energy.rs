//! Methods that gain energy where there is none to gain.

use super::*;
use softstop_testing::assert_near;
use softstop_testing::tolerance::{MOTION, ROUNDING};

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
        assert_near(found.end.0, end.0, MOTION);
        assert_near(found.end.1, end.1, 10.0 * MOTION);
        assert_eq!(found.impacts.len(), impacts.len());
        for (impact, time) in found.impacts.iter().zip(impacts) {
            assert_near(impact.time, time, ROUNDING);
            assert_near(impact.velocity, 99.0_f64.sqrt(), MOTION);
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
