//! A press stated in SI units, from a push: its impacts, and what becomes of the energy.

use softstop::Machine;

const PRESS: &str = r#"
name = "press"
mass = 12.0                   # kg
stiffness = 4.8e5             # N/m
damping = 96.0                # N s/m
clearance = 18.75e-3          # m
contact.damping = 432.0       # N s/m

[excitation]
amplitude = 900.0             # N
frequency = 230.0             # rad/s

[stop]
model = "preloaded"
stiffness = 3.36e6            # N/m
preload = 63e3                # N

[initial]
velocity = 5.25               # m/s
"#;

/// Runs the example.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let press = Machine::from_toml(PRESS)?;
    let motion = press.scene.trajectory(press.start, 300)?;
    for impact in motion.impacts() {
        let time = motion.clock.time(impact.instant);
        println!("{time:9.6} s {:9.6} m/s", impact.before_impact_velocity);
    }
    // The paper's point A in other units: its X'- = 6.494627 times F0 / sqrt(k1 m).
    let last = motion.impacts().last().ok_or("it strikes")?;
    assert!((last.before_impact_velocity - 0.375 * 6.494_627_429_363).abs() < 1e-9);
    assert!(motion.energy_defect().abs() < 1e-11 * motion.work().supplied);
    Ok(())
}
