//! The family of a machine along its own parameters.

use super::Family;
use softstop::{CheckedScene, Dimension, Machine, MotionError, Parameter, SceneError};

/// A machine as a family along some of its parameters.
#[derive(Debug, Clone)]
pub struct ParameterFamily<const N: usize> {
    machine: Machine,
    scene: CheckedScene,
    parameters: [Parameter; N],
    state_scales: [f64; 2],
    parameter_scales: [f64; N],
}

/// Typical change of a parameter in units of its value.
const TYPICAL_CHANGE: f64 = 0.2;

impl<const N: usize> ParameterFamily<N> {
    /// A machine, or a scene, along parameters that it has, in its own units.
    ///
    /// # Errors
    /// [`SceneError`] if it lacks one, or is none.
    pub fn new(
        machine: impl Into<Machine>,
        parameters: [Parameter; N],
    ) -> Result<Self, SceneError> {
        let machine = machine.into();
        let scene = machine.check(None)?;
        let scales = scene.motion_scales();
        let mut parameter_scales = [TYPICAL_CHANGE; N];
        for (scale, parameter) in parameter_scales.iter_mut().zip(parameters) {
            let value = machine
                .value(parameter)
                .ok_or(SceneError::Lacks(parameter.name()))?;
            if value != 0.0 {
                *scale = TYPICAL_CHANGE * value.abs();
            }
        }
        Ok(Self {
            machine,
            scene,
            parameters,
            state_scales: [scales.length, scales.speed()],
            parameter_scales,
        })
    }
}

impl<const N: usize> Family<N> for ParameterFamily<N> {
    fn scene(&self, parameters: [f64; N]) -> Result<CheckedScene, MotionError> {
        let mut machine = self.machine.clone();
        for (parameter, value) in self.parameters.into_iter().zip(parameters) {
            machine.set(parameter, value);
        }
        Ok(machine.check(Some(&self.scene))?)
    }

    fn state_scales(&self) -> [f64; 2] {
        self.state_scales
    }

    fn parameter_scales(&self) -> [f64; N] {
        self.parameter_scales
    }

    fn by_frequency(&self) -> [Option<f64>; N] {
        let unit = self.machine.to_si(Dimension::Frequency, 1.0);
        let is_alone = self.machine.followers(Parameter::Frequency).is_empty();
        self.parameters
            .map(|parameter| (parameter == Parameter::Frequency && is_alone).then_some(unit))
    }
}
