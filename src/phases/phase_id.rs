//! Names of phases and surfaces.

use serde::{Deserialize, Serialize};

/// One of a scene's phases.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct PhaseId(pub(super) u32);

impl PhaseId {
    /// The free phase.
    pub const FREE: Self = Self(0);

    /// Index of the phase among [`Phases::phases`](super::Phases::phases).
    pub const fn index(self) -> usize {
        self.0 as usize
    }
}

/// One of the surfaces between a scene's phases.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct SurfaceId(pub(super) usize);
