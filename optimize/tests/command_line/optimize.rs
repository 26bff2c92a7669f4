//! `softstop optimize`: what it prints and writes, and that it leaves nothing behind.

use std::fs;
use std::path::Path;

use serde_json::Value;
use softstop_testing::{docs, has_near, words};

use super::{Outcome, SOFTSTOP};

/// A search that is quick: one quantity, few evaluations.
const QUICK: &str = "optimize --fix stiffness=7 --evaluations 100 --bounds clearance=2:22";

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
        "orbit --frequency {} --clearance {}",
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
    let task = "regime = \"unloaded\"\nmargin = 0.4\nevaluations = 100\nformat = \"json\"\n\
                [fix]\nstiffness = 7\n[bounds]\nclearance = [2, 22]\n[scene]\ncontact-damping = 0.09\n";
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
    let folder = tempfile::tempdir()?;
    let press = fs::read_to_string(docs("press/press.toml"))?;
    let certain = "certainty = { least = 0.85, at = \"drawing\" } ";
    let task = press.replace("certainty = 0.5 ", certain);
    assert!(task.contains(certain));
    let file = folder.path().join("press.toml");
    fs::write(&file, task)?;
    let line = format!("optimize {} --no-report --samples 64", file.display());
    let velocity = SOFTSTOP
        .report(&line)
        .number("design/before_impact_velocity");
    assert!(velocity > 8.0, "{velocity}");
    Ok(())
}

/// A search of some words, and its notes.
fn noted(line: &str, output: &Path) -> Outcome<(Value, Vec<String>)> {
    let more = "--no-report --evaluations 100 --format json --output";
    let line = format!("optimize {line} {more} {}", output.display());
    let run = SOFTSTOP.run(&words(&line));
    let notes = String::from_utf8_lossy(&run.stderr);
    let notes: Vec<String> = notes.lines().map(str::to_owned).collect();
    assert!(run.status.success(), "{notes:?}");
    Ok((serde_json::from_slice(&run.stdout)?, notes))
}

/// Older words do what the present ones do, and say once what to write instead.
#[test]
fn older_words_say_what_to_write_instead() -> Outcome {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("task.toml");
    let present =
        "loaded --set damping=0.021 --vary stop.stiffness=7 --vary clearance=2:22 --margin 0.3";
    let older =
        "--regime loaded --damping 0.021 --bounds clearance=2:22 --fix stiffness=7 --margin 0.3";
    let (expected, none) = noted(present, folder.path())?;
    let (found, notes) = noted(older, folder.path())?;
    assert_eq!((&found, none.len()), (&expected, 0));
    let told = [
        "note: instead of --regime loaded --damping 0.021 write loaded --set damping=0.021",
        "note: instead of --bounds clearance=2:22 --fix stiffness=7 write --vary clearance=2:22 --vary stiffness=7",
    ];
    assert_eq!(notes.len(), told.len(), "{notes:?}");
    for (note, told) in notes.iter().zip(told) {
        assert!(note.starts_with(told), "{note}");
    }
    let files = [
        "machine = \"loaded\"\nset = [\"damping=0.021\"]\n[vary]\nstop.stiffness = 7\nclearance = [2, 22]\n\
         [require]\nmargin = 0.3\n",
        "regime = \"loaded\"\nmargin = 0.3\n[scene]\ndamping = 0.021\n[fix]\nstiffness = 7\n[bounds]\nclearance = [2, 22]\n",
    ];
    for (text, count) in files.into_iter().zip([0, 1]) {
        fs::write(&file, text)?;
        let (found, notes) = noted(&format!("--config {}", file.display()), folder.path())?;
        assert_eq!((&found, notes.len()), (&expected, count), "{notes:?}");
    }
    Ok(())
}
