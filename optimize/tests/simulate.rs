//! `softstop simulate` and `softstop stops` as users and scripts meet them.

use std::f64::consts::TAU;
use std::fs;
use std::path::Path;

use softstop_testing::tolerance::{GROWN, MOTION};
use softstop_testing::{Report, assert_near, docs, number, with_folders, words};

use crate::{Outcome, SOFTSTOP};

fn simulate(line: &str) -> Report {
    SOFTSTOP.report(&format!("simulate {line}"))
}

#[test]
fn point_a_settles_on_its_before_impact_velocity() {
    let summary = simulate("SCENES/preloaded.toml --periods 400 --position 0 --velocity 14");
    let last = summary.list("impacts/last").last().expect("an impact");
    let velocity = number(last, "before_impact_velocity");
    assert_near(velocity, 6.494_627_429, GROWN);
    assert!(summary.number("impacts/before_impact_velocity") >= velocity);
    let parameters = summary.at("machine/parameters");
    assert_eq!(parameters["stop.model"], "preloaded");
    assert_eq!(parameters["stop.preload"], 70.0);
    let defect = summary.number("energy/defect").abs();
    assert!(defect < 1e-11 * summary.number("energy/supplied"));
}

#[test]
fn what_dissipates_nothing_gains_nothing_by_rounding() {
    let line = "SCENES/preloaded.toml --set damping=0 --set contact.damping=0 --periods 200";
    assert!(simulate(line).number("energy/dissipated") >= 0.0);
}

#[test]
fn tables_hold_every_sample_and_every_impact() -> Outcome {
    let summary = simulate("SCENES/piercing.toml --periods 7 --samples-per-period 11");
    let motion = summary.text("motion.csv");
    assert!(motion.starts_with("time,position,velocity,contact_force,phase\n"));
    assert_eq!(motion.lines().count(), 1 + 7 * 11 + 1);
    let end: Vec<&str> = motion.lines().last().ok_or("empty")?.split(',').collect();
    assert_near(end[0].parse()?, 7.0 * TAU / 1.15, MOTION);
    assert_eq!(end[1].parse(), Ok(summary.number("end/position")));
    assert_eq!(end[2].parse(), Ok(summary.number("end/velocity")));

    let rows = summary.table("crossings.csv");
    let impacts = rows.iter().filter(|row| row["impact"] == "1").count();
    assert_eq!(summary.number("impacts/count"), impacts as f64);
    assert!(
        rows.iter().any(|row| row["kind"] == "rebound"),
        "phase IV is met"
    );

    let axes = [
        "position x (m)",
        "velocity v (m/s)",
        "contact force F (N)",
        "pierce",
    ];
    summary.shows("motion.svg", &axes);
    assert_eq!(summary.names().len(), 3);
    Ok(())
}

#[test]
fn samples_change_nothing_in_the_motion() {
    let [few, many] = [1, 777].map(|samples| {
        simulate(&format!(
            "SCENES/chatter.toml --periods 20 --samples-per-period {samples}"
        ))
    });
    for key in ["impacts", "rests", "end"] {
        assert_eq!(few.at(key), many.at(key), "{key}");
    }
    assert_eq!(few.text("crossings.csv"), many.text("crossings.csv"));
}

#[test]
fn chatter_ends_in_rests_that_are_told_with_begin_and_end() {
    let summary = simulate("SCENES/chatter.toml --periods 5");
    let rests = summary.list("rests");
    assert_eq!(rests.len(), 5);
    for rest in &rests[..4] {
        assert!(number(rest, "end") > number(rest, "begin"));
        assert_eq!(rest["phase"], "resting");
    }
    // Released where the load turns: w t = pi/2 + whole turns pulls the mass off its stop at 0.
    assert_near(number(&rests[0], "end") * 0.3 / TAU, 1.25, MOTION);
    assert!(rests[4]["end"].is_null(), "the last one lasts");
    let visited = summary.list("phases").iter();
    let named: Vec<_> = visited
        .clone()
        .filter_map(|seen| seen["phase"].as_str())
        .collect();
    assert_eq!(named, ["free", "chatter", "resting"]);
    assert_near(visited.map(|seen| number(seen, "share")).sum(), 1.0, MOTION);
}

#[test]
fn all_example_scenes_can_be_run_and_drawn() -> Outcome {
    let mut seen = 0;
    for entry in fs::read_dir(docs("scenes"))? {
        let file = entry?.path().display().to_string();
        let run = simulate(&format!("{file} --periods 20"));
        let [defect, supplied] =
            ["defect", "supplied"].map(|it| run.number(&format!("energy/{it}")));
        assert!(defect.abs() < 1e-8_f64.min(1e-9 * supplied.abs()), "{file}");
        let strikes = run.number("impacts/count") > 0.0;
        let has_stop = run.at("machine/parameters/stop.model") != "none";
        assert_eq!(strikes, has_stop, "{file}");
        seen += 1;
    }
    assert_eq!(seen, 18);
    Ok(())
}

#[test]
fn text_names_what_matters() -> Outcome {
    let folder = tempfile::tempdir()?;
    let line = format!(
        "simulate SCENES/stiff.toml --periods 20 --output {}",
        folder.path().display()
    );
    let text = SOFTSTOP.text(&words(&with_folders(&line)));
    let told = [
        "impacts",
        "before-impact velocity",
        "rests",
        "balance",
        "Phases visited",
        "Written",
    ];
    for word in told {
        assert!(text.contains(word), "{word} is not in {text}");
    }
    Ok(())
}

#[test]
fn stops_writes_the_whole_zoo() -> Outcome {
    let folder = tempfile::tempdir()?;
    let target = folder.path().join("zoo");
    let told = SOFTSTOP.text(&["stops", "--output", target.to_str().ok_or("path")?]);
    let written = told
        .lines()
        .filter_map(|line| line.strip_prefix("Written: "));
    assert_eq!(written.clone().count(), fs::read_dir(&target)?.count());
    for line in written {
        let (place, _kind) = line.rsplit_once(" (").ok_or("no kind")?;
        assert!(Path::new(place).is_file(), "{place}");
    }
    Ok(())
}

/// x = (cos t - cos 2t)/3 for m = k1 = F0 = 1 and w = 2: back at rest at t = 2 pi, with no energy left and none given.
#[test]
fn a_motion_that_comes_back_to_rest_keeps_its_digits() {
    let summary = simulate(
        "unloaded --set damping=0 --set excitation.frequency=2 --position 0 --velocity 0 --periods 2",
    );
    summary.has_near(&[
        ("end/position", 0.0, MOTION),
        ("energy/supplied", 0.0, MOTION),
    ]);
}
