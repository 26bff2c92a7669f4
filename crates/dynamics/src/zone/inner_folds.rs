//! The ranges of a zone whose branch folds back within it: along each of them one stable motion goes on from end to end.

use super::{Frequencies, Zone};
use crate::continuation::{BranchPoint, Continuation};
use crate::orbit::{Orbit, OrbitError};
use crate::tolerance::SAME;

impl Zone {
    /// True if the branch has stable sides of more than one pair of folds: at some frequencies two stable motions coexist, and
    /// a motion of the zone may end at a fold within it.
    pub fn has_inner_folds(&self) -> bool {
        self.stable_sides().count() > 1
    }

    /// Lowest and highest frequency in rad/s up to which an orbit of the zone goes on, stable or flipped: the folds beside it, or
    /// the ends of the zone.
    ///
    /// # Errors
    /// [`OrbitError`] if the motions of the zone at the orbit's frequency are lost.
    pub fn range_of(&self, orbit: &Orbit) -> Result<(f64, f64), OrbitError> {
        let whole = (self.low.frequency, self.high.frequency);
        if !self.has_inner_folds() {
            return Ok(whole);
        }
        let at = orbit.scene.excitation.frequency;
        let mut nearest = (f64::INFINITY, whole);
        for side in self.stable_sides() {
            let Some(point) = self.point_on(side, at)? else {
                continue;
            };
            let off = (point.before_impact_velocity() - orbit.before_impact_velocity()).abs();
            if off < nearest.0 {
                nearest = (off, (side[0].parameter, side[side.len() - 1].parameter));
            }
        }
        Ok(nearest.1)
    }

    /// Parts of the branch between neighbouring folds on which the parameter rises: the stable sides of folds.
    pub(super) fn stable_sides(&self) -> impl Iterator<Item = &[BranchPoint]> {
        let is_stable_side = |point: &BranchPoint| point.fold_test() >= -SAME;
        let runs = self
            .branch
            .chunk_by(move |from, to| is_stable_side(from) && is_stable_side(to));
        runs.filter(|run| run.len() > 1)
    }

    /// The motion at a frequency in rad/s on a stable side, that with the hardest impact; none beyond its ends.
    pub(super) fn point_on(
        &self,
        side: &[BranchPoint],
        frequency: f64,
    ) -> Result<Option<BranchPoint>, OrbitError> {
        let family = Frequencies(&self.scene);
        let continuation = Continuation::new(&family, 1);
        let mut hardest: Option<BranchPoint> = None;
        for pair in side.windows(2) {
            let (from, to) = (&pair[0], &pair[1]);
            let point = match (from.parameter - frequency, to.parameter - frequency) {
                (0.0, _) => from.clone(),
                (_, 0.0) => to.clone(),
                (a, b) if a * b < 0.0 => continuation.point_between(from, to, frequency)?,
                _ => continue,
            };
            if hardest
                .as_ref()
                .is_none_or(|known| is_harder(&point, known))
            {
                hardest = Some(point);
            }
        }
        Ok(hardest)
    }
}

/// True if a motion has a harder impact than another.
pub(super) fn is_harder(one: &BranchPoint, other: &BranchPoint) -> bool {
    one.before_impact_velocity() > other.before_impact_velocity()
}
