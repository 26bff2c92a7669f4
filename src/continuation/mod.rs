//! Branches of z = 1 orbits in one parameter, by pseudo-arclength (Keller 1977).

use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};

use crate::error::MotionError;
use crate::orbit::{Orbit, OrbitError, Passage, StroboscopicMap, is_stable, round_off};
use crate::scene::Scene;

/// Scenes along one parameter.
pub trait Family {
    /// The scene at a value of the parameter.
    ///
    /// # Errors
    /// [`MotionError`] if there is no such scene.
    fn scene(&self, parameter: f64) -> Result<Scene, MotionError>;

    /// Typical sizes of position, velocity and parameter: the units of the arclength.
    fn scales(&self) -> [f64; 3];
}

/// A point of a branch.
#[derive(Debug, Clone)]
pub struct BranchPoint {
    /// The parameter's value.
    pub parameter: f64,
    /// Position in m at time 0.
    pub position: f64,
    /// Velocity in m/s at time 0.
    pub velocity: f64,
    /// Before-impact velocity in m/s.
    pub before_impact_velocity: f64,
    /// Jacobian of the map.
    pub monodromy: Matrix2<f64>,
}

impl BranchPoint {
    /// 1 - tr + det: zero at a fold, positive on its stable side.
    pub fn fold_test(&self) -> f64 {
        1.0 - self.monodromy.trace() + self.monodromy.determinant()
    }

    /// True if the orbit is stable.
    pub fn is_stable(&self) -> bool {
        is_stable(&self.monodromy)
    }

    /// State and parameter in units of `scales`.
    fn scaled(&self, scales: &[f64; 3]) -> Vector3<f64> {
        Vector3::new(
            self.position / scales[0],
            self.velocity / scales[1],
            self.parameter / scales[2],
        )
    }
}

/// Follows the z = 1 orbits of a family.
#[derive(Debug)]
pub struct Follower<'a, F> {
    family: &'a F,
    scales: [f64; 3],
}

/// Newton steps of one correction.
const CORRECTIONS: usize = 12;
/// Relative step of the central difference for the parameter's column: its error only slows the
/// convergence, the residual stays exact.
const DIFFERENCE: f64 = 1e-6;
/// First, smallest and largest arclength steps.
const FIRST_STEP: f64 = 0.02;
const SMALLEST_STEP: f64 = 1e-9;
const LARGEST_STEP: f64 = 0.25;
/// Largest turn of the branch's direction per step, as a cosine.
const LARGEST_TURN: f64 = 0.96;

impl<'a, F: Family> Follower<'a, F> {
    /// A follower of `family`.
    pub fn new(family: &'a F) -> Self {
        Self {
            family,
            scales: family.scales(),
        }
    }

    /// The branch from an orbit at `parameter` towards rising parameters, until `stop` says so of
    /// its last point or `limit` points are there, or until it cannot be followed any farther even
    /// with the smallest step (where the regime ends).
    ///
    /// # Errors
    /// [`OrbitError`] if the start is not on a branch.
    pub fn follow(
        &self,
        start: &Orbit,
        parameter: f64,
        limit: usize,
        stop: impl Fn(&BranchPoint) -> bool,
    ) -> Result<Vec<BranchPoint>, OrbitError> {
        let mut last = self.point_at(start, parameter)?;
        let mut points = vec![last.clone()];
        let mut direction = Vector3::new(0.0, 0.0, 1.0);
        direction = self.tangent(&last, &direction)?;
        let mut step = FIRST_STEP;
        while points.len() < limit {
            let guess = last.scaled(&self.scales) + step * direction;
            let attempt = self
                .correct(guess, &direction)
                .and_then(|point| Ok((self.tangent(&point, &direction)?, point)));
            match attempt {
                Ok((turned, point)) if turned.dot(&direction) > LARGEST_TURN => {
                    let gentle = turned.dot(&direction) > 0.995;
                    (last, direction) = (point, turned);
                    points.push(last.clone());
                    if stop(&last) {
                        break;
                    }
                    step = if gentle {
                        (1.6 * step).min(LARGEST_STEP)
                    } else {
                        step
                    };
                }
                _ if step > SMALLEST_STEP => step *= 0.4,
                _ => break,
            }
        }
        Ok(points)
    }

    /// The point between two neighbours at which `test` changes its sign: the Illinois variant of
    /// the secant method along the chord, each trial corrected onto the branch.
    ///
    /// # Errors
    /// [`OrbitError`] if a correction fails.
    pub fn locate(
        &self,
        from: &BranchPoint,
        to: &BranchPoint,
        test: impl Fn(&BranchPoint) -> f64,
    ) -> Result<BranchPoint, OrbitError> {
        let (a, b) = (from.scaled(&self.scales), to.scaled(&self.scales));
        let chord = (b - a).normalize();
        let (mut low, mut high) = ((0.0, test(from)), (1.0, test(to)));
        let mut best = if low.1.abs() < high.1.abs() {
            from.clone()
        } else {
            to.clone()
        };
        let mut last_side = 0;
        for _ in 0..80 {
            if high.0 - low.0 <= 4.0 * f64::EPSILON || low.1 == high.1 {
                break;
            }
            let secant = low.0 - low.1 * (high.0 - low.0) / (high.1 - low.1);
            let inside = secant > low.0 && secant < high.0;
            let share = if inside {
                secant
            } else {
                0.5 * (low.0 + high.0)
            };
            let point = self.correct(a + share * (b - a), &chord)?;
            let value = test(&point);
            if value.abs() < test(&best).abs() {
                best = point;
            }
            if value == 0.0 {
                break;
            }
            let side = if (value > 0.0) == (high.1 > 0.0) {
                1
            } else {
                -1
            };
            if side == 1 {
                high = (share, value);
                low.1 *= if last_side == 1 { 0.5 } else { 1.0 };
            } else {
                low = (share, value);
                high.1 *= if last_side == -1 { 0.5 } else { 1.0 };
            }
            last_side = side;
        }
        Ok(best)
    }

    /// The full orbit at a point.
    ///
    /// # Errors
    /// [`OrbitError`] if the point is not on a z = 1 orbit.
    pub fn orbit(&self, point: &BranchPoint) -> Result<Orbit, OrbitError> {
        let scene = self.family.scene(point.parameter)?;
        let map = StroboscopicMap::new(&scene, 1)?;
        let state = Vector2::new(point.position, point.velocity);
        let passage = map.apply(state)?;
        Orbit::on(&scene, &map, state, &passage)
    }

    fn point_at(&self, orbit: &Orbit, parameter: f64) -> Result<BranchPoint, OrbitError> {
        let orbit = Orbit::near(
            &self.family.scene(parameter)?,
            Vector2::new(orbit.position, orbit.velocity),
        )?;
        Ok(BranchPoint {
            parameter,
            position: orbit.position,
            velocity: orbit.velocity,
            before_impact_velocity: orbit.before_impact_velocity(),
            monodromy: orbit.monodromy,
        })
    }

    /// Newton's method in the plane through `guess` across `normal`.
    fn correct(
        &self,
        guess: Vector3<f64>,
        normal: &Vector3<f64>,
    ) -> Result<BranchPoint, OrbitError> {
        let mut at = guess;
        let mut last = f64::INFINITY;
        for _ in 0..CORRECTIONS {
            let (passage, residual) = self.residual(&at)?;
            let size = residual.norm();
            let settled = size <= self.tolerance(&at, &passage);
            if settled && size >= 0.1 * last {
                return self.point(&at, &passage);
            }
            last = size;
            let system = self.bordered(&at, &passage, normal)?;
            let right = Vector3::new(residual.x, residual.y, normal.dot(&(guess - at)));
            let Some(step) = system.lu().solve(&right) else {
                return Err(OrbitError::Diverged { residual: size });
            };
            at += step;
        }
        let (passage, residual) = self.residual(&at)?;
        if residual.norm() <= self.tolerance(&at, &passage) {
            return self.point(&at, &passage);
        }
        Err(OrbitError::Diverged {
            residual: residual.norm(),
        })
    }

    /// Unit direction of the branch at a point, on the side of `along`.
    fn tangent(
        &self,
        point: &BranchPoint,
        along: &Vector3<f64>,
    ) -> Result<Vector3<f64>, OrbitError> {
        let at = point.scaled(&self.scales);
        let (passage, _) = self.residual(&at)?;
        let system = self.bordered(&at, &passage, along)?;
        system
            .lu()
            .solve(&Vector3::new(0.0, 0.0, 1.0))
            .map(|direction| direction.normalize())
            .ok_or(OrbitError::Diverged { residual: 0.0 })
    }

    /// The passage from a scaled point and P(s) - s, scaled.
    fn residual(&self, at: &Vector3<f64>) -> Result<(Passage, Vector2<f64>), OrbitError> {
        let map = StroboscopicMap::new(&self.family.scene(at.z * self.scales[2])?, 1)?;
        let state = self.state(at);
        let passage = map.apply(state)?;
        let gap = passage.end - state;
        let residual = Vector2::new(gap.x / self.scales[0], gap.y / self.scales[1]);
        Ok((passage, residual))
    }

    /// [I - M, -dP/dp; normal], scaled.
    fn bordered(
        &self,
        at: &Vector3<f64>,
        passage: &Passage,
        normal: &Vector3<f64>,
    ) -> Result<Matrix3<f64>, OrbitError> {
        let state = self.state(at);
        let parameter = at.z * self.scales[2];
        let width = DIFFERENCE * self.scales[2];
        let image = |parameter: f64| -> Result<Vector2<f64>, OrbitError> {
            Ok(StroboscopicMap::new(&self.family.scene(parameter)?, 1)?.image(state)?)
        };
        let slope = (image(parameter + width)? - image(parameter - width)?) / (2.0 * width);
        let m = &passage.monodromy;
        let [sx, sv, sp] = self.scales;
        Ok(Matrix3::new(
            1.0 - m.m11,
            -m.m12 * sv / sx,
            -slope.x * sp / sx,
            -m.m21 * sx / sv,
            1.0 - m.m22,
            -slope.y * sp / sv,
            normal.x,
            normal.y,
            normal.z,
        ))
    }

    /// Scaled residual that rounding alone may leave.
    fn tolerance(&self, at: &Vector3<f64>, passage: &Passage) -> f64 {
        round_off(&self.state(at), passage) / self.scales[0].min(self.scales[1])
    }

    fn state(&self, at: &Vector3<f64>) -> Vector2<f64> {
        Vector2::new(at.x * self.scales[0], at.y * self.scales[1])
    }

    fn point(&self, at: &Vector3<f64>, passage: &Passage) -> Result<BranchPoint, OrbitError> {
        let [before_impact_velocity] = passage.impacts[..] else {
            return Err(OrbitError::OtherRegime {
                impacts: passage.impacts.len(),
            });
        };
        let state = self.state(at);
        Ok(BranchPoint {
            parameter: at.z * self.scales[2],
            position: state.x,
            velocity: state.y,
            before_impact_velocity,
            monodromy: passage.monodromy,
        })
    }
}
