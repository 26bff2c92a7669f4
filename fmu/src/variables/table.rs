//! The table itself, group by group.
//!
//! The names are a tree, and the rows stand depth first, as structured naming demands: all of a
//! branch and all elements of an array come in one piece.

mod machine;
mod outputs;
mod rows;
mod stops;

use super::Variable;

const GROUPS: &[&[Variable]] = &[
    machine::INPUTS,
    machine::OSCILLATOR,
    stops::LAWS,
    stops::LOADING_FROM,
    stops::LOADING_STIFFNESS,
    stops::UNLOADING_COUNT,
    stops::UNLOADING_FROM,
    stops::UNLOADING_STIFFNESS,
    stops::RIGID,
    machine::STRIP_AND_START,
    outputs::OUTPUTS,
];

const fn number_of_rows() -> usize {
    let (mut rows, mut group) = (0, 0);
    while group < GROUPS.len() {
        rows += GROUPS[group].len();
        group += 1;
    }
    rows
}

static ROWS: [Variable; number_of_rows()] = {
    let mut rows = [GROUPS[0][0]; number_of_rows()];
    let (mut filled, mut group) = (0, 0);
    while group < GROUPS.len() {
        let mut row = 0;
        while row < GROUPS[group].len() {
            rows[filled] = GROUPS[group][row];
            filled += 1;
            row += 1;
        }
        group += 1;
    }
    rows
};

/// All variables, in the order of the XML.
pub static VARIABLES: &[Variable] = &ROWS;
