//! Where impacts and rest coexist: the hysteresis zone of a machine, in ratios and in SI.

use approx::assert_abs_diff_eq;
use softstop::{Ratios, Units};
use softstop_dynamics::zone;

/// Runs the example.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let machine = Ratios::unloaded().scene()?;
    let zone = zone::hysteresis(&machine)?;
    println!("eta from {} to {}", zone.frequency_g0, zone.high.frequency);
    assert_abs_diff_eq!(zone.frequency_g0, 1.04444, epsilon = 5e-6);
    assert_abs_diff_eq!(zone.high.frequency, 1.369_036, epsilon = 5e-7);

    let units = Units {
        mass: 12.0,
        stiffness: 4.8e5,
        force: 900.0,
    };
    let press = machine.in_units(units)?;
    let zone_in_si = zone::hysteresis(&press)?;
    println!(
        "{} to {} rad/s",
        zone_in_si.frequency_g0, zone_in_si.high.frequency
    );
    let ratio = zone_in_si.high.frequency / zone.high.frequency;
    assert_abs_diff_eq!(ratio / units.frequency(), 1.0, epsilon = 1e-9);
    Ok(())
}
