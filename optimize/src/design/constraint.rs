//! What may hold a design back, as a constraint.

use softstop::Parameter;

use super::figure::{Figure, Sense};
use super::slope::Slope;
use super::space::End;

/// What may hold a design back.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Limit {
    /// An end of what a parameter is searched in.
    Axis(Parameter, End),
    /// An end of the drive's frequencies.
    Frequency(End),
    /// The margin M from an end of the zone.
    Margin(End),
    /// A required figure, by the side that is good.
    Required(Figure, Sense),
    /// Tolerances that reach an end of the zone.
    Tolerances(End),
    /// Tolerances that reach a border inside the zone.
    Loss,
}

/// What holds a design back in the drawing's operating point or in a case.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct ActiveLimit {
    /// What.
    pub limit: Limit,
    /// The index of the case, if it is one.
    pub case: Option<usize>,
}

impl From<Limit> for ActiveLimit {
    /// In the drawing's operating point.
    fn from(limit: Limit) -> Self {
        Self { limit, case: None }
    }
}

/// A constraint, met where it is not negative, in units of its bound.
#[derive(Debug, Clone)]
pub struct Constraint {
    /// What it keeps.
    pub limit: ActiveLimit,
    /// Its value.
    pub slope: Slope,
}
