//! What a motion adds up to: impacts, rests, phases, energies.

use softstop::{Crossing, CrossingKind, Impact, PhaseKind, Work};

/// Impacts kept one by one; all of them stand in crossings.csv.
const RECENT: usize = 10;
/// Rests kept one by one.
const MOST_RESTS: usize = 1000;

/// The impacts of a motion.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ImpactTally {
    /// How many.
    pub count: u64,
    sum: f64,
    /// Lowest and highest before-impact velocity in m/s.
    pub range: Option<(f64, f64)>,
    /// The last ones.
    pub recent: Vec<Impact>,
}

impl ImpactTally {
    /// Mean before-impact velocity in m/s.
    pub fn mean(&self) -> Option<f64> {
        self.range.map(|_| self.sum / self.count as f64)
    }

    fn add(&mut self, impact: Impact) {
        let velocity = impact.velocity;
        let (low, high) = self.range.unwrap_or((velocity, velocity));
        self.range = Some((low.min(velocity), high.max(velocity)));
        self.count += 1;
        self.sum += velocity;
        if self.recent.len() == RECENT {
            self.recent.remove(0);
        }
        self.recent.push(impact);
    }
}

/// A stretch of time during which the mass is held.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RestInterval {
    /// By what: a face or dry friction.
    pub phase: PhaseKind,
    /// In s.
    pub begin: f64,
    /// In s; none if it lasts beyond the end of the run.
    pub end: Option<f64>,
    /// In m.
    pub position: f64,
}

/// What was seen of one phase.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PhaseVisit {
    /// The phase.
    pub kind: PhaseKind,
    /// How often it was entered.
    pub visits: u64,
    /// Seconds spent in it.
    pub time: f64,
}

/// All sums of a motion.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MotionTally {
    /// Its impacts.
    pub impacts: ImpactTally,
    /// Strips pierced through.
    pub pierced: u64,
    /// Rests counted.
    pub rest_count: u64,
    /// The first of them.
    pub rests: Vec<RestInterval>,
    /// Phases in order of their first visit.
    pub phases: Vec<PhaseVisit>,
    /// Energies in J.
    pub work: Work,
    /// The phase of the last arc; none after a rebound, which begins a new visit.
    last: Option<PhaseKind>,
}

impl MotionTally {
    /// Counts an arc of a phase.
    pub fn arc(&mut self, kind: PhaseKind, elapsed: f64) {
        let entered = u64::from(self.last != Some(kind));
        self.last = Some(kind);
        match self.phases.iter_mut().find(|seen| seen.kind == kind) {
            Some(seen) => {
                seen.visits += entered;
                seen.time += elapsed;
            }
            None => self.phases.push(PhaseVisit {
                kind,
                visits: entered,
                time: elapsed,
            }),
        }
    }

    /// Counts a rest.
    pub fn rest(&mut self, rest: RestInterval) {
        self.rest_count += 1;
        if self.rests.len() < MOST_RESTS {
            self.rests.push(rest);
        }
    }

    /// Counts a crossing at `time` of a body of `mass`, with the energy that it takes.
    pub fn crossing(&mut self, crossing: &Crossing, time: f64, mass: f64) {
        let (before, after) = (crossing.velocity, crossing.velocity_after);
        self.work.dissipated += 0.5 * mass * (before * before - after * after);
        self.pierced += u64::from(crossing.pierces());
        if matches!(crossing.kind, CrossingKind::Rebound { .. }) {
            self.last = None;
        }
        if let Some(velocity) = crossing.impact_velocity() {
            self.impacts.add(Impact { time, velocity });
        }
    }
}
