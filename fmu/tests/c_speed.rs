//! What calls cost from C. The figures are for reading, nothing is asserted about them:
//! `cargo test --release --package softstop-fmu --test fmu c_speed -- --ignored --nocapture`
#![cfg(unix)]

use crate::common::c_program::{Program, succeeded};

#[test]
#[ignore = "a measurement, to be run alone and in release mode"]
fn what_calls_cost() {
    if let Some(program) = Program::compile("bench") {
        succeeded(&program.command().output().expect("a program that runs"));
    }
}
