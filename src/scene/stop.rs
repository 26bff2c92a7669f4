//! The stops' laws of force (Peterka 2003, figures 1 and 2).

use serde::{Deserialize, Serialize};

/// The stop's law of force. d is the deflection x - [`Scene::stop_position`](super::Scene), v the
/// velocity. Viscous damping in contact is the scene's own, whatever the law.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "model", rename_all = "camelCase", deny_unknown_fields)]
pub enum Stop {
    /// No stop: the linear oscillator (Fig. 1a).
    None,
    /// A spring beside a damper: F = stiffness d (Fig. 2a); the damper is the contact damping.
    #[serde(alias = "kelvin-voigt")]
    KelvinVoigt {
        /// Stiffness k2 in N/m, >= 0.
        stiffness: f64,
        /// When a mass that moves back is let go.
        #[serde(default)]
        release: Release,
    },
    /// A continuous chain of slopes (Fig. 2b), on the way back that of `unloading`.
    #[serde(alias = "piecewise-linear")]
    PiecewiseLinear {
        /// Slopes while the mass moves on; the first begins at deflection 0.
        loading: Vec<Slope>,
        /// Slopes while the mass moves back, nowhere with a higher force; empty if the same.
        #[serde(default)]
        unloading: Vec<Slope>,
    },
    /// F = stiffness d^exponent max(0, 1 + dissipation v) (Fig. 2c; Hertz 1882; Hunt and Crossley 1975).
    Hertz {
        /// Stiffness in N/m^exponent, >= 0.
        stiffness: f64,
        /// Exponent, >= 1; 3/2 for a sphere.
        #[serde(default = "sphere_exponent")]
        exponent: f64,
        /// Hunt and Crossley's factor in s/m, >= 0.
        #[serde(default)]
        dissipation: f64,
    },
    /// A pre-stressed spring: F = preload + stiffness d (eq. 5).
    Preloaded {
        /// Stiffness k4 in N/m, >= 0.
        stiffness: f64,
        /// Force at first touch in N, >= 0.
        preload: f64,
    },
    /// A rigid stop (Fig. 1c): v+ = -restitution v-.
    Rigid {
        /// Newton's coefficient of restitution R, 0 <= R <= 1.
        restitution: f64,
    },
}

impl Stop {
    /// The name of the stop's law, as in TOML and in the FMU.
    pub const fn model(&self) -> &'static str {
        match self {
            Self::None => "none",
            Self::KelvinVoigt { .. } => "kelvinVoigt",
            Self::PiecewiseLinear { .. } => "piecewiseLinear",
            Self::Hertz { .. } => "hertz",
            Self::Preloaded { .. } => "preloaded",
            Self::Rigid { .. } => "rigid",
        }
    }
}

const fn sphere_exponent() -> f64 {
    1.5
}

/// When a Kelvin-Voigt stop lets go of a mass that moves back.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Release {
    /// At the clearance: the damper may pull (Peterka's reading).
    #[default]
    Clearance,
    /// Where spring and damper together cease to press: contact never pulls.
    #[serde(alias = "zero-force")]
    ZeroForce,
}

/// One slope of a piecewise linear law.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Slope {
    /// Deflection in m from which it holds, >= 0.
    pub from: f64,
    /// Stiffness in N/m, >= 0.
    pub stiffness: f64,
}

/// A rigid stop behind another one: phase IV (Peterka 2003, eq. 7).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RigidStop {
    /// Travel e in m from the stop in front to this one, >= 0.
    pub travel: f64,
    /// Newton's coefficient of restitution R, 0 <= R <= 1.
    pub restitution: f64,
}

/// The rigid stop that a mass meets, and can go no further.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wall {
    /// Position in m.
    pub position: f64,
    /// Newton's coefficient of restitution R, 0 <= R <= 1.
    pub restitution: f64,
}

/// A stop on the other side: it is met at x = -`clearance` on the way down, and its deflection is -x - `clearance`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(expecting = "a table")]
pub struct Below {
    /// Clearance in m, measured downwards; the free way between both stops must be > 0.
    pub clearance: f64,
    /// The stop.
    #[serde(flatten)]
    pub stop: Stop,
}

/// Force in N at `deflection` >= 0 of a stop with a continuous chain of slopes that starts at zero.
pub fn force_of(slopes: &[Slope], deflection: f64) -> f64 {
    let ends = slopes.iter().skip(1).map(|next| next.from);
    slopes
        .iter()
        .zip(ends.chain([f64::INFINITY]))
        .map(|(slope, end)| slope.stiffness * (deflection.min(end) - slope.from).max(0.0))
        .sum()
}

/// The slope of a stop that holds from `deflection` on.
pub(crate) fn stiffness_from(slopes: &[Slope], deflection: f64) -> f64 {
    let held = slopes.iter().rev().find(|slope| slope.from <= deflection);
    held.map_or(0.0, |slope| slope.stiffness)
}
