//! A machine simulated from a start: its impacts and its energy.

use approx::assert_abs_diff_eq;
use softstop::{Ratios, Start};

/// Runs the example.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scene = Ratios::unloaded().scene()?;
    let start = Start::new(0.0, 14.0);
    let motion = scene.trajectory(start, 1000)?;
    let last = motion
        .impacts()
        .last()
        .ok_or("it strikes in every period")?;
    println!(
        "velocity before the last impact: {}",
        last.before_impact_velocity
    );
    assert_abs_diff_eq!(
        last.before_impact_velocity,
        6.494_627_429_363,
        epsilon = 1e-10
    );
    assert!(motion.energy_defect().abs() < 1e-11 * motion.work().supplied);
    Ok(())
}
