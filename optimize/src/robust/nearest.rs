//! The nearest machine that loses the motion: normal distances to the manifolds of fold, flip and grazing
//! (Moennigmann and Marquardt 2002; Otten and Moennigmann 2019).
//!
//! On a straight way out from the nominal machine the motion is lost at a share t of it. The distance is the least t over
//! all directions of length 1. From one direction, the manifold's normal n where it is met says which is better: the
//! corner of the box that lies farthest along n, or n itself in the ball. A step towards it is shortened until t falls;
//! it ends where the tangent plane there leaves nothing to gain.

use std::mem::{Discriminant, discriminant};

use rayon::prelude::*;
use softstop::MotionError;
use softstop_dynamics::continuation::{Heading, Test};
use softstop_dynamics::orbit::OrbitError;
use softstop_dynamics::spread::{Reached, Spread, along, critical_normal, free_normal};
use softstop_dynamics::watch::Watcher;
use softstop_dynamics::zone::{Loss, grazing_frequencies, loss_of_stability};
use softstop_dynamics::{BranchPoint, Orbit};

use super::points::place;

/// Directions all around, beside those of the axes.
const AROUND: usize = 8;
/// Steps towards a nearest point, and the least share of one.
const STEPS: usize = 40;
const SHORTEST: f64 = 1e-3;
/// Share of a distance that is nothing to gain.
const GAIN: f64 = 1e-10;
/// Change of a direction over which its distance is differenced.
const DIFFERENCE: f64 = 1e-3;
/// Share of the way between two looks at g0.
const STRIDE: f64 = 0.125;

/// How far apart machines are, in coordinates of the box.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Norm {
    /// The largest coordinate: a distance is the factor by which all tolerances may grow.
    Box,
    /// The root of the sum of squares.
    Ball,
}

/// What is lost at a manifold.
#[derive(Debug, Clone, PartialEq)]
pub enum Manifold {
    /// The z = 1 motion, by this.
    Motion(Loss),
    /// Hysteresis: beyond g0 the motion without impacts strikes.
    Hysteresis,
}

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
    /// The manifold's normal there, outwards, of Euclidean length 1.
    pub normal: Vec<f64>,
}

/// The nearest machine of each manifold that is met within a distance of `farthest`, the nearest first. The motion is lost
/// nowhere nearer, as far as the directions looked at tell: those of the axes, some all around, those that the
/// normals of fold, flip and g0 over the drive's frequency point to, and those that normals lead to from there.
///
/// # Errors
/// [`OrbitError::Stopped`]; [`OrbitError`] if the nominal motion is not one to start from.
pub fn nearest(
    spread: &(impl Spread + ?Sized),
    nominal: &Orbit,
    norm: Norm,
    farthest: f64,
    watcher: Watcher<'_>,
) -> Result<Vec<Nearest>, OrbitError> {
    along(spread, nominal, &vec![0.0; spread.dimensions()], 1e-3)?;
    let search = Search {
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
    let met: Result<Vec<_>, _> = directions.par_iter().map(asked).collect();
    let met = met?.into_iter().flatten().collect();
    let mut found = search.of_motion(met, watcher)?;
    let free = directions
        .iter()
        .filter_map(|direction| search.meet_free(direction));
    if let Some(start) = free.min_by(|a, b| a.share.total_cmp(&b.share)) {
        found.push(search.descend(start, &mut Vec::new(), watcher)?);
    }
    found.sort_by(|a, b| a.distance.total_cmp(&b.distance));
    Ok(found)
}

/// Where a direction meets a manifold.
#[derive(Debug, Clone)]
struct Meeting {
    manifold: Manifold,
    /// Of length 1.
    direction: Vec<f64>,
    share: f64,
    /// The motion there; none at g0.
    point: Option<BranchPoint>,
}

impl Meeting {
    /// The coordinates of the machine there.
    fn at(&self) -> Vec<f64> {
        let parts = self.direction.iter();
        parts.map(|part| self.share * part).collect()
    }
}

struct Search<'a, S: ?Sized> {
    spread: &'a S,
    nominal: &'a Orbit,
    norm: Norm,
    farthest: f64,
}

impl<S: Spread + ?Sized> Search<'_, S> {
    /// Along the axes, all around, and where the borders over the drive's frequency are the nearest by their normals.
    fn directions(&self) -> Vec<Vec<f64>> {
        let dimensions = self.spread.dimensions();
        let axis = |index: usize| {
            let sign = if index.is_multiple_of(2) { 1.0 } else { -1.0 };
            let own = |other| if other == index / 2 { sign } else { 0.0 };
            (0..dimensions).map(own).collect()
        };
        let around = (0..AROUND).map(|index| self.farthest_along(&place(index, dimensions)));
        let centre = vec![0.0; dimensions];
        let border = |(heading, test, outwards): (Heading, Test, f64)| {
            let point = loss_of_stability(self.nominal, heading, test).ok()??;
            let normal = critical_normal(self.spread, &centre, (test, &point)).ok()?;
            Some((outwards, normal))
        };
        let borders = [
            (Heading::Up, Test::Fold, 1.0),
            (Heading::Down, Test::Flip, -1.0),
        ];
        let free = free_normal(self.spread, &centre).ok();
        let normals = borders.into_iter().filter_map(border);
        let normals = normals.chain(free.map(|normal| (-1.0, normal)));
        let towards = normals.map(|(outwards, normal)| {
            let normal: Vec<f64> = normal.iter().map(|part| outwards * part).collect();
            self.farthest_along(&normal)
        });
        let axes = (0..2 * dimensions).map(axis);
        axes.chain(around).chain(towards).collect()
    }

    /// A direction of length 1.
    fn scaled(&self, direction: Vec<f64>) -> Vec<f64> {
        let length = match self.norm {
            Norm::Box => direction
                .iter()
                .fold(0.0, |most: f64, part| most.max(part.abs())),
            Norm::Ball => euclidean(&direction),
        };
        direction.iter().map(|part| part / length).collect()
    }

    /// Where the motion is lost in a direction.
    fn meet(&self, direction: &[f64]) -> Option<Meeting> {
        let reached = along(self.spread, self.nominal, direction, self.farthest);
        let Reached {
            share, loss, point, ..
        } = reached.ok()?;
        let is_machine = |loss: &Loss| {
            !matches!(
                loss,
                Loss::Lost(OrbitError::Motion(MotionError::Scene(_))) | Loss::Range
            )
        };
        Some(Meeting {
            manifold: Manifold::Motion(loss.filter(is_machine)?),
            direction: direction.to_vec(),
            share,
            point: Some(point),
        })
    }

    /// How far the drive is above g0, in rad/s.
    fn above_free(&self, at: &[f64]) -> Option<f64> {
        let scene = self.spread.scene(at);
        let (_, above) = grazing_frequencies(&scene).ok()?;
        Some(scene.excitation.frequency - above)
    }

    /// Where hysteresis is lost in a direction.
    fn meet_free(&self, direction: &[f64]) -> Option<Meeting> {
        let above = |share: f64| {
            let at: Vec<f64> = direction.iter().map(|part| share * part).collect();
            self.above_free(&at)
        };
        let (mut low, mut high) = (0.0, 0.0);
        while above(high)? > 0.0 {
            if high >= self.farthest {
                return None;
            }
            (low, high) = (high, (high + STRIDE).min(self.farthest));
        }
        loop {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                break;
            }
            match above(middle)? > 0.0 {
                true => low = middle,
                false => high = middle,
            }
        }
        Some(Meeting {
            manifold: Manifold::Hysteresis,
            direction: direction.to_vec(),
            share: high,
            point: None,
        })
    }

    fn meet_again(&self, manifold: &Manifold, direction: &[f64]) -> Option<Meeting> {
        match manifold {
            Manifold::Motion(_) => self.meet(direction),
            Manifold::Hysteresis => self.meet_free(direction),
        }
    }

    /// The nearest machine of each manifold at which the motion is lost, from the nearest of those that were met.
    fn of_motion(
        &self,
        mut met: Vec<Meeting>,
        watcher: Watcher<'_>,
    ) -> Result<Vec<Nearest>, OrbitError> {
        let mut found: Vec<Nearest> = Vec::new();
        while let Some(start) = {
            let known = |meeting: &Meeting| {
                found
                    .iter()
                    .any(|own| same(&own.manifold, &meeting.manifold))
            };
            met.retain(|meeting| !known(meeting));
            let nearest = |(_, meeting): &(usize, &Meeting)| meeting.share;
            let least = met
                .iter()
                .enumerate()
                .min_by(|a, b| nearest(a).total_cmp(&nearest(b)));
            least
                .map(|(index, _)| index)
                .map(|index| met.swap_remove(index))
        } {
            let own = self.descend(start, &mut met, watcher)?;
            found.push(own);
        }
        Ok(found)
    }

    /// Goes to a nearest point of the manifold; what other ones are met on the way is kept.
    fn descend(
        &self,
        start: Meeting,
        others: &mut Vec<Meeting>,
        watcher: Watcher<'_>,
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
        let size = euclidean(&normal);
        Ok(Nearest {
            distance: here.share,
            at: here
                .direction
                .iter()
                .map(|part| here.share * part)
                .collect(),
            normal: normal.iter().map(|part| part / size).collect(),
            manifold: here.manifold,
        })
    }

    /// The direction of length 1 that reaches farthest along a normal.
    fn farthest_along(&self, normal: &[f64]) -> Vec<f64> {
        match self.norm {
            Norm::Ball => self.scaled(normal.to_vec()),
            Norm::Box => {
                let corner = |normal: &f64| if *normal == 0.0 { 0.0 } else { normal.signum() };
                normal.iter().map(corner).collect()
            }
        }
    }

    /// The manifold's normal where a direction meets it, outwards: exact at g0, folds and flips of motions that have
    /// derivatives.
    fn normal(&self, here: &Meeting) -> Vec<f64> {
        let critical = |test| {
            let point = BranchPoint {
                parameter: self.spread.scene(&here.at()).excitation.frequency,
                ..here.point.clone()?
            };
            critical_normal(self.spread, &here.at(), (test, &point)).ok()
        };
        let exact = match here.manifold {
            Manifold::Hysteresis => free_normal(self.spread, &here.at()).ok(),
            Manifold::Motion(Loss::Fold) => critical(Test::Fold),
            Manifold::Motion(Loss::Flip) => critical(Test::Flip),
            Manifold::Motion(_) => None,
        };
        let normal = exact.unwrap_or_else(|| self.differenced(here));
        let outwards = dot(&normal, &here.direction).signum();
        normal.iter().map(|part| outwards * part).collect()
    }

    /// The same by how the share changes with the direction, over central differences; a part along which the manifold is
    /// not met again is left out.
    fn differenced(&self, here: &Meeting) -> Vec<f64> {
        let share = |index: usize, change: f64| {
            let mut direction = here.direction.clone();
            direction[index] += change;
            let met = self.meet_again(&here.manifold, &direction)?;
            same(&met.manifold, &here.manifold).then_some(met.share)
        };
        let part = |index: usize| {
            let sides = (share(index, -DIFFERENCE), share(index, DIFFERENCE));
            match sides {
                (Some(below), Some(above)) => (below - above) / (2.0 * DIFFERENCE),
                (Some(below), None) => (below - here.share) / DIFFERENCE,
                (None, Some(above)) => (here.share - above) / DIFFERENCE,
                (None, None) => 0.0,
            }
        };
        (0..here.direction.len())
            .into_par_iter()
            .map(part)
            .collect()
    }
}

/// True if it is the same loss.
fn same(one: &Manifold, other: &Manifold) -> bool {
    let kind = |manifold: &Manifold| -> Option<Discriminant<Loss>> {
        match manifold {
            Manifold::Motion(loss) => Some(discriminant(loss)),
            Manifold::Hysteresis => None,
        }
    };
    kind(one) == kind(other)
}

fn dot(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(one, other)| one * other).sum()
}

fn euclidean(direction: &[f64]) -> f64 {
    dot(direction, direction).sqrt()
}
