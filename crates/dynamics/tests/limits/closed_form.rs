//! The rigid stop's periodic motion in closed form.

use super::*;
use softstop_testing::assert_near;
use softstop_testing::tolerance::{MOTION, ROUNDING};

/// The z = 1 motion of a rigid stop in closed form (Peterka 1981; Shaw and Holmes 1983): between two
/// impacts the particular solution (X, V at the impact) plus a free motion y that leads from
/// (r - X, -R v - V) to (r - X, v - V). Both are linear in v, and X^2 + (V/eta)^2 = A^2 fixes v.
struct RigidOrbit {
    before_impact_velocity: f64,
    trace: f64,
}

fn rigid_orbits(frequency: f64, clearance: f64, restitution: f64) -> Vec<RigidOrbit> {
    let omega = (1.0 - DAMPING * DAMPING).sqrt();
    let period = std::f64::consts::TAU / frequency;
    let fade = (-DAMPING * period).exp();
    let (sin, cos) = (omega * period).sin_cos();
    let c = fade * (cos + DAMPING / omega * sin);
    let s = fade * sin / omega;
    let rates = Matrix2::new(c, s, -s, fade * (cos - DAMPING / omega * sin));
    // (Phi - 1) (r - X, -V) = (0, v) + Phi (0, R v), hence r - X = p v and -V = q v.
    let right = Vector2::new(0.0, 1.0) + rates * Vector2::new(0.0, restitution);
    let unit = (rates - Matrix2::identity())
        .lu()
        .solve(&right)
        .expect("off resonance");
    let (p, q) = (unit.x, unit.y);
    let amplitude = ((1.0 - frequency * frequency).powi(2) + (2.0 * DAMPING * frequency).powi(2))
        .sqrt()
        .recip();
    // (r - p v)^2 + (q v / eta)^2 = A^2
    let a = p * p + q * q / (frequency * frequency);
    let b = -2.0 * clearance * p;
    let d = clearance * clearance - amplitude * amplitude;
    let root = (b * b - 4.0 * a * d).sqrt();
    [(-b + root) / (2.0 * a), (-b - root) / (2.0 * a)]
        .into_iter()
        .filter(|v| *v > 1e-3)
        .map(|v| {
            // The drive at the impact, from the equation of motion of the particular solution.
            let (x, rate) = (clearance - p * v, -q * v);
            let push = (1.0 - frequency * frequency) * x + 2.0 * DAMPING * rate;
            let after = push + 2.0 * DAMPING * restitution * v - clearance;
            let before = push - 2.0 * DAMPING * v - clearance;
            let jump = Matrix2::new(
                -restitution,
                0.0,
                (after + restitution * before) / v,
                -restitution,
            );
            RigidOrbit {
                before_impact_velocity: v,
                trace: (jump * rates).trace(),
            }
        })
        .collect()
}

#[test]
fn rigid_orbits_are_those_of_the_closed_form() {
    // Frequency, clearance, restitution: all with a stable z = 1 motion.
    for (frequency, clearance, restitution) in [
        (2.0, 0.0, 0.6),
        (2.2, 0.0, 0.8),
        (1.8, 0.1, 0.5),
        (2.5, -0.05, 0.7),
        (1.2, 1.0, 0.6),
        (1.9, 0.3, 0.4),
    ] {
        let scene = machine(frequency, clearance, 0.0, Stop::Rigid { restitution });
        let orbit = orbit::find(&scene).expect("a stable z = 1 motion");
        let expected = rigid_orbits(frequency, clearance, restitution);
        let gap = |candidate: &&RigidOrbit| {
            (orbit.before_impact_velocity() - candidate.before_impact_velocity).abs()
        };
        let nearest = expected
            .iter()
            .min_by(|a, b| gap(a).total_cmp(&gap(b)))
            .expect("a solution");
        assert!(gap(&nearest) < 1e-12, "velocity off by {:e}", gap(&nearest));
        assert_near(orbit.monodromy.trace(), nearest.trace, 10.0 * MOTION);
        let fade = (-2.0 * DAMPING * scene.period()).exp();
        let determinant = restitution * restitution * fade;
        assert_near(orbit.monodromy.determinant(), determinant, 10.0 * ROUNDING);
        // From a state near it Newton's method finds it again, even where its first step leads beyond
        // the stop.
        for (dx, dv) in [(-1e-2, -1e-2), (-1e-2, 1e-2), (-3e-2, 0.0)] {
            let state = Vector2::new(orbit.position + dx, orbit.velocity + dv);
            let again = Orbit::find_near(&scene, state).expect("Newton's method settles");
            assert_near(
                again.before_impact_velocity(),
                orbit.before_impact_velocity(),
                10.0 * MOTION,
            );
        }
    }
}
