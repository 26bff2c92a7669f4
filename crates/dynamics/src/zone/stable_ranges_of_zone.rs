//! The ranges of a zone whose branch folds back within it: along each of them one stable motion goes on from end to end.

use super::Zone;
use super::stable_range::is_same_state;
use super::zone_end::ZoneEnd;
use crate::continuation::{BranchPoint, SpecialKind, TestFunction};
use crate::orbit::Orbit;
use crate::tolerance::SAME;

impl Zone {
    /// The ranges of the zone along each of which one stable motion goes on, as zones of their own, in order along the branch:
    /// where the branch folds back they overlap in frequency, and a motion ends at the folds beside it. The zone itself alone
    /// where it does not fold back, or a range ends in anything but a fold or an end of the zone.
    pub fn ranges(&self) -> Vec<Self> {
        let sides: Vec<&[BranchPoint]> = self.stable_sides().collect();
        let ranges = sides.iter().map(|side| self.range_on(side));
        match ranges.collect::<Option<Vec<Self>>>() {
            Some(ranges) if ranges.len() > 1 => ranges,
            _ => vec![self.clone()],
        }
    }

    /// The one of the [`Zone::ranges`] that is asked for, counted from the lower end of the branch; the last of fewer. The zone as it
    /// is if none is asked for, or it has one only.
    #[must_use]
    pub fn on_range(self, range: Option<usize>) -> Self {
        let mut ranges = match range {
            Some(_) => self.ranges(),
            None => Vec::new(),
        };
        match (range, ranges.len()) {
            (Some(index), count @ 2..) => Self {
                range,
                ..ranges.swap_remove(index.min(count - 1))
            },
            _ => self,
        }
    }

    /// The one of the [`Zone::ranges`] that holds an orbit of the zone's machine; none if it is an orbit of another branch.
    pub fn range_holding(&self, orbit: &Orbit) -> Option<Self> {
        let holds = |range: &Self| {
            let point = range.point_at(range.place_of(orbit.scene.excitation.frequency));
            point.is_ok_and(|point| is_same_state(&point, orbit.state(), &self.scene))
        };
        self.ranges().into_iter().find(holds)
    }

    /// The range along one stable side of the branch, as a zone; none if it does not end in folds or ends of the zone.
    fn range_on(&self, side: &[BranchPoint]) -> Option<Self> {
        let end = |point: &BranchPoint, own: &ZoneEnd| match own.frequency == point.parameter {
            true => Some(own.clone()),
            false => {
                let fold = SpecialKind::Critical(TestFunction::Fold);
                let is_fold = point.fold_test().abs() <= SAME;
                is_fold.then(|| ZoneEnd::at_special(point, fold))
            }
        };
        Some(Self {
            low: end(side.first()?, &self.low)?,
            high: end(side.last()?, &self.high)?,
            branch: side.to_vec(),
            ..self.clone()
        })
    }

    /// The parts of the zone's branch on the stable side of its folds: from the lower end to the first fold, then between
    /// neighbouring folds along which the frequency rises.
    pub(super) fn stable_sides(&self) -> impl Iterator<Item = &[BranchPoint]> {
        let is_beyond_fold = |point: &BranchPoint| point.fold_test() < -SAME;
        let sides = self
            .branch
            .chunk_by(move |from, to| !is_beyond_fold(from) && !is_beyond_fold(to));
        sides.filter(|side| side.len() > 1)
    }
}
