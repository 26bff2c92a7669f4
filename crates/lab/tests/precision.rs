//! `softstop chart precision`: what it measures, and how users and scripts meet it.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;
use softstop::{Impact, Scene, Start};
use softstop_console::scene_file;
use softstop_lab::methods::{Integrator, MethodError, Solution, Task, Work};
use softstop_lab::precision::case::{self, BUILT_IN};
use softstop_lab::precision::errors::Scale;
use softstop_lab::precision::family::{self, Family, Look};
use softstop_lab::precision::measure::{Bench, Effort, Outcome as Run, Row};
use softstop_lab::precision::truth::Truth;

type Outcome = Result<(), Box<dyn std::error::Error>>;

fn docs(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
        .join("../../docs")
        .join(name)
}

fn softstop(arguments: &[&str]) -> std::io::Result<Output> {
    Command::new(env!("CARGO_BIN_EXE_softstop-lab"))
        .args(["chart", "precision"])
        .args(arguments)
        .output()
}

/// Runs a scene as fast as may be and returns the JSON of its one chart.
fn chart(scene: &str, folder: &Path, more: &[&str]) -> Result<Value, Box<dyn std::error::Error>> {
    let folder = folder.to_str().ok_or("path")?;
    let basic = [scene, "--quick", "--format", "json", "--output", folder];
    let output = softstop(&[&basic[..], more].concat())?;
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{scene}: {message}");
    let mut report: Value = serde_json::from_slice(&output.stdout)?;
    Ok(report["charts"][0].take())
}

fn refuses(arguments: &[&str], words: &[&str]) -> Outcome {
    let output = softstop(arguments)?;
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
    assert!(output.stdout.is_empty(), "{arguments:?} wrote to stdout");
    for word in words {
        assert!(message.contains(word), "{word:?} is not in {message:?}");
    }
    Ok(())
}

/// A scene of `docs/scenes` for some periods.
fn task(file: &str, periods: f64) -> Result<Task, Box<dyn std::error::Error>> {
    let text = fs::read_to_string(docs("scenes").join(file))?;
    let file = scene_file::parse(&text)?;
    Ok(Task {
        scene: file.scene,
        start: file.start,
        periods,
        most_steps: u64::MAX,
    })
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

fn rows(task: &Task, family: &Family) -> Result<Vec<Row>, Box<dyn std::error::Error>> {
    let told = |failure: softstop_console::failure::Failure| failure.to_string();
    let scale = Scale::of(task)?;
    let truth = Truth::of(task, &scale, &|_| {}).map_err(told)?;
    let bench = Bench {
        task,
        truth: &truth,
        scale,
        effort: ONCE,
    };
    Ok(bench.family(family, &|| {}).map_err(told)?)
}

fn end_error(row: &Row) -> f64 {
    match &row.outcome {
        Run::Done { errors, .. } => errors.end,
        other => panic!("{} {:?}: {other:?}", row.method, row.knob),
    }
}

/// Heun's method on the oscillator without a stop, of second order.
struct Heun {
    steps: u64,
}

impl Integrator for Heun {
    fn name(&self) -> String {
        "Heun".to_owned()
    }

    fn integrate(&self, task: &Task) -> Result<Solution, MethodError> {
        let Scene {
            mass,
            stiffness,
            damping,
            excitation: drive,
            ..
        } = task.scene;
        let acceleration = |t: f64, (x, v): (f64, f64)| {
            let force = drive.amplitude * (drive.frequency * t + drive.phase).cos();
            (force - damping * v - stiffness * x) / mass
        };
        let h = task.duration() / self.steps as f64;
        let Start { position, velocity } = task.start;
        let (mut x, mut v) = (position, velocity);
        for step in 0..self.steps {
            let t = step as f64 * h;
            let a = acceleration(t, (x, v));
            let b = acceleration(t + h, (x + h * v, v + h * a));
            (x, v) = (x + h * v + 0.5 * h * h * a, v + 0.5 * h * (a + b));
        }
        Ok(Solution {
            end: (x, v),
            impacts: Vec::new(),
            work: Work {
                steps: self.steps,
                evaluations: 2 * self.steps,
            },
        })
    }
}

#[test]
fn the_error_of_a_method_falls_with_its_order() -> Outcome {
    let task = task("none.toml", 2.0)?;
    let knobs = [1e-2, 5e-3, 2.5e-3];
    let heun = Family::new("Heun", LOOK, knobs, |knob| Heun {
        steps: (2.0 / knob) as u64,
    });
    let errors: Vec<f64> = rows(&task, &heun)?.iter().map(end_error).collect();
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((order - 2.0).abs() < 0.1, "{errors:?}");
    }
    Ok(())
}

#[test]
fn the_exact_method_is_exact_to_rounding_on_short_runs() -> Outcome {
    for (file, periods) in [
        ("preloaded.toml", 3.0),
        ("loaded.toml", 2.0),
        ("sticking.toml", 1.2),
    ] {
        let task = task(file, periods)?;
        let row = &rows(&task, &Family::exact())?[0];
        let Run::Done {
            errors, impacts, ..
        } = &row.outcome
        else {
            panic!("{file}: {:?}", row.outcome);
        };
        assert!(errors.worst() < 1e-13, "{file}: {errors:?}");
        assert!(*impacts > 0, "{file}");
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
    let task = task("preloaded.toml", 3.0)?;
    let errors = |wrong: fn(&mut Solution)| {
        let family = Family::new("wrong", LOOK, [1.0], move |_| Wrong(wrong));
        let rows = rows(&task, &family)?;
        match rows[0].outcome {
            Run::Done { errors, .. } => Ok(errors),
            ref other => Err(Box::<dyn std::error::Error>::from(format!("{other:?}"))),
        }
    };
    let late = errors(|solution| solution.impacts[1].time += 1e-3)?;
    let period = task.scene.period();
    assert!((late.impact_time.ok_or("time")? - 1e-3 / period).abs() < 1e-13);
    assert!(late.end < 1e-13);
    let doubled = errors(|solution| {
        let first: Impact = solution.impacts[0];
        solution.impacts.insert(0, first);
    })?;
    assert_eq!(doubled.impact_difference, 1);
    assert_eq!(doubled.worst(), f64::INFINITY);
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
    let task = task("preloaded.toml", 1.0)?;
    let rows = rows(&task, &Family::new("fails", LOOK, [1.0, 0.2, 0.01], Fails))?;
    assert_eq!(
        rows[0].outcome,
        Run::Failed("blown up near t = 3 s".to_owned())
    );
    assert!(matches!(rows[1].outcome, Run::Failed(_)));
    assert!(end_error(&rows[2]) < 1e-13);
    Ok(())
}

#[test]
fn a_power_law_is_measured_against_methods_that_agree() -> Outcome {
    let task = task("hertz.toml", 2.0)?;
    let scale = Scale::of(&task)?;
    let truth = Truth::of(&task, &scale, &|_| {}).map_err(|failure| failure.to_string())?;
    let doubt = truth.doubt.worst();
    assert!(doubt > 0.0 && doubt < 1e-10, "{doubt}");
    let exact = softstop_lab::methods::Exact.integrate(&task)?;
    assert_eq!(truth.errors_of(&exact, &scale).end, truth.doubt.end);
    Ok(())
}

#[test]
fn json_and_csv_have_a_row_for_every_setting_of_every_method() -> Outcome {
    let folder = tempfile::tempdir()?;
    let report = chart(
        "chatter",
        folder.path(),
        &["--periods", "0.9", "--budget", "0.02"],
    )?;
    let rows = report["rows"].as_array().ok_or("rows")?;
    let task = task("chatter.toml", 0.9)?;
    let families = family::all(&task.scene, true);
    let settings = families.iter().map(|family| family.settings.len());
    assert_eq!(rows.len(), settings.sum::<usize>());
    for family in &families {
        let own = rows.iter().filter(|row| row["method"] == *family.name);
        assert_eq!(own.count(), family.settings.len(), "{}", family.name);
    }
    for row in rows {
        let done = row["status"] == "done";
        assert_eq!(done, row["end_error"].is_number(), "{row}");
        assert_eq!(
            done,
            row["seconds"].as_f64().is_some_and(|s| s > 0.0),
            "{row}"
        );
        assert_eq!(done, row["reason"].is_null(), "{row}");
    }
    assert_eq!(rows[0]["method"], "exact");
    assert!(rows[0]["end_error"].as_f64().ok_or("error")? < 1e-14);
    assert!(report["reference"]["digits"].as_u64().ok_or("digits")? >= 40);
    assert!(!report["lead"]["at"].as_array().ok_or("lead")?.is_empty());
    for key in ["cpu", "cores", "os", "rustc"] {
        assert!(!report["machine"][key].is_null(), "{key}");
    }
    let table = fs::read_to_string(folder.path().join("chatter.csv"))?;
    assert_eq!(table.lines().count(), 1 + rows.len());
    let file: Value = serde_json::from_slice(&fs::read(folder.path().join("chatter.json"))?)?;
    assert_eq!(file["rows"], report["rows"]);
    let drawn = fs::read_to_string(folder.path().join("chatter.svg"))?;
    assert!(families.iter().all(|family| drawn.contains(&family.name)));
    Ok(())
}

#[test]
fn any_scene_file_can_be_measured() -> Outcome {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("my machine.toml");
    fs::copy(docs("scenes").join("kelvin-voigt.toml"), &file)?;
    let more = [
        "--periods",
        "2",
        "--method",
        "RK4",
        "--method",
        "tsit45",
        "--budget",
        "0.05",
    ];
    let report = chart(file.to_str().ok_or("path")?, folder.path(), &more)?;
    assert_eq!(report["scene"], "my machine");
    let mut names: Vec<&str> = report["rows"]
        .as_array()
        .ok_or("rows")?
        .iter()
        .filter_map(|row| row["method"].as_str())
        .collect();
    names.dedup();
    let expected = [
        "exact",
        "RK4, events located",
        "RK4, events ignored",
        "diffsol tsit45",
    ];
    assert_eq!(names, expected);
    assert!(folder.path().join("my machine.svg").is_file());
    Ok(())
}

#[test]
fn bad_values_are_named() -> Outcome {
    refuses(
        &["periodic", "--periods", "0"],
        &["periods = 0", "above 0 to 100000"],
    )?;
    refuses(&["periodic", "--periods", "nan"], &["periods = NaN"])?;
    refuses(&["periodic", "--periods", "-1"], &["periods = -1"])?;
    refuses(
        &["periodic", "--budget", "0"],
        &["budget = 0", "0.001 to 3600"],
    )?;
    refuses(&["periodic", "--method", "rk5"], &["method = rk5", "RK4"])?;
    refuses(&["periodic", "--method", ""], &["method = :", "RK4"])?;
    refuses(
        &["smooth"],
        &["scene = smooth", "periodic", "sticking", "TOML"],
    )
}

#[test]
fn a_start_behind_a_rigid_stop_is_refused() -> Outcome {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("behind.toml");
    let text = fs::read_to_string(docs("scenes").join("rigid.toml"))?;
    fs::write(&file, text.replace("position = 6.9", "position = 16.9"))?;
    refuses(&[file.to_str().ok_or("path")?], &["position", "16.9"])
}

#[cfg(unix)]
#[test]
fn an_interrupt_leaves_nothing_behind() -> Outcome {
    let folder = tempfile::tempdir()?;
    let target = folder.path().join("charts");
    let mut run = Command::new(env!("CARGO_BIN_EXE_softstop-lab"))
        .args(["chart", "precision", "all", "--budget", "5", "--output"])
        .arg(&target)
        .stderr(std::process::Stdio::null())
        .spawn()?;
    let begin = std::time::Instant::now();
    while !target.is_dir() && begin.elapsed().as_secs() < 20 {
        std::thread::sleep(std::time::Duration::from_millis(10));
    }
    Command::new("kill")
        .args(["-INT", &run.id().to_string()])
        .status()?;
    assert_eq!(run.wait()?.code(), Some(130));
    assert!(!target.exists());
    Ok(())
}

#[test]
fn every_built_in_scene_is_on_the_page_with_its_chart() -> Outcome {
    let page = fs::read_to_string(docs("accuracy.md"))?;
    for built_in in BUILT_IN {
        let chart = format!("accuracy/{}.svg", built_in.name);
        assert!(page.contains(&format!("({chart})")), "{chart}");
        let drawn = fs::read_to_string(docs(&chart))?;
        assert!(drawn.contains(built_in.title), "{chart}");
        assert!(drawn.len() < 200_000, "{chart}");
        let cases = case::cases(built_in.name, None).map_err(|failure| failure.to_string())?;
        assert_eq!(cases.len(), 1);
    }
    Ok(())
}

#[test]
fn help_teaches_by_example() -> Outcome {
    let text = String::from_utf8(softstop(&["--help"])?.stdout)?;
    assert!(
        text.contains("Examples:\n  softstop chart precision"),
        "{text}"
    );
    for built_in in BUILT_IN {
        assert!(text.contains(built_in.name), "{}", built_in.name);
    }
    Ok(())
}
