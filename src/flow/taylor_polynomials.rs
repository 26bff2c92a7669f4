//! Local Taylor polynomials of the exact motion: they locate crossings without cancellation.

use super::{Departure, DriveAngle, LinearLaw};

/// Degree of the polynomials (odd): over one [`reach`](LinearLaw::reach) the remainder is far below rounding, and a contact
/// under a power law costs least.
pub(crate) const DEGREE: usize = 25;

/// Taylor polynomials of position and forcing about one instant, x(s) = sum c_n s^n.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TaylorPolynomials {
    /// Position in m/s^n.
    pub position: [f64; DEGREE + 1],
    /// Forcing p(t) + A cos(angle + w t) in m/s^2/s^n.
    pub forcing: [f64; DEGREE + 1],
}

/// The reciprocals 1/n of whole numbers, as Taylor recurrences divide by them.
pub const RECIPROCALS: [f64; DEGREE + 3] = {
    let mut table = [0.0; DEGREE + 3];
    let mut n = 1;
    while n < table.len() {
        table[n] = 1.0 / n as f64;
        n += 1;
    }
    table
};

impl TaylorPolynomials {
    /// The Taylor polynomials of a linear law from the state (x, v), with these coefficients of the forcing per mass and,
    /// where it is known, this initial acceleration.
    pub fn expand(
        flow: &LinearLaw,
        (x, v): (f64, f64),
        acceleration: Option<f64>,
        forcing: [f64; DEGREE + 1],
    ) -> Self {
        let (twice_decay, b) = (2.0 * flow.modes.decay, flow.modes.stiffness);
        let mut position = [0.0; DEGREE + 1];
        (position[0], position[1]) = (x, v);
        position[2] = 0.5 * acceleration.unwrap_or_default();
        for n in usize::from(acceleration.is_some())..DEGREE - 1 {
            let sum = forcing[n] - b * position[n];
            let damped = twice_decay * position[n + 1];
            position[n + 2] = (sum * RECIPROCALS[n + 1] - damped) * RECIPROCALS[n + 2];
        }
        Self { position, forcing }
    }

    /// The Taylor polynomials of the same forcing, with the mass held at `position`.
    pub fn held_at(mut self, position: f64) -> Self {
        self.position = [0.0; DEGREE + 1];
        self.position[0] = position;
        self
    }

    /// The forcing per mass and the velocity by the polynomials at eight times, in s: Horner's rule on all of them side by side.
    pub fn forcing_and_velocity(&self, times: [f64; 8]) -> [(f64, f64); 8] {
        let (mut forcing, mut velocity) = ([0.0; 8], [0.0; 8]);
        for n in (0..DEGREE).rev() {
            let rate = (n + 1) as f64 * self.position[n + 1];
            for (lane, s) in times.iter().enumerate() {
                forcing[lane] = forcing[lane] * s + self.forcing[n];
                velocity[lane] = velocity[lane] * s + rate;
            }
        }
        std::array::from_fn(|lane| (forcing[lane], velocity[lane]))
    }

    /// Position and velocity `s` seconds on by the Taylor polynomials.
    pub fn state_after(&self, s: f64) -> (f64, f64) {
        value_and_rate(&self.position, s)
    }
}

/// Taylor coefficients of the forcing p(t) + A cos(angle + w t) about a departure.
pub(super) fn forcing_series(flow: &LinearLaw, from: &Departure) -> [f64; DEGREE + 1] {
    let (value, rate) = (from.forcing.value(), from.forcing.rate());
    let mut forcing = linear_forcing_series(flow, from.drive, (value, rate));
    if !from.forcing.is_linear() {
        let higher = from.forcing.taylor_coefficients();
        for (sum, coefficient) in forcing.iter_mut().zip(higher).skip(2) {
            *sum += coefficient;
        }
    }
    forcing
}

/// Taylor coefficients of the forcing `constant` + `ramp` t + A cos(angle + w t) from the drive angle (cos, sin).
pub(super) fn linear_forcing_series(
    flow: &LinearLaw,
    DriveAngle { cos, sin }: DriveAngle,
    (constant, ramp): (f64, f64),
) -> [f64; DEGREE + 1] {
    let mut forcing = [0.0; DEGREE + 1];
    let (mut even, mut odd) = (flow.amplitude * cos, -flow.amplitude * sin * flow.frequency);
    let square = -flow.frequency * flow.frequency;
    for n in (0..DEGREE).step_by(2) {
        forcing[n] = even;
        forcing[n + 1] = odd;
        even *= square * RECIPROCALS[n + 1] * RECIPROCALS[n + 2];
        odd *= square * RECIPROCALS[n + 2] * RECIPROCALS[n + 3];
    }
    forcing[0] += constant;
    forcing[1] += ramp;
    forcing
}

/// Value of a Taylor polynomial at `s`: Horner's rule on four parts of it, side by side.
#[inline]
pub(crate) fn value(coefficients: &[f64; DEGREE + 1], s: f64) -> f64 {
    let square = s * s;
    let fourth = square * square;
    let (rows, rest) = coefficients.as_chunks::<4>();
    let mut value = [0.0; 4];
    value[..rest.len()].copy_from_slice(rest);
    for row in rows.iter().rev() {
        for lane in 0..4 {
            value[lane] = value[lane] * fourth + row[lane];
        }
    }
    (value[0] + s * value[1]) + square * (value[2] + s * value[3])
}

/// Value and first derivative of a Taylor polynomial at `s`.
#[inline]
pub(crate) fn value_and_rate(coefficients: &[f64; DEGREE + 1], s: f64) -> (f64, f64) {
    value_and_rate_from(coefficients[0], coefficients, s)
}

/// Value and first derivative at `s` of a Taylor polynomial whose constant term is `first`: Horner's rule on four parts
/// of it, side by side.
#[inline]
pub(super) fn value_and_rate_from(
    first: f64,
    coefficients: &[f64; DEGREE + 1],
    s: f64,
) -> (f64, f64) {
    let square = s * s;
    let fourth = square * square;
    let (rows, rest) = coefficients.as_chunks::<4>();
    let mut value = [0.0; 4];
    value[..rest.len()].copy_from_slice(rest);
    let mut rate = [0.0; 4];
    for row in rows[1..].iter().rev() {
        for lane in 0..4 {
            rate[lane] = rate[lane] * fourth + value[lane];
            value[lane] = value[lane] * fourth + row[lane];
        }
    }
    let lowest = [first, coefficients[1], coefficients[2], coefficients[3]];
    for lane in 0..4 {
        rate[lane] = rate[lane] * fourth + value[lane];
        value[lane] = value[lane] * fourth + lowest[lane];
    }
    // p = P0 + s P1 + s^2 P2 + s^3 P3, each a polynomial in s^4.
    let inner = (rate[0] + s * rate[1]) + square * (rate[2] + s * rate[3]);
    let outer = value[1] + s * (2.0 * value[2] + 3.0 * s * value[3]);
    (
        (value[0] + s * value[1]) + square * (value[2] + s * value[3]),
        outer + 4.0 * (s * square) * inner,
    )
}
