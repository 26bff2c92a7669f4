//! Stroboscopic shooting: the equations P(s) = s of a periodic orbit over a number of drive periods, and half the period of one
//! that is its own mirror image.

use std::f64::consts::TAU;
use std::ops::Range;

use nalgebra::{DMatrix, DVector, Matrix2, Vector2};

use super::Family;
use super::arclength::{Equations, Evaluation, Node};
use super::period_map::{PeriodMap, half_way};
use super::test_function::TestFunction;
use crate::orbit::{Monodromy, OrbitError};
use crate::tolerance::{DIFFERENCE_WIDTH, NEAR_GRAZING, SAME};
use softstop::internals::{ParameterSensitivity, PhaseDerivatives};
use softstop::{CheckedScene, MotionError, Scene, Trajectory};

/// The shooting for orbits of a family over drive periods, in scaled unknowns: position, velocity, parameters.
#[derive(Debug)]
pub(crate) struct Shooting<'a, const N: usize> {
    pub family: &'a dyn Family<N>,
    pub periods: u64,
    /// Drive periods from drive angle phi to the section.
    pub turn: f64,
    scales: Vector2<f64>,
}

impl<'a, const N: usize> Shooting<'a, N> {
    /// The shooting for orbits of a family over some drive periods, with the section at drive angle phi.
    pub fn new(family: &'a dyn Family<N>, periods: u64) -> Self {
        Self {
            family,
            periods,
            turn: 0.0,
            scales: family.state_scales().into(),
        }
    }

    /// This shooting over another number of drive periods, with its section so many of them after drive angle phi.
    pub fn seen_at(&self, turn: f64, periods: u64) -> Self {
        Self {
            family: self.family,
            periods,
            turn: turn.rem_euclid(periods as f64),
            scales: self.scales,
        }
    }

    /// The scaled unknowns of the shooting for a state and parameters.
    pub fn scaled(&self, state: Vector2<f64>, parameters: [f64; N]) -> DVector<f64> {
        let state = self.scaled_change(state);
        let parameters = self.family.scaled_parameters(parameters);
        DVector::from_iterator(2 + N, state.iter().copied().chain(parameters))
    }

    /// The state that these scaled unknowns of the shooting stand for.
    pub fn state_at(&self, at: &DVector<f64>) -> Vector2<f64> {
        Vector2::new(at[0] * self.scales.x, at[1] * self.scales.y)
    }

    /// The parameters that these scaled unknowns of the shooting stand for.
    pub fn parameters(&self, at: &DVector<f64>) -> [f64; N] {
        self.family.unscaled_parameters(at.as_slice())
    }

    /// The scene of these unknowns, with time 0 at the section.
    pub fn scene_at(&self, at: &DVector<f64>) -> Result<CheckedScene, MotionError> {
        let scene = self.family.scene(self.parameters(at))?;
        let phase = scene.excitation.reduced_phase() + TAU * self.turn;
        Ok(scene.at_phase(phase)?)
    }

    /// A change of the state in units of the family's scales.
    fn scaled_change(&self, change: Vector2<f64>) -> Vector2<f64> {
        change.component_div(&self.scales)
    }

    /// Typical size of the velocity in m/s.
    pub fn velocity_scale(&self) -> f64 {
        self.scales.y
    }

    /// Norm of a monodromy matrix without units: growth of small differences.
    pub fn growth(&self, m: &Matrix2<f64>) -> f64 {
        let [length, speed] = self.family.state_scales();
        let mixed = (m.m12 * speed / length).hypot(m.m21 * length / speed);
        m.m11.hypot(m.m22).hypot(mixed)
    }
}

impl<const N: usize> Equations for Shooting<'_, N> {
    type Point = PeriodMap;
    const EXACT: usize = 2;

    fn evaluate(&self, at: &DVector<f64>) -> Result<Evaluation<PeriodMap>, OrbitError> {
        let state = self.state_at(at);
        let scene = self.scene_at(at)?;
        let start = (at, state);
        let by_frequency = self.family.by_frequency().iter().all(Option::is_some);
        let round = PeriodMap::from_state(scene, self.periods, start, by_frequency)?;
        let gap = Vector2::from(round.trajectory.end) - state;
        let sizes = self.family.state_scales();
        Ok(Evaluation {
            residual: DVector::from_column_slice(self.scaled_change(gap).as_slice()),
            tolerance: round_off(&round.trajectory.scene, &state, &round.monodromy, sizes),
            point: round,
        })
    }

    /// The exact Jacobian of the residual: that of the map, and the slopes.
    fn jacobian(&self, here: &Evaluation<PeriodMap>, slopes: &DMatrix<f64>) -> DMatrix<f64> {
        let (m, ratio) = (&here.point.monodromy, self.scales.y / self.scales.x);
        let own = Matrix2::new(m.m11 - 1.0, m.m12 * ratio, m.m21 / ratio, m.m22 - 1.0);
        DMatrix::from_fn(2, 2 + N, |row, column| match column {
            0 | 1 => own[(row, column)],
            _ => slopes[(row, column - 2)],
        })
    }

    fn motion_size(&self, at: &DVector<f64>) -> f64 {
        at.rows(0, 2).norm()
    }

    /// True if small changes of the state grow a hundredfold and more, though the orbit grazes nothing. Near grazing a touch
    /// is slow by the same share.
    fn is_steep(&self, here: &PeriodMap) -> bool {
        let speed = self.velocity_scale();
        let grazes = here
            .slowest
            .is_some_and(|touch| touch.amount < NEAR_GRAZING * speed);
        !grazes && NEAR_GRAZING * here.monodromy.trace().abs() > 1.0
    }

    fn residual_beside(
        &self,
        here: &PeriodMap,
        at: &DVector<f64>,
    ) -> Result<(DVector<f64>, bool), OrbitError> {
        let there = self.evaluate(at)?;
        Ok((there.residual, there.point.sequence == here.sequence))
    }

    fn exact_slopes(&self, here: &Evaluation<PeriodMap>) -> Option<DMatrix<f64>> {
        let change = self.scaled_change(here.point.by_frequency?);
        let mut slopes = DMatrix::zeros(2, N);
        let parameters = self.parameters(&here.point.place);
        let units = self.family.by_frequency().into_iter();
        let by = units.zip(self.family.parameter_slopes(parameters));
        for (index, (unit, slope)) in by.enumerate() {
            slopes.set_column(index, &(change * (unit? * slope)));
        }
        Some(slopes)
    }

    fn slopes_along(&self, here: &Evaluation<PeriodMap>) -> Option<DMatrix<f64>> {
        let map = &here.point;
        let at_wall = map.monodromy == Monodromy::ZERO;
        let orbit = (&*map.trajectory, map.start, at_wall);
        let scene_at = |place: &DVector<f64>| self.scene_at(place).ok();
        let ends = end_derivatives(orbit, (&map.place, 2..2 + N), scene_at)?;
        let slopes: Vec<_> = ends
            .iter()
            .map(|(end, _)| self.scaled_change(*end))
            .collect();
        Some(DMatrix::from_fn(2, N, |row, column| slopes[column][row]))
    }
}

/// Derivatives of the end of a motion, in m and m/s, by unknowns of its scene, and of the position of its start, which moves
/// with a surface that it lies at; none where the motion has no derivatives.
pub(super) fn end_derivatives(
    orbit: (&Trajectory, Vector2<f64>, bool),
    (place, unknowns): (&DVector<f64>, Range<usize>),
    scene_at: impl Fn(&DVector<f64>) -> Option<CheckedScene>,
) -> Option<Vec<(Vector2<f64>, f64)>> {
    let by = unknowns.map(|unknown| {
        let towards = |step: f64| {
            let mut moved = place.clone();
            moved[unknown] += step;
            PhaseDerivatives::between(&orbit.0.scene, &scene_at(&moved)?, step)
        };
        towards(DIFFERENCE_WIDTH).or_else(|| towards(-DIFFERENCE_WIDTH))
    });
    derivatives_by(orbit, &by.collect::<Option<Vec<_>>>()?)
}

/// Derivatives of the end of a motion, and of the position of its start, by what changes the phases of its scene.
pub(crate) fn derivatives_by(
    (trajectory, start, at_surface): (&Trajectory, Vector2<f64>, bool),
    by: &[PhaseDerivatives],
) -> Option<Vec<(Vector2<f64>, f64)>> {
    let scene = &trajectory.scene;
    let mut sensitivity = ParameterSensitivity::new(scene.phases(), by);
    trajectory.replay(&mut sensitivity);
    let [from_position, from_velocity, forced @ ..] = sensitivity.columns()? else {
        return None;
    };
    let derivatives = forced.iter().zip(by).map(|(forced, by)| {
        // Velocities are per radian there.
        let faster = by.frequency * Vector2::new(0.0, trajectory.end.velocity)
            - by.frequency * start.y * from_velocity.xy();
        let moved = match at_surface {
            true => by.surface_derivative(scene.phases(), start.x),
            false => 0.0,
        };
        (forced.xy() + faster + moved * from_position.xy(), moved)
    });
    Some(derivatives.collect())
}

/// What rounding alone may leave of the residual P(s) - s, in units of `sizes`.
pub(crate) fn round_off(
    scene: &Scene,
    state: &Vector2<f64>,
    jacobian: &Matrix2<f64>,
    [length, speed]: [f64; 2],
) -> f64 {
    let scales = scene.scales();
    let least = (length / scales.length).min(speed / scales.speed());
    scales.map_rounding(state, jacobian) / least
}

/// The shooting for periodic orbits on which a test function vanishes besides.
#[derive(Debug)]
pub(crate) struct Critical<'a, const N: usize> {
    pub shooting: Shooting<'a, N>,
    pub test: TestFunction,
}

impl<const N: usize> Equations for Critical<'_, N> {
    type Point = PeriodMap;

    fn evaluate(&self, at: &DVector<f64>) -> Result<Evaluation<PeriodMap>, OrbitError> {
        let orbit = self.shooting.evaluate(at)?;
        let value = self.test.scaled_value(&orbit.point.monodromy);
        Ok(orbit.with_test(value))
    }

    fn motion_size(&self, at: &DVector<f64>) -> f64 {
        self.shooting.motion_size(at)
    }
}

/// True if a machine is its own mirror image half a drive period later: both stops are alike.
pub(super) fn is_symmetric(scene: &Scene) -> bool {
    let below = scene.below.as_ref();
    let is_alike =
        below.is_some_and(|below| below.clearance == scene.clearance && below.stop == scene.stop);
    is_alike && scene.piercing.is_none() && scene.rigid.is_none()
}

/// Half the period of an orbit, compared with the mirror image of its start.
pub(super) struct HalfPeriod {
    /// Scaled distance of its end from the mirror image of its start.
    pub asymmetry: DVector<f64>,
    /// Its Jacobian P'.
    pub monodromy: Monodromy,
    /// What rounding may leave of the asymmetry.
    pub tolerance: f64,
}

impl Shooting<'_, 1> {
    /// Half the period of a motion; none if the machine is not its own mirror image, or periods are even in number.
    pub(super) fn half_period(&self, map: &PeriodMap) -> Option<HalfPeriod> {
        let scene = &*map.trajectory.scene;
        if self.periods.is_multiple_of(2) || !is_symmetric(scene) {
            return None;
        }
        let motion = map.trajectory.up_to(half_way(scene, self.periods));
        let monodromy = Monodromy::from(&motion.tangent());
        let scales = self.family.state_scales();
        Some(HalfPeriod {
            asymmetry: self.scaled(
                -Vector2::from(motion.end) - self.state_at(&map.place),
                [0.0],
            ),
            tolerance: round_off(scene, &map.start, &monodromy, scales),
            monodromy,
        })
    }

    /// The Jacobian of half the period of a symmetric orbit; none of another one.
    pub(super) fn symmetric_half_period(&self, node: &Node<PeriodMap>) -> Option<Monodromy> {
        let half = self.half_period(&node.here.point)?;
        (half.asymmetry.norm() < SAME).then_some(half.monodromy)
    }
}
