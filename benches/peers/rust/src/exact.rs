//! softstop itself, its scalar engine. The tolerance is of no use to it.

use softstop::{Clock, Crossing, Observer, Ratios, Start};

use crate::request::{End, Request};

struct Impacts(u64);

impl Observer for Impacts {
    fn crossing(&mut self, crossing: &Crossing) {
        self.0 += u64::from(crossing.impact_velocity().is_some());
    }
}

/// The exact motion of the unloaded machine at one frequency.
pub fn solve(request: &Request, frequency: f64) -> Result<End, String> {
    let ratios = Ratios {
        frequency,
        ..Ratios::unloaded()
    };
    let scene = ratios.scene().map_err(|error| error.to_string())?;
    let [position, velocity] = request.scene.start;
    let mut motion = scene
        .motion(Start::new(position, velocity))
        .map_err(|error| error.to_string())?;
    let mut impacts = Impacts(0);
    motion
        .advance(Clock::at_cycle(request.scene.periods as u64), &mut impacts)
        .map_err(|error| error.to_string())?;
    let state = motion.state();
    Ok((state.position, state.velocity, impacts.0))
}
