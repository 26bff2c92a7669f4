//! Memory over thousands of loads and in a crowd of instances, as a C program sees it.
#![cfg(target_os = "linux")]

use crate::common::c_program::{Program, succeeded};

/// `RUST_BACKTRACE` would make a panic's backtrace read symbol tables that are never given back.
#[test]
fn five_thousand_loads_leave_nothing() {
    if let Some(program) = Program::compile("memory") {
        let mut command = program.command();
        command.args(["cycles", "5000"]).env("RUST_BACKTRACE", "1");
        succeeded(&command.output().expect("a program that runs"));
    }
}

#[test]
fn ten_thousand_instances_at_a_time() {
    if let Some(program) = Program::compile("memory") {
        let mut command = program.command();
        command.args(["crowd", "10000"]);
        succeeded(&command.output().expect("a program that runs"));
    }
}
