//! The regime z = p/n of a motion that repeats, and the count of its impacts.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::recurrence::find_recurrence;
use softstop::{Clock, Crossing, MotionError, Observer, Scene, Start};

/// The regime z = p/n: p impacts in n drive periods, after which the state returns.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Regime {
    /// Impacts p.
    pub impacts: u64,
    /// Drive periods n.
    pub periods: u64,
}

/// Most drive periods after which a state is looked for again to tell a regime.
const MAX_REGIME_PERIODS: u64 = 64;

impl Regime {
    /// The regime z = 1: one impact in each drive period.
    pub const ONE: Self = Self {
        impacts: 1,
        periods: 1,
    };

    /// The regime that a motion from `start` shows after `transient` drive periods; none if its state
    /// does not return within 64 periods, as in chaos.
    ///
    /// The state has returned after n periods if each of the next 64 states lies within 1e-4 of the one n periods before it.
    ///
    /// # Errors
    /// [`MotionError`] if the motion cannot be computed.
    pub fn after_transient(
        scene: &Scene,
        start: Start,
        transient: u64,
    ) -> Result<(Option<Self>, Start), MotionError> {
        let mut motion = scene.motion(start)?;
        motion.advance(Clock::at_cycle(transient), &mut ())?;
        let settled = motion.state();
        let mut counter = ImpactCounter::default();
        let (mut states, mut counts) = (vec![settled], vec![0]);
        for period in 1..=2 * MAX_REGIME_PERIODS {
            motion.advance(Clock::at_cycle(transient + period), &mut counter)?;
            states.push(motion.state());
            counts.push(counter.0);
        }
        let found = find_recurrence(scene.excitation.frequency, &states);
        let regime = found.map(|found| Self {
            impacts: counts[found.periods],
            periods: found.periods as u64,
        });
        Ok((regime, settled))
    }
}

impl fmt::Display for Regime {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.impacts, self.periods) {
            (impacts, 1) => write!(formatter, "{impacts}"),
            (impacts, periods) => write!(formatter, "{impacts}/{periods}"),
        }
    }
}

/// An observer that counts the impacts of a motion.
#[derive(Default)]
pub struct ImpactCounter(pub u64);

impl Observer for ImpactCounter {
    fn crossing(&mut self, crossing: &Crossing) {
        self.0 += u64::from(crossing.impact_velocity().is_some());
    }
}
