//! The family of one machine at all frequencies of its drive.

use crate::continuation::Family;
use softstop::internals::Scales;
use softstop::{CheckedScene, MotionError};

/// The one-parameter family of scenes that continuation follows for zones: one scene at all frequencies of its drive.
#[doc(hidden)]
#[derive(Debug)]
pub struct FrequencyFamily<'a>(pub &'a CheckedScene);

impl Family for FrequencyFamily<'_> {
    fn scene(&self, [frequency]: [f64; 1]) -> Result<CheckedScene, MotionError> {
        Ok(self.0.recheck(self.0.at_frequency(frequency))?)
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
