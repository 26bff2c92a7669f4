//! `softstop fidelity` as users and scripts meet it.

use approx::assert_abs_diff_eq;
use softstop_testing::tolerance::DIFFERENCED;
use std::fs;
use std::path::Path;

use serde_json::Value;
use softstop_testing::Program;

type Outcome = Result<(), Box<dyn std::error::Error>>;

const FIDELITY: Program = Program {
    file: env!("CARGO_BIN_EXE_softstop"),
    first: &["fidelity"],
};

/// Timed once only: the times are not looked at.
fn fidelity(scene: &str, folder: &Path, more: &[&str]) -> Value {
    let quick = [scene, "--periods", "50", "--repeats", "1"];
    FIDELITY.json_into(folder, &[&quick, more].concat())
}

fn scene(name: &str) -> String {
    format!("{}/../docs/scenes/{name}", env!("CARGO_MANIFEST_DIR"))
}

fn model<'a>(report: &'a Value, rung: &str, matched: Option<&str>) -> Option<&'a Value> {
    report["models"]
        .as_array()?
        .iter()
        .find(|model| model["rung"] == rung && model["matched"].as_str() == matched)
}

#[test]
fn the_answer_follows_the_tolerance() -> Outcome {
    let folder = tempfile::tempdir()?;
    let named = |tolerance| fidelity("B", folder.path(), &["--tolerance", tolerance]);
    let strict = named("1e-6");
    assert_eq!(strict["cheapest"]["rung"], "full");
    assert_eq!(strict["cheapest_is_scene"], true);
    assert_abs_diff_eq!(
        strict["value"].as_f64().ok_or("value")?,
        8.398_675_591_86,
        epsilon = 1e-9
    );
    let fair = named("0.02");
    assert_eq!(fair["cheapest"]["rung"], "kelvinVoigt");
    assert_eq!(fair["cheapest"]["matched"], "duration");
    assert_eq!(fair["cheapest_is_scene"], false);
    assert_eq!(named("0.5")["cheapest"]["rung"], "rigid");
    let linear = model(&fair, "linear", None).ok_or("linear")?;
    assert_eq!(linear["error"], Value::Null);
    assert_eq!(
        (&linear["kind"], &linear["z"]),
        (&"periodic".into(), &"0".into())
    );
    Ok(())
}

#[test]
fn grazing_needs_no_stop_at_all() -> Outcome {
    let folder = tempfile::tempdir()?;
    let more = ["--quantity", "grazing-frequency", "--tolerance", "0"];
    let report = fidelity("B", folder.path(), &more);
    assert_eq!(report["cheapest"]["rung"], "linear");
    Ok(())
}

#[test]
fn a_spring_stop_is_a_spring_stop() -> Outcome {
    let folder = tempfile::tempdir()?;
    let report = fidelity(
        &scene("kelvin-voigt.toml"),
        folder.path(),
        &["--tolerance", "0"],
    );
    assert_eq!(report["cheapest"]["rung"], "kelvinVoigt");
    assert_eq!(report["cheapest_is_scene"], true);
    assert!(model(&report, "preloaded", None).is_none());
    assert!(model(&report, "full", None).is_none());
    Ok(())
}

#[test]
fn a_stiff_stop_may_be_taken_as_rigid() -> Outcome {
    let folder = tempfile::tempdir()?;
    let report = fidelity(
        &scene("stiff.toml"),
        folder.path(),
        &["--tolerance", "0.01"],
    );
    assert_eq!(report["cheapest"]["rung"], "rigid");
    let rigid = model(&report, "rigid", None).ok_or("rigid")?;
    let restitution = rigid["machine"]["parameters"]["stop.restitution"]
        .as_f64()
        .ok_or("R")?;
    let zeta: f64 = 0.09;
    let expected = (-std::f64::consts::PI * zeta / (1.0 - zeta * zeta).sqrt()).exp();
    assert_abs_diff_eq!(restitution, expected, epsilon = 1e-9);
    Ok(())
}

#[test]
fn a_rigid_scene_says_why_it_has_no_soft_models() -> Outcome {
    let folder = tempfile::tempdir()?;
    let report = fidelity(&scene("rigid.toml"), folder.path(), &[]);
    let unmatched = report["unmatched"].as_array().ok_or("unmatched")?;
    assert_eq!(unmatched.len(), 4, "two models of two rungs");
    for missing in unmatched {
        let reason = missing["reason"].as_str().ok_or("reason")?;
        assert!(reason.contains("takes no way and no time"), "{reason}");
    }
    Ok(())
}

#[test]
fn structure_compares_the_regimes() -> Outcome {
    let folder = tempfile::tempdir()?;
    let more = ["--structure", "--points", "7", "--match", "duration"];
    let report = fidelity("A", folder.path(), &more);
    let tracks = report["structure"].as_array().ok_or("structure")?;
    let track = |rung: &str| tracks.iter().find(|track| track["rung"] == rung);
    let own = track("preloaded").ok_or("preloaded")?;
    assert_eq!(own["same_regime"], 1.0);
    assert_abs_diff_eq!(
        own["fold_frequency"].as_f64().ok_or("fold")?,
        1.369_036,
        epsilon = DIFFERENCED
    );
    let linear = track("linear").ok_or("linear")?;
    assert!(linear["same_regime"].as_f64().ok_or("share")? < 0.7);
    assert_eq!(linear["sequence_flung"], serde_json::json!(["0"]));
    let table = fs::read_to_string(folder.path().join("structure.csv"))?;
    assert!(table.starts_with("rung,matched,start,frequency,kind,z\n"));
    assert_eq!(table.lines().count(), 1 + tracks.len() * 2 * 7);
    let chart = fs::read_to_string(folder.path().join("structure.svg"))?;
    for words in ["kelvinVoigt (duration)", "from rest", "z = 1"] {
        assert!(chart.contains(words), "{words}");
    }
    Ok(())
}

#[test]
fn files_are_whole_and_text_names_the_model() -> Outcome {
    let folder = tempfile::tempdir()?;
    let place = folder.path().join("new");
    let output = place.to_str().ok_or("path")?;
    let line = [
        "B",
        "--tolerance",
        "0.02",
        "--periods",
        "10",
        "--output",
        output,
    ];
    let text = FIDELITY.text(&line);
    assert!(
        text.contains("The cheapest model within 0.02: kelvinVoigt (duration)."),
        "{text}"
    );
    let table = fs::read_to_string(place.join("fidelity.csv"))?;
    assert_eq!(
        table.lines().count(),
        1 + 9 * 11,
        "every quantity of every model"
    );
    let chart = fs::read_to_string(place.join("fidelity.svg"))?;
    assert!(chart.trim_end().ends_with("</svg>"));
    assert!(chart.contains("tolerance 0.02"));
    assert_eq!(fs::read_dir(&place)?.count(), 2);
    Ok(())
}

#[test]
fn predictive_models_know_nothing_of_the_motion() -> Outcome {
    let folder = tempfile::tempdir()?;
    let informed = fidelity("B", folder.path(), &[]);
    let predicted = fidelity("B", folder.path(), &["--predictive"]);
    let restitution = |report: &Value| {
        let rigid = model(report, "rigid", None).expect("rigid");
        rigid["machine"]["parameters"]["stop.restitution"]
            .as_f64()
            .expect("R")
    };
    assert!(restitution(&predicted) < restitution(&informed) - 0.05);
    Ok(())
}

#[test]
fn what_cannot_be_is_refused() {
    let refuses = |more: &[&str], words: &[&str]| {
        FIDELITY.refuses_and_writes_nothing(&[&["A"], more].concat(), words);
    };
    FIDELITY.refuses_and_writes_nothing(&["C"], &["C: cannot be read"]);
    refuses(&["--tolerance", "-1"], &["tolerance"]);
    refuses(&["--tolerance", "nan"], &["tolerance", "finite and >= 0"]);
    refuses(
        &["--quantity", "speed"],
        &["quantity", "before_impact_velocity"],
    );
    refuses(
        &["--structure", "--points", "1"],
        &["points = 1", "2 to 10000"],
    );
    refuses(&["--sweep", "2:1", "--structure"], &["LOW < HIGH"]);
    refuses(&["--sweep", "0:1", "--structure"], &["--sweep 0:1", "> 0"]);
    refuses(&["--repeats", "0"], &["repeats = 0"]);
}

#[test]
fn a_scene_without_the_quantity_has_no_models() {
    let folder = tempfile::tempdir().expect("a folder");
    let place = folder.path().join("never");
    let line = [
        &scene("none.toml"),
        "--output",
        place.to_str().expect("path"),
    ];
    let words = ["before_impact_velocity", "the scene itself has none"];
    FIDELITY.ends_with(&line, 1, &words);
    assert!(!place.exists(), "a folder is left");
}
