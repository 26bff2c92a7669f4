//! The paper's ratios as shorthands on the command line and in task files.

use std::path::Path;

use clap::{Args, ValueEnum};
use serde::{Deserialize, Serialize};

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
    /// The paper's name of its point in this regime (Fig. 7).
    pub const fn point(self) -> &'static str {
        match self {
            Self::Unloaded => "A",
            Self::Loaded => "B",
        }
    }

    /// The one of a machine that is called by the name of its regime or of its point.
    pub fn called(machine: &Path) -> Option<Self> {
        let mut all = Self::value_variants().iter().copied();
        all.find(|it| machine == Path::new(it.name()) || machine == Path::new(it.point()))
    }

    /// As on the command line.
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
