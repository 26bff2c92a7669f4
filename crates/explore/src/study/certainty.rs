//! The table `[certainty]` of a study's file.

use serde::{Deserialize, Serialize};
use softstop_console::failure::Failure;
use softstop_console::range::within;
use softstop_dynamics::attractors::Region;

/// The table `[certainty]`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct Certainty {
    /// Starts at each point.
    pub starts: usize,
    /// Where they lie, if not in the box of each machine's own size.
    position: Option<[f64; 2]>,
    velocity: Option<[f64; 2]>,
}

impl Certainty {
    /// Where starts lie, if that is said.
    pub fn region(&self) -> Option<Region> {
        let (position, velocity) = self.position.zip(self.velocity)?;
        Some(Region { position, velocity })
    }

    /// Refuses what cannot be.
    ///
    /// # Errors
    /// [`Failure::Usage`] naming the key, its value and what is allowed.
    pub fn checked(self) -> Result<Self, Failure> {
        within("certainty.starts", self.starts, 1..=100_000)?;
        let sides = [("position", self.position), ("velocity", self.velocity)];
        for (name, side) in sides {
            let rises = |[low, high]: &[f64; 2]| low.is_finite() && high.is_finite() && low < high;
            match side {
                None if self.region().is_none() && sides.iter().any(|it| it.1.is_some()) => {
                    return Err(Failure::usage(format!(
                        "certainty.{name}: goes with the other side of the box"
                    )));
                }
                Some(side) if !rises(&side) => {
                    return Err(Failure::usage(format!(
                        "certainty.{name} = {side:?}: must be finite, and rising"
                    )));
                }
                _ => {}
            }
        }
        Ok(self)
    }
}

impl Default for Certainty {
    fn default() -> Self {
        Self {
            starts: 64,
            position: None,
            velocity: None,
        }
    }
}
