//! The library as a C program sees it: loaded at run time, by function types from the standard.
#![cfg(unix)]

use crate::common::c_program::{Program, available, succeeded};

#[test]
fn all_calls_from_c() {
    if let Some(program) = Program::compile("drive") {
        succeeded(&program.command().output().expect("a program that runs"));
    }
}

/// The communication points drift by rounding; the motion must not.
#[test]
fn ten_million_steps_from_c() {
    if let Some(program) = Program::compile("drive") {
        let mut command = program.command();
        command.args(["long", "10000000"]);
        succeeded(&command.output().expect("a program that runs"));
    }
}

#[test]
fn valgrind_finds_nothing() {
    if !available("valgrind") {
        return;
    }
    if let Some(program) = Program::compile("drive") {
        let options = [
            "--quiet",
            "--leak-check=full",
            "--errors-for-leak-kinds=definite,indirect",
            "--error-exitcode=9",
        ];
        let mut command = program.under("valgrind", &options);
        // Millions of impacts would take valgrind minutes.
        command.arg("brief");
        succeeded(&command.output().expect("a program that runs"));
    }
}
