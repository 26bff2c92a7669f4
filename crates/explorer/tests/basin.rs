//! Basins of the page.

use serde_json::json;
use softstop::Machine;
use softstop_dynamics::motion_kind::MotionClass;

/// After the first 200 drive periods no start of this machine has come within the distance of a return: its multipliers have
/// modulus 0.981.
#[test]
fn cells_that_settle_slowly_settle() {
    let machine = Machine::named("unloaded").expect("the paper's").to_toml();
    let set = [["eta", "2.57"], ["clearance", "11.6"], ["damping", "0.008"]];
    let question = json!({
        "machine": machine, "set": set, "task": "basin",
        "reach": [20.0, 30.0], "cells": [8, 8], "rows": [2, 6], "periods": 200
    });
    let answer = softstop_explorer::answer(&question.to_string());
    assert_eq!(answer.numbers.len(), 3 * 8 * 4, "{}", answer.text);
    let place = MotionClass::ALL
        .iter()
        .position(|it| *it == MotionClass::Zero);
    let expected = [place.expect("a class") as f64, 0.0, 1.0];
    assert!(
        answer.numbers.chunks(3).all(|kind| kind == expected),
        "{:?}",
        answer.numbers
    );
}
