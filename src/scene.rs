//! The scene: a machine as plain, validated data.

mod allowed_range;
mod parameter;
mod ratios;
mod scales;
mod stop;
mod strip;
mod ties;
mod units;
mod validate;

pub use allowed_range::Allowed;
pub use parameter::{Dimension, Parameter, ParameterInfo};
pub use ratios::Ratios;
pub use scales::{MIN_SCALE_STIFFNESS, Scales};
pub(crate) use stop::stiffness_from;
pub use stop::{Below, Release, RigidStop, Slope, Stop, Wall, force_of};
pub use strip::Strip;
pub use ties::Ties;
pub(crate) use ties::{Quantity, Tie};
pub use units::Units;
pub use validate::{MAX_DAMPER_RATE, MAX_SPRING_RATE};

use serde::{Deserialize, Serialize};

/// Parameters of one machine, SI units:
///
/// ```text
/// m x'' + b1 x' + k1 x + F(x, x') = F0 cos(w t + phi) + f(t)        (Peterka 2003, eq. 8)
/// ```
///
/// [`Ratios`] holds the same in the paper's dimensionless quantities; the two agree through [`Ratios::scene`]. Any
/// scene with m = k1 = F0 = 1 is dimensionless, and [`Scene::in_units`] makes it dimensional.
///
/// Time scales may not lie too far apart: sqrt(k/m) of each spring is at most 1e7 times the drive's frequency, b/m of
/// each damper 1e9 times. A contact is known to eight digits of the motion where springs keep that limit and dampers 1e6,
/// for positions are doubles: their rounding, 2^-53 of the clearance, is a share of 1e-9 of its depth. A power law may be
/// so stiff, and so lossy, that it takes all of a motion as large as the clearance within 1e-7 of it; its exponent is at
/// most 20.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// Mass m in kg, > 0.
    pub mass: f64,
    /// Stiffness k1 of the suspension in N/m, >= 0.
    pub stiffness: f64,
    /// Viscous damping b1 of the impact-less motion in N s/m, >= 0.
    pub damping: f64,
    /// The harmonic drive.
    pub excitation: Excitation,
    /// Clearance r in m; negative means interference.
    pub clearance: f64,
    /// Total viscous damping b while bodies touch (x > r) in N s/m, >= 0. It replaces [`Scene::damping`] there.
    pub contact_damping: f64,
    /// The stop.
    pub stop: Stop,
    /// The strip that is pierced ahead of the stop, if one is fed.
    #[serde(default)]
    pub piercing: Option<Strip>,
    /// A rigid stop behind the stop, if there is one.
    #[serde(default)]
    pub rigid: Option<RigidStop>,
    /// What follows the frequency of the drive where that is varied.
    #[serde(skip)]
    pub followers: Ties,
    /// The stop on the other side, if there is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub below: Option<Box<Below>>,
}

/// The drive F0 cos(w t + phi).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Excitation {
    /// Amplitude F0 in N, >= 0.
    pub amplitude: f64,
    /// Angular frequency w in rad/s, > 0.
    pub frequency: f64,
    /// Drive angle phi at time 0 in rad.
    #[serde(default)]
    pub phase: f64,
}

impl Excitation {
    /// Drive angle phi at time 0 in rad, without its whole turns where they would take digits of what is added to it.
    pub fn reduced_phase(&self) -> f64 {
        // Rounding takes less than 1e-13 rad of such an angle.
        if self.phase.abs() <= 1e3 {
            return self.phase;
        }
        let (sin, cos) = self.phase.sin_cos();
        sin.atan2(cos)
    }
}

impl Scene {
    /// The oscillator with m = k1 = F0 = w = 1 and without damping that meets this stop at position 0.
    pub const fn of_stop(stop: Stop) -> Self {
        Self {
            mass: 1.0,
            stiffness: 1.0,
            damping: 0.0,
            excitation: Excitation {
                amplitude: 1.0,
                frequency: 1.0,
                phase: 0.0,
            },
            clearance: 0.0,
            contact_damping: 0.0,
            stop,
            piercing: None,
            rigid: None,
            followers: Ties::NONE,
            below: None,
        }
    }

    /// This machine seen from the other side, positions counted downwards: its stop is the one below. None if there is none.
    #[doc(hidden)]
    pub fn mirrored(&self) -> Option<Self> {
        let Below { clearance, stop } = *self.below.clone()?;
        Some(Self {
            clearance,
            stop,
            piercing: None,
            rigid: None,
            below: None,
            ..self.clone()
        })
    }

    /// Where the stop of the scene stands, in m: the clearance, or behind the strip.
    pub fn stop_position(&self) -> f64 {
        let behind = self.piercing.map_or(0.0, |p| p.thickness + p.travel);
        self.clearance + behind
    }

    /// True if anything stands at the scene's clearance.
    fn has_stop(&self) -> bool {
        self.stop != Stop::None || self.piercing.is_some() || self.rigid.is_some()
    }

    /// The rigid stop that the mass meets, if there is one: another one behind it is out of reach.
    pub fn wall(&self) -> Option<Wall> {
        let (travel, restitution) = match (&self.stop, self.rigid) {
            (Stop::Rigid { restitution }, _) => (0.0, *restitution),
            (_, Some(rigid)) => (rigid.travel, rigid.restitution),
            _ => return None,
        };
        Some(Wall {
            position: self.stop_position() + travel,
            restitution,
        })
    }

    /// Positions in m between which rigid stops leave the mass, infinite where there is none.
    pub fn reach(&self) -> (f64, f64) {
        let wall = |scene: &Self| scene.wall().map(|wall| wall.position);
        let below = self.mirrored().and_then(|mirrored| wall(&mirrored));
        let lowest = below.map_or(f64::NEG_INFINITY, |position| -position);
        (lowest, wall(self).unwrap_or(f64::INFINITY))
    }

    /// The smaller clearance of the scene in m: how far a harmonic motion may swing before it meets a stop.
    pub fn least_clearance(&self) -> f64 {
        match self.mirrored().filter(Self::has_stop) {
            Some(below) if self.has_stop() => self.clearance.min(below.clearance),
            Some(below) => below.clearance,
            None => self.clearance,
        }
    }

    /// Period of the drive, 2 pi / w, in s.
    pub fn period(&self) -> f64 {
        std::f64::consts::TAU / self.excitation.frequency
    }
}
