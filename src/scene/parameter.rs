//! The parameters of a machine: the one list of their names, letters, units, meanings and ranges.

use super::{Allowed, Scene, Stop};
use crate::error::SceneError;

/// The description of a parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct ParameterInfo {
    /// The parameter.
    pub parameter: Parameter,
    /// Name of the parameter in TOML, in `--set`, in messages and in the FMU.
    pub name: &'static str,
    /// Letter of the parameter (Peterka 2003): the dimensionless one, where there are two.
    pub letter: &'static str,
    /// Letter of the parameter in charts of dimensionless machines.
    pub symbol: &'static str,
    /// What it is also called: letters with a dimension, and the names of 0.1.0.
    pub aliases: &'static [&'static str],
    /// What it measures.
    pub dimension: Dimension,
    /// What it is, in a few words.
    pub meaning: &'static str,
    /// Where its values may lie.
    pub allowed: Allowed,
}

/// What a quantity measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Dimension {
    /// kg.
    Mass,
    /// N/m.
    Stiffness,
    /// N s/m.
    Damping,
    /// N.
    Force,
    /// rad/s.
    Frequency,
    /// rad.
    Angle,
    /// m.
    Length,
    /// m/s.
    Velocity,
    /// s.
    Time,
    /// J.
    Energy,
    /// W.
    Power,
    /// s/m.
    Slowness,
    /// A bare number.
    Number,
}

impl Dimension {
    /// The SI unit of a dimension.
    pub const fn unit(self) -> &'static str {
        match self {
            Self::Mass => "kg",
            Self::Stiffness => "N/m",
            Self::Damping => "N s/m",
            Self::Force => "N",
            Self::Frequency => "rad/s",
            Self::Angle => "rad",
            Self::Length => "m",
            Self::Velocity => "m/s",
            Self::Time => "s",
            Self::Energy => "J",
            Self::Power => "W",
            Self::Slowness => "s/m",
            Self::Number => "",
        }
    }
}

macro_rules! table {
    ($($parameter:ident $name:literal, $letter:literal, $symbol:literal, [$($alias:literal),*],
        $dimension:ident, $allowed:ident, $meaning:literal;)*) => {
        /// A number that makes out a [`Scene`]. [`Parameter::about`] says all about it.
        ///
        /// To add one: its row in this table, and its place in the scene.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
        #[non_exhaustive]
        pub enum Parameter {
            $(#[doc = concat!("`", $name, "`, ", $letter, ": ", $meaning, ".")] $parameter,)*
        }

        /// The descriptions of all parameters, in their order.
        const TABLE: &[ParameterInfo] = &[$(ParameterInfo {
            parameter: Parameter::$parameter,
            name: $name,
            letter: $letter,
            symbol: $symbol,
            aliases: &[$($alias),*],
            dimension: Dimension::$dimension,
            meaning: $meaning,
            allowed: Allowed::$allowed,
        }),*];

        impl Parameter {
            /// All parameters, in the order of the table.
            pub const ALL: [Self; TABLE.len()] = [$(Self::$parameter),*];

            /// The parameters of the drive alone.
            pub(crate) const OF_DRIVE: [Self; 3] = [Self::Amplitude, Self::Frequency, Self::Phase];
        }
    };
}

table! {
    Mass "mass", "m", "m", [], Mass, Positive, "mass";
    Suspension "stiffness", "k1", "k₁", [], Stiffness, NotNegative, "stiffness of the suspension";
    Damping "damping", "beta1", "β₁", ["b1"], Damping, NotNegative, "damping in flight";
    Amplitude "excitation.amplitude", "F0", "F₀", ["amplitude"], Force, NotNegative, "drive amplitude";
    Frequency "excitation.frequency", "eta", "η = ω/Ω", ["w", "frequency"], Frequency, Positive, "drive frequency";
    Phase "excitation.phase", "phi", "φ", ["phase"], Angle, Finite, "drive angle at time 0";
    Clearance "clearance", "rho", "ρ", ["r"], Length, Finite, "clearance";
    ContactDamping "contact.damping", "beta", "β", ["b", "contact_damping"], Damping, NotNegative, "damping in contact";
    StopStiffness "stop.stiffness", "k4", "k₄/k₁", ["stop_stiffness", "stiffness"], Stiffness, NotNegative, "stiffness of the stop";
    Preload "stop.preload", "Fp", "Fₚ/F₀", ["preload"], Force, NotNegative, "preload of the stop";
    Exponent "stop.exponent", "exponent", "exponent", [], Number, Power, "exponent of the stop";
    Dissipation "stop.dissipation", "dissipation", "dissipation", [], Slowness, NotNegative, "dissipation of the stop";
    Restitution "stop.restitution", "R", "R", ["restitution"], Number, Share, "restitution of the stop";
    PiercingStiffness "piercing.stiffness", "k2", "k₂/k₁", ["piercing_stiffness"], Stiffness, NotNegative, "stiffness of the strip";
    PiercingFriction "piercing.friction", "k3", "k₃/k₁", ["piercing_friction"], Stiffness, NotNegative, "friction of the strip";
    Thickness "piercing.thickness", "sigma", "σ", ["s", "thickness"], Length, NotNegative, "thickness of the strip";
    Travel "piercing.travel", "nu", "ν", ["v", "travel"], Length, NotNegative, "travel behind the strip";
    RigidTravel "rigid.travel", "epsilon", "ε", ["e", "rigid_travel"], Length, NotNegative, "travel to the rigid stop";
    RigidRestitution "rigid.restitution", "R", "R", ["restitution"], Number, Share, "restitution of the rigid stop behind";
    BelowClearance "stop.below.clearance", "rho_below", "ρ⁻", [], Length, Finite, "clearance of the stop below";
    BelowStiffness "stop.below.stiffness", "k4_below", "k₄⁻/k₁", [], Stiffness, NotNegative, "stiffness of the stop below";
    BelowPreload "stop.below.preload", "Fp_below", "Fₚ⁻/F₀", [], Force, NotNegative, "preload of the stop below";
    BelowExponent "stop.below.exponent", "exponent_below", "exponent below", [], Number, Power, "exponent of the stop below";
    BelowDissipation "stop.below.dissipation", "dissipation_below", "dissipation below", [], Slowness, NotNegative, "dissipation of the stop below";
    BelowRestitution "stop.below.restitution", "R_below", "R⁻", [], Number, Share, "restitution of the stop below";
}

/// The place of a parameter of a stop in it.
macro_rules! place_in_stop {
    ($parameter:expr, $stop:expr) => {
        match ($parameter, $stop) {
            (
                Parameter::StopStiffness,
                Stop::KelvinVoigt { stiffness, .. }
                | Stop::Hertz { stiffness, .. }
                | Stop::Preloaded { stiffness, .. },
            ) => Some(stiffness),
            (Parameter::Preload, Stop::Preloaded { preload, .. }) => Some(preload),
            (Parameter::Exponent, Stop::Hertz { exponent, .. }) => Some(exponent),
            (Parameter::Dissipation, Stop::Hertz { dissipation, .. }) => Some(dissipation),
            (Parameter::Restitution, Stop::Rigid { restitution }) => Some(restitution),
            _ => None,
        }
    };
}

/// The place of a parameter in a scene, to read (`&`) or to write (`&mut`).
macro_rules! place {
    ($parameter:expr, $scene:expr $(, $mutable:tt)?) => {{
        use Parameter as P;
        let scene = $scene;
        match $parameter {
            P::Mass => Some(&$($mutable)? scene.mass),
            P::Suspension => Some(&$($mutable)? scene.stiffness),
            P::Damping => Some(&$($mutable)? scene.damping),
            P::Amplitude => Some(&$($mutable)? scene.excitation.amplitude),
            P::Frequency => Some(&$($mutable)? scene.excitation.frequency),
            P::Phase => Some(&$($mutable)? scene.excitation.phase),
            P::Clearance => Some(&$($mutable)? scene.clearance),
            P::ContactDamping => Some(&$($mutable)? scene.contact_damping),
            P::PiercingStiffness | P::PiercingFriction | P::Thickness | P::Travel => {
                match (&$($mutable)? scene.piercing, $parameter) {
                    (Some(strip), P::PiercingStiffness) => Some(&$($mutable)? strip.stiffness),
                    (Some(strip), P::PiercingFriction) => Some(&$($mutable)? strip.friction),
                    (Some(strip), P::Thickness) => Some(&$($mutable)? strip.thickness),
                    (Some(strip), _) => Some(&$($mutable)? strip.travel),
                    (None, _) => None,
                }
            }
            P::RigidTravel | P::RigidRestitution => match (&$($mutable)? scene.rigid, $parameter) {
                (Some(rigid), P::RigidTravel) => Some(&$($mutable)? rigid.travel),
                (Some(rigid), _) => Some(&$($mutable)? rigid.restitution),
                (None, _) => None,
            },
            own => match (own.above(), &$($mutable)? scene.below) {
                (None, _) => place_in_stop!(own, &$($mutable)? scene.stop),
                (Some(_), None) => None,
                (Some(P::Clearance), Some(below)) => Some(&$($mutable)? below.clearance),
                (Some(twin), Some(below)) => place_in_stop!(twin, &$($mutable)? below.stop),
            },
        }
    }};
}

impl Parameter {
    /// The description of this parameter.
    pub const fn about(self) -> &'static ParameterInfo {
        &TABLE[self as usize]
    }

    /// Name of the parameter in TOML, in messages and in the FMU.
    pub const fn name(self) -> &'static str {
        self.about().name
    }

    /// The parameter of this name.
    pub fn named(name: &str) -> Option<Self> {
        let about = TABLE.iter().find(|about| about.name == name)?;
        Some(about.parameter)
    }

    /// True if a text is the name of the parameter, its letter or an older name.
    pub fn is_called(self, name: &str) -> bool {
        let about = self.about();
        name == about.name || name == about.letter || about.aliases.contains(&name)
    }

    /// True if ratios are in units of it: machines in ratios do not state it.
    pub const fn is_unit(self) -> bool {
        matches!(self, Self::Mass | Self::Suspension | Self::Amplitude)
    }

    /// The parameter of the stop above that is this one of the stop below; none if it is none of that.
    pub const fn above(self) -> Option<Self> {
        Some(match self {
            Self::BelowClearance => Self::Clearance,
            Self::BelowStiffness => Self::StopStiffness,
            Self::BelowPreload => Self::Preload,
            Self::BelowExponent => Self::Exponent,
            Self::BelowDissipation => Self::Dissipation,
            Self::BelowRestitution => Self::Restitution,
            _ => return None,
        })
    }

    /// Value of the parameter in SI units, if the machine has it.
    pub fn get(self, scene: &Scene) -> Option<f64> {
        place!(self, scene).copied()
    }

    /// Sets the parameter in a scene, in SI units; nothing happens if the machine does not have it. The value is not checked:
    /// [`Scene::validate`] does that.
    pub fn set(self, scene: &mut Scene, value: f64) {
        if let Some(place) = place!(self, scene, mut) {
            *place = value;
        }
    }

    /// Refuses a value that the parameter cannot have.
    ///
    /// # Errors
    /// [`SceneError::OutOfRange`].
    pub fn check(self, value: f64) -> Result<(), SceneError> {
        self.about().allowed.check(self.name(), value)
    }
}
