//! The hysteresis zone, from grazing of the impact-less motion to the fold of z = 1.
//!
//! A zone of the unloaded machine takes 4.6 million instructions (AVX2, a grid of 12 x 12 over clearance 2 to 22 and stiffness
//! 1 to 30): 41 % are the lanes' 1,491 periods (144 starts of 4 periods, and 8 more unless a known motion attracts them), 32 %
//! the 93 periods with Jacobian for 21 points of the branch (16,000 each), 11 % Newton's method from 15 states near which
//! motions come back (48 periods, 10,400 each). The search for the next crossing, with its proof, is 40 % of a period with
//! its Jacobian.

use super::all_stable_ranges::{FOLLOWED_RANGE, find_stable_ranges};
use super::end_of_followed_branch::{LONGEST_BRANCH, follow_to_end};
use super::stable_range::StableRange;
use super::zone_end::{Loss, ZoneEnd};
use super::{
    FrequencyFamily, StableBranchEnd, Zone, ZoneError, ZoneKind, grazing_frequencies, refuse_below,
};
use crate::continuation::{BranchPoint, Continuation, Direction, SpecialKind, TestFunction};
use crate::monitor::{Monitor, stop_if, unmonitored};
use crate::orbit::{Orbit, OrbitError, find_batch, find_with_known_orbits};
use crate::parallel;
use crate::tolerance::TEST_ROUNDING;
use softstop::Scene;

/// Number of machines whose hysteresis zones are found together.
const MACHINES_TOGETHER: usize = 8;

/// The hysteresis zone of a scene, from the grazing frequency g0 to the fold of z = 1; the frequency of its drive plays no part.
///
/// # Errors
/// [`ZoneError`] if there is no grazing boundary, no z = 1 motion at it, or no fold.
pub fn hysteresis(scene: &Scene) -> Result<Zone, ZoneError> {
    hysteresis_with_monitor(scene, &unmonitored)
}

/// The hysteresis zone of a scene as [`hysteresis`] finds it, as long as a monitor, which is not told how much is done, lets the
/// search go on.
///
/// # Errors
/// As [`hysteresis`]; [`OrbitError::Stopped`].
pub fn hysteresis_with_monitor(scene: &Scene, monitor: Monitor<'_>) -> Result<Zone, ZoneError> {
    zone_with_singles(scene, None, monitor)
}

/// The hysteresis zone of a scene and all its stable ranges: the z = 1 motions at g0 are searched once for both.
///
/// # Errors
/// As [`hysteresis_with_monitor`] and [`stable_ranges_with_monitor`](super::stable_ranges_with_monitor).
pub fn hysteresis_and_stable_ranges(
    scene: &Scene,
    monitor: Monitor<'_>,
) -> (Result<Zone, ZoneError>, Result<Vec<StableRange>, ZoneError>) {
    let all = refuse_below(scene).and_then(|()| Ok(find_stable_ranges(scene, monitor)?));
    let (stable_ranges, singles) = match all {
        Ok(found) => (Ok(found.ranges), found.singles_at_grazing),
        Err(error) => (Err(error), None),
    };
    (zone_with_singles(scene, singles, monitor), stable_ranges)
}

/// The hysteresis zone of a scene; `singles`: the z = 1 orbits at its grazing frequency g0, if they are known.
fn zone_with_singles(
    scene: &Scene,
    singles: Option<Vec<Orbit>>,
    monitor: Monitor<'_>,
) -> Result<Zone, ZoneError> {
    let grazing = grazing_frequencies(scene)?;
    let start = find_with_known_orbits(&scene.at_frequency(grazing.1), singles, monitor);
    zone_from_start(scene, grazing, (start.ok(), UpperEnd::Fold), monitor)
}

/// What may end a hysteresis zone at its upper frequency.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum UpperEnd {
    /// A fold.
    Fold,
    /// A fold, or where none comes first the grazing of a surface beyond the clearance, as of a rigid stop behind the other.
    FoldOrGrazing,
}

/// The hysteresis zones of many machines at once, in a fraction of the work: the z = 1 motion at g0 is taken for the hardest of
/// those that simulated motions come back near to, and is searched as in [`hysteresis`] only where there is none.
///
/// # Errors
/// Each as [`hysteresis_with_monitor`].
pub fn hysteresis_batch(scenes: &[Scene], monitor: Monitor<'_>) -> Vec<Result<Zone, ZoneError>> {
    zones_of(scenes, UpperEnd::Fold, monitor)
}

/// The hysteresis zones of many machines as [`hysteresis_batch`] finds them, with the upper ends that are allowed.
pub(super) fn zones_of(
    scenes: &[Scene],
    upper: UpperEnd,
    monitor: Monitor<'_>,
) -> Vec<Result<Zone, ZoneError>> {
    let chunks: Vec<_> = scenes.chunks(MACHINES_TOGETHER).collect();
    let zones = parallel::map(&chunks, |scenes| zones_together(scenes, upper, monitor));
    zones.into_iter().flatten().collect()
}

/// The hysteresis zones of a few machines, whose z = 1 motions at g0 are searched in one batch.
fn zones_together(
    scenes: &[Scene],
    upper: UpperEnd,
    monitor: Monitor<'_>,
) -> Vec<Result<Zone, ZoneError>> {
    let grazing: Vec<_> = scenes.iter().map(grazing_frequencies).collect();
    let with_grazing = scenes.iter().zip(&grazing);
    let at_grazing: Vec<Scene> = with_grazing
        .filter_map(|(scene, grazing)| Some(scene.at_frequency(grazing.as_ref().ok()?.1)))
        .collect();
    let mut starts = find_batch(&at_grazing, monitor).into_iter();
    let zones = scenes.iter().zip(grazing).map(|(scene, grazing)| {
        let grazing = grazing?;
        let start = starts.next().and_then(Result::ok);
        zone_from_start(scene, grazing, (start, upper), monitor)
    });
    zones.collect()
}

/// The hysteresis zone of a scene from the z = 1 motion `start` at the grazing frequency g0 upward.
fn zone_from_start(
    scene: &Scene,
    (frequency_g0_below, frequency_g0): (Option<f64>, f64),
    (start, upper): (Option<Orbit>, UpperEnd),
    monitor: Monitor<'_>,
) -> Result<Zone, ZoneError> {
    OrbitError::ask_monitor(monitor)?;
    let scene = &scene.check()?;
    let family = FrequencyFamily(scene);
    let start = start.ok_or(ZoneError::NoOrbit {
        frequency: frequency_g0.into(),
    })?;
    let continuation = Continuation::new(&family, 1);
    let range = (frequency_g0, FOLLOWED_RANGE.1 * frequency_g0);
    let (mut branch, fold) = follow_upward(&continuation, &start, range, monitor)?;
    let high = match (fold, upper) {
        (Some(fold), _) => fold,
        (None, UpperEnd::Fold) => return Err(no_fold_error(frequency_g0, &branch)),
        (None, UpperEnd::FoldOrGrazing) => {
            let none = no_fold_error(frequency_g0, &branch);
            branch.truncate(1);
            let end = follow_to_end(&continuation, &mut branch, Direction::Up, range).ok();
            end.filter(ends_in_grazing).ok_or(none)?
        }
    };
    Ok(Zone {
        kind: ZoneKind::Hysteresis,
        range: None,
        scene: scene.clone(),
        frequency_g0_below,
        frequency_g0,
        low: ZoneEnd {
            frequency: frequency_g0,
            ..ZoneEnd::at_point(&branch[0], Loss::FreeGrazing, None)
        },
        high,
        branch,
    })
}

/// Follows the branch of a z = 1 motion from the lower of two frequencies upward, through all its folds, until it leaves the
/// range, doubles its period, or ends in grazing: its points, and the fold at the highest frequency, if it has one.
pub(super) fn follow_upward(
    continuation: &Continuation<'_>,
    start: &Orbit,
    (lowest, highest): (f64, f64),
    monitor: Monitor<'_>,
) -> Result<(Vec<BranchPoint>, Option<ZoneEnd>), OrbitError> {
    let mut branch =
        continuation.follow_points(start, lowest, Direction::Up, LONGEST_BRANCH, |point| {
            let flipped = !point.is_stable() && point.fold_test() > 0.0;
            let weak = point.before_impact_velocity() < 0.2 * start.before_impact_velocity();
            let outside = point.parameter < lowest || point.parameter > highest;
            // An unstable branch ends in grazing: its impacts become weak, and only there its multiplier grows so far.
            let ends_in_grazing = point.fold_test() < -4.0 || (weak && point.fold_test() < 0.0);
            stop_if(flipped || outside || ends_in_grazing || monitor(0, 0).is_break())
        })?;
    OrbitError::ask_monitor(monitor)?;
    let folds = insert_folds(continuation, &mut branch);
    let highest = folds
        .iter()
        .max_by(|a, b| a.parameter.total_cmp(&b.parameter));
    let end =
        highest.map(|fold| ZoneEnd::at_special(fold, SpecialKind::Critical(TestFunction::Fold)));
    Ok((branch, end))
}

/// True if a surface is grazed at the end of a zone.
fn ends_in_grazing(end: &ZoneEnd) -> bool {
    matches!(end.special, Some(SpecialKind::Grazing(_)))
}

/// Locates the folds of a branch between points where 1 - tr + det passes zero, but for border collisions, and inserts them.
fn insert_folds(
    continuation: &Continuation<'_>,
    branch: &mut Vec<BranchPoint>,
) -> Vec<BranchPoint> {
    let mut folds = Vec::new();
    for index in (1..branch.len()).rev() {
        let (from, to) = (&branch[index - 1], &branch[index]);
        let tests = [from, to].map(|point| TestFunction::Fold.scaled_value(&point.monodromy));
        let passes_zero = tests[0] * tests[1] < 0.0;
        if passes_zero
            && tests.iter().any(|value| value.abs() > TEST_ROUNDING)
            && let Ok(fold) = continuation.critical_between(from, to, TestFunction::Fold)
        {
            branch.insert(index, fold.clone());
            folds.push(fold);
        }
    }
    folds
}

/// The error of a hysteresis zone whose branch, followed from a frequency on, has no fold.
fn no_fold_error(from: f64, branch: &[BranchPoint]) -> ZoneError {
    let last = branch.last().map_or(f64::NAN, |point| point.parameter);
    let unstable = branch.iter().find(|point| !point.is_stable());
    if let Some(flipped) = unstable.filter(|point| point.fold_test() > 0.0) {
        return ZoneError::Flip {
            frequency: flipped.parameter.into(),
        };
    }
    let end = match last {
        _ if last < from => StableBranchEnd::Below,
        _ if last > FOLLOWED_RANGE.1 * from => StableBranchEnd::Range,
        _ if branch.len() >= LONGEST_BRANCH => StableBranchEnd::Budget,
        _ => StableBranchEnd::Regime,
    };
    ZoneError::NoFold {
        from: from.into(),
        to: last.into(),
        end,
    }
}
