//! The particular solution of a linear law.

use nalgebra::{Complex, Vector2};

use super::{Departure, DriveAngle, LinearLaw};

/// The particular solution offset + slope t + cosine cos(angle) + sine sin(angle).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ParticularSolution {
    pub offset: f64,
    pub slope: f64,
    pub cosine: f64,
    pub sine: f64,
    frequency: f64,
}

impl ParticularSolution {
    /// The particular solution with offset + slope t = (c + r t)/b - 2 a r/b^2 and this steady state.
    pub fn new(flow: &LinearLaw, from: &Departure, (cosine, sine): (f64, f64)) -> Self {
        let b = flow.modes.stiffness;
        let slope = from.forcing.rate() / b;
        let offset = (from.forcing.value() - 2.0 * flow.modes.decay * slope) / b;
        Self {
            offset,
            slope,
            cosine,
            sine,
            frequency: flow.frequency,
        }
    }

    /// Position and velocity of the particular solution.
    #[inline]
    pub fn state_at(&self, elapsed: f64, DriveAngle { cos, sin }: DriveAngle) -> (f64, f64) {
        (
            self.offset + self.slope * elapsed + self.cosine * cos + self.sine * sin,
            self.slope + self.frequency * (self.sine * cos - self.cosine * sin),
        )
    }

    /// Derivative of the harmonic part by the drive's frequency, `time` seconds after the instant at which the drive's
    /// angle is held: the response Re((c1 t + c0) e^(i angle)) to the force -A t sin(angle).
    pub fn frequency_derivative(
        &self,
        flow: &LinearLaw,
        time: f64,
        drive: DriveAngle,
    ) -> Vector2<f64> {
        if flow.amplitude == 0.0 {
            return Vector2::zeros();
        }
        let (i, w): (Complex<f64>, f64) = (Complex::i(), self.frequency);
        let steady = Complex::new(self.cosine, -self.sine);
        let grows = i * steady;
        let stays = steady * steady * Complex::new(2.0 * w, -flow.damping()) / flow.amplitude;
        let (angle, now) = (Complex::new(drive.cos, drive.sin), grows * time + stays);
        Vector2::new((now * angle).re, ((grows + i * w * now) * angle).re)
    }
}
