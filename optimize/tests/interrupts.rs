//! Every long command of `softstop` ends on a signal, unless it inherits that it is ignored, and leaves nothing half
//! written.
#![cfg(unix)]

#[path = "interrupts/dispositions.rs"]
pub mod dispositions;
#[cfg(target_os = "linux")]
#[path = "interrupts/faults.rs"]
mod faults;
#[path = "interrupts/writers.rs"]
mod writers;

use std::fs;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use softstop_console::interrupt::LATE;
use softstop_testing::{with_folders, words};

use crate::{Outcome, SOFTSTOP};

const SIGNALS: [&str; 5] = ["INT", "TERM", "HUP", "QUIT", "USR1"];

/// A budget that no run spends before it is interrupted.
const ENDLESS: &str = "--budget 1000000";

/// It ends by itself: no step of it takes long. It goes on where the signals are ignored.
fn ends(line: &str, kept: &[&str]) {
    let budget = if line.starts_with("study") {
        ""
    } else {
        ENDLESS
    };
    let line = with_folders(&format!("{line} {budget}"));
    for signal in SIGNALS {
        let folder = tempfile::tempdir().expect("a folder");
        let said = SOFTSTOP.ends_on(signal, &words(&line), folder.path(), kept);
        assert!(!said.contains(LATE), "{line}: {said}");
    }
    let folder = tempfile::tempdir().expect("a folder");
    SOFTSTOP.outlives_ignored_signals(&words(&line), folder.path(), kept);
}

#[test]
fn simulate() {
    ends("simulate --periods 1000000 --samples-per-period 20", &[]);
    ends(
        "simulate SCENES/hertz.toml --periods 1000000 --samples-per-period 1",
        &[],
    );
}

#[test]
fn watch() {
    ends("watch SCENES/hertz.toml --periods 1000000", &[]);
}

#[test]
fn motions() {
    ends("motions --set rho=-3", &[]);
    ends("motions SCENES/chatter.toml --starts 100000", &[]);
}

#[test]
fn zone() {
    ends("zone SCENES/hertz.toml --set contact.damping=1e4", &[]);
}

#[test]
fn orbit() {
    ends("orbit SCENES/hertz.toml --set contact.damping=1e5", &[]);
}

#[test]
fn continuation() {
    ends(
        "continue --set rho=-3 --orbit 5/7 --parameter eta --from 0.1 --to 3",
        &[],
    );
}

#[test]
fn sweep() {
    ends("sweep --from 0.8 --to 1.8 --steps 100000", &["sweep.part"]);
}

#[test]
fn basin() {
    ends("basin --size 3000", &["basin.part"]);
    ends("basin SCENES/chatter.toml --size 100", &["basin.part"]);
    ends("basin --along-zone 1000 --size 1000", &["basin.part"]);
}

#[test]
fn optimize() {
    ends("optimize --set contact.damping=100", &DESIGN);
}

/// What is left of an interrupted search.
const DESIGN: [&str; 6] = [
    "optimize.part",
    "design.fmu",
    "design.json",
    "design.ssv",
    "design.svg",
    "design.toml",
];

/// An interrupted search writes its best design, whole and marked; if none is as asked, nothing.
#[test]
fn the_best_design_so_far_is_written() -> Outcome {
    let task = "machine = \"loaded\"\n[vary]\nstop.stiffness = [1, 30]\nclearance = [2, 22]\ndamping = [0.01, 0.05]\n\
                [search]\nevaluations = 4000000\n";
    let certain = "[require]\ncertainty = 0.9999\n";
    for (require, is_met) in [
        ("", true),
        ("[require]\nvelocity = 1000\n", false),
        (certain, false),
    ] {
        let folder = tempfile::tempdir()?;
        let out = folder.path().join("out");
        fs::write(folder.path().join("task.toml"), format!("{task}{require}"))?;
        let mut command = Command::new(SOFTSTOP.file);
        command.args(words("optimize --config task.toml --output out"));
        let quiet = command.stdout(Stdio::null()).stderr(Stdio::piped());
        let run = quiet.current_dir(folder.path()).spawn()?;
        let deadline = Instant::now() + Duration::from_secs(60);
        let kept = || fs::metadata(out.join("optimize.part")).map_or(0, |file| file.len());
        while kept() < 20_000 && Instant::now() < deadline {
            std::thread::sleep(Duration::from_millis(20));
        }
        let id = run.id().to_string();
        assert!(Command::new("kill").args(["-INT", &id]).status()?.success());
        let end = run.wait_with_output()?;
        let said = String::from_utf8_lossy(&end.stderr);
        assert_eq!(end.status.code(), Some(130), "{said}");
        assert!(said.contains("--resume"), "{said}");
        let mut left: Vec<String> = Vec::new();
        for entry in fs::read_dir(&out)? {
            left.push(entry?.file_name().to_string_lossy().into_owned());
        }
        left.sort();
        if !is_met {
            assert_eq!(left, ["optimize.part"], "{said}");
            assert!(
                said.contains("no design met so far is as required"),
                "{said}"
            );
            continue;
        }
        assert!(said.contains("best design so far is written"), "{said}");
        let mut whole = DESIGN;
        whole.sort_unstable();
        assert_eq!(left, whole);
        let report: serde_json::Value =
            serde_json::from_slice(&fs::read(out.join("design.json"))?)?;
        assert_eq!(report["search"]["interrupted"], "search");
        let machine = fs::read_to_string(out.join("design.toml"))?;
        assert!(machine.contains("interrupted search"), "{machine}");
        softstop::Machine::from_toml(&machine)?;
    }
    Ok(())
}

/// Whatever beginning of what a killed search has kept is there, it goes on to the same design; it says that no run has written it
/// where the first 8 bytes, by which it is known, are not all there.
#[test]
fn every_beginning_of_what_is_kept_resumes_or_is_refused() -> Outcome {
    let folder = tempfile::tempdir()?;
    let out = folder.path().join("out");
    let part = out.join("optimize.part");
    let command = |more: &str| {
        let mut command = Command::new(SOFTSTOP.file);
        let line = "optimize loaded --evaluations 400 --no-report --samples 1000 --output out";
        command.args(words(line)).args(words(more));
        command.stdout(Stdio::null()).stderr(Stdio::piped());
        command.current_dir(folder.path());
        command
    };
    let design = || fs::read(out.join("design.json"));
    let mut run = command("").spawn()?;
    let mut kept = Vec::new();
    while run.try_wait()?.is_none() {
        let now = fs::read(&part).unwrap_or_default();
        if now.len() > kept.len() {
            kept = now;
        }
    }
    let whole = design()?;
    assert!(kept.len() > 2000, "{} bytes are kept", kept.len());
    let cuts = (0..16).chain((1..=16).map(|step| step * kept.len() / 16));
    for cut in cuts {
        fs::remove_dir_all(&out)?;
        fs::create_dir(&out)?;
        fs::write(&part, &kept[..cut])?;
        let end = command("--resume").output()?;
        let said = String::from_utf8_lossy(&end.stderr);
        if (1..8).contains(&cut) {
            assert!(said.contains("no run has written it"), "{cut}: {said}");
            assert_eq!(fs::read(&part)?, kept[..cut]);
        } else {
            assert!(end.status.success(), "{cut}: {said}");
            assert_eq!(design()?, whole, "cut at {cut}");
            assert!(!part.exists(), "cut at {cut}");
        }
    }
    Ok(())
}

#[test]
fn study() {
    let kept = &["study.part"];
    ends("study STUDIES/press.toml", kept);
    ends(
        "study STUDIES/press.toml --shard 2/3",
        &["shard-2-of-3.part"],
    );
}

#[test]
fn fidelity() {
    ends("fidelity B --repeats 1000", &[]);
}

/// Kills at random moments, each job taken up after each of them.
#[test]
fn nothing_is_lost_to_kills() {
    for line in [
        "sweep --from 0.8 --to 1.8 --steps 6000",
        "basin --size 700",
        "basin SCENES/chatter.toml --size 8 --transient 400",
        "basin --along-zone 4 --size 200",
        "optimize --evaluations 4000",
        "study STUDIES/map.toml --csv",
    ] {
        let line = with_folders(line);
        let folder = tempfile::tempdir().expect("a folder");
        SOFTSTOP.survives_kills(&words(&line), 6, folder.path());
    }
}
