//! An observer of one's own: it counts impacts, keeps the hardest, and stops the motion at the hundredth.

use std::ops::ControlFlow;

use softstop::{Crossing, Observer, Ratios, Simulation, Start};

/// Impacts so far.
#[derive(Default)]
struct Hardest {
    impacts: u32,
    velocity: f64,
}

impl Observer for Hardest {
    fn crossing(&mut self, crossing: &Crossing) {
        if let Some(velocity) = crossing.impact_velocity() {
            self.impacts += 1;
            self.velocity = self.velocity.max(velocity);
        }
    }

    fn progress(&mut self, _: u64) -> ControlFlow<()> {
        match self.impacts {
            100 => ControlFlow::Break(()),
            _ => ControlFlow::Continue(()),
        }
    }
}

/// Runs the example.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scene = Ratios::unloaded().scene()?;
    let mut machine = Simulation::new(&scene, Start::new(0.0, 14.0))?;
    let mut hardest = Hardest::default();
    let stopped = machine.watch(10_000.0, &mut hardest)?.is_break();
    println!(
        "after {} s: {} impacts, the hardest at {} m/s",
        machine.time(),
        hardest.impacts,
        hardest.velocity
    );
    assert!(stopped && hardest.impacts == 100);
    // The motion stands right behind that impact, and can go on.
    let last = machine.last_impact().ok_or("it has struck")?;
    assert_eq!(last.time, machine.time());
    Ok(())
}
