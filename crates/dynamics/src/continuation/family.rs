//! Families of scenes along parameters: any family, that of a machine along its own parameters, and a family at one value of its
//! second.

use std::fmt::Debug;

use softstop::{CheckedScene, Dimension, Machine, MotionError, Parameter, SceneError};

/// Value of a parameter in units of its scale beyond which its unknown is a logarithm.
const MAX_SCALED_PARAMETER: f64 = 20.0;

/// A family of scenes along one or more parameters. To add one, implement the first three methods.
pub trait Family<const PARAMETERS: usize = 1>: Debug + Sync {
    /// The scene of the family at values of the parameters.
    ///
    /// # Errors
    /// [`MotionError`] if there is no such scene.
    fn scene(&self, parameters: [f64; PARAMETERS]) -> Result<CheckedScene, MotionError>;

    /// Typical sizes of position in m and velocity in m/s in the family.
    fn state_scales(&self) -> [f64; 2];

    /// Typical changes of the family's parameters: with the sizes of the state, the units of the arclength.
    fn parameter_scales(&self) -> [f64; PARAMETERS];

    /// d(drive frequency in rad/s) / d(parameter) of each parameter of the family that changes nothing else: exact for orbits.
    fn by_frequency(&self) -> [Option<f64>; PARAMETERS] {
        [None; PARAMETERS]
    }
}

impl<const PARAMETERS: usize> dyn Family<PARAMETERS> + '_ {
    /// Parameters as unknowns of a continuation: in units of their scales, and where they outgrow these by a factor of twenty,
    /// as a logarithm, so that a step is a share of the parameter.
    pub fn scaled_parameters(&self, parameters: [f64; PARAMETERS]) -> [f64; PARAMETERS] {
        let scales = self.parameter_scales();
        let logarithm = |growth: f64| 1.0 + growth.ln();
        std::array::from_fn(|index| {
            apply_beyond_limit(parameters[index] / scales[index], logarithm)
        })
    }

    /// The parameters of unknowns, which are the last of them: the inverse of `scaled_parameters`.
    pub fn unscaled_parameters(&self, unknowns: &[f64]) -> [f64; PARAMETERS] {
        let scales = self.parameter_scales();
        let unknowns = &unknowns[unknowns.len() - PARAMETERS..];
        let exponential = |growth: f64| (growth - 1.0).exp();
        std::array::from_fn(|index| {
            apply_beyond_limit(unknowns[index], exponential) * scales[index]
        })
    }

    /// Derivatives of the parameters by the unknowns that they are.
    pub fn parameter_derivatives(&self, parameters: [f64; PARAMETERS]) -> [f64; PARAMETERS] {
        let scales = self.parameter_scales();
        let slope = |index: usize| parameters[index].abs() / MAX_SCALED_PARAMETER;
        std::array::from_fn(|index| scales[index].max(slope(index)))
    }
}

/// A value up to the limit of scaled parameters, and beyond a function of how many times as large it is.
fn apply_beyond_limit(value: f64, beyond: impl Fn(f64) -> f64) -> f64 {
    let growth = value.abs() / MAX_SCALED_PARAMETER;
    match growth > 1.0 {
        true => (MAX_SCALED_PARAMETER * beyond(growth)).copysign(value),
        false => value,
    }
}

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

/// A family at one value of its second parameter.
#[derive(Debug)]
pub(super) struct RestrictedFamily<'a> {
    pub family: &'a dyn Family<2>,
    pub second: f64,
}

impl Family for RestrictedFamily<'_> {
    fn scene(&self, [first]: [f64; 1]) -> Result<CheckedScene, MotionError> {
        self.family.scene([first, self.second])
    }

    fn state_scales(&self) -> [f64; 2] {
        self.family.state_scales()
    }

    fn parameter_scales(&self) -> [f64; 1] {
        [self.family.parameter_scales()[0]]
    }

    fn by_frequency(&self) -> [Option<f64>; 1] {
        [self.family.by_frequency()[0]]
    }
}
