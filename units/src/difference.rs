//! Derivatives of outputs along a direction, by differences of the last step gone through again.

use softstop_fmi::variable::Scaled;
use softstop_fmi::{Known, slope};

/// Width of the first differences along the direction, in units of what is typical of each known.
const RELATIVE_WIDTH: f64 = 1e-3;

/// How a unit goes through its last step again, from a beginning that was moved.
pub(crate) type Repeat<U> = fn(&U, &[(Known, f64)], f64) -> Option<U>;

/// A direction of change at the beginning of the last step.
#[derive(Debug)]
pub struct Direction<U> {
    unit: U,
    direction: Vec<(Known, f64)>,
    /// The largest seed in units of what is typical of its known.
    steepest: f64,
    repeat: Repeat<U>,
}

impl<U: Clone> Direction<U> {
    pub(crate) fn new(
        unit: &U,
        direction: &[(Known, f64)],
        typical: impl Fn(Known) -> f64,
        repeat: Repeat<U>,
    ) -> Self {
        let steep = |(known, seed): &(Known, f64)| seed.abs() / typical(*known);
        Self {
            unit: unit.clone(),
            direction: direction.to_vec(),
            steepest: direction.iter().map(steep).fold(0.0, f64::max),
            repeat,
        }
    }

    /// The derivative of an output.
    pub(crate) fn of(&self, (value, nominal): Scaled<U>) -> f64 {
        if self.steepest == 0.0 {
            return 0.0;
        }
        let (here, width) = (value(&self.unit), RELATIVE_WIDTH / self.steepest);
        slope(here, nominal, width, |step| {
            let moved = (self.repeat)(&self.unit, &self.direction, step)?;
            Some(value(&moved))
        })
    }
}
