//! Where straight ways out from the nominal machine meet the manifolds at which something is lost, and their normals there.

use std::mem::{Discriminant, discriminant};

use super::Tolerances;
use crate::spread::{HomotopyEnd, along, critical_normal, free_normal};
use softstop::MotionError;
use softstop_dynamics::continuation::{Direction, TestFunction};
use softstop_dynamics::orbit::OrbitError;
use softstop_dynamics::parallel;
use softstop_dynamics::spread_points::sobol_point;
use softstop_dynamics::zone::{Loss, grazing_frequencies, loss_of_stability};
use softstop_dynamics::{BranchPoint, Orbit};

/// Directions all around, beside those of the axes.
const AROUND: usize = 8;
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

/// Where a direction meets a manifold.
#[derive(Debug, Clone)]
pub(super) struct LossPoint {
    pub manifold: Manifold,
    /// Of length 1.
    pub direction: Vec<f64>,
    pub share: f64,
    /// The motion there; none at g0.
    point: Option<BranchPoint>,
}

impl LossPoint {
    /// The coordinates of the machine there.
    pub fn at(&self) -> Vec<f64> {
        let parts = self.direction.iter();
        parts.map(|part| self.share * part).collect()
    }
}

pub(super) struct LossSearch<'a> {
    pub spread: &'a Tolerances,
    pub nominal: &'a Orbit,
    pub norm: Norm,
    pub farthest: f64,
}

impl LossSearch<'_> {
    /// Along the axes, all around, and where the borders over the drive's frequency are the nearest by their normals.
    pub fn directions(&self) -> Vec<Vec<f64>> {
        let dimensions = self.spread.dimensions();
        let axis = |index: usize| {
            let sign = if index.is_multiple_of(2) { 1.0 } else { -1.0 };
            let own = |other| if other == index / 2 { sign } else { 0.0 };
            (0..dimensions).map(own).collect()
        };
        let around = (0..AROUND).map(|index| self.farthest_along(&sobol_point(index, dimensions)));
        let centre = vec![0.0; dimensions];
        let border = |(heading, test, outwards): (Direction, TestFunction, f64)| {
            let point = loss_of_stability(self.nominal, heading, test).ok()??;
            let normal = critical_normal(self.spread, &centre, (test, &point)).ok()?;
            Some((outwards, normal))
        };
        let borders = [
            (Direction::Up, TestFunction::Fold, 1.0),
            (Direction::Down, TestFunction::Flip, -1.0),
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
    pub fn scaled(&self, direction: Vec<f64>) -> Vec<f64> {
        let length = match self.norm {
            Norm::Box => direction
                .iter()
                .fold(0.0, |most: f64, part| most.max(part.abs())),
            Norm::Ball => dot(&direction, &direction).sqrt(),
        };
        direction.iter().map(|part| part / length).collect()
    }

    /// Where the motion is lost in a direction.
    pub fn meet(&self, direction: &[f64]) -> Option<LossPoint> {
        let reached = along(self.spread, self.nominal, direction, self.farthest);
        let HomotopyEnd {
            share, loss, point, ..
        } = reached.ok()?;
        Some(LossPoint {
            manifold: Manifold::Motion(loss.filter(is_loss)?),
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

    /// Where hysteresis is lost in a direction; none if the nominal machine has none.
    pub fn meet_free(&self, direction: &[f64]) -> Option<LossPoint> {
        let above = |share: f64| {
            let at: Vec<f64> = direction.iter().map(|part| share * part).collect();
            self.above_free(&at)
        };
        if above(0.0)? <= 0.0 {
            return None;
        }
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
        Some(LossPoint {
            manifold: Manifold::Hysteresis,
            direction: direction.to_vec(),
            share: high,
            point: None,
        })
    }

    pub fn meet_again(&self, manifold: &Manifold, direction: &[f64]) -> Option<LossPoint> {
        match manifold {
            Manifold::Motion(_) => self.meet(direction),
            Manifold::Hysteresis => self.meet_free(direction),
        }
    }

    /// The direction of length 1 that reaches farthest along a normal.
    pub fn farthest_along(&self, normal: &[f64]) -> Vec<f64> {
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
    pub fn normal(&self, here: &LossPoint) -> Vec<f64> {
        let critical = |test| {
            let point = BranchPoint {
                parameter: self.spread.scene(&here.at()).excitation.frequency,
                ..here.point.clone()?
            };
            critical_normal(self.spread, &here.at(), (test, &point)).ok()
        };
        let exact = match here.manifold {
            Manifold::Hysteresis => free_normal(self.spread, &here.at()).ok(),
            Manifold::Motion(Loss::Fold) => critical(TestFunction::Fold),
            Manifold::Motion(Loss::Flip) => critical(TestFunction::Flip),
            Manifold::Motion(_) => None,
        };
        let normal = exact.unwrap_or_else(|| self.differenced(here));
        let outwards = dot(&normal, &here.direction).signum();
        normal.iter().map(|part| outwards * part).collect()
    }

    /// The same by how the share changes with the direction, over central differences; a part along which the manifold is
    /// not met again is left out.
    fn differenced(&self, here: &LossPoint) -> Vec<f64> {
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
        parallel::map_indices(here.direction.len(), &part)
    }
}

/// True if a motion is lost, and does not just end with the machines.
pub(crate) fn is_loss(loss: &Loss) -> bool {
    !matches!(
        loss,
        Loss::Lost(OrbitError::Motion(MotionError::Scene(_))) | Loss::Range
    )
}

/// True if it is the same loss.
pub(super) fn same(one: &Manifold, other: &Manifold) -> bool {
    let kind = |manifold: &Manifold| -> Option<Discriminant<Loss>> {
        match manifold {
            Manifold::Motion(loss) => Some(discriminant(loss)),
            Manifold::Hysteresis => None,
        }
    };
    kind(one) == kind(other)
}

pub(crate) fn dot(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(one, other)| one * other).sum()
}
