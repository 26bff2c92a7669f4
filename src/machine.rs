//! Machines as their users state them: in files, on command lines, in their own units.

mod apply_changes;
mod keys;
mod line_numbers;
mod machine_ties;
mod misspelt_keys;
mod read_file;
mod read_table;
mod units_and_labels;
mod write_file;

pub use misspelt_keys::{nearest_name, with_near_word};

use crate::checked_scene::CheckedScene;
use crate::error::{MachineError, SceneError};
use crate::integrator::Start;
use crate::scene::{Allowed, Dimension, Parameter, Ratios, Scene, Ties};

/// The units in which a machine is stated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UnitSystem {
    /// SI units.
    Si,
    /// SI units, but the drive's frequency in Hz.
    Hertz,
    /// The paper's dimensionless ratios: m = k1 = F0 = 1, damping in units of 2 sqrt(m k1).
    Ratios,
}

impl UnitSystem {
    /// The sign of the unit of a dimension in this system; empty for bare numbers.
    pub const fn unit(self, dimension: Dimension) -> &'static str {
        match (self, dimension) {
            (Self::Ratios, _) => "",
            (Self::Hertz, Dimension::Frequency) => "Hz",
            _ => dimension.unit(),
        }
    }
}

/// A machine as its user states it: a scene, where it starts, its name, and the units that it is stated in.
///
/// A value in a file may be an expression of other keys, in their units: `amplitude = "0.7 * excitation.frequency^2"`. What
/// follows others so is set with them.
///
/// The same names stand in TOML files ([`Machine::from_toml`]), on command lines ([`Machine::apply`]), in
/// messages and in the FMU: those of [`Parameter`]. The scene is the same to the engine whatever the units.
///
/// ```
/// use softstop::Machine;
///
/// let press = Machine::from_toml(
///     r#"
///     name = "press"
///     mass = 20.0             # kg
///     stiffness = 8e4         # N/m
///     damping = 50.0          # N s/m
///     clearance = 0.012       # m
///     contact.damping = 230.0 # N s/m
///     excitation = { amplitude = 96.0, frequency_hz = 11.6 }
///     stop = { model = "kelvinVoigt", stiffness = 5.6e5 }
///     "#,
/// )?;
/// assert_eq!(press.scene.clearance, 0.012);
/// assert_eq!(press.value(softstop::Parameter::Frequency), Some(11.6));
/// # Ok::<(), softstop::MachineError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Machine {
    /// Name of the machine, if it has one.
    pub name: Option<String>,
    /// What the machine is, in a sentence, if its user has said so.
    pub description: Option<String>,
    /// The machine in SI units; with m = k1 = F0 = 1 if it is stated in ratios.
    pub scene: Scene,
    /// The state at time 0; at rest at position 0 unless its user says otherwise.
    pub start: Start,
    /// The units that it is stated in.
    pub unit_system: UnitSystem,
    /// The preload as a deflection, if it is stated so: the force follows the stiffness of the stop.
    pub preload_deflection: Option<f64>,
    /// The parameters that follow others.
    pub ties: Ties,
}

/// A scene in SI units.
impl From<Scene> for Machine {
    fn from(scene: Scene) -> Self {
        let ties = scene.followers.clone();
        Self {
            name: None,
            description: None,
            scene,
            start: Start::REST,
            unit_system: UnitSystem::Si,
            preload_deflection: None,
            ties,
        }
    }
}

impl Machine {
    /// A machine of the paper, by the name `unloaded` or `loaded` of its regime.
    pub fn named(name: &str) -> Option<Self> {
        let ratios = match name {
            "unloaded" => Ratios::unloaded(),
            "loaded" => Ratios::loaded(),
            _ => return None,
        };
        Some(Self {
            name: Some(name.to_owned()),
            ..Self::of_ratios(&ratios).ok()?
        })
    }

    /// A machine of Peterka (2003) by its ratios, with a start from which it strikes the stop.
    ///
    /// # Errors
    /// [`SceneError`] if a ratio is out of range.
    pub fn of_ratios(ratios: &Ratios) -> Result<Self, SceneError> {
        Ok(Self {
            start: Start::new(0.0, 14.0),
            unit_system: UnitSystem::Ratios,
            ..Self::from(ratios.scene()?)
        })
    }

    /// The parameters that this machine has. A machine in ratios has no mass, suspension and drive amplitude.
    pub fn parameters(&self) -> impl Iterator<Item = Parameter> + '_ {
        let mut all = Parameter::ALL.into_iter();
        std::iter::from_fn(move || all.find(|parameter| self.value(*parameter).is_some()))
    }

    /// The value of a parameter in the units of this machine, if it has it.
    pub fn value(&self, parameter: Parameter) -> Option<f64> {
        let value = parameter.get(&self.scene)?;
        match parameter {
            unit if unit.is_unit() && self.unit_system == UnitSystem::Ratios => None,
            Parameter::Preload => Some(self.preload_deflection.unwrap_or(value)),
            _ => Some(self.to_own(parameter.about().dimension, value)),
        }
    }

    /// Sets a parameter, in its own units, and those that follow it; nothing happens if it does not have it, or if it follows
    /// others itself. The value is not checked: [`Machine::validate`] does that. A preload stated as a deflection stays one,
    /// and follows the stiffness.
    pub fn set(&mut self, parameter: Parameter, value: f64) {
        if self.value(parameter).is_none() || self.expression(parameter).is_some() {
            return;
        }
        match (parameter, &mut self.preload_deflection) {
            (Parameter::Preload, Some(deflection)) => *deflection = value,
            _ => {
                let value = self.to_si(parameter.about().dimension, value);
                parameter.set(&mut self.scene, value);
            }
        }
        self.update_followers();
    }

    /// Sets the frequency of the drive, in rad/s, with all parameters that follow it; changes nothing where the frequency itself
    /// follows others.
    pub fn set_frequency(&mut self, frequency: f64) {
        let dimension = Parameter::Frequency.about().dimension;
        self.set(Parameter::Frequency, self.to_own(dimension, frequency));
    }

    /// Checks every value of the machine against its range, as its user states it.
    ///
    /// # Errors
    /// [`SceneError`] naming the first parameter that is out of range.
    pub fn validate(&self) -> Result<(), SceneError> {
        for parameter in Parameter::ALL {
            if let Some(value) = self.value(parameter) {
                parameter
                    .about()
                    .allowed
                    .check(self.name(parameter), value)?;
            }
        }
        Allowed::Finite.check(keys::POSITION, self.start.position)?;
        Allowed::Finite.check(keys::VELOCITY, self.start.velocity)?;
        self.scene
            .validate()
            .map_err(|error| self.scene_error_in_own_units(error))
    }

    /// Checks the machine as [`Machine::validate`]; its scene takes the phases of one that is known where only the drive
    /// differs.
    ///
    /// # Errors
    /// As [`Machine::validate`].
    pub fn check(&self, known: Option<&CheckedScene>) -> Result<CheckedScene, SceneError> {
        self.validate()?;
        Ok(CheckedScene::of_valid(self.scene.clone(), known))
    }

    /// Checks its name and its description: a name has no control characters and none that XML refuses, a description
    /// none but line feeds and tabs.
    ///
    /// # Errors
    /// [`MachineError::ControlCharacters`] with the text.
    pub(crate) fn check_texts(&self) -> Result<(), MachineError> {
        let texts = [("name", &self.name), ("description", &self.description)];
        for (key, text) in texts {
            let allowed = |c| key == "description" && matches!(c, '\n' | '\t');
            let breaks = |c: char| c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}');
            match text {
                Some(text) if text.contains(|c| breaks(c) && !allowed(c)) => {
                    let value = text.clone();
                    return Err(MachineError::ControlCharacters { key, value });
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// Dimensionless ratios of the machine, if it is stated in ratios and is a machine like the paper's.
    pub fn ratios(&self) -> Option<Ratios> {
        if self.unit_system != UnitSystem::Ratios || self.scene.excitation.phase != 0.0 {
            return None;
        }
        let value = |parameter| self.value(parameter);
        Some(Ratios {
            frequency: value(Parameter::Frequency)?,
            clearance: value(Parameter::Clearance)?,
            damping: value(Parameter::Damping)?,
            contact_damping: value(Parameter::ContactDamping)?,
            stiffness: value(Parameter::StopStiffness)?,
            preload: Parameter::Preload.get(&self.scene)?,
            piercing: self.scene.piercing,
            rigid: self.scene.rigid,
        })
    }

    /// The name of a parameter of the machine in its own units.
    pub fn name(&self, parameter: Parameter) -> &'static str {
        match parameter {
            Parameter::Frequency if self.unit_system == UnitSystem::Hertz => keys::FREQUENCY_HZ,
            Parameter::Preload if self.preload_deflection.is_some() => keys::PRELOAD_DEFLECTION,
            _ => parameter.name(),
        }
    }
}
