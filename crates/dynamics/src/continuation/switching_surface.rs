//! The surfaces at which the law of force changes, which an orbit may graze, and how near it is to touching one.

use crate::tolerance::ROUNDING;
use softstop::{Parameter, Scene, Stop};

/// A surface at which a scene's law of force changes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SwitchingSurface {
    /// The clearance: an impact.
    Clearance,
    /// The end of phase I, where the strip is pierced.
    Pierced,
    /// The stop behind the strip.
    Stop,
    /// The rigid stop behind that.
    Wall,
    /// The stop below.
    Below,
}

/// Arrays of one value for each surface are indexed by `surface as usize`: [`SwitchingSurface::ALL`] is in the order of the variants.
const _: () = {
    let mut index = 0;
    while index < SwitchingSurface::ALL.len() {
        assert!(SwitchingSurface::ALL[index] as usize == index);
        index += 1;
    }
};

impl SwitchingSurface {
    /// All surfaces, in the order of the variants.
    pub const ALL: [Self; 5] = [
        Self::Clearance,
        Self::Pierced,
        Self::Stop,
        Self::Wall,
        Self::Below,
    ];

    /// Position of the surface in m, if the scene has it.
    pub fn surface_position(self, scene: &Scene) -> Option<f64> {
        match self {
            Self::Clearance => Some(scene.clearance),
            Self::Pierced => scene
                .piercing
                .map(|strip| scene.clearance + strip.thickness),
            Self::Stop => scene.piercing.map(|_| scene.stop_position()),
            Self::Wall => scene.wall().map(|wall| wall.position),
            Self::Below => scene.below.as_ref().map(|below| -below.clearance),
        }
    }

    /// True if meeting the surface is an impact.
    pub(crate) fn is_clearance(self) -> bool {
        matches!(self, Self::Clearance | Self::Below)
    }

    /// True if an orbit can graze the surface without losing its derivative: the force does not jump there.
    pub(crate) fn is_force_continuous(self, scene: &Scene) -> bool {
        match (self, scene.piercing) {
            (Self::Clearance, Some(strip)) => strip.thickness > 0.0,
            (Self::Clearance, None) => match &scene.stop {
                Stop::None
                | Stop::KelvinVoigt { .. }
                | Stop::PiecewiseLinear { .. }
                | Stop::Hertz { .. } => scene
                    .wall()
                    .is_none_or(|wall| wall.position > scene.clearance),
                Stop::Preloaded { preload, .. } => *preload == 0.0,
                Stop::Rigid { .. } => false,
            },
            (Self::Below, _) => {
                let mirrored = scene.mirrored();
                mirrored.is_none_or(|mirrored| Self::Clearance.is_force_continuous(&mirrored))
            }
            _ => false,
        }
    }

    /// True if a weak impact at the surface has a square root, and a motion may begin there: at a rigid stop, and where
    /// the force jumps against the mass or with it but for the strip's edges.
    pub(crate) fn has_square_root(self, scene: &Scene) -> bool {
        match self {
            Self::Clearance => scene.piercing.is_none() && !self.is_force_continuous(scene),
            Self::Below => !self.is_force_continuous(scene),
            Self::Pierced => false,
            Self::Stop => {
                let cutting = scene.piercing.filter(|strip| strip.travel > 0.0);
                let friction = cutting.map_or(0.0, |strip| strip.cut_force_forward());
                friction != Parameter::Preload.get(scene).unwrap_or(0.0)
            }
            Self::Wall => true,
        }
    }

    /// The surface at a position, to rounding.
    pub(crate) fn at_position(scene: &Scene, position: f64) -> Option<Self> {
        let near = ROUNDING * (scene.scales().length + position.abs());
        let stands = |surface: &Self| {
            surface
                .surface_position(scene)
                .is_some_and(|level| (level - position).abs() < near)
        };
        Self::ALL.into_iter().find(stands)
    }
}

/// Where an orbit comes near to grazing a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct NearGrazing {
    /// Time in s.
    pub time: f64,
    /// Velocity in m/s of a crossing, or distance in m of a turning point from the surface ahead.
    pub amount: f64,
    /// The surface.
    pub surface: SwitchingSurface,
    /// Dry friction turns its sign there.
    pub reverses: bool,
}
