//! The library as a C program sees it: loaded at run time, by function types from the standard; and its memory over
//! thousands of loads and with many instances at a time.
#![cfg(unix)]

use crate::common::c_program::{Program, available, succeeded};

/// Runs a program of `tests/c`, under another program and its options if there is one: it has to succeed. With
/// `RUST_BACKTRACE` a panic's backtrace would read symbol tables that are never given back.
fn run(name: &str, arguments: &[&str], under: &[&str]) {
    let Some(program) = Program::compile(name) else {
        return;
    };
    let mut command = match under {
        [] => program.command(),
        [other, options @ ..] => program.under(other, options),
    };
    command.args(arguments).env("RUST_BACKTRACE", "1");
    succeeded(&command.output().expect("a program that runs"));
}

#[test]
fn all_calls_from_c() {
    run("drive", &[], &[]);
}

/// The communication points drift by rounding; the motion must not.
#[test]
fn ten_million_steps_from_c() {
    run("drive", &["long", "10000000"], &[]);
}

#[test]
fn valgrind_finds_nothing() {
    const VALGRIND: [&str; 5] = [
        "valgrind",
        "--quiet",
        "--leak-check=full",
        "--errors-for-leak-kinds=definite,indirect",
        "--error-exitcode=9",
    ];
    if available("valgrind") {
        // Millions of impacts would take valgrind minutes.
        run("drive", &["brief"], &VALGRIND);
    }
}

#[cfg(target_os = "linux")]
#[test]
fn five_thousand_loads_leave_nothing() {
    run("memory", &["cycles", "5000"], &[]);
}

#[cfg(target_os = "linux")]
#[test]
fn ten_thousand_instances_at_a_time() {
    run("memory", &["crowd", "10000"], &[]);
}
