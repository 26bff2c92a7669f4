//! Names and files that are refused, or written so that they act on nothing.

use std::fs;
use std::process::Stdio;

use softstop_optimize::design::figure::Figure;
use softstop_optimize::optimize::task_schema;
use softstop_testing::{docs, words};

use super::{Outcome, SOFTSTOP};

/// Every command refuses a task that stands beside the machine and that the optimiser would refuse.
#[test]
fn tasks_beside_machines_are_read_by_every_command() -> Outcome {
    let folder = tempfile::tempdir()?;
    let scene = fs::read_to_string(docs("scenes/hertz.toml"))?;
    let [file, study] = ["press.toml", "study.toml"].map(|name| folder.path().join(name));
    let axis = "[[axis]]\nparameter = \"clearance\"\nvalues = [0.01]\n";
    fs::write(
        &study,
        format!("machine = \"press.toml\"\noutputs = [\"z\"]\n{axis}"),
    )?;
    for (task, told) in [
        (
            "[tolerance]\nclearence = 1\n",
            "tolerance.clearence: unknown key",
        ),
        (
            "[require]\nvelocity = \"fast\"\n",
            "require.velocity = \"fast\": must be a number",
        ),
        ("[vary]\nweight = [1, 2]\n", "vary.weight: unknown key"),
        ("[objective]\nmaximise = \"joy\"\n", "joy"),
        ("[search]\nseeds = 1\n", "unknown field `seeds`"),
    ] {
        fs::write(&file, format!("{scene}\n{task}"))?;
        let commands = "orbit zone motions simulate watch fmu fidelity basin optimize study";
        for command in words(commands) {
            let path = if command == "study" { &study } else { &file };
            let line = [command, path.to_str().ok_or("path")?];
            SOFTSTOP.ends_with(&line, 2, &["press.toml", told]);
        }
    }
    Ok(())
}

/// What an FMU or the folder refuses is told before the search.
#[test]
fn designs_that_could_not_be_written_are_not_searched() -> Outcome {
    let folder = tempfile::tempdir()?;
    fs::create_dir_all(folder.path().join("erosion.csv"))?;
    let search = format!(
        "optimize --evaluations 1000000000 --output {}",
        folder.path().display()
    );
    let told = ["erosion.csv", "a folder or a device is in its place"];
    SOFTSTOP.ends_with(&words(&search), 1, &told);
    let line = format!("{search} --set name={}", "n".repeat(60));
    SOFTSTOP.ends_with(&words(&line), 2, &["name = \"nnn", "64 bytes"]);
    Ok(())
}

#[cfg(unix)]
#[test]
fn a_named_pipe_is_no_file_to_wait_for_or_to_replace() -> Outcome {
    let folder = tempfile::tempdir()?;
    let pipe = folder.path().join("pipe.toml");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status()?;
    assert!(made.success());
    for (line, code, told) in [
        ("study", 2, "named pipe"),
        ("orbit", 2, "named pipe"),
        ("optimize --config", 2, "named pipe"),
        ("fmu --output", 1, "a device is in its place"),
        ("watch --output", 1, "a device is in its place"),
    ] {
        let line = format!("{line} {}", pipe.display());
        SOFTSTOP.ends_with(&words(&line), code, &["pipe.toml", told]);
    }
    assert!(!fs::metadata(&pipe)?.is_file());
    let scene = fs::File::open(docs("scenes/hertz.toml"))?;
    let mut piped = std::process::Command::new("cat")
        .stdin(scene)
        .stdout(Stdio::piped())
        .spawn()?;
    let open = piped.stdout.take().ok_or("a pipe")?;
    let run = SOFTSTOP
        .command(&["orbit", "/dev/stdin"])
        .stdin(open)
        .output()?;
    assert!(run.status.success(), "{run:?}");
    piped.wait()?;
    Ok(())
}

/// Nothing that a user writes acts on the terminal.
#[test]
fn control_characters_do_not_reach_the_terminal() -> Outcome {
    let folder = tempfile::tempdir()?;
    let fmu = folder.path().join("a\u{1b}.fmu");
    for command in ["fmu", "watch"] {
        let line = [command, "--output", fmu.to_str().ok_or("path")?];
        SOFTSTOP.ends_with(&line, 2, &["name of a file"]);
    }
    assert_eq!(fs::read_dir(folder.path())?.count(), 0);
    let file = folder.path().join("a\u{1b}[31mb.toml");
    let path = file.to_str().ok_or("path")?;
    let scene = fs::read_to_string(docs("scenes/hertz.toml"))?;
    let lines = scene.lines().filter(|line| !line.starts_with("name"));
    let scene: String = lines.map(|line| format!("{line}\n")).collect();
    let is_quiet = |text: &[u8]| {
        !String::from_utf8_lossy(text).contains(|c: char| c.is_control() && c != '\n')
    };
    let out = folder.path().join("out");
    for (more, is_good) in [("", true), ("\n\"\\u001b\" = 1\n", false)] {
        fs::write(&file, format!("{scene}{more}"))?;
        let run = SOFTSTOP.run(&["simulate", path, "--output", out.to_str().ok_or("path")?]);
        assert_eq!(run.status.success(), is_good);
        assert!(is_quiet(&run.stdout) && is_quiet(&run.stderr), "{run:?}");
    }
    assert!(is_quiet(&fs::read(out.join("motion.svg"))?));
    Ok(())
}

/// Tasks that hold every key and word of the format, a line each, with those of the line.
const KEYS: [(&str, &str); 23] = [
    (
        "vary.clearance = { values = [0.01, 0.02] }",
        "vary clearance values",
    ),
    (
        "vary.clearance = { follows = \"damping\", factor = 1, offset = 1 }",
        "follows damping factor offset",
    ),
    ("tolerance.clearance = 1e-4", "tolerance clearance"),
    (
        "tolerance.clearance = { half_width = 1e-4, distribution = \"normal\", cpk = 1.33 }",
        "half_width distribution normal cpk",
    ),
    ("tolerance.clearance = { sigma = 1e-4 }", "sigma"),
    (
        "objective = { maximise = \"velocity\", of = \"worst\" }",
        "objective maximise velocity of worst",
    ),
    ("objective.minimise = \"cost\"", "minimise cost"),
    ("objective.cost = \"3 * clearance\"", "cost"),
    (
        "require.velocity = { least = 1, most = 2, at = \"drawing\" }",
        "require velocity least most at drawing",
    ),
    ("require.tolerance_reserve = 2", "tolerance_reserve"),
    ("require.violating = 0.01", "violating"),
    (
        "require.starts = { position = [0, 1], velocity = [0, 1] }",
        "starts position velocity",
    ),
    (
        "require.run_up = { ways = [\"frequency_raised\"], ramp_rate = 0.2, force = 1, least = 1 }",
        "run_up ways frequency_raised ramp_rate force least",
    ),
    (
        "require.run_up = { most = 2, at = \"drawing\" }",
        "most at drawing",
    ),
    (
        "[[case]]\nname = \"worn\"\nweight = 1\ndamping = 700",
        "case name weight damping",
    ),
    (
        "[search]\nevaluations = 200\nzone = \"hysteresis\"",
        "search evaluations zone hysteresis",
    ),
    ("report.title = \"A press\"", "report title"),
    ("report.author = \"A. Engineer\"", "author"),
    ("report.date = 2026-11-26", "date"),
    ("machine = \"unloaded\"", "machine"),
    ("set = [\"damping=700\"]", "set"),
    ("output = \"there\"", "output"),
    ("format = \"json\"", "format"),
];

/// Whatever word of a task is misspelt, the refusal says which one it may mean.
#[test]
fn misspelt_words_of_tasks_are_told() -> Outcome {
    let folder = tempfile::tempdir()?;
    let task = folder.path().join("task.toml");
    let machine = docs("scenes/hertz.toml").display().to_string();
    let line = [
        "optimize",
        &machine,
        "--config",
        &task.display().to_string(),
        "--output",
        &folder.path().join("never").display().to_string(),
    ];
    for (text, keys) in KEYS {
        for key in words(keys) {
            let misspelt = text.replacen(key, &format!("{key}x"), 1);
            fs::write(&task, misspelt)?;
            SOFTSTOP.ends_with(&line, 2, &[&format!("did you mean {key}?"), "task.toml"]);
        }
    }
    Ok(())
}

/// No key of the schema of tasks but a figure's is missing among those that are misspelt, and each table of these is in the
/// schema.
#[test]
fn all_words_of_tasks_are_misspelt_once() -> Outcome {
    let known: Vec<&str> = KEYS.iter().flat_map(|it| words(it.1)).collect();
    let mut all = vec![task_schema()];
    for (text, _) in KEYS {
        let table: toml::Table = toml::from_str(text)?;
        let is_stated = |key: &String| all[0]["properties"].get(key).is_some();
        assert!(table.keys().all(is_stated), "{text}");
    }
    while let Some(schema) = all.pop() {
        let keys = schema["properties"].as_object().into_iter().flatten();
        for (key, below) in keys {
            let is_figure = Figure::ALL.iter().any(|it| it.name() == key);
            assert!(is_figure || known.contains(&key.as_str()), "{key}");
            all.push(below.clone());
            all.extend(below["anyOf"].as_array().into_iter().flatten().cloned());
        }
    }
    Ok(())
}
