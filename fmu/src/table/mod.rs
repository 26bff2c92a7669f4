//! The table of variables, group by group.

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
    stops::SLOPES_ABOVE,
    stops::LAWS_BELOW,
    stops::SLOPES_BELOW,
    stops::RIGID,
    parameters::STRIP_AND_START,
    outputs::OUTPUTS,
    exchange::INDICATORS,
];
