//! What calls cost from C (`tests/c/bench.c`): `cargo bench --profile dist --package softstop-fmu --bench c_speed`, a
//! few seconds. Where there is no C compiler nothing is measured.

#[path = "../tests/common/c_program.rs"]
#[expect(dead_code, reason = "the tests run programs otherwise, too")]
mod c_program;
#[path = "../tests/common/library.rs"]
mod library;

use c_program::{Program, succeeded};

fn main() {
    if cfg!(unix)
        && let Some(program) = Program::compile("bench")
    {
        succeeded(&program.command().output().expect("a program that runs"));
    }
}
