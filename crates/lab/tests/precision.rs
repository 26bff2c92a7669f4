//! `softstop-lab chart precision`: what it measures, and how users and scripts meet it.

mod command;

use softstop_testing::tolerance::ROUNDING;
use std::fs;
use std::path::Path;

use serde_json::Value;
use softstop::Impact;
use softstop_lab::methods::{Events, FixedStep, Integrator, MethodError, Scheme, Solution, Task};
use softstop_lab::precision::case::{self, BUILT_IN, Case};
use softstop_lab::precision::errors::Scale;
use softstop_lab::precision::family::{self, Family, Look};
use softstop_lab::precision::measure::{Bench, Effort, Row};
use softstop_lab::precision::truth::Truth;
use softstop_testing::{Program, assert_near, docs, is_near};

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// A built-in scene, or one in a file, for some periods.
fn case(scene: &str, periods: f64) -> Result<Case, Box<dyn std::error::Error>> {
    let cases = case::cases(scene, Some(periods)).map_err(|failure| failure.to_string())?;
    Ok(cases.into_iter().next().ok_or("a scene")?)
}

const LOOK: Look = Look {
    scheme: 1,
    blind: false,
};
const ONCE: Effort = Effort {
    longest: 10.0,
    repeat: 0.0,
    most: 1,
};

fn rows(case: &Case, family: &Family) -> Result<Vec<Row>, Box<dyn std::error::Error>> {
    let told = |failure: softstop_console::failure::Failure| failure.to_string();
    let task = &case.task();
    let scale = Scale::of(task)?;
    let truth = Truth::of(task, &scale, case.stored(None)).map_err(told)?;
    let bench = Bench {
        task,
        truth: &truth,
        scale,
        effort: ONCE,
    };
    Ok(bench.family(family, &|| {}).map_err(told)?)
}

fn end_error(row: &Row) -> f64 {
    row.end_error.unwrap_or_else(|| panic!("{row:?}"))
}

#[test]
fn the_error_of_a_method_falls_with_its_order() -> Outcome {
    let none = docs("scenes/none.toml");
    let case = Case {
        reference: Some("precision/none"),
        ..case(none.to_str().ok_or("UTF-8")?, 2.0)?
    };
    assert!(case.stored(None).is_some());
    let knobs = [1e-2, 5e-3, 2.5e-3];
    let period = case.machine.scene.period();
    let newmark = Family::new("Newmark", LOOK, knobs, move |knob| {
        Box::new(FixedStep::new(
            Scheme::NEWMARK,
            knob * period,
            Events::Located,
        ))
    });
    let errors: Vec<f64> = rows(&case, &newmark)?.iter().map(end_error).collect();
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!(is_near(order, 2.0, 0.1), "{errors:?}");
    }
    Ok(())
}

#[test]
fn the_exact_method_is_exact_to_rounding_on_short_runs() -> Outcome {
    for (name, periods) in [("periodic", 3.0), ("loaded", 2.0), ("sticking", 1.2)] {
        let case = case(name, periods)?;
        assert!(case.stored(None).is_some(), "{name}");
        let row = &rows(&case, &Family::exact())?[0];
        let worst = row.worst_error().ok_or("an error")?;
        assert!(
            worst < 1e-13 && row.impact_difference == Some(0),
            "{name}: {row:?}"
        );
        assert!(row.impacts > Some(0), "{name}");
    }
    Ok(())
}

/// A method that is right, but for one thing.
struct Wrong(fn(&mut Solution));

impl Integrator for Wrong {
    fn name(&self) -> String {
        "wrong".to_owned()
    }

    fn integrate(&self, task: &Task) -> Result<Solution, MethodError> {
        let mut solution = softstop_lab::methods::Exact.integrate(task)?;
        (self.0)(&mut solution);
        Ok(solution)
    }
}

#[test]
fn each_error_is_measured_for_itself() -> Outcome {
    let case = case("periodic", 3.0)?;
    let errors = |wrong: fn(&mut Solution)| {
        let family = Family::new("wrong", LOOK, [1.0], move |_| Box::new(Wrong(wrong)));
        rows(&case, &family).map(|rows| rows[0].clone())
    };
    let late = errors(|solution| solution.impacts[1].time += 1e-3)?;
    let period = case.machine.scene.period();
    assert_near(
        late.impact_time_error.ok_or("time")?,
        1e-3 / period,
        10.0 * ROUNDING,
    );
    assert!(end_error(&late) < 1e-13);
    let doubled = errors(|solution| {
        let first: Impact = solution.impacts[0];
        solution.impacts.insert(0, first);
    })?;
    assert_eq!(doubled.impact_difference, Some(1));
    Ok(())
}

#[test]
fn failures_are_told_and_finer_settings_still_run() -> Outcome {
    struct Fails(f64);
    impl Integrator for Fails {
        fn name(&self) -> String {
            "fails".to_owned()
        }
        fn integrate(&self, task: &Task) -> Result<Solution, MethodError> {
            match self.0 {
                knob if knob > 0.5 => Err(MethodError::BlownUp { time: 3.0 }),
                knob if knob > 0.1 => {
                    let mut solution = softstop_lab::methods::Exact.integrate(task)?;
                    solution.end.0 = f64::NAN;
                    Ok(solution)
                }
                _ => softstop_lab::methods::Exact.integrate(task),
            }
        }
    }
    let case = case("periodic", 1.0)?;
    let rows = rows(
        &case,
        &Family::new("fails", LOOK, [1.0, 0.2, 0.01], |knob| {
            Box::new(Fails(knob))
        }),
    )?;
    let reason = rows[0].reason.as_deref();
    assert_eq!(reason, Some("blown up near t = 3 s"));
    assert_eq!([rows[0].status, rows[1].status], ["failed"; 2]);
    assert!(end_error(&rows[2]) < 1e-13);
    Ok(())
}

#[test]
fn a_power_law_is_measured_against_methods_that_agree() -> Outcome {
    let task = case("hertz", 2.0)?.task();
    let scale = Scale::of(&task)?;
    let truth = Truth::of(&task, &scale, None).map_err(|failure| failure.to_string())?;
    let doubt = truth.doubt.worst();
    assert!(doubt > 0.0 && doubt < 1e-10, "{doubt}");
    let exact = softstop_lab::methods::Exact.integrate(&task)?;
    assert_eq!(truth.errors_of(&exact, &scale).end, truth.doubt.end);
    Ok(())
}
