//! Contraction balls: balls about the points of a stable orbit in which its map contracts.

use std::f64::consts::TAU;

use nalgebra::{Matrix2, Vector2};

use crate::orbit::{Orbit, StroboscopicMap, multipliers};
use crate::tolerance::SAME;
use softstop::{MotionError, Start};

/// Contraction balls about the points of several orbits, each with the index of its orbit.
#[derive(Debug, Default)]
pub(super) struct ContractionBalls(Vec<(usize, ContractionBall)>);

impl ContractionBalls {
    /// Adds the contraction balls about the points of an orbit; a point about which none is found has none.
    pub fn add_orbit(&mut self, index: usize, orbit: &Orbit) -> Result<(), MotionError> {
        let balls = ContractionBall::about_orbit(orbit)?.into_iter();
        self.0.extend(balls.map(|ball| (index, ball)));
        Ok(())
    }

    /// The index of the first orbit in one of whose contraction balls a state lies; none if it lies in no ball.
    pub fn orbit_holding(&self, state: Start) -> Option<usize> {
        let ball = self.0.iter().find(|(_, ball)| ball.contains(state));
        ball.map(|(orbit, _)| *orbit)
    }
}

/// A ball |L (s - c)| <= r about a point of a stable orbit in which its map contracts: motions in it come to the orbit.
#[derive(Debug, Clone, Copy)]
struct ContractionBall {
    centre: Vector2<f64>,
    shape: Matrix2<f64>,
    /// Square of the radius, r^2.
    square: f64,
}

/// Radii of the rings in a contraction ball on which the Jacobian is tested, in units of that of the ball.
const RING_RADII: [f64; 4] = [1.0, 0.75, 0.5, 0.25];
/// Number of points on each ring at which the Jacobian is tested.
const RING_POINTS: usize = 24;
/// Most terms of the series for the contracting norm.
const MAX_NORM_TERMS: usize = 20_000;

impl ContractionBall {
    /// True if a state lies in the contraction ball.
    fn contains(&self, state: Start) -> bool {
        let gap = Vector2::new(state.position, state.velocity) - self.centre;
        (self.shape * gap).norm_squared() <= self.square
    }

    /// The contraction balls about all points of an orbit about which one is found.
    fn about_orbit(orbit: &Orbit) -> Result<Vec<Self>, MotionError> {
        let map = StroboscopicMap::new(&orbit.scene, orbit.periods);
        let states = orbit.states()?;
        let w = orbit.scene.excitation.frequency;
        let lengths = states.iter().map(|state| (w * state.x).hypot(state.y));
        let size = lengths.fold(0.0, f64::max);
        let ball =
            |centre| Self::about_point(&map, centre, orbit.impacts.len(), w, size).transpose();
        states.into_iter().filter_map(ball).collect()
    }

    /// The contraction ball about one point of an orbit: the largest tried in which the Jacobian contracts at all test points,
    /// with the orbit's number of impacts.
    fn about_point(
        map: &StroboscopicMap,
        centre: Vector2<f64>,
        impacts: usize,
        w: f64,
        size: f64,
    ) -> Result<Option<Self>, MotionError> {
        let Some((shape, rate)) = ball_norm(&map.apply(centre)?.monodromy, w) else {
            return Ok(None);
        };
        let Some(back) = shape.try_inverse() else {
            return Ok(None);
        };
        let mut radius = size;
        while radius > SAME * size {
            let contracts = |point: Vector2<f64>| {
                map.apply(centre + back * point).is_ok_and(|passage| {
                    let tangent = shape * passage.monodromy.matrix * back;
                    passage.impacts.len() == impacts
                        && largest_singular_value(&tangent) <= 0.5 * (1.0 + rate)
                })
            };
            if ring_points(radius).all(contracts) {
                return Ok(Some(Self {
                    centre,
                    shape,
                    square: radius * radius,
                }));
            }
            radius *= 0.7;
        }
        Ok(None)
    }
}

/// The points on rings in a ball of a radius at which the Jacobian is tested.
fn ring_points(radius: f64) -> impl Iterator<Item = Vector2<f64>> {
    RING_RADII.into_iter().flat_map(move |share| {
        (0..RING_POINTS).map(move |k| {
            let (sin, cos) = (TAU * k as f64 / RING_POINTS as f64).sin_cos();
            share * radius * Vector2::new(cos, sin)
        })
    })
}

/// The largest singular value of a matrix, its norm.
fn largest_singular_value(matrix: &Matrix2<f64>) -> f64 {
    multipliers(&(matrix.transpose() * matrix))[0]
        .re
        .max(0.0)
        .sqrt()
}

/// The norm |L s| of a contraction ball, in which its stable matrix M contracts, with the factor g half-way between the largest
/// multiplier of M and 1: L^T L = P, the sum of (M/g)^jT diag(w^2, 1) (M/g)^j. None unless M is stable.
fn ball_norm(matrix: &Matrix2<f64>, w: f64) -> Option<(Matrix2<f64>, f64)> {
    let spectral = multipliers(matrix)[0].norm();
    let rate = 0.5 * (1.0 + spectral);
    if spectral.is_nan() || spectral >= 1.0 {
        return None;
    }
    let slower = matrix / rate;
    let first = Matrix2::new(w * w, 0.0, 0.0, 1.0);
    let (mut sum, mut term) = (first, first);
    for _ in 0..MAX_NORM_TERMS {
        term = slower.transpose() * term * slower;
        sum += term;
        if term.norm() <= f64::EPSILON * sum.norm() {
            let shape = sum.cholesky()?.l().transpose();
            return Some((shape, rate));
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn in_its_norm_a_matrix_contracts() {
        // Far from normal: its plain norm is 50.
        let matrix = Matrix2::new(0.9, 50.0, 0.0, -0.8);
        let (shape, rate) = ball_norm(&matrix, 1.3).expect("stable");
        let back = shape.try_inverse().expect("regular");
        let norm = largest_singular_value(&(shape * matrix * back));
        assert!(norm < rate && rate < 1.0, "{norm} {rate}");
        assert!(ball_norm(&Matrix2::new(1.01, 0.0, 0.0, 0.1), 1.0).is_none());
    }
}
