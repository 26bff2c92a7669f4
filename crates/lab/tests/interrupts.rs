//! Every long command of `softstop-lab` ends on a signal, and leaves nothing half written.
#![cfg(unix)]

use softstop_testing::{Program, words};

const LABORATORY: Program = Program {
    file: env!("CARGO_BIN_EXE_softstop-lab"),
    first: &[],
};

#[test]
fn long_commands_end_on_a_signal() {
    for line in [
        "paper",
        "table1",
        "table1 --output .",
        "chart precision all",
        "chart failures",
        "throughput --check 100000000",
    ] {
        for signal in ["INT", "TERM", "HUP"] {
            let folder = tempfile::tempdir().expect("a folder");
            LABORATORY.ends_on(
                signal,
                &words(line),
                folder.path(),
                &["paper.part", "table1.part"],
            );
        }
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
