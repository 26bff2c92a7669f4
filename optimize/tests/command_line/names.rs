//! Names and files that are refused, or written so that they act on nothing.

use std::fs;
use std::process::{Command, Stdio};

use super::{Outcome, SOFTSTOP};

#[test]
fn names_of_files_that_some_system_refuses_are_refused() -> Outcome {
    let folder = tempfile::tempdir()?;
    for name in ["CON.fmu", "-rf.fmu", "nul.fmu", "a?.fmu", "a\u{1b}.fmu"] {
        let place = folder.path().join(name);
        let place = place.to_str().ok_or("path")?;
        SOFTSTOP.ends_with(&["fmu", "--output", place], 2, &["name of a file"]);
        SOFTSTOP.ends_with(&["watch", "--output", place], 2, &["name of a file"]);
    }
    SOFTSTOP.ends_with(&["fmu", "--set", "name=-rf"], 2, &["-rf.fmu"]);
    assert_eq!(fs::read_dir(folder.path())?.count(), 0);
    Ok(())
}

/// Every command refuses a task that stands beside the machine and that the optimiser would refuse.
#[test]
fn tasks_beside_machines_are_read_by_every_command() -> Outcome {
    let folder = tempfile::tempdir()?;
    let scene = fs::read_to_string(softstop_testing::docs("scenes/hertz.toml"))?;
    let file = folder.path().join("press.toml");
    let path = file.to_str().ok_or("path")?;
    let study = folder.path().join("study.toml");
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
        let lines = [
            "orbit", "zone", "motions", "simulate", "watch", "fmu", "fidelity", "basin", "optimize",
        ];
        for command in lines {
            SOFTSTOP.ends_with(&[command, path], 2, &["press.toml", told]);
        }
        SOFTSTOP.ends_with(
            &["study", study.to_str().ok_or("path")?],
            2,
            &["press.toml", told],
        );
    }
    Ok(())
}

/// What an FMU or the folder refuses is told before the search.
#[test]
fn designs_that_could_not_be_written_are_not_searched() -> Outcome {
    let folder = tempfile::tempdir()?;
    let out = folder.path().join("out");
    fs::create_dir_all(out.join("erosion.csv"))?;
    let output = out.to_str().ok_or("path")?;
    let search = [
        "optimize",
        "--evaluations",
        "1000000000",
        "--output",
        output,
    ];
    SOFTSTOP.ends_with(
        &search,
        1,
        &["erosion.csv", "a folder or a device is in its place"],
    );
    let name = format!("name={}", "n".repeat(60));
    let told = ["name = \"nnn", "64 bytes"];
    SOFTSTOP.ends_with(&[&search[..], &["--set", &name]].concat(), 2, &told);
    Ok(())
}

/// Neither what cannot start nor what an importer refuses is packed.
#[test]
fn what_an_fmu_cannot_hold_is_named() -> Outcome {
    let folder = tempfile::tempdir()?;
    let place = folder.path().join("one.fmu");
    let place = place.to_str().ok_or("path")?;
    let file = |name: &str| softstop_testing::docs(&format!("scenes/{name}.toml"));
    for (scene, set, told) in [
        ("hertz", "clearance=1e13", "1000000000000.0 in an FMU"),
        ("rigid", "initial.position=77", "77"),
        ("hertz", "name=\u{ffff}", "control characters"),
        ("hertz", "name=", "name"),
    ] {
        let scene = file(scene);
        let scene = scene.to_str().ok_or("path")?;
        SOFTSTOP.ends_with(&["fmu", scene, "--set", set, "--output", place], 2, &[told]);
    }
    assert_eq!(fs::read_dir(folder.path())?.count(), 0);
    Ok(())
}

#[cfg(unix)]
#[test]
fn a_named_pipe_is_no_file_to_wait_for_or_to_replace() -> Outcome {
    let folder = tempfile::tempdir()?;
    let pipe = folder.path().join("pipe.toml");
    assert!(Command::new("mkfifo").arg(&pipe).status()?.success());
    let path = pipe.to_str().ok_or("path")?;
    for line in [
        &["study", path][..],
        &["orbit", path],
        &["optimize", "--config", path],
        &["orbit", "--scene", path],
    ] {
        SOFTSTOP.ends_with(line, 2, &["pipe.toml", "named pipe"]);
    }
    for command in ["fmu", "watch"] {
        let told = ["a device is in its place"];
        SOFTSTOP.ends_with(&[command, "--output", path], 1, &told);
    }
    assert!(!fs::metadata(&pipe)?.is_file());
    let scene = fs::File::open(softstop_testing::docs("scenes/hertz.toml"))?;
    let mut piped = Command::new("cat")
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
    let file = folder.path().join("a\u{1b}[31mb.toml");
    let path = file.to_str().ok_or("path")?;
    let scene = fs::read_to_string(softstop_testing::docs("scenes/hertz.toml"))?;
    let scene: String = scene
        .lines()
        .filter(|line| !line.starts_with("name"))
        .map(|line| format!("{line}\n"))
        .collect();
    let is_quiet = |text: &[u8]| {
        !String::from_utf8_lossy(text).contains(|c: char| c.is_control() && c != '\n')
    };
    for (text, is_good) in [
        (scene.clone(), true),
        (format!("{scene}\n\"\\u001b\" = 1\n"), false),
    ] {
        fs::write(&file, text)?;
        let out = folder.path().join("out");
        let run = SOFTSTOP.run(&["simulate", path, "--output", out.to_str().ok_or("path")?]);
        assert_eq!(run.status.success(), is_good);
        assert!(is_quiet(&run.stdout) && is_quiet(&run.stderr), "{run:?}");
    }
    let picture = fs::read(folder.path().join("out/motion.svg"))?;
    assert!(is_quiet(&picture));
    Ok(())
}
