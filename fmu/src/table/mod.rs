//! The table of variables, group by group.

mod below;
mod drive;
mod exchange;
mod outputs;
mod parameters;
mod rows;
mod stops;
mod terminals;

pub(crate) use exchange::STATE_SPACE;
pub(crate) use outputs::IMPACT;
use rows::Row;
pub(crate) use terminals::TERMINALS;

/// All variables, in the order of the XML.
pub(crate) const GROUPS: &[&[Row]] = &[
    parameters::INPUTS,
    drive::DRIVE,
    parameters::OSCILLATOR,
    stops::LAWS,
    stops::LOADING_FROM,
    stops::LOADING_STIFFNESS,
    stops::UNLOADING_COUNT,
    stops::UNLOADING_FROM,
    stops::UNLOADING_STIFFNESS,
    below::LAWS,
    below::LOADING_FROM,
    below::LOADING_STIFFNESS,
    below::UNLOADING_COUNT,
    below::UNLOADING_FROM,
    below::UNLOADING_STIFFNESS,
    stops::RIGID,
    parameters::STRIP_AND_START,
    outputs::OUTPUTS,
    exchange::INDICATORS,
];
