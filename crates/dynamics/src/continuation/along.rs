//! A machine along its parameters.

use super::Family;
use softstop::error::{MotionError, SceneError};
use softstop::machine::Machine;
use softstop::scene::{Parameter, Ratios, Scene};

/// A machine whose parameters can be changed by name. To add one, implement the three methods.
pub trait Adjustable {
    /// The value of a parameter, if the machine has it.
    fn value(&self, parameter: Parameter) -> Option<f64>;

    /// Sets it; nothing happens if the machine does not have it.
    fn set(&mut self, parameter: Parameter, value: f64);

    /// The scene.
    ///
    /// # Errors
    /// [`SceneError`] if no machine can have these values.
    fn scene(&self) -> Result<Scene, SceneError>;
}

impl Adjustable for Scene {
    fn value(&self, parameter: Parameter) -> Option<f64> {
        parameter.get(self)
    }

    fn set(&mut self, parameter: Parameter, value: f64) {
        parameter.set(self, value);
    }

    fn scene(&self) -> Result<Scene, SceneError> {
        self.validate()?;
        Ok(self.clone())
    }
}

impl Adjustable for Machine {
    fn value(&self, parameter: Parameter) -> Option<f64> {
        Machine::value(self, parameter)
    }

    fn set(&mut self, parameter: Parameter, value: f64) {
        Machine::set(self, parameter, value);
    }

    fn scene(&self) -> Result<Scene, SceneError> {
        self.validate()?;
        Ok(self.scene.clone())
    }
}

fn of_ratios(ratios: &mut Ratios, parameter: Parameter) -> Option<&mut f64> {
    let rigid = ratios.rigid.as_mut();
    let strip = ratios.piercing.as_mut();
    match parameter {
        Parameter::Frequency => Some(&mut ratios.frequency),
        Parameter::Clearance => Some(&mut ratios.clearance),
        Parameter::StopStiffness => Some(&mut ratios.stiffness),
        Parameter::Preload => Some(&mut ratios.preload),
        Parameter::Damping => Some(&mut ratios.damping),
        Parameter::ContactDamping => Some(&mut ratios.contact_damping),
        Parameter::RigidRestitution => rigid.map(|rigid| &mut rigid.restitution),
        Parameter::RigidTravel => rigid.map(|rigid| &mut rigid.travel),
        Parameter::PiercingStiffness => strip.map(|strip| &mut strip.stiffness),
        Parameter::PiercingFriction => strip.map(|strip| &mut strip.friction),
        Parameter::Thickness => strip.map(|strip| &mut strip.thickness),
        Parameter::Travel => strip.map(|strip| &mut strip.travel),
        _ => None,
    }
}

impl Adjustable for Ratios {
    fn value(&self, parameter: Parameter) -> Option<f64> {
        of_ratios(&mut self.clone(), parameter).copied()
    }

    fn set(&mut self, parameter: Parameter, value: f64) {
        if let Some(place) = of_ratios(self, parameter) {
            *place = value;
        }
    }

    fn scene(&self) -> Result<Scene, SceneError> {
        Ratios::scene(self)
    }
}

/// A machine along some of its parameters.
#[derive(Debug, Clone)]
pub struct Along<M, const N: usize> {
    machine: M,
    parameters: [Parameter; N],
    state_scales: [f64; 2],
    parameter_scales: [f64; N],
}

/// Typical change of a parameter in units of its value.
const TYPICAL: f64 = 0.2;

impl<M: Adjustable + Clone, const N: usize> Along<M, N> {
    /// A machine along parameters that it has.
    ///
    /// # Errors
    /// [`SceneError`] if it lacks one, or is none.
    pub fn new(machine: M, parameters: [Parameter; N]) -> Result<Self, SceneError> {
        let scales = machine.scene()?.motion_scales();
        let mut parameter_scales = [TYPICAL; N];
        for (scale, parameter) in parameter_scales.iter_mut().zip(parameters) {
            let value = machine
                .value(parameter)
                .ok_or(SceneError::Lacks(parameter.name()))?;
            if value != 0.0 {
                *scale = TYPICAL * value.abs();
            }
        }
        Ok(Self {
            machine,
            parameters,
            state_scales: [scales.length, scales.speed()],
            parameter_scales,
        })
    }

    /// The values of the parameters of the machine itself.
    pub fn values(&self) -> [f64; N] {
        self.parameters
            .map(|parameter| self.machine.value(parameter).unwrap_or(f64::NAN))
    }
}

impl<M: Adjustable + Clone, const N: usize> Family<N> for Along<M, N> {
    fn scene(&self, parameters: [f64; N]) -> Result<Scene, MotionError> {
        let mut machine = self.machine.clone();
        for (parameter, value) in self.parameters.into_iter().zip(parameters) {
            machine.set(parameter, value);
        }
        Ok(machine.scene()?)
    }

    fn state_scales(&self) -> [f64; 2] {
        self.state_scales
    }

    fn parameter_scales(&self) -> [f64; N] {
        self.parameter_scales
    }
}
