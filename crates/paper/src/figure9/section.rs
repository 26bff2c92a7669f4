//! States of a motion at drive angle 0.

use softstop::{MotionError, Start};
use softstop_dynamics::orbit::StroboscopicMap;

/// Drive periods without any impact after which chaos is over.
const OVER: usize = 200;
/// Starts from which chaos is tried to last.
const TRIES: u32 = 64;
/// Distance between them.
const APART: f64 = 1e-4;

/// States of a motion, one for each drive period.
pub(super) struct Section {
    /// Position and velocity.
    pub(super) states: Vec<(f64, f64)>,
    impacts: usize,
}

impl Section {
    /// All states of a periodic motion.
    pub(super) fn periodic(
        map: &StroboscopicMap,
        start: Start,
        periods: u64,
    ) -> Result<Self, MotionError> {
        Self::of(map, start, periods, usize::MAX)
    }

    /// So many states of chaos, and where they begin: at a state of it, or, if it is soon over there, near that
    /// state. If it is over everywhere, as many as there are.
    pub(super) fn lasting(
        map: &StroboscopicMap,
        state: Start,
        most: u64,
    ) -> Result<(Start, Self), MotionError> {
        let mut longest = (state, Self::of(map, state, most, OVER)?);
        for step in 1..TRIES {
            if longest.1.states.len() as u64 == most {
                break;
            }
            let start = Start {
                position: state.position - APART * f64::from(step),
                ..state
            };
            let section = Self::of(map, start, most, OVER)?;
            if section.states.len() > longest.1.states.len() {
                longest = (start, section);
            }
        }
        Ok(longest)
    }

    /// States until there have been no impacts for so many drive periods; those in which there are none are
    /// left out then.
    fn of(
        map: &StroboscopicMap,
        start: Start,
        most: u64,
        over: usize,
    ) -> Result<Self, MotionError> {
        let mut state = start.into();
        let mut section = Self {
            states: Vec::new(),
            impacts: 0,
        };
        let mut struck = 0;
        for _ in 0..most {
            let passage = map.apply(state)?;
            section.states.push((state.x, state.y));
            state = passage.end;
            section.impacts += passage.impacts.len();
            if !passage.impacts.is_empty() {
                struck = section.states.len();
            }
            if section.states.len() - struck >= over {
                section.states.truncate(struck);
                break;
            }
        }
        Ok(section)
    }

    /// Mean number of impacts per drive period.
    pub(super) fn impacts_per_period(&self) -> f64 {
        self.impacts as f64 / self.states.len().max(1) as f64
    }
}
