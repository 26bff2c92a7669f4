//! Matching formulas: the parameters of a simple contact from what a contact is like.
//!
//! With damping ratio zeta = b / (2 sqrt(m k)) and a before-impact velocity v, a spring k beside a damper
//! b, by itself, has
//!
//! ```text
//! released at the clearance:   R = exp(-pi zeta / sqrt(1 - zeta^2)),  T = pi / w_d
//! released at zero force:      R = exp(-2 zeta acos(zeta) / sqrt(1 - zeta^2)),
//!                              T = 2 acos(zeta) / w_d + 2 zeta sqrt(m/k)
//! deepest:                     d = v sqrt(m/k) exp(-zeta acos(zeta) / sqrt(1 - zeta^2))
//! ```
//!
//! with w_d = sqrt(k/m) sqrt(1 - zeta^2); the last part of T is the free way back to the clearance (Nagurka and Huang 2006; Schwager and Poeschel 2007, whose three
//! cases are this one formula: pi - atan2(2 b w, w^2 - b^2) = 2 acos(zeta), and cosh for cos beyond critical
//! damping). A contact k d^n (1 + lambda v) by itself has, with a = lambda v,
//!
//! ```text
//! a (1 + R) = ln((1 + a) / (1 - a R)),     k d^(n+1) / (n+1) = m v^2 (a - ln(1 + a)) / a^2
//! ```
//!
//! which is the equation of motion integrated once (Hunt and Crossley 1975; Carvalho and Martins 2019). To
//! first order in 1 - R it gives a = 3 (1 - R) / 2, as Hunt and Crossley's R = 1 - (2/3) lambda v and
//! Lankarani and Nikravesh's a = 3 (1 - R^2) / 4 do.
//!
//! - M. Nagurka, S. Huang, A mass-spring-damper model of a bouncing ball, Int. J. Engng Ed. 22 (2006) 393-401.
//! - T. Schwager, T. Poeschel, Coefficient of restitution and linear-dashpot model revisited, Granular
//!   Matter 9 (2007) 465-469.
//! - K. H. Hunt, F. R. E. Crossley, Coefficient of restitution interpreted as damping in vibroimpact,
//!   J. Appl. Mech. 42 (1975) 440-445.
//! - H. M. Lankarani, P. E. Nikravesh, A contact force model with hysteresis damping for impact analysis of
//!   multibody systems, J. Mech. Des. 112 (1990) 369-376.
//! - A. S. Carvalho, J. M. Martins, Exact restitution and generalizations for the Hunt-Crossley contact
//!   model, Mech. Mach. Theory 139 (2019) 174-194.

use std::convert::Infallible;
use std::f64::consts::PI;

use softstop::Release;
use softstop::internals::narrow_root;

/// acos(z)/sqrt(1 - z^2), continued by acosh(z)/sqrt(z^2 - 1) beyond 1, where both are 1.
fn angle_over_sine(zeta: f64) -> f64 {
    let square = (1.0 - zeta) * (1.0 + zeta);
    let sine = square.abs().sqrt();
    if square > 0.0 {
        sine.atan2(zeta) / sine
    } else if square < 0.0 {
        (zeta - 1.0 + sine).ln_1p() / sine
    } else {
        1.0
    }
}

/// Restitution of a spring beside a damper with damping ratio `zeta` >= 0.
pub fn restitution(release: Release, zeta: f64) -> f64 {
    match release {
        Release::ZeroForce => (-2.0 * zeta * angle_over_sine(zeta)).exp(),
        Release::Clearance if zeta < 1.0 => {
            (-PI * zeta / ((1.0 - zeta) * (1.0 + zeta)).sqrt()).exp()
        }
        // It creeps back and never arrives.
        Release::Clearance => 0.0,
    }
}

/// The damping ratio with which a spring beside a damper has a restitution in (0, 1]; none if there is
/// no such ratio.
pub fn damping_ratio(release: Release, restitution: f64) -> Option<f64> {
    if !(restitution > 0.0 && restitution <= 1.0) {
        return None;
    }
    let loss = -restitution.ln();
    Some(match release {
        Release::Clearance => loss / PI.hypot(loss),
        // 2 z acos(z)/sqrt(1 - z^2) rises with z and is at least 2 ln z beyond 1.
        Release::ZeroForce => {
            let excess = |zeta: f64| 2.0 * zeta * angle_over_sine(zeta) - loss;
            root(excess, 0.0, (0.5 * loss).exp())?
        }
    })
}

/// How long a mass is beyond the clearance in a contact of a spring beside a damper, in units of
/// sqrt(m/k).
pub fn duration(release: Release, zeta: f64) -> f64 {
    match release {
        Release::ZeroForce => 2.0 * (angle_over_sine(zeta) + zeta),
        Release::Clearance if zeta < 1.0 => PI / ((1.0 - zeta) * (1.0 + zeta)).sqrt(),
        Release::Clearance => f64::INFINITY,
    }
}

/// How deep a contact of a spring beside a damper goes, in units of v sqrt(m/k).
pub fn penetration(zeta: f64) -> f64 {
    (-zeta * angle_over_sine(zeta)).exp()
}

/// (ln(1 + x) - x) / x^2, to rounding also where x is small.
fn log_remainder(x: f64) -> f64 {
    if x.abs() > 0.25 {
        return (x.ln_1p() - x) / (x * x);
    }
    // -1/2 + x/3 - x^2/4 + ..., by Horner's scheme; 0.25^26/28 lies below rounding.
    let terms = (2..=28).rev();
    -terms.fold(0.0, |sum, n| 1.0 / f64::from(n) - x * sum)
}

/// The product lambda v with which a contact k d^n (1 + lambda v) has a restitution in (0, 1]; none if
/// there is no such product.
pub fn hunt_crossley(restitution: f64) -> Option<f64> {
    if !(restitution > 0.0 && restitution <= 1.0) {
        return None;
    }
    let r = restitution;
    // The equation over a^2: positive below the root. Its pole stands at a = 1/R, and from R = 1/36
    // down the root is the pole to rounding.
    let excess = |a: f64| r * r * log_remainder(-a * r) - log_remainder(a);
    let pole = (1.0 - f64::EPSILON) / r;
    root(excess, 0.0, pole).or(Some(pole))
}

/// k d^(n+1) / (n+1) of a contact k d^n (1 + lambda v), in units of m v^2, with `a` = lambda v >= 0.
pub fn hunt_crossley_energy(a: f64) -> f64 {
    -log_remainder(a)
}

/// The root of a continuous function between two places at which it does not have the same sign, to rounding of the
/// larger one.
pub(super) fn root(f: impl Fn(f64) -> f64, low: f64, high: f64) -> Option<f64> {
    let (at_low, at_high) = (f(low), f(high));
    if at_low == 0.0 {
        return Some(low);
    }
    if at_high == 0.0 {
        return Some(high);
    }
    if at_low.is_nan() || (at_low > 0.0) == (at_high > 0.0) {
        return None;
    }
    let width = 4.0 * f64::EPSILON * low.abs().max(high.abs());
    // What is no number counts as below zero, at the end as well.
    let value = |x| Ok::<f64, Infallible>(Some(f(x)).filter(|it| !it.is_nan()).unwrap_or(-1.0));
    let ends = ((low, at_low), (high, value(high).ok()?));
    let (low, high) = narrow_root(ends.0, ends.1, width, value).ok()?;
    Some(low.midpoint(high))
}
