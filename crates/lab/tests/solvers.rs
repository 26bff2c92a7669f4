//! The adaptive solvers of other crates against the exact method.

use std::path::PathBuf;

use softstop::{PhaseKind, Ratios, Start, Stop};
use softstop_console::scene_file;
use softstop_lab::methods::{Exact, Integrator, MethodError, Solution, Task};
use softstop_lab::solvers::{Adaptive, AdaptiveScheme};

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// All schemes with the same tolerance.
fn adaptive(tolerance: f64) -> [Adaptive; 5] {
    AdaptiveScheme::ALL.map(|scheme| Adaptive { scheme, tolerance })
}

/// Point A of Peterka 2003 on its way to the motion with one impact per period.
fn point_a() -> Result<Task, Box<dyn std::error::Error>> {
    Ok(Task::new(
        Ratios::unloaded().scene()?,
        Start::new(0.0, 14.0),
        20.0,
        1_000_000,
    ))
}

/// An example scene of docs/scenes.
fn example(name: &str) -> Result<Task, Box<dyn std::error::Error>> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../docs/scenes");
    let file =
        scene_file::read(&folder.join(name)).map_err(|failure| format!("{name}: {failure}"))?;
    Ok(Task {
        scene: file.scene,
        start: file.start,
        ..point_a()?
    })
}

/// Largest difference at the end, in m or m/s.
fn apart(one: &Solution, other: &Solution) -> f64 {
    let position = one.end.0 - other.end.0;
    let velocity = one.end.1 - other.end.1;
    position.abs().max(velocity.abs())
}

/// What a motion of 20 periods makes of the error allowed in a step: that of a step times their number,
/// or less. Schemes of low order take more of them.
fn share(scheme: AdaptiveScheme) -> f64 {
    match scheme {
        AdaptiveScheme::Tsit45 | AdaptiveScheme::Dopri5 | AdaptiveScheme::Dop853 => 1e3,
        AdaptiveScheme::Bdf => 5e3,
        AdaptiveScheme::Esdirk34 => 5e4,
    }
}

/// The same impacts as the exact method, at the same times and velocities, and the same end, to a share of the
/// tolerance.
fn agrees(method: &Adaptive, task: &Task, name: &str) -> Outcome {
    let exact = Exact.integrate(task)?;
    let found = method.integrate(task)?;
    let allowed = share(method.scheme) * method.tolerance;
    let what = format!("{name}, {}", method.name());
    assert!(apart(&exact, &found) <= allowed, "{what}: {found:?}");
    assert_eq!(exact.impacts.len(), found.impacts.len(), "{what}");
    for (one, other) in exact.impacts.iter().zip(&found.impacts) {
        let late = (one.time - other.time).abs();
        let faster = (one.velocity - other.velocity).abs();
        assert!(late.max(faster) <= allowed, "{what}: {one:?} {other:?}");
    }
    Ok(())
}

#[test]
fn errors_fall_with_the_tolerance_on_smooth_motion() -> Outcome {
    let task = example("none.toml")?;
    let exact = Exact.integrate(&task)?;
    for scheme in AdaptiveScheme::ALL {
        let mut last: Option<(f64, u64)> = None;
        for tolerance in [1e-4, 1e-6, 1e-8, 1e-10] {
            let method = Adaptive { scheme, tolerance };
            let found = method.integrate(&task)?;
            let error = apart(&exact, &found);
            let evaluations = found.work.evaluations;
            assert!(error <= share(scheme) * tolerance, "{method:?} {error:e}");
            if let Some((larger, fewer)) = last {
                assert!(error < 0.2 * larger, "{method:?} {error:e} {larger:e}");
                assert!(evaluations > fewer, "{method:?} {evaluations} {fewer}");
            }
            last = Some((error, evaluations));
        }
    }
    Ok(())
}

#[test]
fn point_a_has_the_impacts_of_the_exact_method() -> Outcome {
    let task = point_a()?;
    for method in adaptive(1e-9) {
        agrees(&method, &task, "point A")?;
    }
    Ok(())
}

#[test]
fn every_law_is_followed() -> Outcome {
    for name in [
        "hertz.toml",
        "hunt-crossley.toml",
        "kelvin-voigt.toml",
        "kelvin-voigt-zero-force.toml",
        "piecewise-linear.toml",
        "piecewise-linear-unloading.toml",
        "piercing.toml",
        "rigid.toml",
        "stiff.toml",
    ] {
        let task = example(name)?;
        for method in adaptive(1e-9) {
            agrees(&method, &task, name)?;
        }
    }
    Ok(())
}

/// A mass that a strip holds for a good part of each period, and that the drive lets go.
fn sticking() -> Result<Task, Box<dyn std::error::Error>> {
    let ratios = Ratios {
        clearance: 0.0,
        frequency: 0.6,
        ..Ratios::loaded()
    };
    Ok(Task {
        scene: ratios.scene()?,
        start: Start::new(-0.5, 0.0),
        ..point_a()?
    })
}

#[test]
fn a_held_mass_is_let_go_by_the_drive() -> Outcome {
    let task = sticking()?;
    let mut motion = task.scene.motion(task.start)?;
    let clock = *motion.clock();
    let mut held = 0;
    for index in 0..200 {
        let time = task.duration() * f64::from(index) / 200.0;
        motion.advance(clock.instant(time), &mut ())?;
        held += u32::from(motion.kind() == PhaseKind::Stuck);
    }
    assert!((50..150).contains(&held), "{held} of 200 times");
    for method in adaptive(1e-9) {
        agrees(&method, &task, "sticking")?;
    }
    Ok(())
}

#[test]
fn chatter_ends_in_rest_for_all() -> Outcome {
    let task = example("chatter.toml")?;
    let exact = Exact.integrate(&task)?;
    for method in adaptive(1e-9) {
        let found = method.integrate(&task)?;
        assert_eq!(found.end, exact.end, "{}", method.name());
        let (impacts, all) = (found.impacts.len(), exact.impacts.len());
        // Bounces whose speed is below its error mean rest to the one that places a crossing least well.
        if method.scheme == AdaptiveScheme::Bdf {
            assert!((300..all).contains(&impacts), "{impacts} of {all}");
        } else {
            assert_eq!(impacts, all, "{}", method.name());
        }
    }
    Ok(())
}

/// Point A's machine with a stop so hard that contact is short.
fn hard() -> Result<Task, Box<dyn std::error::Error>> {
    let mut task = point_a()?;
    let (stiffness, preload) = (1e6, 70.0);
    task.scene.stop = Stop::Preloaded { stiffness, preload };
    task.start.position = 9.9;
    task.periods = 3.0;
    Ok(task)
}

#[test]
fn what_happens_within_a_step_is_missed_and_not_mended() -> Outcome {
    let task = hard()?;
    let exact = Exact.integrate(&task)?;
    assert_eq!(exact.impacts.len(), 3);
    // Free motion rises above the clearance and falls again within one of the long steps of high order: two of
    // the impacts are missed, one of them still at a fine tolerance.
    for (tolerance, seen) in [(1e-2, 1), (1e-9, 2), (1e-10, 3)] {
        let long_steps = Adaptive {
            scheme: AdaptiveScheme::Dop853,
            tolerance,
        };
        let found = long_steps.integrate(&task)?;
        assert_eq!(found.impacts.len(), seen, "{}", long_steps.name());
    }
    // Contact that begins on the surface ends in the first step.
    let coarse = Adaptive {
        scheme: AdaptiveScheme::Esdirk34,
        tolerance: 0.1,
    };
    let error = coarse.integrate(&task).expect_err("a step too far");
    let told = error.to_string();
    assert!(told.contains("beyond its phase"), "{told}");
    for method in adaptive(1e-10) {
        let found = method.integrate(&task)?;
        assert_eq!(found.impacts.len(), 3, "{}", method.name());
    }
    Ok(())
}

#[test]
fn bad_settings_and_tasks_are_named() -> Outcome {
    let task = point_a()?;
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = adaptive(bad)[0].integrate(&task).expect_err("refused");
        let told = format!("tolerance = {bad}: must be finite and > 0");
        assert_eq!(error.to_string(), told);
    }
    for method in adaptive(1e-9) {
        let short = Task {
            most_steps: 100,
            ..task.clone()
        };
        let error = method.integrate(&short);
        assert!(
            matches!(error, Err(MethodError::Stuck { steps, .. }) if steps <= 100),
            "{error:?}"
        );
        let backwards = Task {
            periods: -1.0,
            ..task.clone()
        };
        let error = method.integrate(&backwards);
        assert!(matches!(error, Err(MethodError::Task(_))), "{error:?}");
        let nothing = Task {
            periods: 0.0,
            ..task.clone()
        };
        assert_eq!(method.integrate(&nothing)?.end, (0.0, 14.0));
    }
    Ok(())
}
