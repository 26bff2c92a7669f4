//! Half the period of an orbit between two stops that are alike, which leads a symmetric one to its mirror image.

use nalgebra::{DVector, Vector2};

use super::arclength::Node;
use super::period_map::{PeriodMap, half_way};
use super::shooting::{Shooting, round_off};
use crate::orbit::Monodromy;
use crate::tolerance::SAME;
use softstop::Scene;

/// True if a machine is its own mirror image half a drive period later: both stops are alike.
pub(super) fn is_symmetric(scene: &Scene) -> bool {
    let below = scene.below.as_ref();
    let is_alike =
        below.is_some_and(|below| below.clearance == scene.clearance && below.stop == scene.stop);
    is_alike && scene.piercing.is_none() && scene.rigid.is_none()
}

/// Half the period of an orbit, compared with the mirror image of its start.
pub(super) struct HalfPeriod {
    /// Scaled distance of its end from the mirror image of its start.
    pub asymmetry: DVector<f64>,
    /// Its Jacobian P'.
    pub monodromy: Monodromy,
    /// What rounding may leave of the asymmetry.
    pub tolerance: f64,
}

impl Shooting<'_, 1> {
    /// Half the period of a motion; none if the machine is not its own mirror image, or periods are even in number.
    pub(super) fn half_period(&self, map: &PeriodMap) -> Option<HalfPeriod> {
        let scene = &*map.trajectory.scene;
        if self.periods.is_multiple_of(2) || !is_symmetric(scene) {
            return None;
        }
        let motion = map.trajectory.up_to(half_way(scene, self.periods));
        let monodromy = Monodromy::from(&motion.tangent());
        let scales = self.family.state_scales();
        Some(HalfPeriod {
            asymmetry: self.scaled(
                -Vector2::from(motion.end) - self.state_at(&map.place),
                [0.0],
            ),
            tolerance: round_off(scene, &map.start, &monodromy, scales),
            monodromy,
        })
    }

    /// The Jacobian of half the period of a symmetric orbit; none of another one.
    pub(super) fn symmetric_half_period(&self, node: &Node<PeriodMap>) -> Option<Monodromy> {
        let half = self.half_period(&node.here.point)?;
        (half.asymmetry.norm() < SAME).then_some(half.monodromy)
    }
}
