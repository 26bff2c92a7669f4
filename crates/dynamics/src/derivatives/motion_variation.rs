//! The variation of a motion with its start and with parameters: one pass with all derivatives.

use nalgebra::{Vector2, Vector3};

use softstop::internals::PhaseDerivatives;
use softstop::{CheckedScene, MotionError, Parameter};

use super::figure_recorder::{DifferentiatedFigure, FigureRecorder, RecordedFigures};
use crate::orbit::{Monodromy, OrbitError, StroboscopicMap};
use crate::tolerance::TEST_ROUNDING;

/// A motion from time 0 over some drive periods, with its derivatives by start and parameters.
pub(super) struct MotionVariation {
    pub parameters: Vec<Parameter>,
    pub start: Vector2<f64>,
    frequency: f64,
    /// The Jacobian of the map.
    pub monodromy: Monodromy,
    /// Columns of the sensitivity matrix at the end, as of
    /// [`ParameterSensitivity`](softstop::internals::ParameterSensitivity).
    pub columns: Vec<Vector3<f64>>,
    pub watched: RecordedFigures,
    pub supplied: DifferentiatedFigure,
}

/// The derivatives of a scene's phases by each parameter.
pub(super) fn phase_derivatives(
    scene: &CheckedScene,
    parameters: &[Parameter],
) -> Result<Vec<PhaseDerivatives>, MotionError> {
    let each = parameters.iter();
    each.map(|parameter| PhaseDerivatives::new(*parameter, scene))
        .collect()
}

impl MotionVariation {
    /// The variation of the motion of a scene from a state over some drive periods, by parameters.
    pub fn of_motion(
        scene: &CheckedScene,
        start: Vector2<f64>,
        periods: u64,
        parameters: &[Parameter],
    ) -> Result<Self, OrbitError> {
        let motion = StroboscopicMap::new(scene, periods).trajectory(start)?;
        let by = phase_derivatives(scene, parameters)?;
        let mut recorder = FigureRecorder::new(scene.phases(), &by, motion.clock);
        motion.replay(&mut recorder);
        let columns = recorder
            .sensitivity
            .columns()
            .ok_or_else(|| OrbitError::no_derivative(parameters))?;
        let supplied = DifferentiatedFigure {
            value: recorder.sensitivity.supplied,
            by: columns.iter().map(|column| column.z).collect(),
        };
        Ok(Self {
            parameters: parameters.to_vec(),
            start,
            frequency: scene.excitation.frequency,
            monodromy: Monodromy::from(&motion.tangent()),
            columns: columns.to_vec(),
            supplied,
            watched: recorder.watched,
        })
    }

    /// Derivatives of the orbit's state at time 0 by each parameter, velocities with the drive's frequency held.
    pub fn state_rates(&self) -> Result<Vec<Vector2<f64>>, OrbitError> {
        let monodromy = &self.monodromy;
        let size = 1.0 + monodromy.trace().abs() + monodromy.determinant().abs();
        let inverse = (monodromy.fold_test().abs() > 10.0 * TEST_ROUNDING * size)
            .then(|| monodromy.resolvent())
            .flatten()
            .ok_or(OrbitError::NotIsolated)?;
        let forced = self.columns[2..].iter();
        Ok(forced.map(|column| inverse * column.xy()).collect())
    }

    /// The total derivatives of a figure by the parameters, with the orbit's start moving along.
    pub fn total_rates(&self, row: &DifferentiatedFigure, starts: &[Vector2<f64>]) -> Vec<f64> {
        let own = row.by[2..].iter().zip(starts);
        own.map(|(own, start)| own + row.by[0] * start.x + row.by[1] * start.y)
            .collect()
    }

    /// The orbit's state at time 0, position and velocity, with derivatives.
    pub fn start_state(
        &self,
        starts: &[Vector2<f64>],
    ) -> (DifferentiatedFigure, DifferentiatedFigure) {
        let faster = |parameter: &Parameter| match parameter {
            Parameter::Frequency => self.start.y / self.frequency,
            _ => 0.0,
        };
        let own = self.parameters.iter().map(faster);
        (
            DifferentiatedFigure {
                value: self.start.x,
                by: starts.iter().map(|start| start.x).collect(),
            },
            DifferentiatedFigure {
                value: self.start.y,
                by: starts
                    .iter()
                    .zip(own)
                    .map(|(start, own)| start.y + own)
                    .collect(),
            },
        )
    }
}
