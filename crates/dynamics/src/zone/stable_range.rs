//! A stable range: a range of frequencies with a stable z = 1 motion, and what ends it.

use std::cell::RefCell;

use nalgebra::{Vector2, Vector4};

use super::zone_end::{Loss, ZoneEnd};
use super::{FrequencyFamily, Zone};
use crate::continuation::{
    Branch, BranchEnd, BranchPoint, Continuation, Family, MAX_CHORD_DISTANCE, SpecialKind,
};
use crate::orbit::{Orbit, OrbitError};
use crate::tolerance::{ROUNDING, SAME};
use softstop::internals::highest_point;
use softstop::{CheckedScene, Scene};

/// A range of frequencies in which one stable z = 1 motion of a machine changes continuously, with its ends.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct StableRange {
    /// Its lower end.
    pub low: ZoneEnd,
    /// Its upper end.
    pub high: ZoneEnd,
    /// The motion with the hardest impact.
    pub hardest: BranchPoint,
    /// Points of its branch, in rising order of frequency.
    points: Vec<BranchPoint>,
}

impl StableRange {
    /// The z = 1 motion at a frequency in rad/s; none outside the stable range.
    ///
    /// # Errors
    /// [`OrbitError`] if it is lost.
    pub fn point_at(
        &self,
        scene: &CheckedScene,
        frequency: f64,
    ) -> Result<Option<BranchPoint>, OrbitError> {
        let family = FrequencyFamily(scene);
        let after = self
            .points
            .partition_point(|point| point.parameter < frequency);
        match (after.checked_sub(1), self.points.get(after)) {
            (_, Some(point)) if point.parameter == frequency => Ok(Some(point.clone())),
            (Some(before), Some(to)) => {
                let continuation = Continuation::new(&family, 1);
                continuation
                    .point_between(&self.points[before], to, frequency)
                    .map(Some)
            }
            _ => Ok(None),
        }
    }

    /// The orbit of the stable range at the frequency of a scene's drive; none outside the range, or if it is lost.
    pub(super) fn orbit_at(&self, scene: &Scene) -> Option<Orbit> {
        let scene = scene.check().ok()?;
        let point = self.point_at(&scene, scene.excitation.frequency).ok()??;
        let family = FrequencyFamily(&scene);
        let orbit = Continuation::new(&family, 1).orbit_at(&point).ok()?;
        (orbit.is_stable() && orbit.impacts.len() == 1).then_some(orbit)
    }

    /// True if the stable range is a part of another one, or the same one.
    pub(super) fn is_within(&self, other: &Self, scene: &CheckedScene) -> bool {
        let middle = &self.points[self.points.len() / 2];
        let near = |frequency: f64| SAME * frequency.abs();
        self.low.frequency >= other.low.frequency - near(self.low.frequency)
            && self.high.frequency <= other.high.frequency + near(self.high.frequency)
            && other.contains_point(scene, middle).unwrap_or(false)
    }

    /// True if a point of a branch lies on the stable range.
    ///
    /// # Errors
    /// [`OrbitError`] if the stable range is lost.
    pub fn contains_point(
        &self,
        scene: &CheckedScene,
        point: &BranchPoint,
    ) -> Result<bool, OrbitError> {
        let own = self.point_at(scene, point.parameter)?;
        Ok(own.is_some_and(|own| is_same_state(&own, point.state(), scene)))
    }

    /// True if the stable range is a part of a hysteresis zone.
    pub fn is_part_of(&self, zone: &Zone) -> bool {
        let sizes = unknown_scales(&zone.scene);
        let inside = |point: &BranchPoint| {
            let mut pairs = self.points.windows(2);
            point.is_stable() && pairs.any(|pair| lies_on_chord(pair, point, sizes))
        };
        zone.branch.iter().any(inside)
    }
}

/// True if a point of a stable range has a given state but for rounding, at the same frequency.
pub(super) fn is_same_state(one: &BranchPoint, other: Vector2<f64>, scene: &Scene) -> bool {
    let size = other.norm().max(scene.scales().length);
    (one.state() - other).norm() < SAME * size
}

/// Scales of position, velocity and frequency, by which it is told whether a point lies on a stable range.
pub(super) fn unknown_scales(scene: &CheckedScene) -> [f64; 3] {
    let family = FrequencyFamily(scene);
    let ([length, speed], [rate]) = (family.state_scales(), family.parameter_scales());
    [length, speed, rate]
}

/// True if a point lies on the chord between two neighbouring points of a stable range or branch, or as near to it as the branch
/// itself may: by state, frequency and before-impact velocity in units of the three scales.
pub(super) fn lies_on_chord(
    pair: &[BranchPoint],
    point: &BranchPoint,
    [length, speed, rate]: [f64; 3],
) -> bool {
    let place = |point: &BranchPoint| {
        let (state, velocity) = (point.state(), point.before_impact_velocity());
        Vector4::new(
            state.x / length,
            state.y / speed,
            point.parameter / rate,
            velocity / speed,
        )
    };
    let (from, way) = (place(&pair[0]), place(&pair[1]) - place(&pair[0]));
    let gone = place(point) - from;
    let share = gone.dot(&way) / way.norm_squared();
    let off = (gone - share * way).norm();
    (-MAX_CHORD_DISTANCE..=1.0 + MAX_CHORD_DISTANCE).contains(&share)
        && off <= MAX_CHORD_DISTANCE * way.norm() + SAME
}

/// The stable ranges of a branch: its parts between special points along which z = 1 is stable.
pub(super) fn stable_parts(continuation: &Continuation<'_>, branch: &Branch) -> Vec<StableRange> {
    let mut found = Vec::new();
    let mut part = RangeCandidate::new((Loss::of_branch_end(&branch.ends.0), None));
    for point in points_from_special(branch) {
        let special = branch.special_at(point);
        let cause = special.map(|special| (Loss::at_special(&special.kind), Some(special.kind)));
        if let Some(cause) = cause.or_else(|| Some((part.impact_change(point)?, None))) {
            part.points.push(point.clone());
            let part = std::mem::replace(&mut part, RangeCandidate::new(cause.clone()));
            found.extend(part.into_range(continuation, cause));
        }
        part.points.push(point.clone());
    }
    found.extend(part.into_range(continuation, (Loss::of_branch_end(&branch.ends.1), None)));
    found
}

/// The points of a branch in order; those of a closed branch from its first special point around to it again.
fn points_from_special(branch: &Branch) -> Vec<&BranchPoint> {
    let points = branch.points.iter();
    let (BranchEnd::Closed, Some(first)) = (&branch.ends.1, branch.specials.first()) else {
        return points.collect();
    };
    // The last point lies beyond the start.
    let mut points: Vec<&BranchPoint> = points.take(branch.points.len() - 1).collect();
    let start = points.iter().position(|point| first.is_at(point));
    let start = start.unwrap_or(0);
    points.rotate_left(start);
    points.push(&first.point);
    points
}

/// Why a part of a branch ends, and the special point there, if one is.
type EndCause = (Loss, Option<SpecialKind>);

/// A part of a branch between two special points, which may be a stable range.
struct RangeCandidate {
    begins: EndCause,
    points: Vec<BranchPoint>,
}

impl RangeCandidate {
    /// A part of a branch without points yet; `begins`: why it begins where it does.
    fn new(begins: EndCause) -> Self {
        Self {
            begins,
            points: Vec::new(),
        }
    }

    /// The loss of the motion at the next point of the branch if the number of impacts changes there without a special point: in
    /// a grazing that is not located. None if the number stays.
    fn impact_change(&self, point: &BranchPoint) -> Option<Loss> {
        let last = self.points.get(1..)?.last()?;
        match (last.impacts.len(), point.impacts.len()) {
            (1, 0) | (0, 1) => Some(Loss::Grazing),
            (a, b) => (a != b).then_some(Loss::AnotherImpact),
        }
    }

    /// The stable range that the part is, if most of its motions are stable, all have one impact, and its ends lie apart beyond
    /// rounding; `ends`: why it ends where it does.
    fn into_range(self, continuation: &Continuation<'_>, ends: EndCause) -> Option<StableRange> {
        let Self { begins, mut points } = self;
        let end = points.pop()?;
        let mut inner = points.split_off(points.len().min(1));
        let begin = points.pop()?;
        let middle = 0.5 * (begin.parameter + end.parameter);
        let off = |point: &BranchPoint| (point.parameter - middle).abs();
        // At hardly any damping rounding puts motions beyond an end, and onto the other side of it: most of them tell.
        inner.retain(|point| off(point) <= off(&end));
        // Both ends may lie on one step.
        if inner.is_empty() {
            inner.push(continuation.point_between(&begin, &end, middle).ok()?);
        }
        let stable = inner.iter().filter(|point| point.is_stable()).count();
        if 2 * stable <= inner.len() || inner.iter().any(|point| point.impacts.len() != 1) {
            return None;
        }
        inner.retain(BranchPoint::is_stable);
        let mut points = [vec![begin], inner, vec![end]].concat();
        let mut causes = [begins, ends];
        if points[0].parameter > points[points.len() - 1].parameter {
            causes.reverse();
        }
        points.sort_by(|a, b| a.parameter.total_cmp(&b.parameter));
        let [low, high] = [points[0].parameter, points[points.len() - 1].parameter];
        // Each end is known to rounding.
        if high - low <= 2.0 * ROUNDING * high {
            return None;
        }
        let [below, above] = causes;
        Some(StableRange {
            low: ZoneEnd::at_point(&points[0], below.0, below.1),
            high: ZoneEnd::at_point(&points[points.len() - 1], above.0, above.1),
            hardest: hardest_point(continuation, &points)?,
            points,
        })
    }
}

/// The point with the hardest impact along points in rising order of frequency: by golden section about the hardest of them.
fn hardest_point(continuation: &Continuation<'_>, points: &[BranchPoint]) -> Option<BranchPoint> {
    let velocity = BranchPoint::before_impact_velocity;
    let harder = |a: usize, b: usize| velocity(&points[a]).total_cmp(&velocity(&points[b]));
    let best = (0..points.len()).max_by(|a, b| harder(*a, *b))?;
    let (below, above) = (best.saturating_sub(1), (best + 1).min(points.len() - 1));
    let known = RefCell::new(points[below..=above].to_vec());
    let between = |frequency: f64| {
        let mut known = known.borrow_mut();
        let next = known.partition_point(|point| point.parameter < frequency);
        let after = known.get(next)?;
        if after.parameter == frequency {
            return Some(after.clone());
        }
        let before = known.get(next.checked_sub(1)?)?;
        let found = continuation.point_between(before, after, frequency).ok()?;
        known.insert(next, found.clone());
        Some(found)
    };
    let [low, high] = [below, above].map(|at| points[at].parameter);
    let height = |frequency: f64| between(frequency).map_or(f64::NEG_INFINITY, |it| velocity(&it));
    // To a share of 1e-5 of the way, so that the velocity is known to ten digits.
    let (top, _) = highest_point(low, high, 1e-5 * (high - low), height);
    let top = between(top).filter(|top| velocity(top) > velocity(&points[best]));
    Some(top.unwrap_or_else(|| points[best].clone()))
}
