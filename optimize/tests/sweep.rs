//! `softstop sweep` as users and scripts meet it.

use approx::assert_abs_diff_eq;
use softstop_testing::tolerance::MOTION;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};
use std::time::{Duration, Instant};

use serde_json::Value;
use softstop_testing::{Program, words};

type Outcome = Result<(), Box<dyn std::error::Error>>;

const SWEEP: Program = Program {
    file: env!("CARGO_BIN_EXE_softstop"),
    first: &["sweep"],
};

fn sweep(folder: &Path, arguments: &[&str]) -> Output {
    let folder = folder.to_str().expect("UTF-8");
    SWEEP.run(&[&["--output", folder], arguments].concat())
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or(f64::NAN)
}

#[test]
fn the_hysteresis_zone_of_clearance_10() -> Outcome {
    let folder = tempfile::tempdir()?;
    let range = ["--from", "1.02", "--to", "1.4"];
    let few = ["--steps", "39", "--periods", "300"];
    let report = SWEEP.json_into(folder.path(), &[range, few].concat());
    assert_eq!(report["parameter"], "excitation.frequency");
    assert_abs_diff_eq!(
        number(&report["rate_per_period"]),
        0.01 / 300.0,
        epsilon = MOTION
    );
    // Up: z = 1 up to the fold at 1.369036, which the step of 1.37 passes too slowly to settle. Down: z = 0
    // down to g0 = 1.04444.
    let zones = report["hysteresis"].as_array().ok_or("no zones")?;
    assert_eq!(zones.len(), 1);
    assert_eq!(
        (&zones[0]["up"]["z"], &zones[0]["down"]["z"]),
        (&"1".into(), &"0".into())
    );
    assert_abs_diff_eq!(number(&zones[0]["from"]), 1.05, epsilon = 1e-9);
    assert_abs_diff_eq!(number(&zones[0]["to"]), 1.36, epsilon = 1e-9);
    let file: Value = serde_json::from_slice(&fs::read(folder.path().join("sweep.json"))?)?;
    assert_eq!(file, report);
    let table = fs::read_to_string(folder.path().join("sweep.csv"))?;
    assert_eq!(table.lines().count(), 79);
    assert!(fs::read_to_string(folder.path().join("sweep.svg"))?.starts_with("<svg"));
    assert_eq!(fs::read_dir(folder.path())?.count(), 3);
    Ok(())
}

#[test]
fn a_rigid_scene_is_swept_in_si_units() -> Outcome {
    let folder = tempfile::tempdir()?;
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/scenes/rigid.toml");
    let range = words("--from 1 --to 3 --steps 21 --periods 50");
    let report = SWEEP.json_into(folder.path(), &[&[scene], &range[..]].concat());
    assert_eq!(report["sweeps"].as_array().map(Vec::len), Some(2));
    assert_eq!(report["sweeps"][0]["steps"], 21);
    Ok(())
}

#[test]
fn bad_values_are_named() {
    let with = |rest: &[&'static str]| [&["--from", "0.8", "--to", "1.8"], rest].concat();
    SWEEP.refuses_and_writes_nothing(&["--from", "1", "--to", "1"], &["range", "rising"]);
    SWEEP.refuses_and_writes_nothing(&with(&["--steps", "1"]), &["steps", "2 to 1000000"]);
    SWEEP.refuses_and_writes_nothing(&with(&["--periods", "0"]), &["periods"]);
    SWEEP.refuses_and_writes_nothing(&with(&["--tolerance", "1"]), &["tolerance", "> 0 and < 1"]);
    SWEEP.refuses_and_writes_nothing(
        &with(&["--parameter", "restitution"]),
        &["--parameter restitution", "has no"],
    );
    SWEEP.refuses_and_writes_nothing(&with(&["--parameter", "colour"]), &["colour"]);
    SWEEP.refuses_and_writes_nothing(&with(&["--clearances", "2,x"]), &["--clearances"]);
    SWEEP.refuses_and_writes_nothing(&["--from", "-1", "--to", "1"], &["frequency"]);
    SWEEP.refuses_and_writes_nothing(
        &with(&["--steps", "600000"]),
        &["600000 in each of 2 sweeps", "0.6 GB"],
    );
    SWEEP.refuses_and_writes_nothing(
        &with(&["--frequency", "1.2"]),
        &["frequency", "is not used"],
    );
}

#[test]
fn a_machine_is_swept_downwards_along_its_mass() -> Outcome {
    let folder = tempfile::tempdir()?;
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/scenes/rigid.toml");
    let machine = [scene, "--set", "clearance=1", "--parameter", "mass"];
    let range = words("--from 2 --to 1 --steps 5 --periods 20");
    let report = SWEEP.json_into(folder.path(), &[&machine[..], &range[..]].concat());
    assert_eq!(
        (&report["parameter"], &report["unit"]),
        (&"mass".into(), &"kg".into())
    );
    let sweeps = report["sweeps"].as_array().ok_or("no sweeps")?;
    assert_eq!(sweeps.len(), 1);
    assert_eq!(sweeps[0]["direction"], "down");
    let chart = fs::read_to_string(folder.path().join("sweep.svg"))?;
    for words in ["mass (kg)", "before-impact velocity (m/s)"] {
        assert!(chart.contains(words), "{words}");
    }
    Ok(())
}

#[cfg(unix)]
#[test]
fn an_interrupted_sweep_goes_on_to_the_same_result() -> Outcome {
    let folder = tempfile::tempdir()?;
    let (whole, part) = (folder.path().join("whole"), folder.path().join("part"));
    let line = words("--from 0.9 --to 1.1 --steps 2000 --periods 2000");
    let kept = part.join("sweep.part");
    let mut run = Command::new(env!("CARGO_BIN_EXE_softstop"))
        .args(["sweep", "--output"])
        .arg(&part)
        .args(&line)
        .stderr(std::process::Stdio::piped())
        .spawn()?;
    let deadline = Instant::now() + Duration::from_secs(20);
    while !kept.is_file() && Instant::now() < deadline {
        std::thread::sleep(Duration::from_millis(5));
    }
    // It is there already: that is no wrong usage.
    let beside = sweep(&part, &[&line[..], &["--resume"]].concat());
    assert_eq!(beside.status.code(), Some(1));
    Command::new("kill")
        .args(["-INT", &run.id().to_string()])
        .status()?;
    assert_eq!(run.wait()?.code(), Some(130));
    assert!(kept.is_file() && !part.join("sweep.csv").exists());

    // Other arguments are another sweep.
    let other = [&line[..7], &["1999", "--resume"]].concat();
    assert_eq!(sweep(&part, &other).status.code(), Some(2));
    // What is damaged is done anew.
    let mut bytes = fs::read(&kept)?;
    *bytes.last_mut().ok_or("nothing is kept")? ^= 1;
    fs::write(&kept, bytes)?;
    let resumed = sweep(&part, &[&line[..], &["--resume"]].concat());
    let message = String::from_utf8_lossy(&resumed.stderr);
    assert!(resumed.status.success(), "{message}");
    assert!(!kept.exists());
    // With nothing to go on with, the sweep begins.
    assert!(
        sweep(&whole, &[&line[..], &["--resume"]].concat())
            .status
            .success()
    );
    for file in ["sweep.csv", "sweep.svg"] {
        assert_eq!(fs::read(part.join(file))?, fs::read(whole.join(file))?);
    }
    Ok(())
}
