//! Deflation: how Newton's method keeps away from known zeros.
//!
//! Deflation multiplies the residual F by M = prod (1 + w^2 / d_k^2), with the distances d_k from what is known: known
//! zeros are none any more, all others stay. The step of Newton's method for M F is that for F times
//! 1 / (1 - grad(ln M) . step) (Farrell, Birkisson and Funke 2015, SIAM J. Sci. Comput. 37, A2026).

use super::TimedImpact;

/// Width w of deflation: a share of the drive period in time, and of the velocity in velocity.
pub(super) const DEFLATION_WIDTH: f64 = 0.05;

/// The factor by which deflation multiplies a Newton step from an impact, away from the known ones.
pub(super) fn deflation_factor(
    at: TimedImpact,
    step: TimedImpact,
    known: &[TimedImpact],
    period: f64,
) -> f64 {
    let slope = |&(time, velocity): &TimedImpact| {
        let turns = (at.0 - time) / period;
        let apart = [turns - turns.round(), (at.1 - velocity) / velocity];
        let moved = [step.0 / period, step.1 / velocity];
        let square = apart[0] * apart[0] + apart[1] * apart[1];
        let change = 2.0 * (apart[0] * moved[0] + apart[1] * moved[1]);
        -DEFLATION_WIDTH * DEFLATION_WIDTH * change
            / (square * (square + DEFLATION_WIDTH * DEFLATION_WIDTH))
    };
    1.0 / (1.0 - known.iter().map(slope).sum::<f64>())
}
