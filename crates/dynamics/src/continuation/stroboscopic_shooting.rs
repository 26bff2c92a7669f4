//! Stroboscopic shooting: the equations P(s) = s of a periodic orbit over a number of drive periods, and half the period of one
//! that is its own mirror image.

use std::f64::consts::TAU;

use nalgebra::{DMatrix, DVector, Matrix2, Vector2};

use super::end_derivatives::end_derivatives;
use super::equations::{Equations, Evaluation};
use super::period_map::PeriodMap;
use super::{Family, TestFunction};
use crate::orbit::{Monodromy, OrbitError};
use crate::tolerance::NEAR_GRAZING;
use softstop::{CheckedScene, MotionError, Scene};

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

    /// This shooting over another number of drive periods, with its section `turn` of them after drive angle phi.
    pub fn with_section(&self, turn: f64, periods: u64) -> Self {
        Self {
            family: self.family,
            periods,
            turn: turn.rem_euclid(periods as f64),
            scales: self.scales,
        }
    }

    /// The scaled unknowns of the shooting for a state and parameters.
    pub fn scaled_unknowns(&self, state: Vector2<f64>, parameters: [f64; N]) -> DVector<f64> {
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
    pub fn monodromy_norm(&self, m: &Matrix2<f64>) -> f64 {
        let [length, speed] = self.family.state_scales();
        let mixed = (m.m12 * speed / length).hypot(m.m21 * length / speed);
        m.m11.hypot(m.m22).hypot(mixed)
    }
}

impl<const N: usize> Equations for Shooting<'_, N> {
    type Point = PeriodMap;
    const EXACT_COLUMNS: usize = 2;

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
            tolerance: residual_rounding(&round.trajectory.scene, &state, &round.monodromy, sizes),
            point: round,
        })
    }

    /// The exact Jacobian of the residual: that of the map, and the columns by the parameters.
    fn jacobian(&self, here: &Evaluation<PeriodMap>, columns: &DMatrix<f64>) -> DMatrix<f64> {
        let (m, ratio) = (&here.point.monodromy, self.scales.y / self.scales.x);
        let own = Matrix2::new(m.m11 - 1.0, m.m12 * ratio, m.m21 / ratio, m.m22 - 1.0);
        DMatrix::from_fn(2, 2 + N, |row, column| match column {
            0 | 1 => own[(row, column)],
            _ => columns[(row, column - 2)],
        })
    }

    fn motion_size(&self, at: &DVector<f64>) -> f64 {
        at.rows(0, 2).norm()
    }

    /// True if small changes of the state grow a hundredfold and more, though the orbit grazes nothing. Near grazing a touch
    /// is slow by the same share.
    fn needs_close_guess(&self, here: &PeriodMap) -> bool {
        let speed = self.velocity_scale();
        let grazes = here
            .slowest
            .is_some_and(|touch| touch.amount < NEAR_GRAZING * speed);
        !grazes && NEAR_GRAZING * here.monodromy.trace().abs() > 1.0
    }

    fn residual_of_neighbour(
        &self,
        here: &PeriodMap,
        at: &DVector<f64>,
    ) -> Result<(DVector<f64>, bool), OrbitError> {
        let there = self.evaluate(at)?;
        Ok((there.residual, there.point.counts == here.counts))
    }

    fn exact_columns(&self, here: &Evaluation<PeriodMap>) -> Option<DMatrix<f64>> {
        let change = self.scaled_change(here.point.by_frequency?);
        let mut columns = DMatrix::zeros(2, N);
        let parameters = self.parameters(&here.point.place);
        let units = self.family.by_frequency().into_iter();
        let by = units.zip(self.family.parameter_derivatives(parameters));
        for (index, (unit, slope)) in by.enumerate() {
            columns.set_column(index, &(change * (unit? * slope)));
        }
        Some(columns)
    }

    fn variational_columns(&self, here: &Evaluation<PeriodMap>) -> Option<DMatrix<f64>> {
        let map = &here.point;
        let at_wall = map.monodromy == Monodromy::ZERO;
        let orbit = (&*map.trajectory, map.start, at_wall);
        let scene_at = |place: &DVector<f64>| self.scene_at(place).ok();
        let ends = end_derivatives(orbit, (&map.place, 2..2 + N), scene_at)?;
        let columns: Vec<_> = ends
            .iter()
            .map(|(end, _)| self.scaled_change(*end))
            .collect();
        Some(DMatrix::from_fn(2, N, |row, column| columns[column][row]))
    }
}

/// What rounding alone may leave of the residual P(s) - s, in units of `sizes`.
pub(crate) fn residual_rounding(
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
pub(crate) struct CriticalShooting<'a, const N: usize> {
    pub shooting: Shooting<'a, N>,
    pub test: TestFunction,
}

impl<const N: usize> Equations for CriticalShooting<'_, N> {
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
