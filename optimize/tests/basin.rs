//! `softstop basin` as users and scripts meet it.

use approx::assert_abs_diff_eq;
use softstop_testing::tolerance::{GROWN, MOTION};
use std::fs;

use serde_json::Value;
use softstop_testing::Program;

type Outcome = Result<(), Box<dyn std::error::Error>>;

const BASIN: Program = Program {
    file: env!("CARGO_BIN_EXE_softstop"),
    first: &["basin"],
};

/// The names of the motions and the sum of their shares.
fn motions(report: &Value) -> (Vec<&str>, f64) {
    let basins = report["basins"].as_array().expect("a list");
    let names = basins
        .iter()
        .map(|basin| basin["z"].as_str().or(basin["kind"].as_str()));
    let shares = basins.iter().map(|basin| basin["share"].as_f64());
    (
        names.map(|name| name.expect("a name")).collect(),
        shares.map(|share| share.expect("a number")).sum(),
    )
}

#[test]
fn point_a_has_two_basins_and_the_same_in_all_files() -> Outcome {
    let folder = tempfile::tempdir()?;
    let report = BASIN.json_into(folder.path(), &["--size", "60"]);
    let (names, all) = motions(&report);
    assert_eq!(names, ["0", "1"]);
    assert_abs_diff_eq!(all, 1.0, epsilon = MOTION);
    let one = &report["basins"][1];
    let velocity = one["before_impact_velocity"]
        .as_f64()
        .ok_or("no velocity")?;
    assert_abs_diff_eq!(velocity, 6.494_627_429, epsilon = GROWN);
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
    let report = BASIN.json_into(folder.path(), &[&plane[..], &["--size", "30"]].concat());
    let (names, _) = motions(&report);
    assert_eq!(names, ["2/3", "2/4", "chaos"]);
    assert_eq!(report["basins"][1]["order"], "1-1-0-0");
    assert!(report["basins"][2]["exponent"].as_f64() > Some(0.0));
    Ok(())
}

#[test]
fn near_grazing_nearly_all_starts_lead_to_impacts() -> Outcome {
    let folder = tempfile::tempdir()?;
    let report = BASIN.json_into(folder.path(), &["--along-zone", "3", "--size", "24"]);
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
fn the_zone_takes_the_box_of_the_machine() -> Outcome {
    let folder = tempfile::tempdir()?;
    let report = |arguments: &[&str]| BASIN.json_into(folder.path(), arguments);
    let size = ["--size", "4"];
    let along = report(&[&size[..], &["--along-zone", "2"]].concat());
    assert_eq!(along["grid"], report(&size)["grid"]);
    assert_eq!(along["widened"], false);
    // At a frequency far below the zone motions are slower, and the box is made wider for those of the zone.
    let slow = ["--size", "4", "--frequency", "0.2"];
    let along = report(&[&slow[..], &["--along-zone", "2"]].concat());
    assert_eq!(along["widened"], true);
    let high = |report: &Value| report["grid"]["up"]["range"][1].as_f64();
    assert!(high(&along) > high(&report(&slow)));
    Ok(())
}

#[test]
fn a_rigid_scene_over_the_drive_angle() -> Outcome {
    let folder = tempfile::tempdir()?;
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/scenes/rigid.toml");
    let report = BASIN.json_into(folder.path(), &[scene, "--plane", "phi,v", "--size", "16"]);
    let (_, all) = motions(&report);
    assert_abs_diff_eq!(all, 1.0, epsilon = MOTION);
    assert_eq!(report["grid"]["across"]["quantity"], "angle");
    Ok(())
}

#[test]
fn bad_values_are_named() {
    BASIN.refuses_and_writes_nothing(&["--size", "1"], &["size", "2 to 4000"]);
    BASIN.refuses_and_writes_nothing(&["--transient", "0"], &["transient", "1 to 1000000"]);
    BASIN.refuses_and_writes_nothing(&["--longest", "0"], &["longest"]);
    BASIN.refuses_and_writes_nothing(&["--x", "3:1"], &["--x", "LOW < HIGH"]);
    BASIN.refuses_and_writes_nothing(&["--plane", "x,x"], &["--plane", "two different"]);
    BASIN.refuses_and_writes_nothing(&["--at", "nan"], &["at"]);
    BASIN.refuses_and_writes_nothing(&["--along-zone", "1"], &["along-zone", "2 to 1000"]);
    BASIN.refuses_and_writes_nothing(&["--clearance", "-1e400"], &["clearance"]);
    BASIN.refuses_and_writes_nothing(&["none.toml"], &["none.toml"]);
}
