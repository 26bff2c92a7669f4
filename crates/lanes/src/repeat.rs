//! Over all drive periods at once, where each is like the one before.

use nalgebra::Complex;
use pulp::Simd;

use super::engine::Engine;
use super::lanes::{Lanes, Mask};
use super::place::{Drive, Passage};
use super::returns::Turn;

impl<S: Simd, const N: usize> Engine<'_, S, N> {
    /// Notes the returns of a lane from now on, if nobody watches what lies between them.
    pub fn begin_noting(&mut self, lane: usize) {
        let (per_period, left) = (
            self.state.drive.per_period.get(lane),
            self.state.left.get(lane),
        );
        let noted = self.returns[lane].begin(per_period, left);
        if !self.task.watch.impacts && !self.task.watch.periods {
            self.state.noted.set(lane, noted);
        }
    }

    /// Takes note of the crossings of lanes that try a cycle; `before`: their velocity ahead of it.
    #[cold]
    #[inline(never)]
    pub fn note_crossings(&mut self, crossed: Mask<S, N>, before: Lanes<S, N>) {
        for lane in 0..Lanes::<S, N>::COUNT {
            if crossed.get(lane) && self.returns[lane].is_trial() {
                self.returns[lane].pass(Passage {
                    position: self.state.x.get(lane),
                    velocity: before.get(lane),
                    velocity_after: self.state.v.get(lane),
                    phase: self.state.phase.get(lane) as usize,
                    left: self.state.left.get(lane),
                    offset: self.state.offset.get(lane),
                });
            }
        }
    }

    /// Takes note of the returns of lanes that have just met an impact.
    #[cold]
    #[inline(never)]
    pub fn note(&mut self, lanes: Mask<S, N>) {
        for lane in 0..Lanes::<S, N>::COUNT {
            if lanes.get(lane)
                && let Some(machine) = self.machine(lane)
            {
                let now = self.state.returned(lane);
                let drive = Drive {
                    frequency: machine.frequency,
                    period: machine.period(),
                    begin: Complex::new(machine.angle.0, machine.angle.1),
                };
                let laws = machine.laws.as_deref().unwrap_or_default();
                if let Some(turn) = self.returns[lane].note(now, laws, &drive) {
                    self.turn(lane, turn);
                }
            }
        }
    }

    /// Calls lanes back from cycles that lead nowhere.
    pub fn call_back(&mut self) {
        for lane in 0..Lanes::<S, N>::COUNT {
            if self.returns[lane].is_overdue(self.state.left.get(lane)) {
                self.goes_back(lane);
            }
        }
    }

    /// True if a lane that has come to an end was trying a cycle, and goes on from where it was.
    pub fn goes_back(&mut self, lane: usize) -> bool {
        let back = self.returns[lane].back();
        back.map(|turn| self.turn(lane, turn)).is_some()
    }

    fn turn(&mut self, lane: usize, turn: Turn) {
        self.state.noted.set(lane, turn.again);
        self.count_leapt(lane, turn.leapt);
        if let Some(to) = turn.to {
            self.state.put(lane, to);
        }
        self.trials = self
            .returns
            .iter()
            .filter(|returns| returns.is_trial())
            .count();
    }
}
