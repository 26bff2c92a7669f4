//! A periodic motion with its Floquet multipliers and its Lyapunov exponents.

use approx::assert_abs_diff_eq;
use softstop::Ratios;
use softstop_dynamics::{LyapunovExponents, orbit};

/// Runs the example.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let orbit = orbit::find(&Ratios::unloaded().scene()?)?;
    let exponents = LyapunovExponents::of(&orbit);
    println!(
        "z = {}: X'- = {}",
        orbit.regime(),
        orbit.before_impact_velocity()
    );
    println!("multipliers {:?}", orbit.monodromy.multipliers());
    assert_abs_diff_eq!(
        orbit.before_impact_velocity(),
        6.494_627_429_363,
        epsilon = 1e-10
    );
    assert!(orbit.is_stable() && exponents.per_period[0] < 0.0);
    // No sliding: the determinant is that of the damping alone.
    let damped = (-orbit.damping_integral).exp();
    assert_abs_diff_eq!(orbit.monodromy.determinant() / damped, 1.0, epsilon = 1e-9);
    Ok(())
}
