//! The layers of positions beyond a clearance, each with the phases that hold in it.

use std::sync::Arc;

use super::{PhaseId, SurfaceId};

/// The layers beyond a clearance, and the rigid stop that ends them.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Stack {
    pub layers: Arc<[Layer]>,
    /// The surface of that rigid stop.
    pub wall: Option<SurfaceId>,
}

/// A range of positions with its phases at positive and at negative velocities.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Layer {
    /// Position in m at which it begins.
    pub from: f64,
    pub forward: PhaseId,
    pub backward: PhaseId,
    /// 1 of a stop above, -1 of one below.
    pub side: f64,
    /// The surface at `from`.
    pub surface: SurfaceId,
}

impl Layer {
    /// The phase of the layer on the way towards the stop.
    pub const fn inward_phase(self) -> PhaseId {
        if self.side < 0.0 {
            self.backward
        } else {
            self.forward
        }
    }

    /// The phase of the layer on the way back.
    pub const fn outward_phase(self) -> PhaseId {
        if self.side < 0.0 {
            self.forward
        } else {
            self.backward
        }
    }
}

impl Stack {
    /// The surface at which the stack begins: that of its first layer, or of the rigid stop.
    pub fn first_surface(&self) -> Option<SurfaceId> {
        self.layers.first().map(|layer| layer.surface).or(self.wall)
    }

    /// The layer that holds a position in m, if the mass is beyond the clearance there.
    pub fn layer_at(&self, position: f64) -> Option<&Layer> {
        self.layers
            .iter()
            .rev()
            .find(|layer| layer.side * position >= layer.side * layer.from)
    }
}
