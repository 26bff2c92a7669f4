//! Soft stops that grow rigid: how fast, and to which restitution.

use super::*;
use softstop_testing::hertz;

/// A damped spring sends a mass back with R = exp(-zeta pi / sqrt(1 - zeta^2)) when it keeps it for
/// half a period of the damped oscillation, and with R = exp(-zeta / sqrt(1 - zeta^2) acos(2 zeta^2 - 1))
/// when it lets go at zero force; the contact lasts as k^(-1/2).
#[test]
fn kelvin_voigt_grows_rigid() {
    let zeta: f64 = 0.2;
    let root = (1.0 - zeta * zeta).sqrt();
    for (release, angle) in [
        (Release::Clearance, std::f64::consts::PI),
        (Release::ZeroForce, (2.0 * zeta * zeta - 1.0).acos()),
    ] {
        let restitution = (-zeta / root * angle).exp();
        let rigid = machine(0.8, 1.5, 0.0, Stop::Rigid { restitution });
        let limit = end(&rigid, START, 1.2);
        let errors: Vec<f64> = [1e6, 1e8, 1e10, 1e12]
            .into_iter()
            .map(|stiffness: f64| {
                let stop = Stop::KelvinVoigt { stiffness, release };
                let damping = 2.0 * zeta * stiffness.sqrt();
                (end(&machine(0.8, 1.5, damping, stop), START, 1.2) - limit).norm()
            })
            .collect();
        assert_order(&errors, 100.0, 0.5);
    }
}

/// Without dissipation a power law sends the mass back as fast as it came; the contact lasts as
/// k^(-1/(n+1)).
#[test]
fn hertz_grows_rigid() {
    for exponent in [1.0, 1.5, 2.0, 2.7] {
        let rigid = machine(0.8, 1.5, 0.0, Stop::Rigid { restitution: 1.0 });
        let limit = end(&rigid, START, 1.2);
        let factor = 10f64.powf(exponent + 1.0);
        let errors: Vec<f64> = (3..7)
            .map(|power| {
                let stop = hertz(factor.powi(power), exponent, 0.0);
                (end(&machine(0.8, 1.5, 2.0 * DAMPING, stop), START, 1.2) - limit).norm()
            })
            .collect();
        assert_order(&errors, factor, 1.0 / (exponent + 1.0));
    }
}

/// Hunt and Crossley's law: v dv / (1 + lambda v) = -k/m d^n dd, integrated over the contact, gives the
/// restitution R at the before-impact velocity v: g(lambda v) = g(-R lambda v), g(y) = y - ln(1 + y).
fn restitution_of_hunt_and_crossley(y: f64) -> f64 {
    let g = |y: f64| y - y.ln_1p();
    let (mut low, mut high) = (0.0, 1.0f64.min(1.0 / y));
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if g(-middle * y) < g(y) {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

#[test]
fn hunt_and_crossley_grows_rigid() {
    let (exponent, dissipation) = (1.5, 0.4);
    let lossless = machine(0.8, 1.5, 0.0, Stop::Rigid { restitution: 1.0 });
    let first = lossless.trajectory(START, 1).expect("bounded");
    let velocity = first
        .impacts()
        .next()
        .expect("a hit")
        .before_impact_velocity;
    let restitution = restitution_of_hunt_and_crossley(dissipation * velocity);
    assert!(restitution > 0.2 && restitution < 0.8);
    let limit = end(
        &machine(0.8, 1.5, 0.0, Stop::Rigid { restitution }),
        START,
        0.6,
    );
    let factor = 10f64.powf(exponent + 1.0);
    let errors: Vec<f64> = (3..7)
        .map(|power| {
            let stop = hertz(factor.powi(power), exponent, dissipation);
            (end(&machine(0.8, 1.5, 2.0 * DAMPING, stop), START, 0.6) - limit).norm()
        })
        .collect();
    assert_order(&errors, factor, 1.0 / (exponent + 1.0));
}

/// A restitution of almost nothing changes no impact that none would leave, though the mass that then comes to rest bounces.
#[test]
fn stops_without_rebound_are_hit_as_often_as_almost_dead_ones() {
    let impacts = [0.0, 1e-12].map(|restitution| {
        let scene = machine(0.5, 0.2, 0.04, Stop::Rigid { restitution });
        let family = ParameterFamily::new(scene, [Parameter::Frequency]).expect("a parameter");
        let point = Continuation::new(&family, 1).find_point(0.5, Vector2::new(0.2, 0.0));
        point.expect("an orbit").impacts
    });
    for found in &impacts {
        assert_eq!(found.len(), 2, "{impacts:?}");
        assert_near(found[0], 1.204_867, 1e-6);
        assert_near(found[1], 0.072_138, 1e-6);
    }
}
