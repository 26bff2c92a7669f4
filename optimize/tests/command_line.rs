//! The program as users and scripts meet it: JSON keys, exit codes, messages, files.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};
use std::time::{Duration, Instant};

use serde_json::Value;

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// A search that is quick: one quantity, few evaluations.
const QUICK: [&str; 7] = [
    "optimize",
    "--fix",
    "stiffness=7",
    "--evaluations",
    "100",
    "--bounds",
    "clearance=2:22",
];

fn softstop(arguments: &[&str]) -> std::io::Result<Output> {
    Command::new(env!("CARGO_BIN_EXE_softstop"))
        .args(arguments)
        .output()
}

fn json(arguments: &[&str]) -> Result<Value, Box<dyn std::error::Error>> {
    let output = softstop(arguments)?;
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    Ok(serde_json::from_slice(&output.stdout)?)
}

fn number(value: &Value, key: &str) -> f64 {
    value[key]
        .as_f64()
        .unwrap_or_else(|| panic!("{key} is not a number in {value}"))
}

#[track_caller]
fn near(found: f64, expected: f64, tolerance: f64) {
    assert!(
        (found - expected).abs() <= tolerance,
        "{found} is not {expected} +- {tolerance}"
    );
}

/// Runs the program where it has to fail, and checks exit code and message.
#[track_caller]
fn refuses(arguments: &[&str], code: i32, words: &[&str]) {
    let output = softstop(arguments).expect("the program starts");
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {message}");
    assert!(output.stdout.is_empty(), "{arguments:?} wrote to stdout");
    for word in words {
        assert!(
            message.contains(word),
            "{arguments:?}: {word:?} is not in {message:?}"
        );
    }
}

#[test]
fn orbit_at_point_a() -> Outcome {
    let orbit = json(&[
        "orbit",
        "--regime",
        "unloaded",
        "--frequency",
        "1.15",
        "--clearance",
        "10",
        "--format",
        "json",
    ])?;
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
    let force = json(&["orbit", "--preload", "70", "--format", "json"])?;
    let deflection = json(&["orbit", "--preload-deflection", "10", "--format", "json"])?;
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
fn optimize_prints_json_only_and_writes_the_files_it_names() -> Outcome {
    let folder = tempfile::tempdir()?;
    let target = folder.path().join("new/design");
    let path = target.to_str().ok_or("path")?;
    let report = json(&[&QUICK[..], &["--format", "json", "--output", path]].concat())?;
    let design = &report["design"];
    for key in [
        "clearance",
        "frequency",
        "before_impact_velocity",
        "preload",
        "position",
        "velocity",
    ] {
        assert!(number(design, key).is_finite(), "{key}");
    }
    near(number(design, "stiffness"), 7.0, 0.0);
    near(number(design, "margin"), 0.25, 0.0);
    let (g0, sn) = (
        number(design, "frequency_g0"),
        number(design, "frequency_sn"),
    );
    let place = (number(design, "frequency") - g0) / (sn - g0);
    near(place, number(design, "s"), 1e-12);
    assert!((0.25 - 1e-12..=0.75 + 1e-12).contains(&place));
    near(
        number(&report["reference"]["A"], "before_impact_velocity"),
        6.494627,
        5e-7,
    );
    assert!(number(&report["reference"]["A"], "gain") > 1.0);

    let mut names: Vec<String> = fs::read_dir(&target)?
        .map(|entry| Ok(entry?.file_name().to_string_lossy().into_owned()))
        .collect::<std::io::Result<_>>()?;
    names.sort();
    assert_eq!(names, ["design.fmu", "design.json", "design.svg"]);
    let written: Value = serde_json::from_slice(&fs::read(target.join("design.json"))?)?;
    assert_eq!(written, report);
    assert!(
        fs::read_to_string(target.join("design.svg"))?
            .trim_end()
            .ends_with("</svg>")
    );
    assert!(fs::read(target.join("design.fmu"))?.starts_with(b"PK"));
    for (_, file) in report["files"].as_object().ok_or("files")? {
        assert!(Path::new(file.as_str().ok_or("file")?).is_file(), "{file}");
    }
    Ok(())
}

#[test]
fn the_design_is_the_orbit_that_the_program_finds_there() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().to_str().ok_or("path")?;
    let report = json(&[&QUICK[..], &["--format", "json", "--output", path]].concat())?;
    let text = |key: &str| report["design"][key].to_string();
    let orbit = json(&[
        "orbit",
        "--frequency",
        &text("frequency"),
        "--clearance",
        &text("clearance"),
        "--format",
        "json",
    ])?;
    for key in [
        "position",
        "velocity",
        "before_impact_velocity",
        "max_position",
    ] {
        near(number(&orbit, key), number(&report["design"], key), 1e-8);
    }
    Ok(())
}

#[test]
fn task_file_and_command_line_say_the_same() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().to_str().ok_or("path")?;
    let file = folder.path().join("task.toml");
    fs::write(
        &file,
        "regime = \"unloaded\"\nmargin = 0.4\nevaluations = 100\nformat = \"json\"\n\
         [fix]\nstiffness = 7\n[bounds]\nclearance = [2, 22]\n[scene]\ncontact-damping = 0.09\n",
    )?;
    let task = file.to_str().ok_or("path")?;
    let from_file = json(&[
        "optimize", "--config", task, "--margin", "0.25", "--output", path,
    ])?;
    let from_line = json(&[&QUICK[..], &["--format", "json", "--output", path]].concat())?;
    assert_eq!(from_file, from_line);
    Ok(())
}

#[test]
fn bad_values_are_named_with_their_range() {
    let cases: [(&[&str], &[&str]); 14] = [
        (&["orbit", "--stiffness", "-1"], &["stiffness = -1", ">= 0"]),
        (&["orbit", "--frequency", "0"], &["frequency = 0", "> 0"]),
        (
            &["orbit", "--clearance", "NaN"],
            &["clearance = NaN", "finite"],
        ),
        (&["orbit", "--damping=-inf"], &["damping = -inf", ">= 0"]),
        (&["orbit", "--frequency", "fast"], &["--frequency", "fast"]),
        (
            &["zone", "--preload", "1", "--preload-deflection", "1"],
            &["--preload"],
        ),
        (
            &["zone", "--thickness", "0.4"],
            &["thickness = 0.4", "loaded"],
        ),
        (
            &["zone", "--regime", "resting"],
            &["resting", "unloaded", "loaded"],
        ),
        (
            &["optimize", "--margin", "0.6"],
            &["margin = 0.6", "[0, 0.5]"],
        ),
        (
            &["optimize", "--margin", "-0.1"],
            &["margin = -0.1", "[0, 0.5]"],
        ),
        (
            &["optimize", "--bounds", "clearance=5:2"],
            &["clearance = 5:2", "low"],
        ),
        (
            &["optimize", "--fix", "weight=5"],
            &["weight: unknown key", "clearance", "stop.stiffness"],
        ),
        (
            &[
                "optimize",
                "--fix",
                "stiffness=7",
                "--bounds",
                "stiffness=1:9",
            ],
            &["stiffness", "one"],
        ),
        (
            &["optimize", "--evaluations", "5"],
            &["evaluations = 5", "100"],
        ),
    ];
    for (arguments, words) in cases {
        refuses(arguments, 2, words);
    }
}

#[test]
fn bad_files_are_named_with_the_key() -> Outcome {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("task.toml");
    let path = file.to_str().ok_or("path")?;
    let cases: [(&str, &[&str]); 6] = [
        ("mass = -1\n", &["unknown field `mass`", "task.toml"]),
        (
            "margin = 0.1\n[fix]\nweight = 2\n",
            &["weight: unknown key", "stop.stiffness"],
        ),
        ("[scene]\nmass = 1\n", &["unknown field `mass`"]),
        ("[scene]\nstiffness = -2\n", &["stiffness = -2", ">= 0"]),
        ("[bounds]\nfrequency = [0, 2]\n", &["frequency = 0", "> 0"]),
        (
            "regime = \"loaded\"\n[scene]\nregime = \"loaded\"\n",
            &["regime"],
        ),
    ];
    for (text, words) in cases {
        fs::write(&file, text)?;
        refuses(&["optimize", "--config", path], 2, words);
    }
    refuses(
        &["optimize", "--config", "no-such-file.toml"],
        2,
        &["no-such-file.toml"],
    );
    fs::write(&file, "weight = 2\n")?;
    refuses(&["orbit", "--scene", path], 2, &["unknown field `weight`"]);
    Ok(())
}

#[test]
fn what_cannot_be_done_is_told_and_leaves_nothing_behind() -> Outcome {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("file");
    fs::write(&file, "in the way")?;
    let below = file.join("design");
    refuses(
        &["optimize", "--output", below.to_str().ok_or("path")?],
        1,
        &["file/design", "output folder"],
    );

    // Wider than the resonance peak of 25: no g0, no zone, no z = 1 motion, no folder.
    let never = folder.path().join("never/made");
    let path = never.to_str().ok_or("path")?;
    let search = [
        "optimize",
        "--bounds",
        "clearance=26:40",
        "--evaluations",
        "100",
        "--output",
        path,
    ];
    refuses(&search, 1, &["clearance = 26"]);
    assert!(!folder.path().join("never").exists());
    for clearance in ["30", "-2", "nan"] {
        refuses(&["zone", "--clearance", clearance], 2, &["clearance = "]);
    }
    refuses(&["orbit", "--frequency", "3"], 1, &["frequency = 3"]);
    Ok(())
}

#[test]
fn a_folder_in_the_way_is_found_before_the_search() -> Outcome {
    let folder = tempfile::tempdir()?;
    fs::create_dir(folder.path().join("design.json"))?;
    let path = folder.path().to_str().ok_or("path")?;
    refuses(
        &[&QUICK[..], &["--output", path]].concat(),
        1,
        &["design.json"],
    );
    assert_eq!(
        fs::read_dir(folder.path())?.count(),
        1,
        "only what was there before"
    );
    Ok(())
}

#[cfg(unix)]
#[test]
fn an_interrupt_ends_the_search_and_leaves_nothing_behind() -> Outcome {
    let folder = tempfile::tempdir()?;
    let target = folder.path().join("design");
    let mut search = Command::new(env!("CARGO_BIN_EXE_softstop"))
        .args(["optimize", "--evaluations", "100000000", "--output"])
        .arg(&target)
        .stderr(std::process::Stdio::piped())
        .spawn()?;
    let deadline = Instant::now() + Duration::from_secs(20);
    while !target.is_dir() && Instant::now() < deadline {
        std::thread::sleep(Duration::from_millis(10));
    }
    std::thread::sleep(Duration::from_millis(200));
    Command::new("kill")
        .args(["-INT", &search.id().to_string()])
        .status()?;
    assert_eq!(search.wait()?.code(), Some(130));
    assert!(!target.exists());
    Ok(())
}

#[test]
fn what_a_machine_does_not_have_is_refused_by_every_command() -> Outcome {
    let folder = tempfile::tempdir()?;
    let output = folder.path().join("out");
    let output = output.to_str().ok_or("path")?;
    let scene = format!("{}/../docs/scenes/hertz.toml", env!("CARGO_MANIFEST_DIR"));
    let commands: [&[&str]; 6] = [
        &["orbit"],
        &["zone"],
        &["motions"],
        &["simulate", "--output", output],
        &["fmu", "--output", output],
        &["optimize", "--output", output],
    ];
    for command in commands {
        let with = |more: &[&'static str]| [command, more].concat();
        refuses(
            &with(&["--set", "clearence=3"]),
            2,
            &["clearence", "did you mean clearance?"],
        );
        refuses(
            &with(&["--set", "stop.exponent=2"]),
            2,
            &["stop.exponent", "no such parameter"],
        );
        refuses(
            &with(&["--set", "clearance=wide"]),
            2,
            &["clearance = wide"],
        );
        refuses(
            &with(&["--set", "rho=3", "--set", "clearance=4"]),
            2,
            &["twice"],
        );
        refuses(&with(&["--set", "clearance"]), 2, &["KEY=VALUE"]);
        refuses(&with(&["nowhere.toml"]), 2, &["nowhere.toml"]);
        refuses(
            &[command, &[scene.as_str(), "--stiffness", "3"]].concat(),
            2,
            &["--stiffness", "hertz.toml", "--set stop.stiffness=3"],
        );
        refuses(
            &[command, &[scene.as_str(), "--regime", "loaded"]].concat(),
            2,
            &["--regime", "hertz.toml"],
        );
    }
    refuses(&["zone", "--frequency", "1.2"], 2, &["frequency"]);
    refuses(&["zone", "--set", "eta=1.2"], 2, &["eta"]);
    assert!(!Path::new(output).exists());
    Ok(())
}

#[test]
fn shorthands_and_keys_say_the_same() -> Outcome {
    let short = json(&[
        "orbit",
        "--regime",
        "loaded",
        "--clearance",
        "9",
        "--stiffness",
        "8",
        "--thickness",
        "0.3",
        "--preload-deflection",
        "10",
        "--format",
        "json",
    ])?;
    let keys = json(&[
        "orbit",
        "loaded",
        "--set",
        "clearance=9",
        "--set",
        "stop.stiffness=8",
        "--set",
        "sigma=0.3",
        "--set",
        "stop.preload_deflection=10",
        "--format",
        "json",
    ])?;
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
fn help_teaches_by_example() -> Outcome {
    for command in ["orbit", "zone", "optimize"] {
        let output = softstop(&[command, "--help"])?;
        assert!(output.status.success());
        let text = String::from_utf8(output.stdout)?;
        assert!(
            text.contains(&format!("Examples:\n  softstop {command}")),
            "{text}"
        );
        assert!(text.contains("--format"), "{text}");
    }
    Ok(())
}
