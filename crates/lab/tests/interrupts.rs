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
        "chart precision all",
        "chart failures",
        "throughput --check 100000000",
    ] {
        for signal in ["INT", "TERM", "HUP"] {
            let folder = tempfile::tempdir().expect("a folder");
            LABORATORY.ends_on(signal, &words(line), folder.path(), &["paper.part"]);
        }
    }
}

#[test]
fn nothing_of_the_paper_is_lost_to_kills() {
    let folder = tempfile::tempdir().expect("a folder");
    let line = "paper 6a 7a 8 table1 certainty supply hardening --draft";
    LABORATORY.survives_kills(&words(line), 6, folder.path());
}
