//! Curves of special points in two parameters: their points, how far they are followed, and why they end.

use nalgebra::Vector2;

use super::{CodimensionTwo, ContinuationSettings, SpecialKind};
use crate::orbit::{Monodromy, OrbitError};

/// A point of a curve of special points in two parameters.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct CurvePoint {
    /// Values of both parameters.
    pub parameters: [f64; 2],
    /// Position in m at time 0.
    pub position: f64,
    /// Velocity in m/s at time 0.
    pub velocity: f64,
    /// Before-impact velocities of the orbit in m/s.
    pub impacts: Vec<f64>,
    /// Jacobian of the map over the periods from where it is computed: time 0, an impact or a touch, which is left out.
    pub monodromy: Monodromy,
}

impl CurvePoint {
    /// State of the orbit at this point of a curve at time 0, position and velocity.
    pub fn state(&self) -> Vector2<f64> {
        Vector2::new(self.position, self.velocity)
    }

    /// The highest before-impact velocity at this point of a curve in m/s; 0 without any impact.
    pub fn before_impact_velocity(&self) -> f64 {
        self.impacts.iter().copied().fold(0.0, f64::max)
    }
}

/// Where and how far a curve in two parameters is followed: their ranges, the most points in each direction, and the steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurveLimits {
    /// Lowest and highest values of the parameters.
    pub ranges: [(f64, f64); 2],
    /// Points in each direction.
    pub points: usize,
    /// Settings of the continuation, as of [`ContinuationSettings::of_curves`].
    pub settings: ContinuationSettings,
}

/// Why a curve of special points ends.
#[derive(Debug, Clone)]
pub enum CurveEnd {
    /// A parameter reaches the end of its range; the last point is there.
    Range,
    /// There are as many points as asked for.
    Points,
    /// It comes back to its start.
    Closed,
    /// Beyond its last point the orbit would cross surfaces in another order: it grazes there.
    Grazing,
    /// It ends in a point of codimension two, its last one: resonant grazing, or a fold at its flip.
    CodimensionTwo(CodimensionTwo),
    /// The monitor asked for it.
    Stopped,
    /// It cannot be followed even with the smallest step.
    Lost(OrbitError),
}

/// A curve of special points of one kind in two parameters.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Curve {
    /// What its points are.
    pub kind: SpecialKind,
    /// Drive periods of the orbits.
    pub periods: u64,
    /// Points, in order of arclength.
    pub points: Vec<CurvePoint>,
    /// Points of codimension two on it, in the same order.
    pub specials: Vec<(CodimensionTwo, CurvePoint)>,
    /// Why it ends at its first point and at its last.
    pub ends: (CurveEnd, CurveEnd),
}
