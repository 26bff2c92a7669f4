//! Two stable motions of one zone at one frequency: margins to the fold are those of the motion that a design or a row has.

use std::fs;

use approx::assert_abs_diff_eq;
use softstop_testing::{Program, Report, number, number_in};

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
fn task(frequency: &str, lines: &str) -> String {
    let text = include_str!("tasks/two_motions.toml");
    let frequency = format!("frequency_hz = {frequency}");
    text.replace("frequency_hz = 32.65", &frequency) + lines
}

fn design(frequency: &str, lines: &str) -> Report {
    OPTIMIZE.report_of("task.toml", &task(frequency, lines), "FILE")
}

/// The value of a requirement of a design.
fn required(report: &Report, name: &str) -> f64 {
    let mut all = report.list("requirements").iter();
    number(all.find(|it| it["name"] == name).expect(name), "value")
}

#[test]
fn a_margin_reaches_to_the_fold_of_the_own_motion() -> Outcome {
    let report = design("32.65", "[require]\nmargin_sn = 0.1\n");
    assert_abs_diff_eq!(
        required(&report, "margin_sn"),
        OWN_FOLD - 32.65,
        epsilon = 1e-9
    );
    let warning = report.at("warnings/0").as_str().unwrap_or_default();
    assert!(
        warning.contains("from 26.364545 to 32.786338 only"),
        "{warning}"
    );
    let long = report.path("long.toml");
    fs::write(&long, task("32.65", "[require]\nmargin_sn = 1.0\n"))?;
    let long = long.to_str().ok_or("path")?;
    OPTIMIZE.ends_with(&[long], 1, &["margin_sn = 0.136337"]);
    Ok(())
}

/// Held at a frequency, the soft motion is lost at a clearance that is a little larger.
#[test]
fn a_margin_of_the_clearance_is_that_of_the_own_motion() -> Outcome {
    let report = design("32.65", "[require]\nclearance_margin_sn = 0.0001\n");
    let margin = required(&report, "clearance_margin_sn");
    let task = report.path("task.toml").display().to_string();
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

/// Within a budget that zones of many clearances for each motion would exceed.
#[test]
fn a_margin_of_the_clearance_is_where_the_fold_comes_down_to_the_motion() -> Outcome {
    let task = "machine = \"loaded\"\n[vary]\nclearance = [5.0, 20.0]\n[require]\nclearance_margin_sn = 0.3\n";
    let arguments = "--config FILE --evaluations=100 --budget=2";
    let report = OPTIMIZE.report_of("task.toml", task, arguments);
    let margin = required(&report, "clearance_margin_sn");
    let [frequency, clearance] =
        ["frequency", "clearance"].map(|name| report.number(&format!("design/{name}")));
    let fold = |share: f64| {
        let clearance = format!("clearance={}", clearance + share * margin);
        let zone = SOFTSTOP.json(&["zone", "loaded", "--set", &clearance]);
        zone["frequency_sn"].as_f64().ok_or("a fold")
    };
    assert!(margin >= 0.3 && fold(1.0 - 1e-6)? > frequency && fold(1.0 + 1e-6)? < frequency);
    Ok(())
}

#[test]
fn what_is_sought_decides_between_two_motions() {
    for (objective, velocity, fold) in [
        ("maximise = \"velocity\"", 11.917, LAST_FOLD),
        ("minimise = \"stop_force\"", 7.514_105_560_5, OWN_FOLD),
    ] {
        let lines =
            format!("[objective]\n{objective}\n[require]\nmargin_sn = 0.01\nvelocity = 6.0\n");
        let report = design("32.75", &lines);
        assert_abs_diff_eq!(required(&report, "velocity"), velocity, epsilon = 0.01);
        assert_abs_diff_eq!(required(&report, "margin_sn"), fold - 32.75, epsilon = 1e-9);
    }
}

/// The hardest motion of the second range is at its lower fold: a margin is counted from there, whatever the bounds of the
/// frequency, and whether more is required or not.
#[test]
fn a_narrow_range_of_a_wide_zone_is_searched_to_its_margin() {
    for (frequency, more) in [
        ("[32.9, 33.1]", ""),
        ("[20.0, 40.0]", ""),
        ("[20.0, 40.0]", "velocity = 1.0\n"),
    ] {
        let report = design(frequency, &format!("[require]\nmargin = 0.25\n{more}"));
        report.has_near(&[
            ("design/zone_to", LAST_FOLD, 1e-9),
            ("design/s", 0.25, 1e-9),
            ("design/before_impact_velocity", 11.2966, 1e-4),
        ]);
    }
}

/// The margins of a row are those of its motion, whatever else is asked for.
#[test]
fn rows_of_a_study_have_the_margins_of_their_motions() -> Outcome {
    let folder = tempfile::tempdir()?;
    let task_file = folder.path().join("task.toml");
    fs::write(&task_file, task("32.65", ""))?;
    let rows = |outputs: &str| {
        let text = format!(
            "machine = \"{}\"\nset = [\"initial.position=0.0059\", \"initial.velocity=6.8187\"]\n\
             outputs = [{outputs}]\n\
             [[axis]]\nparameter = \"excitation.frequency_hz\"\nvalues = [32.65, 32.78, 32.79, 32.9, 35.0]\n",
            task_file.display()
        );
        let report = SOFTSTOP.report_of("study.toml", &text, "study FILE --csv");
        report.table("study.csv")
    };
    let alone = rows("\"margin_sn\"");
    let both = rows("\"velocity\", \"margin_sn\"");
    let softness = [true, true, false, false, false];
    for ((alone, both), is_soft) in alone.iter().zip(&both).zip(softness) {
        let fold = if is_soft { OWN_FOLD } else { LAST_FOLD };
        let margin = fold - number_in(both, "excitation.frequency_hz");
        assert_abs_diff_eq!(number_in(both, "margin_sn"), margin, epsilon = 1e-9);
        assert_eq!(alone["margin_sn"], both["margin_sn"]);
        let velocity = number_in(both, "velocity");
        assert_eq!(is_soft, (6.0..10.0).contains(&velocity), "{both:?}");
    }
    assert_eq!((alone.len(), both.len()), (5, 5));
    Ok(())
}
