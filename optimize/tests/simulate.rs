//! `softstop simulate` and `softstop stops` as users and scripts meet them.

use approx::assert_abs_diff_eq;
use softstop_testing::tolerance::{GROWN, MOTION};
use std::fs;
use std::path::Path;

use serde_json::Value;
use softstop_testing::Program;

type Outcome = Result<(), Box<dyn std::error::Error>>;

const SOFTSTOP: Program = Program {
    file: env!("CARGO_BIN_EXE_softstop"),
    first: &[],
};

fn scene(name: &str) -> String {
    format!("{}/../docs/scenes/{name}", env!("CARGO_MANIFEST_DIR"))
}

/// Runs a scene into `folder` and returns its summary.
fn simulate(file: &str, folder: &Path, more: &[&str]) -> Result<Value, Box<dyn std::error::Error>> {
    let output = folder.to_str().ok_or("path")?;
    let basic = ["simulate", file, "--output", output];
    Ok(SOFTSTOP.json(&[&basic[..], more].concat()))
}

fn number(value: &Value) -> f64 {
    value
        .as_f64()
        .unwrap_or_else(|| panic!("{value} is not a number"))
}

#[test]
fn point_a_settles_on_its_before_impact_velocity() -> Outcome {
    let folder = tempfile::tempdir()?;
    let more = ["--periods", "400", "--position", "0", "--velocity", "14"];
    let summary = simulate(&scene("preloaded.toml"), folder.path(), &more)?;
    let last = summary["impacts"]["last"].as_array().ok_or("last")?;
    let velocity = number(&last.last().ok_or("no impact")?["before_impact_velocity"]);
    assert_abs_diff_eq!(velocity, 6.494_627_429, epsilon = GROWN);
    let hardest = number(&summary["impacts"]["before_impact_velocity"]);
    assert!(hardest >= velocity, "{hardest}");
    let parameters = &summary["machine"]["parameters"];
    assert_eq!(parameters["stop.model"], "preloaded");
    assert_eq!(parameters["stop.preload"], 70.0);
    let energy = &summary["energy"];
    let defect = number(&energy["defect"]).abs();
    assert!(defect < 1e-11 * number(&energy["supplied"]));
    Ok(())
}

#[test]
fn tables_hold_every_sample_and_every_impact() -> Outcome {
    let folder = tempfile::tempdir()?;
    let more = ["--periods", "7", "--samples-per-period", "11"];
    let summary = simulate(&scene("piercing.toml"), folder.path(), &more)?;
    let motion = fs::read_to_string(folder.path().join("motion.csv"))?;
    assert!(motion.starts_with("time,position,velocity,contact_force,phase\n"));
    assert_eq!(motion.lines().count(), 1 + 7 * 11 + 1);
    let end = motion.lines().last().ok_or("empty")?;
    let end: Vec<&str> = end.split(',').collect();
    let period = std::f64::consts::TAU / 1.15;
    assert_abs_diff_eq!(end[0].parse::<f64>()?, 7.0 * period, epsilon = MOTION);
    assert_eq!(end[1].parse::<f64>()?, number(&summary["end"]["position"]));
    assert_eq!(end[2].parse::<f64>()?, number(&summary["end"]["velocity"]));

    let crossings = fs::read_to_string(folder.path().join("crossings.csv"))?;
    let rows: Vec<Vec<&str>> = crossings
        .lines()
        .map(|row| row.split(',').collect())
        .collect();
    assert!(rows.iter().all(|row| row.len() == rows[0].len()));
    assert_eq!(rows[0][8], "impact");
    let impacts = rows.iter().filter(|row| row[8] == "1").count();
    assert_eq!(number(&summary["impacts"]["count"]), impacts as f64);
    assert!(
        rows.iter().any(|row| row[1] == "rebound"),
        "phase IV is met"
    );

    let chart = fs::read_to_string(folder.path().join("motion.svg"))?;
    assert!(chart.trim_end().ends_with("</svg>"));
    for name in [
        "position x (m)",
        "velocity v (m/s)",
        "contact force F (N)",
        "pierce",
    ] {
        assert!(chart.contains(name), "{name}");
    }
    assert_eq!(fs::read_dir(folder.path())?.count(), 3);
    Ok(())
}

#[test]
fn samples_change_nothing_in_the_motion() -> Outcome {
    let folder = tempfile::tempdir()?;
    let run = |samples: &str| {
        let more = ["--periods", "20", "--samples-per-period", samples];
        simulate(&scene("chatter.toml"), &folder.path().join(samples), &more)
    };
    let (few, many) = (run("1")?, run("777")?);
    assert_eq!(few["impacts"], many["impacts"]);
    assert_eq!(few["rests"], many["rests"]);
    assert_eq!(few["end"], many["end"]);
    let crossings = |samples| fs::read(folder.path().join(samples).join("crossings.csv"));
    assert_eq!(crossings("1")?, crossings("777")?);
    Ok(())
}

#[test]
fn chatter_ends_in_rests_that_are_told_with_begin_and_end() -> Outcome {
    let folder = tempfile::tempdir()?;
    let summary = simulate(&scene("chatter.toml"), folder.path(), &["--periods", "5"])?;
    let rests = summary["rests"].as_array().ok_or("rests")?;
    assert_eq!(rests.len(), 5);
    for rest in &rests[..4] {
        assert!(number(&rest["end"]) > number(&rest["begin"]));
        assert_eq!(rest["phase"], "resting");
    }
    // Released where the load turns: w t = pi/2 + whole turns pulls the mass off its stop at 0.
    let first = number(&rests[0]["end"]) * 0.3 / std::f64::consts::TAU;
    assert_abs_diff_eq!(first, 1.25, epsilon = MOTION);
    assert!(rests[4]["end"].is_null(), "the last one lasts");
    let visited = summary["phases"].as_array().ok_or("phases")?;
    let named: Vec<&str> = visited
        .iter()
        .filter_map(|seen| seen["phase"].as_str())
        .collect();
    assert_eq!(named, ["free", "chatter", "resting"]);
    let share: f64 = visited.iter().map(|seen| number(&seen["share"])).sum();
    assert_abs_diff_eq!(share, 1.0, epsilon = MOTION);
    Ok(())
}

#[test]
fn all_example_scenes_can_be_run_and_drawn() -> Outcome {
    let folder = tempfile::tempdir()?;
    for entry in fs::read_dir(scene(""))? {
        let path = entry?.path();
        let file = path.to_str().ok_or("path")?;
        let summary = simulate(file, folder.path(), &["--periods", "10"])?;
        assert!(number(&summary["energy"]["defect"]).abs() < 1e-8, "{file}");
    }
    Ok(())
}

#[test]
fn text_names_what_matters() -> Outcome {
    let folder = tempfile::tempdir()?;
    let output = folder.path().to_str().ok_or("path")?;
    let file = scene("stiff.toml");
    let output = SOFTSTOP.run(&["simulate", &file, "--periods", "20", "--output", output]);
    let text = String::from_utf8(output.stdout)?;
    for word in [
        "impacts",
        "before-impact velocity",
        "rests",
        "balance",
        "Phases visited",
        "Written",
    ] {
        assert!(text.contains(word), "{word} is not in {text}");
    }
    Ok(())
}

#[test]
fn bad_scenes_are_named_with_key_value_and_range() -> Outcome {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("machine.toml");
    let path = file.to_str().ok_or("path")?;
    let good = fs::read_to_string(scene("preloaded.toml"))?;
    let cases: [(&str, &str, &[&str]); 8] = [
        ("mass = 1.0", "mass = -1.0", &["mass = -1", "> 0"]),
        (
            "preload = 70.0",
            "preload = -7.0",
            &["stop.preload = -7", ">= 0"],
        ),
        (
            "clearance = 10.0",
            "clearance = nan",
            &["clearance = NaN", "finite"],
        ),
        (
            "clearance = 10.0",
            "gap = 10.0",
            &["gap: unknown key", "line 5"],
        ),
        ("clearance = 10.0", "", &["missing field `clearance`"]),
        (
            "\"preloaded\"",
            "\"soft\"",
            &["unknown variant `soft`", "kelvinVoigt"],
        ),
        (
            "position = 6.9",
            "place = 6.9",
            &["place: unknown key", "did you mean", "position"],
        ),
        (
            "velocity = 9.5",
            "velocity = inf",
            &["initial.velocity = inf", "finite"],
        ),
    ];
    for (old, new, words) in cases {
        assert!(good.contains(old), "{old}");
        fs::write(&file, good.replace(old, new))?;
        SOFTSTOP.refuses(&["simulate", path], &[words, &["machine.toml"]].concat());
    }
    assert_eq!(
        fs::read_dir(folder.path())?.count(),
        1,
        "no folder is left behind"
    );
    Ok(())
}

#[test]
fn bad_arguments_are_named_with_their_range() {
    let file = scene("rigid.toml");
    let cases: [(&[&str], &[&str]); 8] = [
        (&["--missing-strips", "7:5"], &["7:5", "FIRST <= LAST"]),
        (
            &["--missing-strips", "5:7"],
            &["missing-strips = 5:7", "no strip"],
        ),
        (&["--periods", "0"], &["periods = 0", "1 to 1000000"]),
        (
            &["--samples-per-period", "0"],
            &["samples-per-period = 0", "1 to 100000"],
        ),
        (
            &["--periods", "1000000", "--samples-per-period", "1000"],
            &["periods x samples-per-period = 1000000000"],
        ),
        (&["--position", "nan"], &["position = NaN", "finite"]),
        (&["--position", "10.5"], &["position = 10.5", "<= 10"]),
        (&["--velocity", "fast"], &["--velocity", "fast"]),
    ];
    for (arguments, words) in cases {
        SOFTSTOP.refuses(&[&["simulate", &file], arguments].concat(), words);
    }
    SOFTSTOP.refuses(&["simulate", "no-such-file.toml"], &["no-such-file.toml"]);
}

#[cfg(unix)]
#[test]
fn an_interrupt_leaves_nothing_behind() -> Outcome {
    let folder = tempfile::tempdir()?;
    let file = scene("rigid.toml");
    let basic = ["simulate", &file, "--periods", "1000000"];
    let arguments = [&basic[..], &["--samples-per-period", "20"]].concat();
    SOFTSTOP.leaves_nothing_when_interrupted(&arguments, &folder.path().join("motion"));
    Ok(())
}

#[test]
fn stops_writes_the_whole_zoo() -> Outcome {
    let folder = tempfile::tempdir()?;
    let target = folder.path().join("zoo");
    let output = SOFTSTOP.run(&["stops", "--output", target.to_str().ok_or("path")?]);
    assert!(output.status.success());
    let told = String::from_utf8(output.stdout)?;
    let written: Vec<&str> = told
        .lines()
        .filter_map(|line| line.strip_prefix("Written: "))
        .collect();
    assert_eq!(written.len(), fs::read_dir(&target)?.count());
    for line in written {
        let (place, _kind) = line.rsplit_once(" (").ok_or("no kind")?;
        assert!(Path::new(place).is_file(), "{place}");
    }
    Ok(())
}

#[test]
fn help_teaches_by_example() -> Outcome {
    for command in ["simulate", "watch", "stops"] {
        let output = SOFTSTOP.run(&[command, "--help"]);
        let text = String::from_utf8(output.stdout)?;
        assert!(
            text.contains(&format!("Examples:\n  softstop {command}")),
            "{text}"
        );
    }
    Ok(())
}

/// x = (cos t - cos 2t)/3 for m = k1 = F0 = 1 and w = 2: back at rest at t = 2 pi, with no energy left and none given.
#[test]
fn a_motion_that_comes_back_to_rest_keeps_its_digits() -> Outcome {
    let folder = tempfile::tempdir()?;
    let back = "--set damping=0 --set excitation.frequency=2 --position 0 --velocity 0 --periods 2";
    let more: Vec<&str> = back.split(' ').collect();
    let summary = simulate("unloaded", folder.path(), &more)?;
    assert_abs_diff_eq!(number(&summary["end"]["position"]), 0.0, epsilon = MOTION);
    assert_abs_diff_eq!(
        number(&summary["energy"]["supplied"]),
        0.0,
        epsilon = MOTION
    );
    Ok(())
}
