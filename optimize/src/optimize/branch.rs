//! The stable z = 1 motions of a zone as curves to draw.

use softstop::{Dimension, Machine};
use softstop_dynamics::{BranchPoint, Zone};

use crate::page::computed::{is_shown, refined};

/// The stable z = 1 motions of a zone.
#[derive(Debug, Clone)]
pub(super) struct Branch {
    pub(super) label: String,
    pub(super) frequency_g0: f64,
    pub(super) frequency_sn: f64,
    /// Frequency and before-impact velocity along each stable piece; folds inside the zone leave gaps.
    pub(super) pieces: Vec<Vec<(f64, f64)>>,
}

impl Branch {
    /// The motions of a machine's zone, in its own units.
    pub(super) fn new(machine: &Machine, zone: &Zone, label: String) -> Self {
        let own = |frequency| machine.to_own(Dimension::Frequency, frequency);
        let stable = zone.branch.chunk_by(|a, b| is_shown(a) && is_shown(b));
        let curve = |piece: &[BranchPoint]| {
            let points = refined(&zone.scene, piece).into_iter();
            points
                .map(|it| (own(it.parameter), it.before_impact_velocity()))
                .collect()
        };
        Self {
            label,
            frequency_g0: own(zone.frequency_g0),
            frequency_sn: own(zone.frequency_sn),
            pieces: stable.filter(|piece| piece.len() > 1).map(curve).collect(),
        }
    }
}
