//! Two stable motions of one zone at one frequency: margins are those of the motion that a design or a row has, and what is
//! sought decides between them.

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

/// The task of `two_motions.toml` at a frequency in Hz, with these further lines.
fn task(folder: &Path, frequency: f64, lines: &str) -> Result<String, std::io::Error> {
    let text = include_str!("tasks/two_motions.toml");
    let path = folder.join("task.toml");
    let held = text.replace(
        "frequency_hz = 32.65",
        &format!("frequency_hz = {frequency}"),
    );
    fs::write(&path, held + lines)?;
    Ok(path.display().to_string())
}

/// The value of the one requirement of a design.
fn required(report: &Value) -> f64 {
    report["requirements"][0]["value"]
        .as_f64()
        .expect("a value")
}

#[test]
fn a_margin_reaches_to_the_fold_of_the_own_motion() -> Outcome {
    let folder = tempfile::tempdir()?;
    let short = task(folder.path(), 32.65, "[require]\nmargin_sn = 0.1\n")?;
    let out = folder.path().join("out");
    let report = OPTIMIZE.json_into(&out, &[&short]);
    assert_abs_diff_eq!(required(&report), OWN_FOLD - 32.65, epsilon = 1e-9);
    let warning = report["warnings"][0].as_str().unwrap_or_default();
    assert!(warning.contains("32.786338"), "{warning}");
    for (lines, words) in [
        ("[require]\nmargin_sn = 1.0\n", "margin_sn = 0.136337"),
        ("[require]\nmargin = 0.15\n", "margin = 0.021230"),
    ] {
        let long = task(folder.path(), 32.65, lines)?;
        OPTIMIZE.ends_with(&[&long], 1, &[words]);
    }
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
        let task = task(folder.path(), 32.75, &lines)?;
        let out = folder.path().join(index.to_string());
        let report = OPTIMIZE.json_into(&out, &[&task]);
        let all = report["requirements"].as_array().expect("a list");
        let value = |figure: &str| {
            let it = all.iter().find(|it| it["name"] == figure);
            it.and_then(|it| it["value"].as_f64()).expect(figure)
        };
        assert_abs_diff_eq!(value("velocity"), velocity, epsilon = 0.01);
        assert_abs_diff_eq!(value("margin_sn"), fold - 32.75, epsilon = 1e-9);
    }
    Ok(())
}

#[test]
fn rows_of_a_study_have_the_margins_of_their_motions() -> Outcome {
    let folder = tempfile::tempdir()?;
    task(folder.path(), 32.65, "")?;
    let study = folder.path().join("study.toml");
    let text = "machine = \"task.toml\"\nset = [\"initial.position=0.0059\", \"initial.velocity=6.8187\"]\n\
        outputs = [\"velocity\", \"margin_sn\"]\n\
        [[axis]]\nparameter = \"excitation.frequency_hz\"\nvalues = [32.65, 32.78, 32.79, 32.9]\n";
    fs::write(&study, text)?;
    let out = folder.path().join("out");
    SOFTSTOP.text(&[
        "study",
        &study.display().to_string(),
        "--csv",
        "--output",
        &out.display().to_string(),
    ]);
    let rows = fs::read_to_string(out.join("study.csv"))?;
    for row in rows.lines().skip(1) {
        let cells: Vec<f64> = row.split(',').map(str::parse).collect::<Result<_, _>>()?;
        let fold = if cells[1] < 10.0 { OWN_FOLD } else { LAST_FOLD };
        assert_abs_diff_eq!(cells[2], fold - cells[0], epsilon = 1e-9);
    }
    let soft = rows
        .lines()
        .filter(|row| row.contains(",6.7") || row.contains(",8.0"));
    assert_eq!(soft.count(), 2, "{rows}");
    Ok(())
}
