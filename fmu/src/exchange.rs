//! The machine as an importer sees it that integrates position and velocity by itself.

use softstop::Start;
use softstop_fmi::{Events, Outcome, Unit};

use crate::machine::Machine;

/// How far, in parts of the machine's size, a state may be beyond an end of its law before an indicator falls below zero: it
/// is exactly there where the law begins at this end.
const SHIFT: f64 = 1e-9;

impl Machine {
    /// The machine in another state at another time in s, under the law that holds. What happened on the way there is told as
    /// far as the law holds.
    pub(crate) fn placed(&self, time: f64, states: &[f64]) -> Outcome<Self> {
        let mut machine = self.clone();
        if time > machine.time() {
            machine.go_to(time, Some(self.time()), &mut Events::default())?;
        }
        machine.more = machine.more.afresh();
        if let [position, velocity] = *states {
            let moved = position - machine.sample().position;
            machine.more.external.shift(moved);
            machine
                .change()
                .set_state(time, Start::new(position, velocity));
        }
        Ok(machine)
    }

    /// What is much of position in m and velocity in m/s.
    pub(crate) fn scales(&self) -> [f64; 2] {
        let (rate, of) = (
            self.simulation().scene().excitation.frequency,
            self.sample(),
        );
        let swing = of.position.abs().max(of.velocity.abs() / rate);
        let length = self.size().max(swing);
        [length, rate * length]
    }

    /// Its size in m: what the drive moves it by far from resonance, or the clearance.
    fn size(&self) -> f64 {
        let scene = self.simulation().scene();
        let rate = scene.excitation.frequency;
        let moved = scene.excitation.amplitude / (scene.stiffness + scene.mass * rate * rate);
        let size = moved.max(scene.clearance.abs());
        if size > 0.0 { size } else { 1.0 }
    }

    /// How far the state is from an end of its law; 1 without such an end.
    pub(crate) fn margin(&self, number: usize) -> f64 {
        let margin = self.simulation().guard_margins(self.size()).nth(number);
        margin.map_or(1.0, |margin| margin + SHIFT)
    }
}
