//! Two stable motions of one zone at one frequency: margins to the fold are those of the motion that a design or a row has.

use std::fs;
use std::path::Path;

use approx::assert_abs_diff_eq;
use serde_json::Value;

use softstop_testing::Program;

use crate::{Outcome, SOFTSTOP};

const OPTIMIZE: Program = Program {
    first: &["optimize", "--no-report"],
    ..SOFTSTOP
};

/// The fold in Hz at which the softer motion ends, by `softstop continue` along its branch.
const OWN_FOLD: f64 = 32.786_337_864_582;
/// The fold of the harder motion, the upper end of the zone.
const LAST_FOLD: f64 = 33.987_918_593_218;

/// The task of `two_motions.toml` at a frequency in Hz, or within a range, with these further lines.
fn task(folder: &Path, frequency: &str, lines: &str) -> Result<String, std::io::Error> {
    let text = include_str!("tasks/two_motions.toml");
    let path = folder.join("task.toml");
    let held = text.replace(
        "frequency_hz = 32.65",
        &format!("frequency_hz = {frequency}"),
    );
    fs::write(&path, held + lines)?;
    Ok(path.display().to_string())
}

/// The value of a requirement of a design.
fn required(report: &Value, name: &str) -> f64 {
    let all = report["requirements"].as_array().expect("a list");
    let it = all.iter().find(|it| it["name"] == name);
    it.and_then(|it| it["value"].as_f64()).expect(name)
}

/// A number that says where a design stands.
fn number(report: &Value, name: &str) -> f64 {
    report["design"][name].as_f64().expect(name)
}

#[test]
fn a_margin_reaches_to_the_fold_of_the_own_motion() -> Outcome {
    let folder = tempfile::tempdir()?;
    let short = task(folder.path(), "32.65", "[require]\nmargin_sn = 0.1\n")?;
    let report = OPTIMIZE.json_into(&folder.path().join("out"), &[&short]);
    assert_abs_diff_eq!(
        required(&report, "margin_sn"),
        OWN_FOLD - 32.65,
        epsilon = 1e-9
    );
    let warning = report["warnings"][0].as_str().unwrap_or_default();
    assert!(
        warning.contains("from 26.364545 to 32.786338 only"),
        "{warning}"
    );
    let long = task(folder.path(), "32.65", "[require]\nmargin_sn = 1.0\n")?;
    OPTIMIZE.ends_with(&[&long], 1, &["margin_sn = 0.136337"]);
    Ok(())
}

/// Held at a frequency, the soft motion is lost at a clearance that is a little larger.
#[test]
fn a_margin_of_the_clearance_is_that_of_the_own_motion() -> Outcome {
    let folder = tempfile::tempdir()?;
    let task = task(
        folder.path(),
        "32.65",
        "[require]\nclearance_margin_sn = 0.0001\n",
    )?;
    let report = OPTIMIZE.json_into(&folder.path().join("out"), &[&task]);
    let margin = required(&report, "clearance_margin_sn");
    let fold = |clearance: f64| -> Result<f64, Box<dyn std::error::Error>> {
        let clearance = format!("clearance={clearance}");
        let zones = SOFTSTOP.json(&["zone", &task, "--set", &clearance]);
        let ranges = zones["stretches"].as_array().ok_or("ranges")?;
        let ends = ranges.iter().filter(|it| it["in_zone"] == true);
        let first = ends.filter_map(|it| it["to"].as_f64()).reduce(f64::min);
        Ok(first.ok_or("a range in the zone")?)
    };
    assert!(fold(0.01 + 0.999 * margin)? > 32.65 && fold(0.01 + 1.001 * margin)? < 32.65);
    Ok(())
}

#[test]
fn what_is_sought_decides_between_two_motions() -> Outcome {
    let folder = tempfile::tempdir()?;
    let values = [
        ("maximise = \"velocity\"", 11.917, LAST_FOLD),
        ("minimise = \"stop_force\"", 7.514_105_560_5, OWN_FOLD),
    ];
    for (index, (objective, velocity, fold)) in values.into_iter().enumerate() {
        let lines =
            format!("[objective]\n{objective}\n[require]\nmargin_sn = 0.01\nvelocity = 6.0\n");
        let task = task(folder.path(), "32.75", &lines)?;
        let report = OPTIMIZE.json_into(&folder.path().join(index.to_string()), &[&task]);
        assert_abs_diff_eq!(required(&report, "velocity"), velocity, epsilon = 0.01);
        assert_abs_diff_eq!(required(&report, "margin_sn"), fold - 32.75, epsilon = 1e-9);
    }
    Ok(())
}

/// The hardest motion of the second range is at its lower fold: a margin is counted from there, whatever the bounds of the
/// frequency, and whether more is required or not.
#[test]
fn a_narrow_range_of_a_wide_zone_is_searched_to_its_margin() -> Outcome {
    let folder = tempfile::tempdir()?;
    let margin = "[require]\nmargin = 0.25\n";
    let cases = [
        ("[32.9, 33.1]", margin.to_owned()),
        ("[20.0, 40.0]", margin.to_owned()),
        ("[20.0, 40.0]", format!("{margin}velocity = 1.0\n")),
    ];
    for (index, (frequency, lines)) in cases.iter().enumerate() {
        let task = task(folder.path(), frequency, lines)?;
        let report = OPTIMIZE.json_into(&folder.path().join(index.to_string()), &[&task]);
        assert_abs_diff_eq!(number(&report, "zone_to"), LAST_FOLD, epsilon = 1e-9);
        assert_abs_diff_eq!(number(&report, "s"), 0.25, epsilon = 1e-9);
        let velocity = report["design"]["before_impact_velocity"].as_f64();
        assert_abs_diff_eq!(velocity.expect("a velocity"), 11.2966, epsilon = 1e-4);
    }
    Ok(())
}

/// The margins of a row are those of its motion, whatever else is asked for.
#[test]
fn rows_of_a_study_have_the_margins_of_their_motions() -> Outcome {
    let folder = tempfile::tempdir()?;
    task(folder.path(), "32.65", "")?;
    let study = folder.path().join("study.toml");
    let rows = |outputs: &str| -> Result<Vec<Vec<f64>>, Box<dyn std::error::Error>> {
        let text = format!(
            "machine = \"task.toml\"\nset = [\"initial.position=0.0059\", \"initial.velocity=6.8187\"]\n\
             outputs = [{outputs}]\n\
             [[axis]]\nparameter = \"excitation.frequency_hz\"\nvalues = [32.65, 32.78, 32.79, 32.9, 35.0]\n"
        );
        fs::write(&study, text)?;
        let out = folder.path().join(outputs.len().to_string());
        let (study, folder) = (study.display().to_string(), out.display().to_string());
        SOFTSTOP.text(&["study", &study, "--csv", "--output", &folder]);
        let table = fs::read_to_string(out.join("study.csv"))?;
        let row = |line: &str| line.split(',').map(str::parse).collect::<Result<_, _>>();
        Ok(table.lines().skip(1).map(row).collect::<Result<_, _>>()?)
    };
    let alone = rows("\"margin_sn\"")?;
    let both = rows("\"velocity\", \"margin_sn\"")?;
    for ((alone, both), is_soft) in alone
        .iter()
        .zip(&both)
        .zip([true, true, false, false, false])
    {
        let fold = if is_soft { OWN_FOLD } else { LAST_FOLD };
        assert_abs_diff_eq!(both[2], fold - both[0], epsilon = 1e-9);
        assert_eq!(alone[1], both[2]);
        assert_eq!(is_soft, (6.0..10.0).contains(&both[1]), "{both:?}");
    }
    Ok(())
}
