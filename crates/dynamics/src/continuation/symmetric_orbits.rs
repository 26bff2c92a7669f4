//! Symmetric orbits, each its own mirror image half its period later, and the pitchforks at which they cease to be.
//!
//! An orbit between two stops that are alike is symmetric where x(t + n T/2) = -x(t): a fixed point of half its map P, followed by
//! a mirror, -P(s) = s. Its monodromy matrix is the square of that matrix, -P', of which a multiplier 1 is a fold of symmetric
//! orbits, and a multiplier -1 a pitchfork: two asymmetric orbits come out of it, mirror images of each other.

use nalgebra::{DVector, Vector2};

use super::chord_and_cubic::{along_chord, is_beside};
use super::equations::{CurveNode, Equations, Evaluation, StepEnds};
use super::newton_corrector::correct;
use super::period_map::{PeriodMap, half_way_instant};
use super::stroboscopic_shooting::{Shooting, residual_rounding};
use super::{Continuation, SpecialKind, SpecialPoint, TestFunction};
use crate::orbit::{Monodromy, OrbitError};
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
    pub(super) fn mirrored_half_period(&self, map: &PeriodMap) -> Option<HalfPeriod> {
        let scene = &*map.trajectory.scene;
        if self.periods.is_multiple_of(2) || !is_symmetric(scene) {
            return None;
        }
        let motion = map.trajectory.up_to(half_way_instant(scene, self.periods));
        let monodromy = Monodromy::from(&motion.tangent());
        let scales = self.family.state_scales();
        Some(HalfPeriod {
            asymmetry: self.scaled_unknowns(
                -Vector2::from(motion.end) - self.state_at(&map.place),
                [0.0],
            ),
            tolerance: residual_rounding(scene, &map.start, &monodromy, scales),
            monodromy,
        })
    }

    /// The Jacobian of half the period of a symmetric orbit; none of another one.
    pub(super) fn symmetric_half_period(&self, node: &CurveNode<PeriodMap>) -> Option<Monodromy> {
        let half = self.mirrored_half_period(&node.here.point)?;
        (half.asymmetry.norm() < SAME).then_some(half.monodromy)
    }
}

impl Continuation<'_> {
    /// The pitchfork of symmetric orbits on a step and its share of the way, if there is one.
    pub(super) fn pitchfork_on_step(
        &self,
        (from, to): StepEnds<'_, PeriodMap>,
    ) -> Result<Option<(f64, SpecialPoint)>, OrbitError> {
        let half = |node| self.shooting.symmetric_half_period(node);
        let (Some(a), Some(b)) = (half(from), half(to)) else {
            return Ok(None);
        };
        if !TestFunction::Fold.passes_zero(&a, &b) {
            return Ok(None);
        }
        let [a, b] = [a, b].map(|half| TestFunction::Fold.scaled_value(&half));
        let way = &to.at - &from.at;
        let node = self.pitchfork(&(&from.at + a / (a - b) * &way))?;
        let (share, _) = along_chord((&from.at, &way), &node.at);
        if !(0.0..=1.0).contains(&share) || !is_beside((&from.at, &way), &node.at) {
            return Err(OrbitError::LOST);
        }
        let (kind, point) = (SpecialKind::Pitchfork, self.point_at(&node)?);
        Ok(Some((share, SpecialPoint { kind, point })))
    }

    /// The node of the pitchfork near a place.
    pub(super) fn pitchfork(
        &self,
        near: &DVector<f64>,
    ) -> Result<CurveNode<PeriodMap>, OrbitError> {
        let at = correct(&Pitchfork(&self.shooting), near, None)?.at;
        let here = self.shooting.evaluate(&at)?;
        Ok(CurveNode { at, here })
    }
}

/// The equations of a pitchfork: symmetric orbits with a multiplier -1 of the mirrored half period.
struct Pitchfork<'a, 'b>(&'b Shooting<'a, 1>);

impl Equations for Pitchfork<'_, '_> {
    type Point = Monodromy;

    fn evaluate(&self, at: &DVector<f64>) -> Result<Evaluation<Monodromy>, OrbitError> {
        let map = self.0.evaluate(at)?.point;
        let half = self.0.mirrored_half_period(&map).ok_or(OrbitError::LOST)?;
        let symmetric = Evaluation {
            residual: half.asymmetry.rows(0, 2).into_owned(),
            tolerance: half.tolerance,
            point: half.monodromy,
        };
        Ok(symmetric.with_test(TestFunction::Fold.scaled_value(&half.monodromy)))
    }
}
