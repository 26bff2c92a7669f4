//! The states of a motion at drive angle 0.

use anyhow::Result;
use softstop::Start;
use softstop_dynamics::StroboscopicMap;

/// Drive periods without any impact after which chaos is over.
const OVER: usize = 200;
/// Starts from which chaos is tried to last.
const TRIES: u32 = 64;
/// Distance between them.
const APART: f64 = 1e-4;

/// States of a motion, one for each drive period.
pub struct Section {
    /// A state of the motion at drive angle 0, from which it is followed.
    pub start: Start,
    /// Position and velocity.
    pub states: Vec<(f64, f64)>,
    impacts: usize,
}

impl Section {
    /// So many states of chaos from a state of it on or, if it is soon over there, from near that state. If it is
    /// over everywhere, as many as there are.
    pub fn lasting(map: &StroboscopicMap, state: Start, most: u64) -> Result<Self> {
        let mut longest = Self::of(map, state, most, OVER)?;
        for step in 1..TRIES {
            if longest.states.len() as u64 == most {
                break;
            }
            let position = state.position - APART * f64::from(step);
            let section = Self::of(map, Start { position, ..state }, most, OVER)?;
            if section.states.len() > longest.states.len() {
                longest = section;
            }
        }
        Ok(longest)
    }

    /// States until there have been no impacts for so many drive periods; those in which there are none are
    /// left out then.
    pub fn of(map: &StroboscopicMap, start: Start, most: u64, over: usize) -> Result<Self> {
        let mut state = start.into();
        let (mut states, mut impacts, mut struck) = (Vec::new(), 0, 0);
        for _ in 0..most {
            let passage = map.apply(state)?;
            states.push((state.x, state.y));
            state = passage.end;
            impacts += passage.impacts.len();
            if !passage.impacts.is_empty() {
                struck = states.len();
            }
            if states.len() - struck >= over {
                states.truncate(struck);
                break;
            }
        }
        Ok(Self {
            start,
            states,
            impacts,
        })
    }

    /// Mean number of impacts per drive period.
    pub fn impacts_per_period(&self) -> f64 {
        self.impacts as f64 / self.states.len().max(1) as f64
    }
}
