//! TOML files: a scene for `orbit` and `zone`, a whole task for `optimize`.

use std::path::PathBuf;

use serde::Deserialize;

use softstop_console::machine::{Regime, SceneSettings};
use softstop_console::output::Format;

/// The task of `softstop optimize` as a TOML file: the names of the command line.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Task {
    /// Without or with a strip.
    pub regime: Option<Regime>,
    /// Distance M from both ends of the zone as a share of its width, 0 to 0.5.
    pub margin: Option<f64>,
    /// Values held: stiffness, clearance, frequency.
    pub fix: Fixed,
    /// Ranges searched: `clearance = [2, 22]`.
    pub bounds: Bounds,
    /// The rest of the machine.
    pub scene: SceneSettings,
    /// Seed of the search.
    pub seed: Option<u64>,
    /// Zones that the search may compute.
    pub evaluations: Option<u64>,
    /// Output folder.
    pub output: Option<PathBuf>,
    /// How to print the result.
    pub format: Option<Format>,
}

/// The table `[fix]`.
#[derive(Debug, Clone, Copy, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Fixed {
    /// k4/k1.
    pub stiffness: Option<f64>,
    /// rho.
    pub clearance: Option<f64>,
    /// eta.
    pub frequency: Option<f64>,
}

/// The table `[bounds]`, each range as `[low, high]`.
#[derive(Debug, Clone, Copy, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Bounds {
    /// k4/k1.
    pub stiffness: Option<[f64; 2]>,
    /// rho.
    pub clearance: Option<[f64; 2]>,
    /// eta.
    pub frequency: Option<[f64; 2]>,
}
