//! `softstop-lab chart failures`: its maps agree with theory, its true motions with 67 digits, its files with its
//! page, and bad values are named.

use softstop_testing::tolerance::SOLVED;
use std::fs;

use serde_json::Value;
use softstop_console::progress::Progress;
use softstop_lab::failures::{self, Atlas, Axes, Cell, SteppedMethod, built_in};
use softstop_lab::methods::{Events, Exact, Integrator, Scheme, Task, Verdict};
use softstop_lab::scenes::Case;
use softstop_testing::{Program, docs, is_near};

type Outcome = Result<(), Box<dyn std::error::Error>>;

const PROGRAM: Program = Program {
    file: env!("CARGO_BIN_EXE_softstop-lab"),
    first: &["chart", "failures"],
};

fn find(name: &str) -> Result<Case, String> {
    failures::find(name).map_err(|failure| failure.to_string())
}

fn atlas(case: Case, axes: Axes, families: &[SteppedMethod]) -> Result<Atlas, String> {
    Atlas::new(case, axes, families, 0.01, &Progress::new(1, "runs"))
        .map_err(|failure| failure.to_string())
}

/// What the strip of the exact method says holds to 1e-10 for all times and velocities of impacts, too.
#[test]
fn the_exact_method_agrees_with_67_digits() -> Outcome {
    for name in ["bounce", "graze", "chatter", "driven"] {
        for stiffness in [1.0, 1e2, 1e4, 1e8] {
            let case = find(name)?;
            let task: Task = case.with_stiffness(stiffness);
            let digits = case
                .stored(Some(stiffness))
                .ok_or("a stored motion")?
                .solution;
            let exact = Exact.integrate(&task)?;
            let apart = |a: f64, b: f64, scale: f64| {
                assert!(
                    is_near(a, b, SOLVED * scale),
                    "{name}, {stiffness}: {a} {b}"
                );
            };
            apart(exact.end.0, digits.end.0, 10.0);
            apart(exact.end.1, digits.end.1, 10.0);
            assert_eq!(exact.impacts.len(), digits.impacts.len(), "{name}");
            for (own, other) in exact.impacts.iter().zip(&digits.impacts) {
                apart(own.time, other.time, 1.0);
                apart(own.velocity, other.velocity, 10.0);
            }
        }
    }
    Ok(())
}

/// Pressed onto the stop, what lies clearly below the line of theory is stable, what lies above is not.
#[test]
fn maps_change_at_the_line_of_theory() -> Outcome {
    let families = [Scheme::SemiImplicitEuler, Scheme::RungeKutta4]
        .map(|scheme| SteppedMethod::FixedStep(scheme, Events::Ignored));
    let axes = Axes {
        stiffness: vec![1e2, 1e3, 1e4, 1e5],
        step: (0..36)
            .map(|index| 1e-4 * 10_f64.powf(0.1 * f64::from(index)))
            .collect(),
    };
    let atlas = atlas(find("pressed")?, axes, &families)?;
    assert_eq!(atlas.maps.len(), 2);
    for map in &atlas.maps {
        for (cells, limit) in map.columns.iter().zip(&map.limit) {
            let limit = limit.ok_or("a limit")?;
            changes_at_the_line(&map.family.name(), limit, cells, &atlas.axes.step);
        }
    }
    Ok(())
}

fn changes_at_the_line(name: &str, limit: f64, cells: &[Cell], steps: &[f64]) {
    let fine = [Verdict::Converged, Verdict::Inaccurate];
    assert!(steps[0] < 0.95 * limit, "nothing lies below {limit}");
    for (cell, step) in cells.iter().zip(steps) {
        if *step < 0.95 * limit {
            assert!(fine.contains(&cell.verdict), "{name}: {step} {limit}");
        } else if *step > 1.05 * limit {
            assert!(!fine.contains(&cell.verdict), "{name}: {step} {limit}");
        }
    }
}

/// Every class occurs on the page that is there for it.
#[test]
fn each_page_shows_its_failure() -> Outcome {
    let everywhere = |events| Scheme::ALL.map(|scheme| SteppedMethod::FixedStep(scheme, events));
    for (name, events, failure) in [
        ("pressed", Events::Ignored, Verdict::BlownUp),
        ("bounce", Events::Ignored, Verdict::EnergyGain),
        ("graze", Events::Located, Verdict::MissedContact),
        ("chatter", Events::Located, Verdict::Stuck),
        ("driven", Events::Ignored, Verdict::WrongCount),
    ] {
        let axes = Axes {
            stiffness: vec![1.0, 1e3, 1e5],
            step: vec![3e-3, 1e-2, 3e-2, 0.1],
        };
        let atlas = atlas(find(name)?, axes, &everywhere(events))?;
        let mut cells = atlas
            .maps
            .iter()
            .flat_map(|map| map.columns.iter().flatten());
        assert!(cells.any(|cell| cell.verdict == failure), "{name}");
        for column in &atlas.columns {
            let exact = column.exact.ok_or("not compared")?;
            assert_eq!(exact.verdict, Verdict::Converged, "{name}");
            assert!(exact.error.is_some_and(|error| error < 1e-11), "{exact:?}");
        }
    }
    Ok(())
}

#[test]
fn writes_pages_table_and_maps() -> Outcome {
    let folder = tempfile::tempdir()?;
    let target = folder.path().join("atlas");
    let place = target.to_str().ok_or("path")?;
    let text = PROGRAM.text(&[
        "--scene", "bounce", "--points", "5", "--format", "json", "--output", place,
    ]);
    let report: Value = serde_json::from_str(&text)?;
    assert_eq!(fs::read_to_string(target.join("failures.json"))?, text);
    let scene = &report["scenes"][0];
    // Moreau's method is made for rigid stops alone.
    assert_eq!(scene["maps"].as_array().map(Vec::len), Some(12));
    assert_eq!(scene["exact"], "CCCCC");
    assert_eq!(scene["true_impacts"], serde_json::json!([2, 2, 2, 2, 2]));
    let euler = &scene["maps"][0];
    assert_eq!(
        (&euler["scheme"], &euler["events"]),
        (&"explicit Euler".into(), &"events ignored".into())
    );
    assert!(
        euler["map"][0]
            .as_str()
            .is_some_and(|column| column.ends_with("EEE")),
        "{euler}"
    );
    let table = fs::read_to_string(target.join("failures.csv"))?;
    assert_eq!(table.lines().count(), 1 + 12 * 25);
    assert!(table.contains("bounce,RK4,events located,1.0,"));
    let page = fs::read_to_string(target.join("bounce.svg"))?;
    assert!(page.contains("A bounce without losses") && page.contains("generalised-alpha"));
    Ok(())
}

#[test]
fn a_scene_of_the_user_and_a_filter() -> Outcome {
    let folder = tempfile::tempdir()?;
    let place = folder.path().to_str().ok_or("path")?;
    for (scene, judged) in [
        ("kelvin-voigt", "exact: 3 of 3 converged"),
        ("piecewise-linear", "exact: 3 of 3 converged"),
        ("hertz", "exact: 3 of 3 converged"),
    ] {
        let file = docs(&format!("scenes/{scene}.toml"));
        let file = file.to_str().ok_or("path")?;
        let text = PROGRAM.text(&[
            "--scene",
            file,
            "--method",
            "rk4",
            "--method",
            "NEWMARK, events located",
            "--periods",
            "1",
            "--points",
            "3",
            "--output",
            place,
        ]);
        assert!(text.contains("RK4, events ignored") && text.contains("RK4, events located"));
        assert!(text.contains("Newmark, events located") && !text.contains("Euler"));
        assert!(text.contains(judged), "{text}");
        assert!(folder.path().join(format!("{scene}.svg")).is_file());
    }
    Ok(())
}

#[test]
fn the_page_shows_every_map_and_scene() -> Outcome {
    let page = fs::read_to_string(docs("methods.md"))?;
    let cases = built_in().map_err(|failure| failure.to_string())?;
    for case in &cases {
        for end in ["svg", "toml"] {
            let name = format!("failures/{}.{end}", case.name);
            assert!(page.contains(&format!("({name})")), "{name}");
            assert!(docs(&name).is_file(), "{name}");
        }
    }
    let pictures = fs::read_dir(docs("failures"))?
        .filter_map(Result::ok)
        .filter(|entry| entry.path().extension().is_some_and(|end| end == "svg"));
    assert_eq!(pictures.count(), cases.len());
    for verdict in Verdict::ALL {
        assert!(
            page.contains(&format!("| {} |", verdict.name())),
            "{}",
            verdict.name()
        );
    }
    Ok(())
}
