//! One round of a motion with all its derivatives.

use nalgebra::{Vector2, Vector3};

use softstop::internals::{PhaseDerivatives, Phases};
use softstop::{MotionError, Parameter, Scene};

use super::figure::DifferentiatedFigure;
use super::recorder::{FigureRecorder, RecordedFigures};
use crate::orbit::{Monodromy, OrbitError, StroboscopicMap};

/// 1 - tr + det in units of the size of the monodromy matrix up to which a motion is at a fold to rounding.
const SINGULAR: f64 = 1e-11;

/// A motion from time 0 over some drive periods.
pub(super) struct Variation {
    pub parameters: Vec<Parameter>,
    pub start: Vector2<f64>,
    frequency: f64,
    /// The Jacobian of the map.
    pub monodromy: Monodromy,
    /// As [`ParameterSensitivity`](softstop::internals::ParameterSensitivity) has them in the end.
    pub columns: Vec<Vector3<f64>>,
    pub watched: RecordedFigures,
    pub supplied: DifferentiatedFigure,
}

/// The changes of a scene's phases with each parameter.
pub(super) fn lowered(
    scene: &Scene,
    phases: &Phases,
    parameters: &[Parameter],
) -> Result<Vec<PhaseDerivatives>, MotionError> {
    let each = parameters.iter();
    each.map(|parameter| PhaseDerivatives::new(*parameter, scene, phases))
        .collect()
}

/// Where there are no derivatives.
pub(super) fn none(parameters: &[Parameter]) -> OrbitError {
    let name = parameters.first().map_or("state", |first| first.name());
    MotionError::NoDerivative { name }.into()
}

impl Variation {
    pub fn of(
        scene: &Scene,
        start: Vector2<f64>,
        periods: u64,
        parameters: &[Parameter],
    ) -> Result<Self, OrbitError> {
        let motion = StroboscopicMap::new(scene, periods)?.trajectory(start)?;
        let by = lowered(scene, &motion.phases, parameters)?;
        let mut recorder = FigureRecorder::new(&motion.phases, &by, motion.clock);
        motion.tell(&mut recorder);
        let columns = recorder
            .influence
            .columns()
            .ok_or_else(|| none(parameters))?;
        let supplied = DifferentiatedFigure {
            value: recorder.influence.supplied,
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

    pub fn none(&self) -> OrbitError {
        none(&self.parameters)
    }

    /// Changes of the state at time 0 with each parameter, velocities with the drive's frequency held.
    pub fn starts(&self) -> Result<Vec<Vector2<f64>>, OrbitError> {
        let monodromy = &self.monodromy;
        let size = 1.0 + monodromy.trace().abs() + monodromy.determinant().abs();
        let inverse = (monodromy.fold_test().abs() > SINGULAR * size)
            .then(|| monodromy.resolvent())
            .flatten()
            .ok_or(OrbitError::NotIsolated)?;
        let forced = self.columns[2..].iter();
        Ok(forced.map(|column| inverse * column.xy()).collect())
    }

    /// A figure's derivatives along the motion.
    pub fn along(&self, row: &DifferentiatedFigure, starts: &[Vector2<f64>]) -> Vec<f64> {
        let own = row.by[2..].iter().zip(starts);
        own.map(|(own, start)| own + row.by[0] * start.x + row.by[1] * start.y)
            .collect()
    }

    /// The state at time 0.
    pub fn state(&self, starts: &[Vector2<f64>]) -> (DifferentiatedFigure, DifferentiatedFigure) {
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
