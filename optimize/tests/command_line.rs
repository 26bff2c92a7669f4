//! The program as users and scripts meet it: JSON keys, exit codes, messages, files.

#[path = "command_line/names.rs"]
mod names;
#[path = "command_line/optimize.rs"]
mod optimize;
#[path = "command_line/refusals.rs"]
mod refusals;
#[path = "command_line/tasks.rs"]
mod tasks;

use std::fs;

use approx::assert_abs_diff_eq;
use serde_json::Value;
use softstop_testing::{Program, words};

type Outcome = Result<(), Box<dyn std::error::Error>>;

const SOFTSTOP: Program = Program {
    file: env!("CARGO_BIN_EXE_softstop"),
    first: &[],
};

fn json(arguments: &[&str]) -> Result<Value, Box<dyn std::error::Error>> {
    Ok(serde_json::from_str(&SOFTSTOP.text(arguments))?)
}

fn number(value: &Value, key: &str) -> f64 {
    value[key]
        .as_f64()
        .unwrap_or_else(|| panic!("{key} is not a number in {value}"))
}

#[track_caller]
fn near(found: f64, expected: f64, tolerance: f64) {
    assert_abs_diff_eq!(found, expected, epsilon = tolerance);
}

#[test]
fn orbit_at_point_a() -> Outcome {
    let orbit = json(&words(
        "orbit --regime unloaded --frequency 1.15 --clearance 10 --format json",
    ))?;
    near(number(&orbit, "frequency"), 1.15, 0.0);
    near(number(&orbit, "clearance"), 10.0, 0.0);
    near(number(&orbit, "before_impact_velocity"), 6.494627, 5e-7);
    near(number(&orbit, "max_position"), 10.26059, 5e-6);
    near(number(&orbit, "position"), 6.901267951548, 1e-10);
    near(number(&orbit, "velocity"), 9.516655745459, 1e-10);
    near(number(&orbit, "trace"), 1.1998, 5e-5);
    near(number(&orbit, "determinant"), 0.7858, 5e-5);
    let multipliers = orbit["multipliers"]
        .as_array()
        .ok_or("multipliers is no list")?;
    let (first, second) = (&multipliers[0], &multipliers[1]);
    near(
        number(first, "re") + number(second, "re"),
        number(&orbit, "trace"),
        1e-12,
    );
    near(number(first, "im") + number(second, "im"), 0.0, 1e-12);
    Ok(())
}

#[test]
fn orbit_at_point_b() -> Outcome {
    let orbit = json(&["orbit", "--regime", "loaded", "--format", "json"])?;
    near(number(&orbit, "before_impact_velocity"), 8.39868, 5e-6);
    // Confirmed by an independent Runge-Kutta integration (order 8, tolerance 1e-12).
    near(number(&orbit, "max_position"), 11.155995, 1e-6);
    Ok(())
}

#[test]
fn preload_as_a_deflection_is_the_papers_reading() -> Outcome {
    let mut force = json(&["orbit", "--preload", "70", "--format", "json"])?;
    let mut deflection = json(&["orbit", "--preload-deflection", "10", "--format", "json"])?;
    // Each is told as it was stated.
    let stated = [&mut force, &mut deflection].map(|report| report["machine"]["parameters"].take());
    assert_eq!(stated[0]["stop.preload"], 70.0);
    assert_eq!(stated[1]["stop.preload_deflection"], 10.0);
    assert_eq!(force, deflection);
    Ok(())
}

#[test]
fn zone_of_the_paper() -> Outcome {
    let zone = json(&["zone", "--clearance", "10", "--format", "json"])?;
    near(number(&zone, "frequency_g0"), 1.04444, 5e-6);
    near(number(&zone, "frequency_sn"), 1.369036, 5e-7);
    near(number(&zone, "velocity_sn"), 16.87, 5e-3);
    near(number(&zone, "clearance"), 10.0, 0.0);
    near(number(&zone, "stiffness"), 7.0, 0.0);
    Ok(())
}

#[test]
fn zone_lists_all_stretches() -> Outcome {
    let zone = json(&["zone", "--clearance", "10", "--format", "json"])?;
    let stretches = zone["stretches"].as_array().ok_or("stretches")?;
    let own: Vec<_> = stretches
        .iter()
        .filter(|one| one["in_zone"] == true)
        .collect();
    let [own] = own[..] else {
        return Err(format!("{stretches:?}").into());
    };
    near(number(own, "from"), 0.988907, 5e-7);
    near(number(own, "to"), 1.369036, 5e-7);
    assert_eq!([&own["from_by"], &own["to_by"]], ["flip", "fold"]);
    Ok(())
}

/// No motion at g0 leads to its z = 1.
#[test]
fn an_isola_is_no_zone_and_is_listed() -> Outcome {
    let flags = "zone --regime loaded --clearance 4.966953067590672 --stiffness 1.4398692936028583 \
                 --preload 262.9190348246658 --damping 0.005802743231567894 --contact-damping 0.002011340630926028 \
                 --piercing-stiffness 2.2530448386935893 --piercing-friction 23.91485155268388 \
                 --thickness 0.8282795600642743 --travel 0.7915560771078273 --format json";
    let flags: Vec<&str> = flags.split_whitespace().collect();
    let zone = json(&flags)?;
    assert!(zone["frequency_sn"].is_null());
    assert!(
        zone["no_zone"]
            .as_str()
            .is_some_and(|why| why.contains("no stable z = 1 motion"))
    );
    let stretches = zone["stretches"].as_array().ok_or("stretches")?;
    let last = stretches.last().ok_or("a stretch")?;
    near(number(last, "to"), 1.6786, 5e-5);
    Ok(())
}

/// A motion that always impacts grazes nothing: no g0, and stretches all the same.
#[test]
fn without_a_grazing_boundary_stretches_are_listed() -> Outcome {
    let zone = json(&words("zone --clearance 0 --format json"))?;
    let why = zone["no_zone"].as_str().ok_or("why")?;
    assert!(why.contains("clearance = 0"), "{why}");
    let stretches = zone["stretches"].as_array().ok_or("stretches")?;
    for (frequency, is_stable) in [("2", true), ("2.7", false)] {
        let at: f64 = frequency.parse()?;
        let mut listed = stretches.iter();
        let holds = |one: &Value| (number(one, "from")..number(one, "to")).contains(&at);
        assert_eq!(listed.any(holds), is_stable);
        let orbit = SOFTSTOP.run(&["orbit", "--clearance", "0", "--frequency", frequency]);
        assert_eq!(orbit.status.success(), is_stable);
    }
    Ok(())
}

#[test]
fn without_damping_motions_are_neutral() -> Outcome {
    let orbit = json(&[
        "orbit",
        "--damping",
        "0",
        "--contact-damping",
        "0",
        "--format",
        "json",
    ])?;
    assert_eq!(orbit["stability"], "neutral");
    let orbit = json(&["orbit", "--format", "json"])?;
    assert_eq!(orbit["stability"], "stable");
    Ok(())
}

#[test]
fn scene_file_stands_below_the_command_line() -> Outcome {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("machine.toml");
    fs::write(
        &file,
        "regime = \"loaded\"\nfrequency = 1.2\nclearance = 10.0\nthickness = 0.4\n",
    )?;
    let path = file.to_str().ok_or("path")?;
    let from_file = json(&[
        "orbit",
        "--scene",
        path,
        "--frequency",
        "1.15",
        "--format",
        "json",
    ])?;
    let from_line = json(&["orbit", "--regime", "loaded", "--format", "json"])?;
    assert_eq!(from_file, from_line);
    Ok(())
}

#[test]
fn shorthands_and_keys_say_the_same() -> Outcome {
    let short = json(&words(
        "orbit --regime loaded --clearance 9 --stiffness 8 --thickness 0.3 --preload-deflection 10 --format json",
    ))?;
    let keys = json(&words(
        "orbit loaded --set clearance=9 --set stop.stiffness=8 --set sigma=0.3 --set stop.preload_deflection=10 --format json",
    ))?;
    assert_eq!(short, keys);
    Ok(())
}

#[test]
fn the_schema_is_printed() -> Outcome {
    let schema = json(&["schema"])?;
    assert_eq!(
        schema["$schema"],
        "https://json-schema.org/draft/2020-12/schema"
    );
    Ok(())
}

#[test]
fn help_teaches_by_example() {
    for command in ["orbit", "zone", "optimize"] {
        let text = SOFTSTOP.text(&[command, "--help"]);
        assert!(
            text.contains(&format!("Examples:\n  softstop {command}")),
            "{text}"
        );
        assert!(text.contains("--format"), "{text}");
    }
}
