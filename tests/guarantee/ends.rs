//! How a leg ends: is it what the crossing states, and truly so.

use softstop::{Crossing, CrossingKind};

use super::check::{Check, Stop, wrong};
use super::motion::Departure;
use super::piece::State;
use super::rules::Mode;
use super::scales::{GRAIN, Scales};

impl Check<'_> {
    /// A surface is reached where it stands, in the right direction, and passed.
    pub fn reaches(
        &mut self,
        end: &Crossing,
        surface: f64,
        forward: bool,
        acceleration: f64,
        scales: &Scales,
    ) -> Result<(), Stop> {
        let velocity = if forward { end.velocity } else { -end.velocity };
        if end.position != surface {
            return wrong(format!("the surface stands at {surface}"));
        }
        if velocity < 0.0 {
            return wrong("it goes the other way".into());
        }
        let depth = velocity * velocity / (2.0 * acceleration.abs());
        let brakes = acceleration * if forward { 1.0 } else { -1.0 } < 0.0;
        if brakes && depth < scales.x {
            self.tally.undecidable += 1;
        } else if brakes && depth < 1e-6 * scales.span {
            self.tally.near_hits += 1;
        }
        Ok(())
    }

    /// The velocity vanishes under friction.
    pub fn reverses(
        &mut self,
        end: &Crossing,
        at: &Departure,
        state: &State,
        scales: &Scales,
        angle: f64,
    ) -> Result<Vec<Mode>, Stop> {
        let rising = if at.forward { -state.a } else { state.a };
        if !self.machine.layers[at.layer].friction {
            return wrong("no friction here".into());
        }
        if state.v.abs() > scales.v || end.velocity_after != 0.0 {
            return wrong(format!("the velocity is {}", state.v));
        }
        if rising < 0.0 {
            self.tally.undecidable += 1;
        }
        Ok(self
            .machine
            .at_rest(end.position, Some(at.layer), at.layer, angle))
    }

    /// Contact ceases or begins to press.
    pub fn switches(
        &mut self,
        end: &Crossing,
        at: &Departure,
        state: &State,
        scales: &Scales,
    ) -> Result<Vec<Mode>, Stop> {
        let Some(guard) = scales.pull(self.machine, at) else {
            return wrong("nothing to switch here".into());
        };
        let value = guard.value(state);
        if value.abs() > guard.grain {
            return wrong(format!(
                "contact is {value:e} from a switch, grain {:e}",
                guard.grain
            ));
        }
        if guard.slope(state) < 0.0 {
            self.tally.undecidable += 1;
        }
        if end.velocity_after != end.velocity {
            return wrong("the velocity jumps".into());
        }
        let (layer, forward, released) = (at.layer, at.forward, !at.released);
        Ok(vec![Mode::Moving {
            layer,
            forward,
            released,
        }])
    }

    /// A held mass stays until its load leaves the interval of friction.
    pub fn held(&mut self, upper: Option<usize>, lower: usize) -> Result<Vec<Mode>, Stop> {
        let (m, leg) = (self.machine, self.leg);
        let turn = m.frequency * leg.duration;
        let (low, high) = extremes(leg.angle, turn);
        let ahead = upper.map(|upper| m.resistance(upper, true, leg.position));
        let behind = m.resistance(lower, false, leg.position);
        let grain =
            |size: f64, rounding: f64| GRAIN * (size + m.amplitude * (1.0 + turn)) + rounding;
        if let Some((most, size, rounding)) = ahead
            && m.amplitude * high > most + grain(size, rounding)
        {
            return wrong(format!(
                "missed: a release ahead by {}",
                m.amplitude * high - most
            ));
        }
        if m.amplitude * low < behind.0 - grain(behind.1, behind.2) {
            return wrong(format!(
                "missed: a release behind by {}",
                behind.0 - m.amplitude * low
            ));
        }
        let Some(end) = &leg.end else {
            return Ok(Vec::new());
        };
        if end.kind != CrossingKind::Release {
            return wrong("a held mass can but be released".into());
        }
        if end.position != leg.position || end.velocity_after != 0.0 {
            return wrong("a held mass moves".into());
        }
        let forcing = m.amplitude * (leg.angle + turn).cos();
        let mut modes = Vec::new();
        if let (Some((most, size, rounding)), Some(layer)) = (ahead, upper)
            && (forcing - most).abs() < grain(size, rounding)
        {
            modes.push(Mode::Moving {
                layer,
                forward: true,
                released: false,
            });
        }
        if (forcing - behind.0).abs() < grain(behind.1, behind.2) {
            let forward = !m.layers[lower].friction;
            modes.push(Mode::Moving {
                layer: lower,
                forward,
                released: false,
            });
        }
        if modes.is_empty() {
            return wrong(format!(
                "released at {forcing} between {:?} and {ahead:?}",
                behind.0
            ));
        }
        Ok(modes)
    }

    /// Ever faster bounces come to rest when their sum says.
    pub fn chatter(&mut self, layer: usize) -> Result<Vec<Mode>, Stop> {
        let (m, leg) = (self.machine, self.leg);
        if leg.duration > 1e-4 * m.period() {
            return wrong("long chatter".into());
        }
        let Some(sum) = m.bounces(layer, -leg.velocity, leg.angle) else {
            return wrong("bounces that do not end".into());
        };
        let Some(end) = &leg.end else {
            return Ok(Vec::new());
        };
        if (leg.duration - sum).abs() > 0.02 * sum {
            return wrong(format!("bounces that take {sum}"));
        }
        let wall = m.wall.map_or(f64::NAN, |wall| wall.0);
        let rests = end.kind == CrossingKind::Rest && end.velocity_after == 0.0;
        if !rests || end.position != wall {
            return wrong("chatter that does not come to rest".into());
        }
        let angle = leg.angle + m.frequency * leg.duration;
        Ok(m.at_rest(wall, None, layer, angle))
    }
}

/// Least and largest cosine over a range of angles.
fn extremes(angle: f64, turn: f64) -> (f64, f64) {
    use std::f64::consts::{PI, TAU};
    let passes = |top: f64| ((angle + turn - top) / TAU).floor() > ((angle - top) / TAU).floor();
    let (a, b) = (angle.cos(), (angle + turn).cos());
    let low = if passes(PI) { -1.0 } else { a.min(b) };
    let high = if passes(0.0) { 1.0 } else { a.max(b) };
    (low, high)
}
