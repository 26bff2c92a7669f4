//! The stable orbits that are known, and how motions are told to have arrived at them.

use nalgebra::{Matrix2, Vector2};

use super::Certainty;
use crate::ensemble::Outcome;
use crate::orbit::recurrence::{distance, returns, size};
use crate::orbit::{Orbit, OrbitError, StroboscopicMap};
use softstop::{Scene, Start};

/// Distance from an orbit at which a motion has arrived, in units of the orbit's size.
pub(crate) const ARRIVED: f64 = 1e-6;
/// Two orbits of the same period are one if two of their states are as near as the first of these, and the
/// others as near as the second, in units of their size: on a strongly unstable stretch rounding grows.
const SAME_ORBIT: (f64, f64) = (1e-7, 1e-3);
/// Distance from 1 of the multiplier of a mass that creeps to rest.
const CREEP: f64 = 1e-6;
/// Distance at which a motion that returns is believed to return to an orbit at once.
const NEAR_ORBIT: f64 = 1e-3;

/// A stable orbit.
#[derive(Debug, Clone)]
pub(crate) struct KnownOrbit {
    pub orbit: Orbit,
    pub certainty: Certainty,
    states: Vec<Start>,
    size: f64,
}

impl KnownOrbit {
    /// Its states after each drive period, from drive angle phi.
    pub(crate) fn states(&self) -> &[Start] {
        &self.states
    }
}

/// All of them.
pub(crate) struct AttractorCatalogue<'a> {
    scene: &'a Scene,
    pub orbits: Vec<KnownOrbit>,
}

impl<'a> AttractorCatalogue<'a> {
    pub(crate) fn new(scene: &'a Scene) -> Self {
        Self {
            scene,
            orbits: Vec::new(),
        }
    }

    fn frequency(&self) -> f64 {
        self.scene.excitation.frequency
    }

    /// The orbit at which one of the last states of a log lies; the motion has been through all of its
    /// period since.
    fn reached(&self, log: &[Start]) -> Option<usize> {
        self.orbits.iter().position(|known| {
            let recent = log.iter().rev().take(known.states.len());
            let mut gaps = recent.map(|state| self.gap(known, state));
            gaps.any(|gap| gap <= ARRIVED * known.size)
        })
    }

    /// Distance of a state from an orbit.
    fn gap(&self, known: &KnownOrbit, state: &Start) -> f64 {
        let others = known.states.iter();
        let gaps = others.map(|other| distance(self.frequency(), state, other));
        gaps.fold(f64::INFINITY, f64::min)
    }

    /// What a motion has come to whose last states are these; what it turns up is entered.
    pub(crate) fn judge(&mut self, log: &[Start]) -> Result<Outcome, OrbitError> {
        let Some(last) = log.last() else {
            return Ok(Outcome::Wandering);
        };
        if let Some(orbit) = self.reached(log) {
            return Ok(Outcome::Arrived(orbit));
        }
        let Some(found) = returns(self.frequency(), log) else {
            return Ok(Outcome::Wandering);
        };
        if self.is_at_rest(last)? {
            return Ok(Outcome::AtRest);
        }
        let orbit = match Orbit::periodic(self.scene, (*last).into(), found.periods as u64) {
            Ok(orbit) if orbit.is_stable() => orbit,
            _ => return Ok(Outcome::Wandering),
        };
        if self.is_at_rest(&orbit.state().into())? {
            return Ok(Outcome::AtRest);
        }
        let orbit = self.enter(orbit, found.distance)?;
        let known = &self.orbits[orbit];
        let gap = self.gap(known, last);
        let is_near = found.distance <= ARRIVED && gap <= NEAR_ORBIT * known.size;
        Ok(match is_near || self.reached(log).is_some() {
            true => Outcome::Arrived(orbit),
            false => Outcome::Approaching(orbit),
        })
    }

    /// True if a mass is held where it is for all of a drive period, or creeps there ever more slowly: not one
    /// orbit among others, but any place where dry friction holds it.
    fn is_at_rest(&self, state: &Start) -> Result<bool, OrbitError> {
        let map = StroboscopicMap::new(self.scene, 1)?;
        let passage = map.apply((*state).into())?;
        let held = Matrix2::new(1.0, 0.0, 0.0, 0.0);
        let gap = Start::new(state.position - passage.end.x, state.velocity);
        let creep = distance(self.frequency(), &gap, &Start::from(Vector2::zeros()));
        let size = size(self.frequency(), [state]);
        Ok((passage.monodromy.matrix - held).norm() <= CREEP && creep <= ARRIVED * size)
    }

    /// The known orbit that another one is.
    fn twin(&self, periods: u64, states: &[Start]) -> Option<usize> {
        let apart = |known: &KnownOrbit, shift: usize| {
            let pairs = states.iter().zip(known.states.iter().cycle().skip(shift));
            let gaps = pairs.map(|(a, b)| distance(self.frequency(), a, b) / known.size);
            gaps.fold((f64::INFINITY, 0.0f64), |(least, largest), gap| {
                (least.min(gap), largest.max(gap))
            })
        };
        self.orbits.iter().position(|known| {
            known.orbit.periods == periods
                && (0..known.states.len()).any(|shift| {
                    let (least, largest) = apart(known, shift);
                    // At rest at the origin there is no size to compare with.
                    known.size == 0.0 || (least <= SAME_ORBIT.0 && largest <= SAME_ORBIT.1)
                })
        })
    }

    /// Enters a stable orbit, unless it is known.
    fn enter(&mut self, orbit: Orbit, returned: f64) -> Result<usize, OrbitError> {
        let states: Vec<Start> = orbit.states()?.into_iter().map(Start::from).collect();
        if let Some(index) = self.twin(orbit.periods, &states) {
            return Ok(index);
        }
        let (residual, rounding) = orbit.residual()?;
        self.orbits.push(KnownOrbit {
            size: size(self.frequency(), &states),
            states,
            orbit,
            certainty: Certainty {
                returned,
                residual,
                rounding,
            },
        });
        Ok(self.orbits.len() - 1)
    }
}
