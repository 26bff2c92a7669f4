//! A stable orbit in the catalogue of a scene.

use super::Certainty;
use crate::orbit::Orbit;
use softstop::Start;

/// A stable orbit in the catalogue.
#[derive(Debug, Clone)]
pub(crate) struct KnownOrbit {
    pub orbit: Orbit,
    pub certainty: Certainty,
    /// Its states at drive angle phi, after each drive period.
    pub(super) states: Vec<Start>,
    /// The size of the motion in m/s.
    pub(super) size: f64,
}

impl KnownOrbit {
    /// States of the known orbit at drive angle phi, after each drive period.
    pub(crate) fn section_states(&self) -> &[Start] {
        &self.states
    }
}
