//! What can be changed of a machine, by the names of the command line.

use super::Family;
use softstop::error::{MotionError, SceneError};
use softstop::scene::{PiercingRatios, Ratios, Scene, Stop};

/// A parameter of a machine: SI of a [`Scene`], dimensionless of [`Ratios`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Parameter {
    /// w or eta of the drive.
    Frequency,
    /// F0 of the drive; of scenes only.
    Amplitude,
    /// r or rho.
    Clearance,
    /// Stiffness of the stop: k4, or that of the other laws that have one.
    Stiffness,
    /// Force of the stop at first touch.
    Preload,
    /// b1 or beta1 of the free flight.
    Damping,
    /// b or beta in contact, all of it.
    ContactDamping,
    /// Restitution R of the rigid stop, at the clearance or behind.
    Restitution,
    /// Travel e from the stop to the rigid one behind it.
    RigidTravel,
    /// k2 of the strip.
    PiercingStiffness,
    /// k3 of the strip.
    PiercingFriction,
    /// Thickness of the strip.
    Thickness,
    /// Travel from the strip to the stop.
    Travel,
}

impl Parameter {
    /// All.
    pub const ALL: [Self; 13] = [
        Self::Frequency,
        Self::Amplitude,
        Self::Clearance,
        Self::Stiffness,
        Self::Preload,
        Self::Damping,
        Self::ContactDamping,
        Self::Restitution,
        Self::RigidTravel,
        Self::PiercingStiffness,
        Self::PiercingFriction,
        Self::Thickness,
        Self::Travel,
    ];

    /// As on the command line and in TOML.
    pub fn name(self) -> &'static str {
        match self {
            Self::Frequency => "frequency",
            Self::Amplitude => "amplitude",
            Self::Clearance => "clearance",
            Self::Stiffness => "stiffness",
            Self::Preload => "preload",
            Self::Damping => "damping",
            Self::ContactDamping => "contact_damping",
            Self::Restitution => "restitution",
            Self::RigidTravel => "rigid_travel",
            Self::PiercingStiffness => "piercing_stiffness",
            Self::PiercingFriction => "piercing_friction",
            Self::Thickness => "thickness",
            Self::Travel => "travel",
        }
    }
}

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

/// The place of a strip's value.
fn of_strip(strip: &mut PiercingRatios, parameter: Parameter) -> Option<&mut f64> {
    match parameter {
        Parameter::PiercingStiffness => Some(&mut strip.stiffness),
        Parameter::PiercingFriction => Some(&mut strip.friction),
        Parameter::Thickness => Some(&mut strip.thickness),
        Parameter::Travel => Some(&mut strip.travel),
        _ => None,
    }
}

fn of_ratios(ratios: &mut Ratios, parameter: Parameter) -> Option<&mut f64> {
    match parameter {
        Parameter::Frequency => Some(&mut ratios.frequency),
        Parameter::Clearance => Some(&mut ratios.clearance),
        Parameter::Stiffness => Some(&mut ratios.stiffness),
        Parameter::Preload => Some(&mut ratios.preload),
        Parameter::Damping => Some(&mut ratios.damping),
        Parameter::ContactDamping => Some(&mut ratios.contact_damping),
        Parameter::Restitution => ratios.rigid.as_mut().map(|rigid| &mut rigid.restitution),
        Parameter::RigidTravel => ratios.rigid.as_mut().map(|rigid| &mut rigid.travel),
        Parameter::Amplitude => None,
        _ => of_strip(ratios.piercing.as_mut()?, parameter),
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

fn of_stop(scene: &mut Scene, parameter: Parameter) -> Option<&mut f64> {
    match (parameter, &mut scene.stop) {
        (
            Parameter::Stiffness,
            Stop::KelvinVoigt { stiffness, .. }
            | Stop::Hertz { stiffness, .. }
            | Stop::Preloaded { stiffness, .. },
        ) => Some(stiffness),
        (Parameter::Preload, Stop::Preloaded { preload, .. }) => Some(preload),
        (Parameter::Restitution, Stop::Rigid { restitution }) => Some(restitution),
        (Parameter::Restitution, _) => scene.rigid.as_mut().map(|rigid| &mut rigid.restitution),
        (Parameter::RigidTravel, _) => scene.rigid.as_mut().map(|rigid| &mut rigid.travel),
        _ => None,
    }
}

fn of_scene(scene: &mut Scene, parameter: Parameter) -> Option<&mut f64> {
    match parameter {
        Parameter::Frequency => Some(&mut scene.excitation.frequency),
        Parameter::Amplitude => Some(&mut scene.excitation.amplitude),
        Parameter::Clearance => Some(&mut scene.clearance),
        Parameter::Damping => Some(&mut scene.damping),
        Parameter::ContactDamping => Some(&mut scene.contact_damping),
        Parameter::PiercingStiffness => scene.piercing.as_mut().map(|strip| &mut strip.stiffness),
        Parameter::PiercingFriction => scene.piercing.as_mut().map(|strip| &mut strip.friction),
        Parameter::Thickness => scene.piercing.as_mut().map(|strip| &mut strip.thickness),
        Parameter::Travel => scene.piercing.as_mut().map(|strip| &mut strip.travel),
        _ => of_stop(scene, parameter),
    }
}

impl Adjustable for Scene {
    fn value(&self, parameter: Parameter) -> Option<f64> {
        of_scene(&mut self.clone(), parameter).copied()
    }

    fn set(&mut self, parameter: Parameter, value: f64) {
        if let Some(place) = of_scene(self, parameter) {
            *place = value;
        }
    }

    fn scene(&self) -> Result<Scene, SceneError> {
        self.validate()?;
        Ok(self.clone())
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
        let scene = machine.scene()?;
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
            state_scales: state_scales(&scene),
            parameter_scales,
        })
    }

    /// The values of the parameters of the machine itself.
    pub fn values(&self) -> [f64; N] {
        self.parameters
            .map(|parameter| self.machine.value(parameter).unwrap_or(f64::NAN))
    }
}

/// Clearance or amplitude of a free mass, whichever is larger, and the speed that the drive's frequency
/// makes of it.
fn state_scales(scene: &Scene) -> [f64; 2] {
    let w = scene.excitation.frequency;
    let free = scene.excitation.amplitude / (scene.mass * w * w);
    let length = scene.clearance.abs().max(free);
    if length > 0.0 {
        [length, length * w]
    } else {
        [1.0, w]
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
