//! The machine whose orbits are followed: the paper's, or any scene.

use softstop::{Scene, SceneError};
use softstop_dynamics::continuation::{Adjustable, Parameter};

use crate::machine::{Machine, Preload};

/// The paper's machine in its ratios, or a scene in SI units.
#[derive(Debug, Clone)]
pub enum Model {
    /// In ratios.
    Paper(Machine),
    /// In SI units.
    Scene(Box<Scene>),
}

impl Adjustable for Model {
    fn value(&self, parameter: Parameter) -> Option<f64> {
        match (self, parameter) {
            (Self::Paper(machine), Parameter::Preload) => Some(match machine.preload {
                Preload::Force(value) | Preload::Deflection(value) => value,
            }),
            (Self::Paper(machine), _) => machine.ratios.value(parameter),
            (Self::Scene(scene), _) => scene.value(parameter),
        }
    }

    /// The preload of the paper's machine is what the user called it, and follows the stiffness if that
    /// was a deflection.
    fn set(&mut self, parameter: Parameter, value: f64) {
        match self {
            Self::Paper(machine) => {
                if parameter == Parameter::Preload {
                    machine.preload = match machine.preload {
                        Preload::Force(_) => Preload::Force(value),
                        Preload::Deflection(_) => Preload::Deflection(value),
                    };
                } else {
                    machine.ratios.set(parameter, value);
                }
                machine.ratios.preload = machine.preload.force(machine.ratios.stiffness);
            }
            Self::Scene(scene) => scene.set(parameter, value),
        }
    }

    fn scene(&self) -> Result<Scene, SceneError> {
        match self {
            Self::Paper(machine) => machine.ratios.scene(),
            Self::Scene(scene) => Adjustable::scene(scene.as_ref()),
        }
    }
}

/// The paper's letters.
const SYMBOLS: [(Parameter, &str); 13] = [
    (Parameter::Frequency, "eta"),
    (Parameter::Amplitude, "F0"),
    (Parameter::Clearance, "rho"),
    (Parameter::Stiffness, "k4"),
    (Parameter::Preload, "Fp"),
    (Parameter::Damping, "beta1"),
    (Parameter::ContactDamping, "beta"),
    (Parameter::Restitution, "R"),
    (Parameter::RigidTravel, "epsilon"),
    (Parameter::PiercingStiffness, "k2"),
    (Parameter::PiercingFriction, "k3"),
    (Parameter::Thickness, "sigma"),
    (Parameter::Travel, "nu"),
];

/// A parameter by the name of its option or the paper's letter.
///
/// # Errors
/// What is allowed.
pub fn parameter(name: &str) -> Result<Parameter, String> {
    let plain = name.replace('-', "_");
    SYMBOLS
        .into_iter()
        .find(|(parameter, symbol)| plain == parameter.name() || plain == *symbol)
        .map(|(parameter, _)| parameter)
        .ok_or_else(|| {
            let names =
                SYMBOLS.map(|(parameter, symbol)| format!("{} ({symbol})", parameter.name()));
            format!("must be one of {}", names.join(", "))
        })
}
