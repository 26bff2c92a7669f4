//! Figures with their derivatives.

/// A figure of a motion with its derivatives.
#[derive(Debug, Clone, PartialEq)]
pub struct DifferentiatedFigure {
    /// The figure.
    pub value: f64,
    /// Its derivatives in SI units, in the order of [`Slopes::parameters`](super::Slopes).
    pub by: Vec<f64>,
}

/// An impact of a motion, time and velocity with their derivatives.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct DifferentiatedImpact {
    /// Time in s.
    pub time: DifferentiatedFigure,
    /// Before-impact velocity in m/s.
    pub velocity: DifferentiatedFigure,
}
