//! All stable z = 1 motions of a machine, as ranges of the drive's frequency.

use std::collections::VecDeque;

use super::stable_range::{
    StableRange, is_same_state, lies_on_chord, stable_parts, unknown_scales,
};
use super::{FrequencyFamily, ZoneError, grazing_frequencies, refuse_below};
use crate::continuation::{Branch, BranchEnd, BranchLimits, BranchPoint, Continuation};
use crate::monitor::{Monitor, unmonitored};
use crate::orbit::{
    Orbit, OrbitError, single_impact_orbits_about_frequency, single_impact_orbits_near_impact,
};
use crate::tolerance::NEAR;
use softstop::{CheckedScene, Scene};

/// Rows of frequencies at which z = 1 motions are searched: lowest and highest in units of the natural frequency, and how many.
/// They lie closer at low frequencies, where a drive period holds several free ones and stable ranges are narrow.
const SEARCH_ROWS: [(f64, f64, usize); 2] = [(0.25, 0.7, 70), (0.7, 4.0, 23)];
/// Range of frequencies in which branches are followed, in units of the natural frequency, or of the grazing
/// frequency g0 of the impact-less motion; below it they wind.
pub(super) const FOLLOWED_RANGE: (f64, f64) = (0.25, 8.0);
/// Most points of a branch that is followed for stable ranges, in each direction.
const MAX_RANGE_POINTS: usize = 20_000;

/// Share of a frequency about it within which motions are searched where one at it is nearly z = 1: the spacing of the row.
const FREE_SHARE: f64 = 0.08;
/// Shares of a frequency by which motions are searched on both sides of a border collision, from the impact there.
const BESIDE_BORDER_SHARES: [f64; 3] = [1e-5, 1e-4, 1e-3];
/// Most frequencies at which motions are searched for stable ranges, and most branches that are followed.
const MAX_BRANCHES: usize = 200;

/// All stable ranges of a scene, in rising order of frequency; the frequency of its drive plays no part.
///
/// At each of a row of frequencies all z = 1 motions are found; those that lie on no branch known so far are followed both ways,
/// through folds. So branches that no motion at g0 leads to, isolas among them, come to light. Where a branch ends in a border
/// collision, motions are looked for on both sides of it: what goes on there is another branch. Ranges narrower than 2e-9 of
/// their frequency are left out: each end is known to 1e-9, as at resonances with hardly any damping.
///
/// # Errors
/// [`ZoneError::Orbit`] for a scene that is none.
pub fn stable_ranges(scene: &Scene) -> Result<Vec<StableRange>, ZoneError> {
    stable_ranges_with_monitor(scene, &unmonitored)
}

/// All stable ranges of a scene as [`stable_ranges`] finds them, as long as a monitor, which is not told how much is done, lets
/// the search go on.
///
/// # Errors
/// As [`stable_ranges`]; [`OrbitError::Stopped`].
pub fn stable_ranges_with_monitor(
    scene: &Scene,
    monitor: Monitor<'_>,
) -> Result<Vec<StableRange>, ZoneError> {
    refuse_below(scene)?;
    Ok(find_stable_ranges(scene, monitor)?.ranges)
}

/// The stable ranges of a scene, and the z = 1 orbits at the grazing frequency g0 that their search meets.
#[derive(Debug)]
pub(super) struct FoundRanges {
    /// In rising order of frequency.
    pub ranges: Vec<StableRange>,
    /// The z = 1 orbits at g0, those with the hardest impacts last, if they were searched.
    pub singles_at_grazing: Option<Vec<Orbit>>,
}

/// Searches all stable ranges of a scene, as [`stable_ranges`] says.
pub(super) fn find_stable_ranges(
    scene: &Scene,
    monitor: Monitor<'_>,
) -> Result<FoundRanges, OrbitError> {
    let scene = &scene.check()?;
    let family = FrequencyFamily(scene);
    let continuation = Continuation::new(&family, 1);
    let natural = scene.scales().rate;
    let limits = BranchLimits {
        range: (FOLLOWED_RANGE.0 * natural, FOLLOWED_RANGE.1 * natural),
        points: MAX_RANGE_POINTS,
    };
    let sizes = unknown_scales(scene);
    let mut branches: Vec<Branch> = Vec::new();
    let grazing = grazing_frequencies(scene).ok();
    let mut singles_at_grazing = None;
    let mut frequencies = search_frequencies(scene, grazing);
    let mut next = 0;
    while let Some(&frequency) = frequencies.get(next).filter(|_| next < MAX_BRANCHES) {
        next += 1;
        let mut met = VecDeque::from(single_impact_orbits_about_frequency(
            &scene.recheck(scene.at_frequency(frequency))?,
            FREE_SHARE,
            monitor,
        )?);
        if grazing.is_some_and(|(_, above)| above == frequency) {
            let is_here = |orbit: &&Orbit| orbit.scene.excitation.frequency == frequency;
            singles_at_grazing = Some(met.iter().filter(is_here).cloned().collect());
        }
        while let Some(orbit) = met.pop_front().filter(|_| branches.len() < MAX_BRANCHES) {
            let frequency = orbit.scene.excitation.frequency;
            let point = BranchPoint {
                parameter: frequency,
                position: orbit.position,
                velocity: orbit.velocity,
                impacts: orbit.before_impact_velocities().collect(),
                monodromy: orbit.monodromy,
            };
            let is_known = branches.iter().any(|branch| {
                let mut pairs = branch.points.windows(2);
                pairs.any(|pair| {
                    lies_on_chord(pair, &point, sizes)
                        && !is_off_branch(&continuation, pair, (&point, scene))
                })
            });
            if is_known {
                continue;
            }
            let go_on = |_: &BranchPoint| monitor(0, 0);
            if let Ok(branch) = continuation.branch(frequency, orbit.state(), &limits, go_on) {
                OrbitError::ask_monitor(monitor)?;
                for border in border_points(&branch) {
                    frequencies.extend(frequencies_beside(border.parameter));
                    let border = continuation.orbit_at(border);
                    met.extend(
                        border.map_or(Vec::new(), |border| orbits_beside_border(scene, &border)),
                    );
                }
                branches.push(branch);
            }
        }
    }
    let mut found: Vec<StableRange> = branches
        .iter()
        .flat_map(|branch| stable_parts(&continuation, branch))
        .collect();
    found.sort_by(|a, b| a.low.frequency.total_cmp(&b.low.frequency));
    let mut distinct: Vec<StableRange> = Vec::new();
    for one in found {
        if !distinct.iter().any(|other| one.is_within(other, scene)) {
            distinct.retain(|other| !other.is_within(&one, scene));
            distinct.push(one);
        }
    }
    Ok(FoundRanges {
        ranges: distinct,
        singles_at_grazing,
    })
}

/// True if a point near the chord between two neighbours of a branch is not that branch's motion at its frequency.
fn is_off_branch(
    continuation: &Continuation<'_>,
    pair: &[BranchPoint],
    (point, scene): (&BranchPoint, &CheckedScene),
) -> bool {
    let [from, to] = [&pair[0], &pair[1]];
    let is_inside = (from.parameter < point.parameter) != (to.parameter < point.parameter);
    let own = || continuation.point_between(from, to, point.parameter);
    is_inside && own().is_ok_and(|own| !is_same_state(&own, point.state(), scene))
}

/// The frequencies at which z = 1 motions are searched for all stable ranges: g0 of grazing, beside both grazings, the
/// [`SEARCH_ROWS`], and beside the lowest.
fn search_frequencies(scene: &Scene, grazing: Option<(Option<f64>, f64)>) -> Vec<f64> {
    let natural = scene.scales().rate;
    let row = SEARCH_ROWS.into_iter().flat_map(|(low, high, count)| {
        let ratio: f64 = (high / low).powf(1.0 / count as f64);
        (0..count).map(move |index| natural * low * ratio.powi(index as i32))
    });
    let (below, above) = grazing.map_or((None, None), |(below, above)| (below, Some(above)));
    let grazing = below.into_iter().chain(above).flat_map(frequencies_beside);
    let lowest = FOLLOWED_RANGE.0 * natural;
    let all = above
        .into_iter()
        .chain(grazing)
        .chain(row)
        .chain(frequencies_beside(lowest));
    all.filter(|frequency| *frequency >= lowest).collect()
}

/// The ends of a branch beyond which another may go on: at grazing, border collision, or where it is unstable or lost.
fn border_points(branch: &Branch) -> Vec<&BranchPoint> {
    let ends = [
        (&branch.ends.0, branch.points.first()),
        (&branch.ends.1, branch.points.last()),
    ];
    let border = |(end, point): (&BranchEnd, _)| match end {
        BranchEnd::Grazing | BranchEnd::Border(_) | BranchEnd::Unstable | BranchEnd::Lost(_) => {
            point
        }
        _ => None,
    };
    ends.into_iter().filter_map(border).collect()
}

/// The z = 1 orbits at frequencies just beside a border collision whose impact is nearly that of the motion there.
fn orbits_beside_border(scene: &CheckedScene, border: &Orbit) -> Vec<Orbit> {
    let impacts = border.timed_impacts();
    let shares = BESIDE_BORDER_SHARES
        .into_iter()
        .flat_map(|share| [-share, share]);
    let near = |share: f64| {
        let there = scene.at_frequency(border.scene.excitation.frequency * (1.0 + share));
        Some(single_impact_orbits_near_impact(
            &scene.recheck(there).ok()?,
            *impacts.first()?,
        ))
    };
    shares.filter_map(near).flatten().collect()
}

/// The two frequencies close below and above one, as near as Newton's method tells motions apart.
fn frequencies_beside(frequency: f64) -> [f64; 2] {
    [
        frequency * (1.0 - 2.0 * NEAR),
        frequency * (1.0 + 2.0 * NEAR),
    ]
}
