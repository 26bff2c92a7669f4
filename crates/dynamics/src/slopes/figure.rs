//! Figures with their derivatives.

/// A figure of a motion with its derivatives.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// The figure.
    pub value: f64,
    /// Its derivatives in SI units, in the order of [`Slopes::parameters`](super::Slopes).
    pub by: Vec<f64>,
}

/// An impact.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Strike {
    /// Time in s.
    pub time: Figure,
    /// Before-impact velocity in m/s.
    pub velocity: Figure,
}
