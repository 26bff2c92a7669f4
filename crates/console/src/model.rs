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

/// A parameter by its name, the paper's letter, or its name of 0.1.0.
///
/// # Errors
/// What is allowed.
pub fn parameter(name: &str) -> Result<Parameter, String> {
    let plain = name.replace('-', "_");
    if plain == "stiffness" {
        return Ok(Parameter::StopStiffness);
    }
    let mut all = Parameter::ALL.into_iter();
    let called = |parameter: &Parameter| parameter.is_called(&plain);
    all.find(called).ok_or_else(|| {
        let names = Parameter::ALL.map(|it| format!("{} ({})", it.name(), it.about().letter));
        format!("must be one of {}", names.join(", "))
    })
}
