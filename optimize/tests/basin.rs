//! `softstop basin` as users and scripts meet it.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};
use std::time::{Duration, Instant};

use serde_json::Value;

type Outcome = Result<(), Box<dyn std::error::Error>>;

fn basin(folder: &Path, arguments: &[&str]) -> std::io::Result<Output> {
    Command::new(env!("CARGO_BIN_EXE_softstop"))
        .args(["basin", "--output"])
        .arg(folder)
        .args(arguments)
        .output()
}

fn json(folder: &Path, arguments: &[&str]) -> Result<Value, Box<dyn std::error::Error>> {
    let arguments = [arguments, &["--format", "json"]].concat();
    let output = basin(folder, &arguments)?;
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{message}");
    Ok(serde_json::from_slice(&output.stdout)?)
}

/// The names of the motions and the sum of their shares.
fn motions(report: &Value) -> (Vec<&str>, f64) {
    let basins = report["basins"].as_array().expect("a list");
    let names = basins.iter().map(|basin| basin["motion"].as_str());
    let shares = basins.iter().map(|basin| basin["share"].as_f64());
    (
        names.map(|name| name.expect("a name")).collect(),
        shares.map(|share| share.expect("a number")).sum(),
    )
}

#[test]
fn point_a_has_two_basins_and_the_same_in_all_files() -> Outcome {
    let folder = tempfile::tempdir()?;
    let report = json(folder.path(), &["--size", "60"])?;
    let (names, all) = motions(&report);
    assert_eq!(names, ["z = 0", "z = 1"]);
    assert!((all - 1.0).abs() < 1e-12);
    let one = &report["basins"][1];
    let velocity = one["before_impact_velocity"]
        .as_f64()
        .ok_or("no velocity")?;
    assert!((velocity - 6.494_627_429).abs() < 1e-8);
    let share = one["share"].as_f64().ok_or("no share")?;
    let low = one["share_low"].as_f64().ok_or("no interval")?;
    let high = one["share_high"].as_f64().ok_or("no interval")?;
    assert!(low < share && share < high && high - low < 0.04);
    let integrity = one["integrity"].as_f64().ok_or("no integrity")?;
    assert!(0.0 < integrity && integrity < 1.0);
    let file: Value = serde_json::from_slice(&fs::read(folder.path().join("basin.json"))?)?;
    assert_eq!(file, report);
    let table = fs::read_to_string(folder.path().join("basin.csv"))?;
    assert_eq!(table.lines().count(), 3);
    let picture = fs::read(folder.path().join("basin.png"))?;
    assert!(picture.starts_with(b"\x89PNG"));
    assert_eq!(fs::read_dir(folder.path())?.count(), 3);
    Ok(())
}

#[test]
fn chaos_and_two_isolated_motions_are_found_side_by_side() -> Outcome {
    let folder = tempfile::tempdir()?;
    let plane = ["--frequency", "0.9875", "--x", "0:15", "--v=-20:20"];
    let report = json(folder.path(), &[&plane[..], &["--size", "30"]].concat())?;
    let (names, _) = motions(&report);
    assert_eq!(names, ["z = 2/3", "z = 2/4", "chaos"]);
    assert_eq!(report["basins"][1]["order"], "1-1-0-0");
    assert!(report["basins"][2]["exponent"].as_f64() > Some(0.0));
    Ok(())
}

#[test]
fn near_grazing_nearly_all_starts_lead_to_impacts() -> Outcome {
    let folder = tempfile::tempdir()?;
    let report = json(folder.path(), &["--along-zone", "3", "--size", "24"])?;
    let places = report["places"].as_array().ok_or("no places")?;
    let certainty = |place: usize| places[place]["certainty"].as_f64().unwrap_or(f64::NAN);
    assert!(certainty(0) > 0.98 && certainty(2) < 0.2);
    assert!(certainty(0) > certainty(1) && certainty(1) > certainty(2));
    let table = fs::read_to_string(folder.path().join("certainty.csv"))?;
    assert_eq!(table.lines().count(), 4);
    assert!(fs::read_to_string(folder.path().join("certainty.svg"))?.starts_with("<svg"));
    Ok(())
}

#[test]
fn a_rigid_scene_over_the_drive_angle() -> Outcome {
    let folder = tempfile::tempdir()?;
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/scenes/rigid.toml");
    let report = json(folder.path(), &[scene, "--plane", "phi,v", "--size", "16"])?;
    let (_, all) = motions(&report);
    assert!((all - 1.0).abs() < 1e-12);
    assert_eq!(report["grid"]["across"]["quantity"], "angle");
    Ok(())
}

/// Runs the program where it has to fail, and checks exit code and message.
#[track_caller]
fn refuses(arguments: &[&str], words: &[&str]) {
    let folder = tempfile::tempdir().expect("a folder");
    let target = folder.path().join("basin");
    let output = basin(&target, arguments).expect("the program starts");
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
    assert!(output.stdout.is_empty() && !target.exists());
    for word in words {
        assert!(message.contains(word), "{arguments:?}: {message:?}");
    }
}

#[test]
fn bad_values_are_named() {
    refuses(&["--size", "1"], &["size", "2 to 4000"]);
    refuses(&["--transient", "0"], &["transient", "1 to 1000000"]);
    refuses(&["--longest", "0"], &["longest"]);
    refuses(&["--x", "3:1"], &["--x", "LOW < HIGH"]);
    refuses(&["--plane", "x,x"], &["--plane", "two different"]);
    refuses(&["--at", "nan"], &["at"]);
    refuses(&["--along-zone", "1"], &["along-zone", "2 to 1000"]);
    refuses(&["--clearance", "-1e400"], &["clearance"]);
    refuses(&["none.toml"], &["none.toml"]);
    let along = ["--along-zone", "3"];
    refuses(
        &[&along[..], &["--frequency", "1.2"]].concat(),
        &["frequency", "is not used"],
    );
}

#[cfg(unix)]
#[test]
fn an_interrupt_leaves_nothing_behind() -> Outcome {
    let folder = tempfile::tempdir()?;
    let target = folder.path().join("basin");
    let mut run = Command::new(env!("CARGO_BIN_EXE_softstop"))
        .args(["basin", "--size", "4000", "--output"])
        .arg(&target)
        .stderr(std::process::Stdio::piped())
        .spawn()?;
    let deadline = Instant::now() + Duration::from_secs(20);
    while !target.is_dir() && Instant::now() < deadline {
        std::thread::sleep(Duration::from_millis(10));
    }
    std::thread::sleep(Duration::from_millis(300));
    Command::new("kill")
        .args(["-INT", &run.id().to_string()])
        .status()?;
    assert_eq!(run.wait()?.code(), Some(130));
    assert!(!target.exists());
    Ok(())
}
