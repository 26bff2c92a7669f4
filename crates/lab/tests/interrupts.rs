//! Every long command of `softstop-lab` ends on a signal, unless it inherits that it is ignored, and leaves nothing half
//! written, whatever becomes of its output.
#![cfg(unix)]

use softstop_testing::{Program, words};

const LABORATORY: Program = Program {
    file: env!("CARGO_BIN_EXE_softstop-lab"),
    first: &[],
};

const KEPT: [&str; 2] = ["paper.part", "table1.part"];

#[test]
fn long_commands_end_on_a_signal() {
    for line in [
        "paper",
        "table1",
        "table1 --output .",
        "chart precision all",
        "chart failures",
        "throughput --repeats 1000",
    ] {
        for signal in ["INT", "TERM", "HUP", "QUIT", "USR1"] {
            let folder = tempfile::tempdir().expect("a folder");
            LABORATORY.ends_on(signal, &words(line), folder.path(), &KEPT);
        }
        let folder = tempfile::tempdir().expect("a folder");
        LABORATORY.outlives_ignored_signals(&words(line), folder.path(), &KEPT);
    }
}

/// Commands that do not take long, and whether they write files.
const BRIEF: [(&str, bool); 5] = [
    ("paper 7a --draft", true),
    ("table1 --motions 2 --lifetime 100", true),
    ("chart precision periodic --method exact --quick", true),
    (
        "chart failures --points 2 --method newmark --scene bounce",
        true,
    ),
    ("throughput --repeats 1 --zones 4", false),
];

#[test]
fn outputs_that_are_unread_or_full_are_told() {
    let folder = tempfile::tempdir().expect("a folder");
    for (line, _) in BRIEF {
        LABORATORY.ends_when_unread(&words(line), folder.path());
        #[cfg(target_os = "linux")]
        LABORATORY.tells_of_a_full_disk(&words(line), folder.path());
    }
    for (line, _) in BRIEF.iter().filter(|(_, writes)| *writes) {
        let folder = tempfile::tempdir().expect("a folder");
        let line = format!("{line} --output out");
        LABORATORY.tells_of_files_too_large(&words(&line), folder.path(), &KEPT);
    }
}

#[test]
fn nothing_is_lost_to_kills() {
    for (line, kills) in [
        ("paper 6a 7a 8 table1 certainty supply hardening --draft", 6),
        ("table1 --motions 2 --lifetime 100", 2),
    ] {
        let folder = tempfile::tempdir().expect("a folder");
        LABORATORY.survives_kills(&words(line), kills, folder.path());
    }
}
