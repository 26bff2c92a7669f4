//! The nearest machine that loses the motion: normal distances to the manifolds of fold, flip and grazing
//! (Moennigmann and Marquardt 2002; Otten and Moennigmann 2019).
//!
//! On a straight way out from the nominal machine the motion is lost at a share t of it. The distance is the least t over
//! all directions of length 1. From one direction, the manifold's normal n where it is met says which is better: the
//! corner of the box that lies farthest along n, or n itself in the ball. A step towards it is shortened until t falls;
//! it ends where the tangent plane there leaves nothing to gain.

use crate::order::sort_rising;
use crate::spread::along;
use softstop_dynamics::Orbit;
use softstop_dynamics::monitor::Monitor;
use softstop_dynamics::orbit::OrbitError;
use softstop_dynamics::parallel;
use softstop_dynamics::spread_points::sobol_point;
use softstop_dynamics::zone::Loss;

use super::Tolerances;
use super::corners::corners;
use super::meeting::{LossPoint, LossSearch, Manifold, Norm, dot, is_loss, same};

/// Steps towards a nearest point, and the least share of one.
const STEPS: usize = 40;
const SHORTEST: f64 = 1e-3;
/// Share of a distance that is nothing to gain.
const GAIN: f64 = 1e-10;

/// The nearest machine of a manifold.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Nearest {
    /// What is lost there.
    pub manifold: Manifold,
    /// Its distance from the nominal machine.
    pub distance: f64,
    /// Its coordinates.
    pub at: Vec<f64>,
}

/// The nearest machine of each manifold that is met within a distance of `farthest`, the nearest first. The motion is lost
/// nowhere nearer, as far as the directions looked at tell: those of the axes, some all around, those that the
/// normals of fold, flip and g0 over the drive's frequency point to, and those that normals lead to from there.
///
/// # Errors
/// [`OrbitError::Stopped`]; [`OrbitError`] if the nominal motion is not one to start from.
pub fn nearest(
    spread: &Tolerances,
    nominal: &Orbit,
    norm: Norm,
    farthest: f64,
    watcher: Monitor<'_>,
) -> Result<Vec<Nearest>, OrbitError> {
    along(spread, nominal, &vec![0.0; spread.dimensions()], 1e-3)?;
    let search = LossSearch {
        spread,
        nominal,
        norm,
        farthest,
    };
    let directions = search.directions();
    let asked = |direction: &Vec<f64>| {
        let go_on = watcher(0, 0).is_continue();
        go_on
            .then(|| search.meet(direction))
            .ok_or(OrbitError::Stopped)
    };
    let met = parallel::try_map(&directions, asked)?;
    let met = met.into_iter().flatten().collect();
    let mut found = search.of_motion(met, watcher)?;
    let free = directions
        .iter()
        .filter_map(|direction| search.meet_free(direction));
    if let Some(start) = free.min_by(|a, b| a.share.total_cmp(&b.share)) {
        found.push(search.descend(start, &mut Vec::new(), watcher)?);
    }
    sort_rising(&mut found, |it| it.distance);
    Ok(found)
}

/// Corners, and places all over the box, to which the nominal motion is followed.
const CORNERS: usize = 32;
const AROUND: usize = 16;

/// Where the motion is lost on the ways to corners of the box and to places all over it.
pub(crate) fn first_losses(spread: &Tolerances, nominal: &Orbit) -> Vec<(Vec<f64>, Loss)> {
    let dimensions = spread.dimensions();
    let mut ends = corners(dimensions, CORNERS);
    ends.extend((0..AROUND).map(|index| sobol_point(index, dimensions)));
    let lost = |end: &Vec<f64>| {
        let reached = along(spread, nominal, end, 1.0).ok()?;
        let loss = reached.loss.filter(is_loss)?;
        Some((end.iter().map(|part| reached.share * part).collect(), loss))
    };
    parallel::filter_map(&ends, lost)
}

impl LossSearch<'_> {
    /// The nearest machine of each manifold at which the motion is lost, from the nearest of those that were met.
    fn of_motion(
        &self,
        mut met: Vec<LossPoint>,
        watcher: Monitor<'_>,
    ) -> Result<Vec<Nearest>, OrbitError> {
        let mut found: Vec<Nearest> = Vec::new();
        loop {
            let is_new =
                |it: &LossPoint| found.iter().all(|own| !same(&own.manifold, &it.manifold));
            met.retain(is_new);
            let nearest = (0..met.len()).min_by(|a, b| met[*a].share.total_cmp(&met[*b].share));
            let Some(nearest) = nearest else {
                return Ok(found);
            };
            let start = met.swap_remove(nearest);
            found.push(self.descend(start, &mut met, watcher)?);
        }
    }

    /// Goes to a nearest point of the manifold; what other ones are met on the way is kept.
    fn descend(
        &self,
        start: LossPoint,
        others: &mut Vec<LossPoint>,
        watcher: Monitor<'_>,
    ) -> Result<Nearest, OrbitError> {
        let mut here = start;
        let mut normal = self.normal(&here);
        for _ in 0..STEPS {
            let best = self.farthest_along(&normal);
            let gain = 1.0 - dot(&normal, &here.direction) / dot(&normal, &best);
            let mut share = 1.0;
            let next = loop {
                if watcher(0, 0).is_break() {
                    return Err(OrbitError::Stopped);
                }
                if gain <= GAIN || share < SHORTEST {
                    break None;
                }
                let towards = here.direction.iter().zip(&best);
                let towards = towards
                    .map(|(own, best)| own + share * (best - own))
                    .collect();
                match self.meet_again(&here.manifold, &self.scaled(towards)) {
                    Some(next) if !same(&next.manifold, &here.manifold) => others.push(next),
                    Some(next) if next.share < here.share => break Some(next),
                    _ => {}
                }
                share *= 0.5;
            };
            let Some(next) = next else { break };
            normal = self.normal(&next);
            here = next;
        }
        Ok(Nearest {
            distance: here.share,
            at: here.at(),
            manifold: here.manifold,
        })
    }
}
