//! What an importer integrates in model exchange, and the event indicators.

use softstop_fmi::variable::{Access, Kind, RealKind};
use softstop_fmi::{State, StateSpace};

use super::rows::{Row, row};

/// Position and velocity, and the indicators.
pub(crate) const STATE_SPACE: StateSpace = StateSpace {
    states: &[
        State {
            value: 200,
            derivative: 201,
            start: 15,
        },
        State {
            value: 201,
            derivative: 202,
            start: 16,
        },
    ],
    indicators: &[230, 231, 232],
};

macro_rules! margin {
    ($reference:literal, $number:literal) => {
        row(
            $reference,
            concat!("event.indicator[", $number, "]"),
            Kind::Real(RealKind::any(None)),
            Access::Local(|machine| machine.margin($number - 1)),
            "For model exchange: how far the state is from an end of the law of motion that holds, in parts of the machine's size; 1 where there is no such end",
        )
    };
}

/// The event indicators, one for each end that a law may have.
pub(super) const INDICATORS: &[Row] = &[margin!(230, 1), margin!(231, 2), margin!(232, 3)];
