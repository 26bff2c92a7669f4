//! Taylor steps of a linear law in time itself, under a force that is not linear in time.
//!
//! With |r| <= rho for both roots of the law, t^k / k! is answered from rest by coefficients of at most (n - k - 1)
//! rho^(n-k-2) / n! for t^n. So the first one that the polynomial leaves out is known beforehand, and the step can be
//! made so short that it is lost in the rounding of the others. What the drive and the free motion leave out is so over
//! one reach of the flow (see [`Taylor`]).

use super::convergence::{TRUNCATION, first_span};
use super::power_law::PowerLaw;
use super::series::{Series, ZERO};
use super::taylor::{DEGREE, Taylor, push_series};
use super::taylor_step::TaylorStep;
use super::{Departure, LinearLaw};

impl TaylorStep {
    /// The step of a linear law; `low` is what rounding took from the position before.
    pub fn of_linear_law(flow: &LinearLaw, from: &Departure, low: f64) -> Self {
        let mut segment = Self::linear_in_time(
            flow,
            &PowerLaw::default(),
            from,
            (from.position, from.velocity),
        );
        segment.low = low;
        segment.end_at(segment.reach_in_time(flow, from));
        segment
    }

    /// The step of a mass that is held while the push changes.
    pub fn of_held_mass(flow: &LinearLaw, from: &Departure) -> Self {
        let mut segment = Self::without_motion(flow, &PowerLaw::default());
        segment.depth[0] = from.position;
        segment.push = push_series(flow, from);
        segment.end_at(flow.reach.min(first_span(&segment.push)));
        segment
    }

    /// The linear law's motion from `start`, in time itself.
    pub(super) fn linear_in_time(
        flow: &LinearLaw,
        hertz: &PowerLaw,
        from: &Departure,
        start: (f64, f64),
    ) -> Self {
        let taylor = Taylor::expand(flow, start, push_series(flow, from));
        let taylor = match from.acceleration {
            Some(acceleration) => taylor.with_acceleration(flow, acceleration),
            None => taylor,
        };
        let mut segment = Self::without_motion(flow, hertz);
        segment.depth = taylor.position;
        segment.push = taylor.push;
        segment
    }

    /// Time in s over which series in time hold to rounding, and over which no power of the force outgrows what the
    /// motion begins with: a crossing early in a step would drown in the rounding of its end.
    pub(super) fn reach_in_time(&self, flow: &LinearLaw, from: &Departure) -> f64 {
        let reach = flow.reach;
        if from.push.is_linear() {
            return reach;
        }
        let (depth, velocity) = (&self.depth, &self.velocity_series());
        let left_out = truncation_bound(flow, from);
        let order = (DEGREE + 1) as i32;
        reach
            .min(first_span(depth))
            .min(first_span(velocity))
            .min(reach_below_rounding(depth, left_out, order))
            .min(reach_below_rounding(
                velocity,
                f64::from(order) * left_out,
                order - 1,
            ))
    }
}

/// A bound on the first coefficient of the position that is left out, as far as the curved part of the force
/// brings it about.
fn truncation_bound(flow: &LinearLaw, from: &Departure) -> f64 {
    let rate = flow.modes.fastest_rate();
    let answer = |k: usize| (DEGREE - k) as f64 * rate.powi((DEGREE - 1 - k) as i32);
    let derivatives = from.push.derivatives().iter().enumerate().skip(2);
    let sum: f64 = derivatives.map(|(k, f)| f.abs() * answer(k)).sum();
    (2..=DEGREE + 1).fold(sum, |sum, n| sum / n as f64)
}

/// Up to where a term `left_out` t^`order` is below the rounding of one of the lower coefficients' terms.
fn reach_below_rounding(series: &Series, left_out: f64, order: i32) -> f64 {
    if left_out == 0.0 || series == &ZERO {
        return f64::INFINITY;
    }
    let size = left_out.log2();
    let reach = |(j, coefficient): (usize, &f64)| {
        (coefficient.abs().log2() - size + TRUNCATION) / f64::from(order - j as i32)
    };
    let lower = series[..DEGREE.div_ceil(2)].iter().enumerate();
    // Comparisons pass over what is not a number: zero against zero.
    lower.map(reach).fold(f64::NEG_INFINITY, f64::max).exp2()
}
