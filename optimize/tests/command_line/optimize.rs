//! `softstop optimize`: what it prints and writes, and that it leaves nothing behind.

use std::fs;

use serde_json::Value;
use softstop_testing::{docs, has_near, words};

use super::{Outcome, SOFTSTOP};

/// A search that is quick: one quantity, few evaluations.
const QUICK: &str = "optimize --vary stiffness=7 --evaluations 100 --vary clearance=2:22";

#[test]
fn optimize_prints_json_only_and_writes_the_files_it_names() -> Outcome {
    let report = SOFTSTOP.report(QUICK);
    for key in words("clearance frequency before_impact_velocity preload position velocity") {
        assert!(report.number(&format!("design/{key}")).is_finite(), "{key}");
    }
    let [g0, sn, own] = ["frequency_g0", "frequency_sn", "frequency"]
        .map(|key| report.number(&format!("design/{key}")));
    let place = (own - g0) / (sn - g0);
    report.has_near(&[
        ("design/stiffness", 7.0, 0.0),
        ("design/margin", 0.25, 0.0),
        ("design/s", place, 1e-12),
        ("reference/A/before_impact_velocity", 6.494627, 5e-7),
    ]);
    assert!((0.25 - 1e-12..=0.75 + 1e-12).contains(&place));
    assert!(report.number("reference/A/gain") > 1.0);

    let names = report.names();
    let files = report.at("files").as_object().ok_or("files")?.values();
    let mut told: Vec<&str> = files.filter_map(Value::as_str).collect();
    told.sort_unstable();
    let places: Vec<String> = names
        .iter()
        .map(|name| report.path(name).display().to_string())
        .collect();
    assert_eq!(told, places);
    for file in words("design.fmu design.json design.ssv design.svg design.toml report.html") {
        assert!(names.iter().any(|name| name == file), "{file}");
    }
    report.is_in("design.json");
    for file in words("design.toml design.json") {
        assert!(
            !report.text(file).contains(" ,"),
            "{file}: a space before a comma"
        );
    }
    report.shows("design.svg", &[]);
    assert!(fs::read(report.path("design.fmu"))?.starts_with(b"PK"));

    // The design is the orbit that the program finds there.
    let design = report.at("design");
    let line = format!(
        "orbit --set eta={} --set rho={}",
        design["frequency"], design["clearance"]
    );
    let same = words("position velocity before_impact_velocity max_position");
    let same = same
        .into_iter()
        .map(|key| (key, report.number(&format!("design/{key}")), 1e-8));
    has_near(&SOFTSTOP.value(&line), &same.collect::<Vec<_>>());
    Ok(())
}

#[test]
fn task_file_and_command_line_say_the_same() -> Outcome {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("task.toml");
    let task = "machine = \"unloaded\"\nset = [\"contact.damping=0.09\"]\nformat = \"json\"\n[vary]\nstiffness = 7\n\
                clearance = [2, 22]\n[require]\nmargin = 0.4\n[search]\nevaluations = 100\n";
    fs::write(&file, task)?;
    let output = format!("--output {}", folder.path().display());
    let from_file = format!(
        "optimize --config {} --margin 0.25 {output}",
        file.display()
    );
    let from_file: Value = serde_json::from_str(&SOFTSTOP.text(&words(&from_file)))?;
    assert_eq!(from_file, SOFTSTOP.value(&format!("{QUICK} {output}")));
    Ok(())
}

/// The most certain zones of this press are far from where the impact is hardest: a search from there alone ends at 3.97 m/s.
#[test]
fn a_certain_design_is_found_far_from_the_hardest_one() -> Outcome {
    let press = fs::read_to_string(docs("press/press.toml"))?;
    let certain = "certainty = { least = 0.85, at = \"drawing\" } ";
    let task = press.replace("certainty = 0.5 ", certain);
    assert!(task.contains(certain));
    let line = "optimize FILE --no-report --samples 64";
    let report = SOFTSTOP.report_of("press.toml", &task, line);
    let velocity = report.number("design/before_impact_velocity");
    assert!(velocity > 8.0, "{velocity}");
    Ok(())
}

/// Of three catalogues the best values lie on another hill than those of the best start: each start is bettered by exchange.
#[test]
fn catalogues_are_exchanged_from_each_of_the_best_starts() {
    let task = r#"
mass = 1.0
stiffness = 1.0
damping = 0.04
clearance = 10.0
contact.damping = 0.04
[excitation]
amplitude = 1.0
frequency = 1.15
[stop]
model = "preloaded"
stiffness = 7
preload = 70
[vary]
stop.stiffness = { values = [1.5368, 7.584, 7.5956, 12.5018, 14.3996, 16.7063, 18.3142, 19.4148, 20.3945, 21.1222, 26.6487, 28.4976] }
clearance = { values = [3.4345, 3.6236, 6.8476, 7.3591, 7.8085, 9.7731, 10.2335, 11.5863, 13.0628, 13.1163, 14.6459, 14.8299] }
stiffness = { values = [0.5289, 0.7726, 0.8666, 0.9687, 1.3109, 1.3122, 1.3835, 1.5015, 1.9027, 2.1578, 2.2004, 2.6762] }
[require]
stroke = 20.0196
"#;
    let line = "optimize FILE --no-report --evaluations 200 --samples 0";
    let report = SOFTSTOP.report_of("task.toml", task, line);
    let velocity = report.number("design/before_impact_velocity");
    assert!(velocity > 13.346, "{velocity}");
}
