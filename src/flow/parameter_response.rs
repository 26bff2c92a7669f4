//! What a course answers to small changes of its start, its law and its drive.

use nalgebra::{Matrix3x2, Vector3};

/// Changes of position in m and velocity in m/s, and of the integral of velocity times cos(angle), in m.
pub(crate) type Answer = Vector3<f64>;

/// Forces per mass along a course that a change of its law and its drive is made of.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Source {
    /// 1.
    Constant,
    /// Position, seen from the departure or, under a power law, from its face.
    Way,
    /// Velocity v.
    Velocity,
    /// Cosine of the drive angle.
    Cosine,
    /// Sine of the drive angle.
    Sine,
    /// The power law d^n (1 + lambda v) itself.
    Power,
    /// d^n v.
    Gripped,
    /// d^n ln d (1 + lambda v).
    Logarithm,
    /// d^(n - 1) (1 + lambda v).
    Steepness,
}

/// How much of each source.
pub(crate) type Forces = [f64; 9];

/// The answers at one time.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ParameterResponse {
    /// To changes of position and velocity at departure.
    pub free: Matrix3x2<f64>,
    /// From rest, to one of each source.
    pub forced: [Answer; 9],
    /// Integrals of the course's own velocity times cosine and sine of the drive angle, in m.
    pub travel: (f64, f64),
}

impl ParameterResponse {
    /// The answer to a change at departure and to forces.
    pub fn to(&self, start: &Answer, forces: &Forces) -> Answer {
        let carried = self.free * start.xy() + Answer::new(0.0, 0.0, start.z);
        let pairs = self.forced.iter().zip(forces);
        pairs.fold(carried, |sum, (answer, force)| sum + *force * answer)
    }
}
