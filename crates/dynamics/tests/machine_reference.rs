//! Whole motions against an independent 30-digit event-driven integrator
//! (tests/reference/machine.py): impacts, states, dry friction, resting on the stop, stiff stops.

use softstop::{Clock, Scene, Start};
use softstop_testing::reference::{MACHINE, list, number, ratios};
use softstop_testing::tolerance::MOTION;
use softstop_testing::{assert_near, is_near};

/// Rounding errors, in units of 2^-53 times the growth of a perturbation, that a motion may show.
const ALLOWED: f64 = 400.0;

fn tolerance(growth: f64, scale: f64) -> f64 {
    ALLOWED * 0.5 * f64::EPSILON * (1.0 + growth) * (1.0 + scale)
}

#[test]
fn motions_agree_with_thirty_digits() {
    let trajectories = list(&MACHINE, "trajectories");
    assert!(trajectories.len() >= 30);
    for expected in trajectories {
        let name = &expected["name"];
        let mut scene: Scene = ratios(&expected["parameters"]).scene().expect("valid");
        scene.excitation.phase = number(expected, "drive_angle");
        let start = Start::new(number(expected, "position"), number(expected, "velocity"));
        let periods = list(expected, "periods");
        let trajectory = scene
            .trajectory(start, periods.len() as u64)
            .expect("a motion");
        for (index, period) in periods.iter().enumerate() {
            let state = trajectory
                .at(Clock::at_cycle(index as u64 + 1))
                .expect("within");
            let (x, v) = (number(period, "position"), number(period, "velocity"));
            let allowed = tolerance(number(period, "growth"), x.abs() + v.abs());
            let error = (state.position - x).abs().max((state.velocity - v).abs());
            assert!(
                error <= allowed,
                "{name}, period {}: {error:e} > {allowed:e}",
                index + 1
            );
        }
        let impacts = list(expected, "impacts");
        let found: Vec<_> = trajectory.impacts().collect();
        assert_eq!(found.len(), impacts.len(), "impacts of {name}");
        for (touch, impact) in found.iter().zip(impacts) {
            let time = number(impact, "time");
            let growth = growth_at(periods, time);
            let scale = 1.0 / number(impact, "velocity").abs();
            let error = (trajectory.clock.time(touch.instant) - time).abs();
            assert!(
                error <= tolerance(growth, time + 10.0 * scale),
                "{name}: impact at {time} is {error:e} off"
            );
            let error = (touch.before_impact_velocity - number(impact, "velocity")).abs();
            assert!(
                error <= tolerance(growth, 10.0 + 100.0 * scale),
                "{name}: velocity of the impact at {time} is {error:e} off"
            );
        }
    }
}

/// Growth of a perturbation up to the end of the period in which `time` lies.
fn growth_at(periods: &[serde_json::Value], time: f64) -> f64 {
    let mut growth: f64 = 1.0;
    for period in periods {
        growth = growth.max(number(period, "growth"));
        if number(period, "time") > time {
            break;
        }
    }
    growth
}

#[test]
fn orbits_agree_with_thirty_digits() {
    for expected in list(&MACHINE, "orbits") {
        let scene = ratios(&expected["parameters"]).scene().expect("valid");
        let orbit = softstop_dynamics::orbit::find(&scene).expect("an orbit");
        let determinant = orbit.monodromy.determinant();
        let pairs = [
            (orbit.position, "position"),
            (orbit.velocity, "velocity"),
            (orbit.max_position, "max_position"),
            (orbit.monodromy.trace(), "trace"),
            (determinant, "determinant"),
        ];
        for (value, key) in pairs {
            assert!(
                is_near(value, number(expected, key), MOTION),
                "{key}: {value}"
            );
        }
        let velocity = number(&list(expected, "impacts")[0], "velocity");
        assert_near(orbit.before_impact_velocity(), velocity, MOTION);
        assert_near(determinant, (-orbit.damping_integral).exp(), MOTION);
    }
}
