//! The table itself, group by group.
//!
//! The names are a tree, and the rows stand depth first, as structured naming demands: all of a
//! branch and all elements of an array come in one piece.

mod outputs;
mod parameters;
mod rows;
mod stops;

use rows::Row;

/// All variables, in the order of the XML.
pub(crate) const GROUPS: &[&[Row]] = &[
    parameters::INPUTS,
    parameters::OSCILLATOR,
    stops::LAWS,
    stops::LOADING_FROM,
    stops::LOADING_STIFFNESS,
    stops::UNLOADING_COUNT,
    stops::UNLOADING_FROM,
    stops::UNLOADING_STIFFNESS,
    stops::RIGID,
    parameters::STRIP_AND_START,
    outputs::OUTPUTS,
];
