//! The program `softstop-lab`; what it does is in the library beside it.

use std::process::ExitCode;

fn main() -> ExitCode {
    softstop_lab::main()
}
