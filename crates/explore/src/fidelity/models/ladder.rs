//! The models of one scene, from no stop at all to the scene itself.

use std::fmt;

use super::matching::{self, root};
use super::{Contact, FidelityError};
use softstop::{Release, Scene, Stop};

/// A rung: a law of contact, simple ones first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ContactLaw {
    /// No stop.
    Linear,
    /// A rigid stop at the clearance with the contact's restitution.
    Rigid,
    /// A spring beside a damper from the clearance on.
    KelvinVoigt,
    /// A pre-stressed spring of the scene's own stiffness from the clearance on, nothing before it.
    Preloaded,
    /// A sphere's contact with dissipation (Hertz, Hunt and Crossley).
    Hertz,
    /// The scene itself, where it is none of these.
    Full,
}

impl ContactLaw {
    /// All rungs.
    pub const ALL: [Self; 6] = [
        Self::Linear,
        Self::Rigid,
        Self::KelvinVoigt,
        Self::Preloaded,
        Self::Hertz,
        Self::Full,
    ];

    /// Its name, as in JSON; that of a stop is its `model`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Linear => "linear",
            Self::Rigid => "rigid",
            Self::KelvinVoigt => "kelvinVoigt",
            Self::Preloaded => "preloaded",
            Self::Hertz => "hertz",
            Self::Full => "full",
        }
    }

    /// The rung that a scene itself stands on.
    pub fn of(scene: &Scene) -> Self {
        if scene.piercing.is_some()
            || scene.below.is_some()
            || (scene.rigid.is_some() && !matches!(scene.stop, Stop::Rigid { .. }))
        {
            return Self::Full;
        }
        match scene.stop {
            Stop::None => Self::Linear,
            Stop::Rigid { .. } => Self::Rigid,
            Stop::KelvinVoigt { .. } => Self::KelvinVoigt,
            Stop::Preloaded { .. } => Self::Preloaded,
            Stop::Hertz { .. } => Self::Hertz,
            Stop::PiecewiseLinear { .. } => Self::Full,
        }
    }
}

impl fmt::Display for ContactLaw {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.name())
    }
}

/// What a soft model has in common with the scene's contact, besides the restitution.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum MatchedProperty {
    /// The largest penetration: without damping, the energy stored there, 1/2 k d^2 = E(d).
    #[default]
    Penetration,
    /// How long the mass is beyond the clearance.
    Duration,
}

/// The models of one scene.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelHierarchy {
    /// The scene itself: what the models are measured by.
    pub truth: Scene,
    /// What soft models have in common with its contact.
    pub likeness: MatchedProperty,
}

/// Hertz's exponent, of a sphere.
const SPHERE: f64 = 1.5;

impl ModelHierarchy {
    /// The rungs below a scene and its own, simple ones first. A preloaded stop is a model only of a
    /// scene that has one, behind a strip or before a rigid stop.
    pub fn rungs(&self) -> Vec<ContactLaw> {
        let own = ContactLaw::of(&self.truth);
        let fits = |rung: &ContactLaw| match rung {
            ContactLaw::Full | ContactLaw::Linear => *rung == own || *rung == ContactLaw::Linear,
            ContactLaw::Preloaded => matches!(self.truth.stop, Stop::Preloaded { .. }),
            _ => own != ContactLaw::Linear,
        };
        ContactLaw::ALL.into_iter().filter(fits).collect()
    }

    /// The model of a rung, matched at a before-impact velocity in m/s. On its own rung the scene is its
    /// own model.
    ///
    /// # Errors
    /// [`FidelityError::Unmatched`] if no contact of this law behaves like the scene's,
    /// [`FidelityError::Motion`] if that cannot be computed.
    pub fn model(&self, rung: ContactLaw, velocity: f64) -> Result<Scene, FidelityError> {
        let scene = if rung == ContactLaw::of(&self.truth) {
            self.truth.clone()
        } else if rung == ContactLaw::Linear {
            self.plain(Stop::None)
        } else {
            self.matched(rung, &Contact::of(&self.truth, velocity)?)?
        };
        scene.validate()?;
        Ok(scene)
    }

    /// The scene with another stop, and with nothing before and behind it.
    fn plain(&self, stop: Stop) -> Scene {
        Scene {
            contact_damping: self.truth.damping,
            stop,
            piercing: None,
            rigid: None,
            ..self.truth.clone()
        }
    }

    fn matched(&self, rung: ContactLaw, contact: &Contact) -> Result<Scene, FidelityError> {
        let restitution = contact.restitution.min(1.0);
        let found = match rung {
            ContactLaw::Rigid => Some(self.plain(Stop::Rigid { restitution })),
            ContactLaw::KelvinVoigt => self.kelvin_voigt(contact, restitution),
            ContactLaw::Hertz => self.hertz(contact, restitution)?,
            ContactLaw::Preloaded => self.preloaded(contact)?,
            ContactLaw::Linear | ContactLaw::Full => None,
        };
        found.ok_or_else(|| FidelityError::Unmatched {
            rung,
            reason: reason(contact),
        })
    }

    fn kelvin_voigt(&self, contact: &Contact, restitution: f64) -> Option<Scene> {
        let release = match self.truth.stop {
            Stop::KelvinVoigt { release, .. } => release,
            _ => Release::Clearance,
        };
        let zeta = matching::damping_ratio(release, restitution)?;
        let frequency = match self.likeness {
            MatchedProperty::Penetration => {
                matching::penetration(zeta) * contact.velocity / contact.penetration
            }
            MatchedProperty::Duration => matching::duration(release, zeta) / contact.duration,
        };
        let stiffness = self.truth.mass * frequency * frequency;
        let scene = Scene {
            contact_damping: 2.0 * zeta * self.truth.mass * frequency,
            ..self.plain(Stop::KelvinVoigt { stiffness, release })
        };
        is_soft(stiffness).then_some(scene)
    }

    /// All of the contact's loss goes into the dissipation of the power law.
    fn hertz(&self, contact: &Contact, restitution: f64) -> Result<Option<Scene>, FidelityError> {
        let Some(a) = matching::hunt_crossley(restitution) else {
            return Ok(None);
        };
        let speed = contact.velocity;
        let energy = matching::hunt_crossley_energy(a) * self.truth.mass * speed * speed;
        let stiffness = (SPHERE + 1.0) * energy / contact.penetration.powf(SPHERE + 1.0);
        let scene = |stiffness| Scene {
            contact_damping: 0.0,
            ..self.plain(Stop::Hertz {
                stiffness,
                exponent: SPHERE,
                dissipation: a / speed,
            })
        };
        if !is_soft(stiffness) {
            return Ok(None);
        }
        if self.likeness == MatchedProperty::Penetration {
            return Ok(Some(scene(stiffness)));
        }
        // At equal v and lambda all contacts are alike: lengths and times go with k^(-1/(n+1)).
        let reference = Contact::of(&scene(stiffness), speed)?;
        let scale = (reference.duration / contact.duration).powf(SPHERE + 1.0);
        Ok(is_soft(scale).then(|| scene(stiffness * scale)))
    }

    /// The scene's own stop at the clearance, with another preload and damping: both by bisection with
    /// the exact contact.
    fn preloaded(&self, contact: &Contact) -> Result<Option<Scene>, FidelityError> {
        let Stop::Preloaded { stiffness, .. } = self.truth.stop else {
            return Ok(None);
        };
        if !(contact.restitution > 0.0 && contact.penetration > 0.0) {
            return Ok(None);
        }
        let (mass, speed) = (self.truth.mass, contact.velocity);
        let scene = |preload, damping| Scene {
            contact_damping: damping,
            ..self.plain(Stop::Preloaded { stiffness, preload })
        };
        let of = |preload, damping| {
            Contact::of(&scene(preload, damping), speed).unwrap_or(Contact {
                restitution: f64::NAN,
                penetration: f64::NAN,
                ..*contact
            })
        };
        // Heavier than critical for any spring that stops the mass within the penetration.
        let heaviest = 8.0 * mass * speed / contact.penetration;
        let damping = |preload| {
            let excess = |damping| of(preload, damping).restitution - contact.restitution;
            root(excess, 0.0, heaviest).unwrap_or(f64::NAN)
        };
        let excess = |preload: f64| {
            let like = of(preload, damping(preload));
            match self.likeness {
                MatchedProperty::Penetration => like.penetration - contact.penetration,
                MatchedProperty::Duration => like.duration - contact.duration,
            }
        };
        // A constant force that stops the mass in half the way, or in half the time.
        let strongest = match self.likeness {
            MatchedProperty::Penetration => mass * speed * speed / contact.penetration,
            MatchedProperty::Duration => 4.0 * mass * speed / contact.duration,
        };
        Ok(root(excess, 0.0, strongest).map(|preload| scene(preload, damping(preload))))
    }
}

fn is_soft(stiffness: f64) -> bool {
    stiffness.is_finite() && stiffness > 0.0
}

fn reason(contact: &Contact) -> String {
    if contact.restitution == 0.0 {
        "the mass does not come back from the scene's own contact".to_owned()
    } else if contact.penetration == 0.0 {
        "the scene's own contact takes no way and no time".to_owned()
    } else {
        format!(
            "restitution {}, penetration {} m and duration {} s at {} m/s lie outside its range",
            contact.restitution, contact.penetration, contact.duration, contact.velocity
        )
    }
}
