//! The tests of the optimiser, and of the program `softstop` as users and scripts meet it, as one program.

mod basin;
mod best;
mod cases;
mod command_line;
mod continuation;
mod fidelity;
mod gallery;
mod gradients;
mod grid;
mod guide;
mod handed_on;
mod held;
mod interrupts;
mod motions;
mod optimum;
mod pareto;
mod pile_driver;
mod prove;
mod refusals;
mod report;
mod robust;
mod simulate;
mod spread;
mod study;
mod sweep;
mod ties;
mod tolerated;
mod trials;
mod two_motions;
mod watch;

use softstop_testing::Program;

type Outcome<T = ()> = Result<T, Box<dyn std::error::Error>>;

const SOFTSTOP: Program = Program {
    file: env!("CARGO_BIN_EXE_softstop"),
    first: &[],
};
