//! Balls of starts about the state of an orbit.

use std::f64::consts::TAU;

use nalgebra::Vector2;

use crate::attractors::Region;
use crate::attractors::region::evenly_spread_point;
use crate::orbit::Orbit;
use softstop::Start;

/// Balls of starts about the state of an orbit, in units of half of each axis of a box.
pub(super) struct StateBall {
    centre: Vector2<f64>,
    half: Vector2<f64>,
}

impl StateBall {
    /// Balls about an orbit's state, measured by a box of starts.
    pub fn new(orbit: &Orbit, region: &Region) -> Self {
        let half = [region.position, region.velocity].map(|[low, high]| 0.5 * (high - low));
        Self {
            centre: orbit.state(),
            half: half.into(),
        }
    }

    /// Distance from the centre of the balls to the nearest edge of the box; 0 if it is not in it.
    pub fn edge_distance(&self, region: &Region) -> f64 {
        let sides = [region.position, region.velocity].into_iter().enumerate();
        let sides = sides.flat_map(|(axis, [low, high])| {
            [self.centre[axis] - low, high - self.centre[axis]].map(|way| way / self.half[axis])
        });
        sides.fold(f64::INFINITY, f64::min).max(0.0)
    }

    /// Distance from the centre to the nearest start that does not lead to the motion, if that is nearer than `radius`.
    pub fn nearest_lost_distance(&self, starts: &[Start], reached: &[bool], radius: f64) -> f64 {
        let lost = starts.iter().zip(reached).filter(|(_, reached)| !**reached);
        let ways = lost.map(|(start, _)| {
            let way = Vector2::new(start.position, start.velocity) - self.centre;
            way.component_div(&self.half).norm()
        });
        ways.fold(radius, f64::min)
    }

    /// So many starts that fill a ball of a radius evenly.
    pub fn starts_in_ball(&self, radius: f64, count: usize) -> Vec<Start> {
        let start = |index| {
            let [area, turn] = evenly_spread_point([0.5; 2], index);
            let (sin, cos) = (TAU * turn).sin_cos();
            let way = radius * area.sqrt() * Vector2::new(cos, sin);
            Start::from(self.centre + way.component_mul(&self.half))
        };
        (0..count).map(start).collect()
    }
}
