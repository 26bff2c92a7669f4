//! What the commands refuse, and in which words.

use std::fs;
use std::path::Path;

use super::{Outcome, SOFTSTOP, words};

#[test]
fn bad_values_are_named_with_their_range() {
    let cases: [(&str, &[&str]); 14] = [
        ("orbit --stiffness -1", &["stiffness = -1", ">= 0"]),
        ("orbit --frequency 0", &["frequency = 0", "> 0"]),
        ("orbit --clearance NaN", &["clearance = NaN", "finite"]),
        ("orbit --damping=-inf", &["damping = -inf", ">= 0"]),
        ("orbit --frequency fast", &["--frequency", "fast"]),
        ("zone --preload 1 --preload-deflection 1", &["--preload"]),
        ("zone --thickness 0.4", &["thickness = 0.4", "loaded"]),
        ("zone --regime resting", &["resting", "unloaded", "loaded"]),
        ("optimize --margin 0.6", &["margin = 0.6", "[0, 0.5]"]),
        ("optimize --margin -0.1", &["margin = -0.1", "[0, 0.5]"]),
        (
            "optimize --bounds clearance=5:2",
            &["clearance = 5:2", "low"],
        ),
        (
            "optimize --fix weight=5",
            &["weight: unknown key", "clearance", "stop.stiffness"],
        ),
        (
            "optimize --fix stiffness=7 --bounds stiffness=1:9",
            &["stiffness", "one"],
        ),
        ("optimize --evaluations 5", &["evaluations = 5", "100"]),
    ];
    for (line, told) in cases {
        SOFTSTOP.ends_with(&words(line), 2, told);
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
        SOFTSTOP.ends_with(&["optimize", "--config", path], 2, words);
    }
    SOFTSTOP.ends_with(
        &["optimize", "--config", "no-such-file.toml"],
        2,
        &["no-such-file.toml"],
    );
    fs::write(&file, "weight = 2\n")?;
    SOFTSTOP.ends_with(&["orbit", "--scene", path], 2, &["unknown field `weight`"]);
    Ok(())
}

#[test]
fn what_a_machine_does_not_have_is_refused_by_every_command() -> Outcome {
    let folder = tempfile::tempdir()?;
    let output = folder.path().join("out");
    let output = output.to_str().ok_or("path")?;
    let scene = format!("{}/../docs/scenes/hertz.toml", env!("CARGO_MANIFEST_DIR"));
    let range = ["--from", "0.9", "--to", "1.5", "--output", output];
    let follow = [&["continue", "--parameter", "eta"], &range[..]].concat();
    let sweep = [&["sweep"], &range[..]].concat();
    let commands: [&[&str]; 11] = [
        &["orbit"],
        &["zone"],
        &["motions"],
        &follow,
        &sweep,
        &["basin", "--output", output],
        &["fidelity", "--output", output],
        &["simulate", "--output", output],
        &["watch", "--output", output],
        &["fmu", "--output", output],
        &["optimize", "--output", output],
    ];
    for command in commands {
        let with = |more: &[&'static str]| [command, more].concat();
        let starts = ["simulate", "watch", "fidelity", "fmu"].contains(&command[0]);
        if !starts {
            SOFTSTOP.ends_with(
                &with(&["--set", "initial.velocity=3"]),
                2,
                &["initial.velocity", "plays no part"],
            );
        }
        SOFTSTOP.ends_with(
            &with(&["--set", "clearence=3"]),
            2,
            &["clearence", "did you mean clearance?"],
        );
        SOFTSTOP.ends_with(
            &with(&["--set", "stop.exponent=2"]),
            2,
            &["stop.exponent", "no such parameter"],
        );
        SOFTSTOP.ends_with(
            &with(&["--set", "clearance=wide"]),
            2,
            &["clearance = wide"],
        );
        SOFTSTOP.ends_with(
            &with(&["--set", "rho=3", "--set", "clearance=4"]),
            2,
            &["twice"],
        );
        SOFTSTOP.ends_with(&with(&["--set", "clearance"]), 2, &["KEY=VALUE"]);
        SOFTSTOP.ends_with(&with(&["nowhere.toml"]), 2, &["nowhere.toml"]);
        SOFTSTOP.ends_with(
            &[command, &[scene.as_str(), "--stiffness", "3"]].concat(),
            2,
            &["--stiffness", "hertz.toml", "--set stop.stiffness=3"],
        );
        SOFTSTOP.ends_with(
            &[command, &[scene.as_str(), "--regime", "loaded"]].concat(),
            2,
            &["--regime", "hertz.toml"],
        );
    }
    assert!(!Path::new(output).exists());
    Ok(())
}

/// The key of a frequency says its unit to every flag, and letters of ratios are for ratios.
#[test]
fn keys_are_read_in_their_own_unit() -> Outcome {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("hertz.toml");
    let text = "mass = 20\nstiffness = 8e4\ndamping = 50\nclearance = 0.012\ncontact.damping = 230\n\
                excitation = { amplitude = 96, frequency_hz = 10 }\nstop.model = \"none\"\n";
    fs::write(&file, text)?;
    let path = file.to_str().ok_or("path")?;
    let cases: [(&str, &[&str]); 6] = [
        (
            "continue --parameter excitation.frequency --from 9 --to 11",
            &["excitation.frequency = 62.83"],
        ),
        (
            "continue --parameter excitation.frequency_hz --from 60 --to 65",
            &["excitation.frequency_hz = 10"],
        ),
        (
            "continue --parameter eta --from 0.9 --to 1.5",
            &["eta", "excitation.frequency_hz"],
        ),
        ("orbit --set eta=1", &["eta", "excitation.frequency_hz"]),
        ("optimize --fix eta=1", &["eta", "excitation.frequency_hz"]),
        ("sweep --from 1 --to nan", &["--to = NaN"]),
    ];
    for (line, told) in cases {
        SOFTSTOP.ends_with(&[&words(line)[..], &[path]].concat(), 2, told);
    }
    fs::write(&file, " ".repeat((1 << 20) + 1))?;
    SOFTSTOP.ends_with(&["orbit", path], 2, &["1 MiB"]);
    Ok(())
}

/// What a command does not use is refused, not ignored.
#[test]
fn what_a_command_does_not_use_is_refused() -> Outcome {
    let folder = tempfile::tempdir()?;
    let output = folder.path().join("out");
    let output = output.to_str().ok_or("path")?;
    let swept = "sweep --from 0.9 --to 1.5";
    let cases: [(&str, &str, &[&str]); 14] = [
        ("zone", "--frequency 1.2", &["frequency"]),
        ("zone", "--set eta=1.2", &["eta"]),
        (swept, "--frequency 1.2", &["frequency", "it is swept"]),
        (swept, "--set w=1.2", &["w", "it is swept"]),
        (
            swept,
            "--clearances 2,6 --set rho=3",
            &["rho", "--clearances"],
        ),
        (
            "orbit",
            "--clearance 6 --set rho=5",
            &["--clearance", "--set rho"],
        ),
        (
            "orbit --stiffness 6",
            "--set stop.model=rigid --set R=0.5",
            &["--stiffness", "stop.model"],
        ),
        (
            "simulate --position 3",
            "--set initial.position=2",
            &["--position", "initial.position"],
        ),
        ("basin", "--phi 0:1", &["--phi", "the plane"]),
        ("basin --plane phi,v", "--x 0:1", &["--x", "the plane"]),
        ("fidelity", "--sweep 1:2", &["--structure"]),
        ("stops", "--set clearance=3", &["--set"]),
        ("stops", "unloaded", &["unloaded"]),
        ("zone", "--output there", &["--output"]),
    ];
    for (line, more, told) in cases {
        let command = words(line);
        let writes = words("simulate sweep basin fidelity stops").contains(&command[0]);
        let place: &[&str] = if writes { &["--output", output] } else { &[] };
        SOFTSTOP.ends_with(&[&command[..], place, &words(more)].concat(), 2, told);
    }
    assert!(!Path::new(output).exists());
    Ok(())
}
