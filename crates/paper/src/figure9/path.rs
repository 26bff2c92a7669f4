//! A motion as points to draw, and its states at drive angle 0.

use super::CLEARANCE;
use anyhow::Result;
use softstop::{Scene, Start};
use softstop_dynamics::StroboscopicMap;

/// Fewest points of an arc.
const FEWEST: f64 = 8.0;
/// How far back what is near the stop goes, in units of the depth beyond it.
const NEAR: f64 = 6.0;
/// Least such depth, in units of the clearance.
pub const SHALLOW: f64 = 0.002;

/// A motion from drive angle 0 on.
pub struct Path {
    /// Time in drive periods, position, velocity.
    pub points: Vec<[f64; 3]>,
    /// When it hits, in drive periods.
    pub impacts: Vec<f64>,
}

impl Path {
    /// The motion from a start over drive periods, with so many points in each.
    pub fn of(scene: &Scene, start: Start, periods: u64, fineness: u32) -> Result<Self> {
        let trajectory = scene.trajectory(start, periods)?;
        let clock = trajectory.clock;
        let period = clock.period();
        let mut points = Vec::new();
        for arc in &trajectory.arcs {
            let steps = f64::from(fineness) * arc.duration / period;
            let steps = steps.ceil().max(FEWEST) as u32;
            points.extend((0..=steps).map(|step| {
                let after = arc.duration * f64::from(step) / f64::from(steps);
                let instant = clock.after(arc.start, after);
                let (position, velocity) = arc.course.at(after, clock.drive(instant));
                [clock.time(instant) / period, position, velocity]
            }));
        }
        let impacts = trajectory.impacts();
        let impacts = impacts.map(|touch| clock.time(touch.instant) / period);
        Ok(Self {
            points,
            impacts: impacts.collect(),
        })
    }

    /// Positions over time in drive periods.
    pub fn positions(&self) -> Vec<(f64, f64)> {
        self.points.iter().map(|at| (at[0], at[1])).collect()
    }

    /// Velocities over positions.
    pub fn states(&self) -> Vec<(f64, f64)> {
        self.points.iter().map(|at| (at[1], at[2])).collect()
    }

    /// The states from the stop back by [`NEAR`] times the depth that the motion reaches beyond it.
    pub fn near(&self) -> Vec<(f64, f64)> {
        let mut states = self.states();
        let highest = states.iter().map(|state| state.0).fold(CLEARANCE, f64::max);
        let depth = (highest - CLEARANCE).max(SHALLOW * CLEARANCE);
        states.retain(|state| state.0 > CLEARANCE - NEAR * depth);
        states
    }
}

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
