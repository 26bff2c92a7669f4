//! The machine as the user states it: the same names on the command line and in TOML.
//!
//! Values come in layers (command line over file over the paper's own); [`Machine::from_layers`]
//! joins them and refuses what no machine can have.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use serde::{Deserialize, Serialize};
use softstop::{PiercingRatios, Ratios};

use crate::failure::Failure;
use crate::scene_file;

/// The paper's two regimes (its Figs. 6 and 7, a and b).
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Regime {
    /// No strip: the preloaded stop stands at the clearance (point A).
    Unloaded,
    /// A strip is pierced before the stop is met (point B).
    Loaded,
}

impl Regime {
    /// The paper's machine in this regime, at its point A or B.
    #[must_use]
    pub const fn ratios(self) -> Ratios {
        match self {
            Self::Unloaded => Ratios::unloaded(),
            Self::Loaded => Ratios::loaded(),
        }
    }

    /// The paper's name of its point in this regime (Fig. 7).
    #[must_use]
    pub const fn point(self) -> &'static str {
        match self {
            Self::Unloaded => "A",
            Self::Loaded => "B",
        }
    }

    /// As on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Unloaded => "unloaded",
            Self::Loaded => "loaded",
        }
    }
}

/// What one layer, command line or TOML table, says about the machine. All are the paper's
/// dimensionless ratios: lengths in units of F0/k1, forces of F0, stiffnesses of k1.
#[derive(Debug, Clone, PartialEq, Default, Args, Deserialize)]
#[serde(deny_unknown_fields, default)]
#[command(
    next_help_heading = "Machine (the paper's dimensionless ratios)",
    allow_negative_numbers = true
)]
pub struct SceneSettings {
    /// Without or with a strip to pierce [default: unloaded]
    #[arg(long, value_enum)]
    pub regime: Option<Regime>,
    /// Drive frequency eta = w/sqrt(k1/m), > 0 [paper: 1.15]
    #[arg(long, value_name = "ETA")]
    pub frequency: Option<f64>,
    /// Clearance rho = r k1/F0 [paper: 10]
    #[arg(long, value_name = "RHO")]
    pub clearance: Option<f64>,
    /// Stiffness k4/k1 of the stop, >= 0 [paper: 7]
    #[arg(long, value_name = "K4")]
    pub stiffness: Option<f64>,
    /// Preload of the stop as a force in units of F0, >= 0; it stays when the stiffness
    /// changes [paper: 70]
    #[arg(long, value_name = "FP", conflicts_with = "preload_deflection")]
    pub preload: Option<f64>,
    /// Preload of the stop as a deflection in units of F0/k1, >= 0: the force is DEFLECTION
    /// times the stiffness (the paper's "10", which is 70 at its stiffness of 7)
    #[arg(long, value_name = "DEFLECTION")]
    #[serde(alias = "preload-deflection")]
    pub preload_deflection: Option<f64>,
    /// Damping beta1 = b1/(2 sqrt(m k1)) of the free flight, >= 0 [paper: 0.02]
    #[arg(long, value_name = "BETA1")]
    pub damping: Option<f64>,
    /// Damping beta in contact, all of it, >= 0 [paper: 0.09]
    #[arg(long, value_name = "BETA")]
    #[serde(alias = "contact-damping")]
    pub contact_damping: Option<f64>,
    /// Stiffness k2/k1 of the strip, >= 0, loaded regime only [paper: 21]
    #[arg(long, value_name = "K2")]
    #[serde(alias = "piercing-stiffness")]
    pub piercing_stiffness: Option<f64>,
    /// Dry friction k3/k1 of the strip, >= 0, loaded regime only [paper: 23]
    #[arg(long, value_name = "K3")]
    #[serde(alias = "piercing-friction")]
    pub piercing_friction: Option<f64>,
    /// Thickness sigma = s k1/F0 of the strip, >= 0, loaded regime only [paper: 0.4]
    #[arg(long, value_name = "SIGMA")]
    pub thickness: Option<f64>,
    /// Travel nu = v k1/F0 from the strip to the stop, >= 0, loaded regime only [paper: 0.5]
    #[arg(long, value_name = "NU")]
    pub travel: Option<f64>,
}

impl SceneSettings {
    /// The values that are given, by their names.
    #[must_use]
    pub fn given(&self) -> Vec<(&'static str, f64)> {
        let values = [
            ("frequency", self.frequency),
            ("clearance", self.clearance),
            ("stiffness", self.stiffness),
            ("preload", self.preload),
            ("preload_deflection", self.preload_deflection),
            ("damping", self.damping),
            ("contact_damping", self.contact_damping),
        ];
        let values = values.into_iter().chain(self.piercing());
        values
            .filter_map(|(name, value)| Some((name, value?)))
            .collect()
    }

    /// True if this is the name of a value of the strip.
    #[must_use]
    pub fn is_of_strip(&self, name: &str) -> bool {
        self.piercing().iter().any(|(strip, _)| *strip == name)
    }

    /// The values of the strip, with their names.
    fn piercing(&self) -> [(&'static str, Option<f64>); 4] {
        [
            ("piercing_stiffness", self.piercing_stiffness),
            ("piercing_friction", self.piercing_friction),
            ("thickness", self.thickness),
            ("travel", self.travel),
        ]
    }
}

/// How the preload of the stop follows its stiffness.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Preload {
    /// A force in units of F0, the same at any stiffness.
    Force(f64),
    /// A deflection in units of F0/k1: the force is deflection times stiffness.
    Deflection(f64),
}

impl Preload {
    /// The preload force in units of F0 at this stiffness in units of k1.
    #[must_use]
    pub fn force(self, stiffness: f64) -> f64 {
        match self {
            Self::Force(force) => force,
            Self::Deflection(deflection) => deflection * stiffness,
        }
    }
}

/// A machine whose every value has been checked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Machine {
    /// With or without a strip.
    pub regime: Regime,
    /// How the preload follows the stiffness.
    pub preload: Preload,
    /// The ratios; its preload is that of its own stiffness.
    pub ratios: Ratios,
}

impl Machine {
    /// Joins layers, the first one having the first word, over the paper's values.
    ///
    /// # Errors
    /// [`Failure::Usage`] naming parameter, value and allowed range.
    pub fn from_layers(layers: &[&SceneSettings]) -> Result<Self, Failure> {
        let regime = pick(layers, |layer| layer.regime).unwrap_or(Regime::Unloaded);
        let paper = regime.ratios();
        let value = |field: fn(&SceneSettings) -> Option<f64>, default| {
            pick(layers, field).unwrap_or(default)
        };
        let stiffness = value(|layer| layer.stiffness, paper.stiffness);
        let preload = preload(layers)?;
        let machine = Self {
            regime,
            preload,
            ratios: Ratios {
                rigid: None,
                frequency: value(|layer| layer.frequency, paper.frequency),
                clearance: value(|layer| layer.clearance, paper.clearance),
                damping: value(|layer| layer.damping, paper.damping),
                contact_damping: value(|layer| layer.contact_damping, paper.contact_damping),
                stiffness,
                preload: preload.force(stiffness),
                piercing: piercing(layers, paper.piercing)?,
            },
        };
        machine.validate()?;
        Ok(machine)
    }

    /// The ratios with another stop stiffness and clearance, the preload following.
    #[must_use]
    pub fn at(&self, stiffness: f64, clearance: f64) -> Ratios {
        Ratios {
            stiffness,
            clearance,
            preload: self.preload.force(stiffness),
            ..self.ratios
        }
    }

    fn validate(&self) -> Result<(), Failure> {
        let ratios = &self.ratios;
        positive("frequency", ratios.frequency)?;
        finite("clearance", ratios.clearance)?;
        not_negative("stiffness", ratios.stiffness)?;
        match self.preload {
            Preload::Force(force) => not_negative("preload", force)?,
            Preload::Deflection(deflection) => not_negative("preload_deflection", deflection)?,
        }
        not_negative("damping", ratios.damping)?;
        not_negative("contact_damping", ratios.contact_damping)?;
        if let Some(strip) = ratios.piercing {
            not_negative("piercing_stiffness", strip.stiffness)?;
            not_negative("piercing_friction", strip.friction)?;
            not_negative("thickness", strip.thickness)?;
            not_negative("travel", strip.travel)?;
        }
        match ratios.scene() {
            Ok(_) => Ok(()),
            Err(error) => Err(Failure::usage(error.to_string())),
        }
    }
}

/// The first layer's word on a value.
fn pick<T>(layers: &[&SceneSettings], field: impl Fn(&SceneSettings) -> Option<T>) -> Option<T> {
    layers.iter().find_map(|layer| field(layer))
}

/// The first layer that speaks of the preload decides whether it is a force or a deflection.
fn preload(layers: &[&SceneSettings]) -> Result<Preload, Failure> {
    for layer in layers {
        match (layer.preload, layer.preload_deflection) {
            (Some(_), Some(_)) => {
                return Err(Failure::usage(
                    "preload and preload_deflection: only one of the two can be given",
                ));
            }
            (Some(force), None) => return Ok(Preload::Force(force)),
            (None, Some(deflection)) => return Ok(Preload::Deflection(deflection)),
            (None, None) => {}
        }
    }
    Ok(Preload::Force(Ratios::unloaded().preload))
}

fn piercing(
    layers: &[&SceneSettings],
    paper: Option<PiercingRatios>,
) -> Result<Option<PiercingRatios>, Failure> {
    let Some(paper) = paper else {
        let given = layers.iter().flat_map(|layer| layer.piercing());
        return match given
            .into_iter()
            .find_map(|(name, value)| value.map(|value| (name, value)))
        {
            Some((name, value)) => Err(Failure::usage(format!(
                "{name} = {value}: the unloaded regime has no strip; allowed only with regime loaded"
            ))),
            None => Ok(None),
        };
    };
    Ok(Some(PiercingRatios {
        stiffness: pick(layers, |layer| layer.piercing_stiffness).unwrap_or(paper.stiffness),
        friction: pick(layers, |layer| layer.piercing_friction).unwrap_or(paper.friction),
        thickness: pick(layers, |layer| layer.thickness).unwrap_or(paper.thickness),
        travel: pick(layers, |layer| layer.travel).unwrap_or(paper.travel),
    }))
}

/// Refuses a value that is not finite and > 0.
pub fn positive(name: &str, value: f64) -> Result<(), Failure> {
    require(
        value.is_finite() && value > 0.0,
        name,
        value,
        "finite and > 0",
    )
}

/// Refuses a value that is not finite and >= 0.
pub fn not_negative(name: &str, value: f64) -> Result<(), Failure> {
    require(
        value.is_finite() && value >= 0.0,
        name,
        value,
        "finite and >= 0",
    )
}

/// Refuses a value that is not finite.
pub fn finite(name: &str, value: f64) -> Result<(), Failure> {
    require(value.is_finite(), name, value, "finite")
}

/// Refuses a value unless the condition holds, saying what is allowed.
pub fn require(holds: bool, name: &str, value: f64, allowed: &str) -> Result<(), Failure> {
    if holds {
        Ok(())
    } else {
        Err(Failure::usage(format!(
            "{name} = {value}: must be {allowed}"
        )))
    }
}

/// The machine of a scene file under the command line.
///
/// # Errors
/// [`Failure::Usage`] naming the file or the parameter.
pub fn machine(scene: Option<&PathBuf>, line: &SceneSettings) -> Result<Machine, Failure> {
    match scene {
        Some(path) => Machine::from_layers(&[line, &scene_file::read_toml(path)?]),
        None => Machine::from_layers(&[line]),
    }
}
