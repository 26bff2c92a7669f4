//! Balls of starts about a state of an orbit, by which its local integrity is measured.

use std::f64::consts::TAU;

use nalgebra::Vector2;

use crate::attractors::Region;
use crate::orbit::Orbit;
use crate::spread_points::evenly_spread_point;
use softstop::Start;

/// Balls of starts of any radius about the state of an orbit, in units of half of each axis of a box of starts.
pub(super) struct StartBalls {
    centre: Vector2<f64>,
    half: Vector2<f64>,
}

impl StartBalls {
    /// The balls about an orbit's state, measured by the axes of a box of starts.
    pub fn new(orbit: &Orbit, region: &Region) -> Self {
        let half = [region.position, region.velocity].map(|[low, high]| 0.5 * (high - low));
        Self {
            centre: orbit.state(),
            half: half.into(),
        }
    }

    /// Distance from the centre of the balls to the nearest edge of a box of starts; 0 if the centre lies outside.
    pub fn edge_distance(&self, region: &Region) -> f64 {
        let sides = [region.position, region.velocity].into_iter().enumerate();
        let sides = sides.flat_map(|(axis, [low, high])| {
            [self.centre[axis] - low, high - self.centre[axis]].map(|way| way / self.half[axis])
        });
        sides.fold(f64::INFINITY, f64::min).max(0.0)
    }

    /// Distance from the balls' centre to the nearest start that does not lead to the motion; `radius` if none is nearer.
    pub fn nearest_lost_distance(&self, starts: &[Start], reached: &[bool], radius: f64) -> f64 {
        let lost = starts.iter().zip(reached).filter(|(_, reached)| !**reached);
        let ways = lost.map(|(start, _)| {
            let way = Vector2::new(start.position, start.velocity) - self.centre;
            way.component_div(&self.half).norm()
        });
        ways.fold(radius, f64::min)
    }

    /// `count` starts that fill the ball of a radius evenly.
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
