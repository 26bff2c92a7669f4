//! The program as users and scripts meet it: JSON keys, exit codes, messages, files.

mod names;
mod optimize;
mod tasks;

use serde_json::Value;
use softstop_testing::{assert_near, has_near, number, words};

use super::{Outcome, SOFTSTOP};

#[test]
fn orbit_at_point_a() {
    let orbit = SOFTSTOP.value("orbit unloaded --set eta=1.15 --set rho=10");
    let figures = [
        ("frequency", 1.15, 0.0),
        ("clearance", 10.0, 0.0),
        ("before_impact_velocity", 6.494627, 5e-7),
        ("max_position", 10.26059, 5e-6),
        ("position", 6.901267951548, 1e-10),
        ("velocity", 9.516655745459, 1e-10),
        ("trace", 1.1998, 5e-5),
        ("determinant", 0.7858, 5e-5),
    ];
    has_near(&orbit, &figures);
    let sum = |part: &str| {
        let parts = [0, 1].map(|index| number(&orbit, &format!("multipliers/{index}/{part}")));
        parts[0] + parts[1]
    };
    assert_near(sum("re"), number(&orbit, "trace"), 1e-12);
    assert_near(sum("im"), 0.0, 1e-12);
}

#[test]
fn preload_as_a_deflection_is_the_papers_reading() {
    let mut force = SOFTSTOP.value("orbit --set stop.preload=70");
    let mut deflection = SOFTSTOP.value("orbit --set stop.preload_deflection=10");
    // Each is told as it was stated.
    let stated = [&mut force, &mut deflection].map(|report| report["machine"]["parameters"].take());
    assert_eq!(stated[0]["stop.preload"], 70.0);
    assert_eq!(stated[1]["stop.preload_deflection"], 10.0);
    assert_eq!(force, deflection);
}

/// The zone of the paper, and all its stretches.
#[test]
fn zone_of_the_paper() {
    let zone = SOFTSTOP.value("zone --set rho=10");
    let figures = [
        ("frequency_g0", 1.04444, 5e-6),
        ("frequency_sn", 1.369036, 5e-7),
        ("velocity_sn", 16.87, 5e-3),
        ("clearance", 10.0, 0.0),
        ("stiffness", 7.0, 0.0),
    ];
    has_near(&zone, &figures);
    let all = zone["stretches"].as_array().expect("a list").iter();
    let own: Vec<_> = all.filter(|one| one["in_zone"] == true).collect();
    assert_eq!(own.len(), 1, "{zone}");
    has_near(own[0], &[("from", 0.988907, 5e-7), ("to", 1.369036, 5e-7)]);
    assert_eq!([&own[0]["from_by"], &own[0]["to_by"]], ["flip", "fold"]);
}

/// Nothing strikes, and nothing is refused.
#[test]
fn beyond_all_motions_there_is_no_zone_and_no_stretch() {
    let zone = SOFTSTOP.value("zone --set rho=30");
    let why = zone["no_zone"].as_str().expect("why");
    assert!(why.contains("clearance = 30"), "{why}");
    assert_eq!(zone["stretches"], serde_json::json!([]));
}

/// A motion that always impacts grazes nothing: no g0, and stretches all the same.
#[test]
fn without_a_grazing_boundary_stretches_are_listed() -> Outcome {
    let zone = SOFTSTOP.value("zone --set rho=0");
    let why = zone["no_zone"].as_str().ok_or("why")?;
    assert!(why.contains("clearance = 0"), "{why}");
    assert!(zone["frequency_sn"].is_null());
    let stretches = zone["stretches"].as_array().ok_or("stretches")?;
    for (frequency, is_stable) in [("2", true), ("2.7", false)] {
        let at: f64 = frequency.parse()?;
        let holds = |one: &Value| (number(one, "from")..number(one, "to")).contains(&at);
        assert_eq!(stretches.iter().any(holds), is_stable);
        let orbit = SOFTSTOP.run(&words(&format!("orbit --set rho=0 --set eta={frequency}")));
        assert_eq!(orbit.status.success(), is_stable);
    }
    Ok(())
}

#[test]
fn without_damping_motions_are_neutral() {
    let stability = |line: &str| SOFTSTOP.value(line)["stability"].clone();
    assert_eq!(
        stability("orbit --set damping=0 --set contact.damping=0"),
        "neutral"
    );
    assert_eq!(stability("orbit"), "stable");
}

#[test]
fn the_schema_is_printed() -> Outcome {
    let schema: Value = serde_json::from_str(&SOFTSTOP.text(&["schema"]))?;
    let draft = "https://json-schema.org/draft/2020-12/schema";
    assert_eq!(schema["$schema"], draft);
    Ok(())
}

#[test]
fn help_teaches_by_example() {
    for command in ["orbit", "zone", "optimize", "simulate", "watch", "stops"] {
        let text = SOFTSTOP.text(&[command, "--help"]);
        let example = format!("Examples:\n  softstop {command}");
        assert!(text.contains(&example), "{text}");
        assert!(command == "stops" || text.contains("--format"), "{text}");
    }
}
