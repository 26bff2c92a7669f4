//! Where one law becomes another: soft stops that grow rigid, springs that vanish, and the rigid
//! stop's periodic motion in closed form.

use nalgebra::{Matrix2, Vector2};
use softstop::scene::{Release, RigidStop, Slope};
use softstop::{Clock, Ratios, Scene, Start, Stop};
use softstop_dynamics::orbit::{self, Orbit};

const DAMPING: f64 = 0.02;

fn machine(frequency: f64, clearance: f64, contact_damping: f64, stop: Stop) -> Scene {
    let base = Ratios {
        frequency,
        clearance,
        damping: DAMPING,
        ..Ratios::unloaded()
    };
    Scene {
        stop,
        contact_damping,
        ..base.scene().expect("valid")
    }
}

fn end(scene: &Scene, start: Start, periods: f64) -> Vector2<f64> {
    let clock = Clock::new(scene.excitation.frequency, 0.0);
    let until = clock.instant(periods * scene.period());
    let state = scene.trajectory_until(start, until).expect("bounded").end;
    Vector2::new(state.position, state.velocity)
}

/// Errors against the limit, as the stiffness grows by a factor from one to the next, must shrink with
/// the expected power of the stiffness.
fn assert_order(errors: &[f64], factor: f64, power: f64) {
    for pair in errors.windows(2) {
        let observed = (pair[0] / pair[1]).ln() / factor.ln();
        assert!(
            (observed - power).abs() < 0.05,
            "order {observed}, expected {power}, errors {errors:?}"
        );
    }
    assert!(errors.last().is_some_and(|last| *last < 1e-2));
}

const START: Start = Start {
    position: 0.0,
    velocity: 3.0,
};

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
                let stop = Stop::Hertz {
                    stiffness: factor.powi(power),
                    exponent,
                    dissipation: 0.0,
                };
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
            let stop = Stop::Hertz {
                stiffness: factor.powi(power),
                exponent,
                dissipation,
            };
            (end(&machine(0.8, 1.5, 2.0 * DAMPING, stop), START, 0.6) - limit).norm()
        })
        .collect();
    assert_order(&errors, factor, 1.0 / (exponent + 1.0));
}

/// A spring that vanishes leaves the linear oscillator, with an error in proportion to its stiffness.
#[test]
fn soft_stops_vanish() {
    let linear = end(&machine(0.8, 1.5, 0.0, Stop::None), START, 3.0);
    let stops: [fn(f64) -> Stop; 4] = [
        |stiffness| Stop::KelvinVoigt {
            stiffness,
            release: Release::ZeroForce,
        },
        |stiffness| Stop::Preloaded {
            stiffness,
            preload: stiffness,
        },
        |stiffness| Stop::PiecewiseLinear {
            loading: vec![
                Slope {
                    from: 0.0,
                    stiffness,
                },
                Slope {
                    from: 0.3,
                    stiffness: 3.0 * stiffness,
                },
            ],
            unloading: vec![Slope {
                from: 0.0,
                stiffness: 0.5 * stiffness,
            }],
        },
        |stiffness| Stop::Hertz {
            stiffness,
            exponent: 1.5,
            dissipation: 0.3,
        },
    ];
    for stop in stops {
        let errors: Vec<f64> = [1e-3, 1e-5, 1e-7]
            .into_iter()
            .map(|k| (end(&machine(0.8, 1.5, 2.0 * DAMPING, stop(k)), START, 3.0) - linear).norm())
            .collect();
        assert_order(&errors, 1e-2, -1.0);
        let none = machine(0.8, 1.5, 2.0 * DAMPING, stop(0.0));
        assert!((end(&none, START, 3.0) - linear).norm() < 1e-13);
    }
}

/// Different words for the same machine move alike, to the last digits.
#[test]
fn equal_laws_move_alike() {
    let spring = Stop::Preloaded {
        stiffness: 30.0,
        preload: 0.0,
    };
    let slope = |from| Slope {
        from,
        stiffness: 30.0,
    };
    let same = [
        Stop::KelvinVoigt {
            stiffness: 30.0,
            release: Release::Clearance,
        },
        Stop::PiecewiseLinear {
            loading: vec![slope(0.0)],
            unloading: vec![],
        },
        Stop::PiecewiseLinear {
            loading: vec![slope(0.0), slope(0.05), slope(0.11)],
            unloading: vec![slope(0.0), slope(0.07)],
        },
        Stop::Hertz {
            stiffness: 30.0,
            exponent: 1.0,
            dissipation: 0.0,
        },
    ];
    for clearance in [1.5, 0.0, -0.4] {
        let expected = end(&machine(0.8, clearance, 0.5, spring.clone()), START, 5.0);
        for stop in &same {
            let found = end(&machine(0.8, clearance, 0.5, stop.clone()), START, 5.0);
            assert!((found - expected).norm() < 1e-12, "{stop:?}");
        }
        // A rigid stop that is not reached changes nothing.
        let far = Scene {
            rigid: Some(RigidStop {
                travel: 50.0,
                restitution: 0.3,
            }),
            ..machine(0.8, clearance, 0.5, spring.clone())
        };
        assert_eq!(end(&far, START, 5.0), expected);
    }
}

/// A power law comes continuously from its neighbours: exponent 1 + e is off the linear spring by O(e).
#[test]
fn exponents_join() {
    let law = |exponent| Stop::Hertz {
        stiffness: 30.0,
        exponent,
        dissipation: 0.0,
    };
    let linear = end(&machine(0.8, 1.5, 0.5, law(1.0)), START, 1.0);
    let errors: Vec<f64> = [1e-3, 1e-5, 1e-7]
        .into_iter()
        .map(|e| (end(&machine(0.8, 1.5, 0.5, law(1.0 + e)), START, 1.0) - linear).norm())
        .collect();
    assert_order(&errors, 1e-2, -1.0);
}

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
        let trace = orbit.trace() - nearest.trace;
        assert!(trace.abs() < 1e-11, "trace off by {trace:e}");
        let fade = (-2.0 * DAMPING * scene.period()).exp();
        let determinant = restitution * restitution * fade;
        assert!((orbit.determinant() - determinant).abs() < 1e-13);
        // From a state near it Newton's method finds it again, even where its first step leads beyond
        // the stop.
        for (dx, dv) in [(-1e-2, -1e-2), (-1e-2, 1e-2), (-3e-2, 0.0)] {
            let state = Vector2::new(orbit.position + dx, orbit.velocity + dv);
            let again = Orbit::near(&scene, state).expect("Newton's method settles");
            let off = again.before_impact_velocity() - orbit.before_impact_velocity();
            assert!(off.abs() < 1e-11, "{off:e}");
        }
    }
}

/// Under heavy damping a nonlinear contact is followed in long steps; with an exponent next to 1 and a
/// faint dissipation it must be where the linear one is.
#[test]
fn slow_contacts_creep_alike() {
    for (stiffness, contact_damping) in [(1e4, 1e4), (1e6, 1e5), (1e8, 3e4)] {
        let law = |exponent, dissipation| Stop::Hertz {
            stiffness,
            exponent,
            dissipation,
        };
        for clearance in [0.0, -0.5] {
            let linear = machine(0.3, clearance, contact_damping, law(1.0, 0.0));
            let expected = linear.trajectory(START, 2).expect("bounded");
            for (exponent, dissipation) in [(1.0, 1e-9), (1.0 + 1e-10, 0.0)] {
                let scene = machine(0.3, clearance, contact_damping, law(exponent, dissipation));
                let found = scene.trajectory(START, 2).expect("bounded");
                let off = (found.end.position - expected.end.position).abs();
                assert!(off < 1e-8, "{stiffness:e} {contact_damping:e}: {off:e}");
                assert!(found.energy_defect().abs() < 1e-12 * (1.0 + found.work.dissipated));
                // Not one step for each lifetime of the damped mode.
                assert!(found.arcs.len() < 20_000, "{} arcs", found.arcs.len());
            }
        }
    }
}

/// A wall behind nothing is a wall behind a stop of no stiffness: the contact's damping holds from the
/// clearance on.
#[test]
fn a_wall_behind_nothing_is_one_behind_a_vanishing_stop() {
    let wall = Some(RigidStop {
        travel: 1.0,
        restitution: 0.5,
    });
    let none = Scene {
        rigid: wall,
        ..machine(1.15, 0.5, 5.0, Stop::None)
    };
    let limp = Scene {
        rigid: wall,
        ..machine(
            1.15,
            0.5,
            5.0,
            Stop::Preloaded {
                stiffness: 0.0,
                preload: 0.0,
            },
        )
    };
    assert_eq!(end(&none, START, 4.0), end(&limp, START, 4.0));
}
