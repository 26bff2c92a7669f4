//! Temporary.
use softstop::Machine;
use softstop_dynamics::monitor::unmonitored;
use softstop_dynamics::zone::{hysteresis_with_monitor, stable_ranges_with_monitor};

/// Runs it.
pub fn main() {
    for name in std::env::args().skip(1) {
        let machine = Machine::named(&name).unwrap_or_else(|| {
            Machine::from_toml(&std::fs::read_to_string(&name).expect("file")).expect("machine")
        });
        match hysteresis_with_monitor(&machine.scene, &unmonitored) {
            Ok(zone) => println!("{name} {} {}", zone.frequency_g0, zone.high.frequency),
            Err(error) => println!("{name} {error}"),
        }
        for one in stable_ranges_with_monitor(&machine.scene, &unmonitored).expect("ranges") {
            println!(
                "{} {} {} {}",
                one.low.frequency,
                one.high.frequency,
                one.hardest.parameter,
                one.hardest.before_impact_velocity()
            );
        }
    }
}
