//! The family of one machine at all frequencies of its drive.

use crate::continuation::Family;
use softstop::internals::Scales;
use softstop::{MotionError, Scene};

/// The family of one scene at all frequencies of its drive.
#[doc(hidden)]
#[derive(Debug)]
pub struct Frequencies<'a>(pub &'a Scene);

impl Family for Frequencies<'_> {
    fn scene(&self, [frequency]: [f64; 1]) -> Result<Scene, MotionError> {
        let scene = self.0.at_frequency(frequency);
        scene.validate()?;
        Ok(scene)
    }

    fn state_scales(&self) -> [f64; 2] {
        let Scales { length, rate } = self.0.scales();
        let length = self.0.clearance.abs().max(length);
        [length, length * rate]
    }

    fn parameter_scales(&self) -> [f64; 1] {
        [0.2 * self.0.scales().rate]
    }

    fn by_frequency(&self) -> [Option<f64>; 1] {
        [self.0.followers.is_empty().then_some(1.0)]
    }
}
