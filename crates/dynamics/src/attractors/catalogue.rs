//! The catalogue of known stable orbits of a scene, and how motions are told to have arrived at them.

use super::OrbitResiduals;
use crate::ensemble::MemberStatus;
use crate::orbit::recurrence::{find_recurrence, motion_size, state_distance};
use crate::orbit::{Orbit, OrbitError, StroboscopicMap};
use crate::tolerance::{NEAR, SAME};
use softstop::{CheckedScene, Start};

/// Largest distance between the nearest, and between the farthest, states of two orbits of the same period that are taken for
/// one, in units of their size: on a strongly unstable stretch rounding grows. Orbits are also one if they are as near as
/// rounding leaves them, which a slow return amplifies.
const SAME_ORBIT: (f64, f64) = (1e-7, 1e-3);

/// The stable orbits of a scene that are known, by which the motions of a search or a survey are classified.
pub(crate) struct AttractorCatalogue {
    scene: CheckedScene,
    pub orbits: Vec<KnownOrbit>,
}

impl AttractorCatalogue {
    /// An empty catalogue of a scene's stable orbits.
    pub(crate) fn new(scene: &CheckedScene) -> Self {
        Self {
            scene: scene.clone(),
            orbits: Vec::new(),
        }
    }

    /// The frequency of the drive of the catalogue's scene in rad/s.
    fn drive_frequency(&self) -> f64 {
        self.scene.excitation.frequency
    }

    /// Index of the known orbit at which a motion has arrived: one of the last states of its log lies on the orbit.
    fn find_arrived_orbit(&self, log: &[Start]) -> Option<usize> {
        self.orbits.iter().position(|known| {
            let recent = log.iter().rev().take(known.states.len());
            let mut gaps = recent.map(|state| self.orbit_distance(known, state));
            gaps.any(|gap| gap <= SAME * known.size)
        })
    }

    /// Distance in m/s of a state from the nearest state of a known orbit, positions times the drive's frequency.
    fn orbit_distance(&self, known: &KnownOrbit, state: &Start) -> f64 {
        let others = known.states.iter();
        let gaps = others.map(|other| state_distance(self.drive_frequency(), state, other));
        gaps.fold(f64::INFINITY, f64::min)
    }

    /// Classifies a motion by the log of its last states, one each drive period: arrived at an orbit, approaching one, at rest,
    /// or wandering. A stable orbit that Newton's method finds from it is entered in the catalogue.
    pub(crate) fn classify_log(&mut self, log: &[Start]) -> Result<MemberStatus, OrbitError> {
        let Some(last) = log.last() else {
            return Ok(MemberStatus::Wandering);
        };
        if let Some(orbit) = self.find_arrived_orbit(log) {
            return Ok(MemberStatus::Arrived(orbit));
        }
        let Some(found) = find_recurrence(self.drive_frequency(), log) else {
            return Ok(MemberStatus::Wandering);
        };
        if self.is_at_rest(last)? {
            return Ok(MemberStatus::AtRest);
        }
        let orbit = match Orbit::find_periodic(&self.scene, (*last).into(), found.periods as u64) {
            Ok(orbit) if orbit.is_stable() => orbit,
            _ => return Ok(MemberStatus::Wandering),
        };
        if self.is_at_rest(&orbit.state().into())? {
            return Ok(MemberStatus::AtRest);
        }
        let orbit = self.enter_orbit(orbit, found.distance)?;
        let known = &self.orbits[orbit];
        let gap = self.orbit_distance(known, last);
        let is_near = found.distance <= SAME && gap <= NEAR * known.size;
        Ok(match is_near || self.find_arrived_orbit(log).is_some() {
            true => MemberStatus::Arrived(orbit),
            false => MemberStatus::Approaching(orbit),
        })
    }

    /// True if dry friction holds the mass at a state for all of a drive period, or lets it creep ever more slowly: no isolated
    /// orbit, but any place where it is held.
    fn is_at_rest(&self, state: &Start) -> Result<bool, OrbitError> {
        let period = StroboscopicMap::new(&self.scene, 1).apply((*state).into())?;
        Ok(period.is_at_rest(state, self.drive_frequency()))
    }

    /// Index of the orbit in the catalogue that is the same as an orbit with these states, if there is one.
    fn find_known(&self, orbit: &Orbit, states: &[Start]) -> Option<usize> {
        let apart = |known: &KnownOrbit, shift: usize| {
            let pairs = states.iter().zip(known.states.iter().cycle().skip(shift));
            let gaps =
                pairs.map(|(a, b)| state_distance(self.drive_frequency(), a, b) / known.size);
            gaps.fold((f64::INFINITY, 0.0f64), |(least, largest), gap| {
                (least.min(gap), largest.max(gap))
            })
        };
        let unit = self.scene.scales().speed();
        // What rounding may leave of motions that return slowly; how much, is hardly known where that is not small.
        let error = |known: &KnownOrbit| match known.orbit.regime() == orbit.regime() {
            true => {
                let both = known.orbit.state_error() + orbit.state_error();
                (unit * both / known.size).min(NEAR)
            }
            false => 0.0,
        };
        self.orbits.iter().position(|known| {
            let error = error(known);
            known.orbit.periods == orbit.periods
                && (0..known.states.len()).any(|shift| {
                    let (least, largest) = apart(known, shift);
                    // At rest at the origin there is no size to compare with.
                    known.size == 0.0
                        || (least <= SAME_ORBIT.0.max(error) && largest <= SAME_ORBIT.1.max(error))
                })
        })
    }

    /// Enters a stable orbit in the catalogue, unless it is known, and returns its index; `returned`: how near it came back.
    fn enter_orbit(&mut self, orbit: Orbit, returned: f64) -> Result<usize, OrbitError> {
        let states: Vec<Start> = orbit.states()?.into_iter().map(Start::from).collect();
        if let Some(index) = self.find_known(&orbit, &states) {
            return Ok(index);
        }
        let (residual, rounding) = orbit.residual()?;
        self.orbits.push(KnownOrbit {
            size: motion_size(self.drive_frequency(), &states),
            states,
            orbit,
            residuals: OrbitResiduals {
                returned,
                residual,
                rounding,
            },
        });
        Ok(self.orbits.len() - 1)
    }
}

/// A stable orbit in the catalogue, with its states after each drive period.
#[derive(Debug, Clone)]
pub(crate) struct KnownOrbit {
    pub orbit: Orbit,
    pub residuals: OrbitResiduals,
    /// Its states at drive angle phi, after each drive period.
    pub states: Vec<Start>,
    /// The size of the motion in m/s.
    size: f64,
}
