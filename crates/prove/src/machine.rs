//! A machine as the laws that its motion obeys, each with what ends it.
//!
//! They are the phases of the engine (`CheckedScene::phases`), whose coefficients are doubles: what is proven is proven of these
//! numbers.

use serde::Serialize;
use softstop::internals::{Beyond, Exit, PhaseId, Phases};
use softstop::{CheckedScene, MotionError, Scene};

use crate::ProofError;
use crate::interval::Interval;
use crate::number::{Decay, Number};

/// m x'' + `damping` x' + `stiffness` x = `force` + F0 cos(drive angle).
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Law {
    /// Damping in N s/m.
    pub damping: f64,
    /// Net stiffness in N/m.
    pub stiffness: f64,
    /// Constant force in N.
    pub force: f64,
}

/// g = `position` x + `velocity` x' - `level`: what ends a phase as it rises through zero.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Guard {
    /// Weight of the position.
    pub position: f64,
    /// Weight of the velocity.
    pub velocity: f64,
    /// What is subtracted.
    pub level: f64,
    /// By what the velocity is multiplied: -R at a rigid stop, else 1.
    pub factor: f64,
    /// The phases that may follow.
    pub to: Vec<usize>,
    /// True if it is an impact.
    pub impact: bool,
}

/// A smooth law with what ends it.
#[derive(Debug, Clone, Serialize)]
pub struct Phase {
    /// Its name.
    pub name: String,
    /// Its law.
    pub law: Law,
    /// Its guards.
    pub guards: Vec<Guard>,
}

/// A machine whose laws are all linear.
#[derive(Debug, Clone, Serialize)]
pub struct Machine {
    /// The mass in kg.
    pub mass: f64,
    /// The drive's amplitude F0 in N.
    pub amplitude: f64,
    /// Its phases, the free flight first.
    pub phases: Vec<Phase>,
    #[serde(skip)]
    engine: CheckedScene,
}

impl Guard {
    /// Its value.
    pub fn value<T: Number>(&self, position: &T, velocity: &T) -> T {
        position.times(self.position) + velocity.times(self.velocity) - T::constant(self.level)
    }

    /// True if both vanish at the same states.
    pub fn is_zero_with(&self, other: &Self) -> bool {
        let weights = |it: &Self| (it.position, it.velocity, it.level);
        let opposite = (-other.position, -other.velocity, -other.level);
        weights(self) == weights(other) || weights(self) == opposite
    }
}

impl Machine {
    /// The laws of a scene.
    ///
    /// # Errors
    /// [`ProofError::Unsupported`] for a law without a closed form.
    pub fn new(scene: &Scene) -> Result<Self, ProofError> {
        let scene = scene.check().map_err(MotionError::from)?;
        let engine = scene.phases();
        if engine.phases.iter().any(|phase| phase.hertz.is_some()) {
            return Err(ProofError::Unsupported(
                "stop.model = \"hertz\": a power law has no closed form to enclose",
            ));
        }
        if scene.below.is_some() {
            return Err(ProofError::Unsupported(
                "stop.below: proofs are of machines with stops on one side",
            ));
        }
        if engine.phases[0].guards.is_empty() {
            return Err(ProofError::Unsupported(
                "stop.model = \"none\": the machine has no stop, so no motion of it crosses anything",
            ));
        }
        let ids = engine.phases.iter().map(|phase| phase.id);
        Ok(Self {
            mass: scene.mass,
            amplitude: scene.excitation.amplitude,
            phases: ids.map(|id| phase(engine, id)).collect(),
            engine: scene.clone(),
        })
    }

    /// The phase at a state that lies on no surface.
    pub fn phase_at(&self, position: f64, velocity: f64) -> usize {
        let [_, backward] = self.engine.phases().laws_at(position, velocity, true);
        backward.index()
    }

    /// Acceleration under a law at a state; `cosine` is that of the drive angle.
    pub fn acceleration<T: Number>(&self, law: &Law, position: &T, velocity: &T, cosine: &T) -> T {
        let force = T::constant(law.force) + cosine.times(self.amplitude)
            - velocity.times(law.damping)
            - position.times(law.stiffness);
        force * T::constant(self.mass).reciprocal()
    }

    /// The free motion of a law.
    pub fn decay(&self, law: &Law) -> Decay {
        Decay {
            rate: Interval::point(law.damping) / Interval::point(2.0 * self.mass),
            stiffness: Interval::point(law.stiffness) / Interval::point(self.mass),
        }
    }
}

/// A phase of the engine, with a strip always fed.
fn phase(engine: &Phases, id: PhaseId) -> Phase {
    let phase = &engine[id];
    let name = format!("{:?}", phase.kind).to_lowercase();
    let turns_back =
        |exit: &Exit| matches!(exit, Exit::Reversal { backward, .. } if *backward == id);
    let back = if phase.exits.iter().any(turns_back) {
        " back"
    } else {
        ""
    };
    let guards = phase.guards.iter().zip(phase.exits.iter());
    Phase {
        name: name + back,
        law: Law {
            damping: phase.law.damping,
            stiffness: phase.law.stiffness,
            force: phase.law.force,
        },
        guards: guards
            .map(|(guard, exit)| {
                let (to, factor, impact) = next(engine, id, *exit);
                Guard {
                    position: guard.position,
                    velocity: guard.velocity,
                    level: guard.level,
                    factor,
                    to: to.iter().map(|it| it.index()).collect(),
                    impact,
                }
            })
            .collect(),
    }
}

/// The phases that may follow an exit, the factor of the velocity, and whether it is an impact.
fn next(engine: &Phases, from: PhaseId, exit: Exit) -> (Vec<PhaseId>, f64, bool) {
    let (to, factor, impact) = match exit {
        Exit::Switch(to) => return (vec![to], 1.0, false),
        Exit::Reversal { forward, backward } => {
            let to = if from == forward { backward } else { forward };
            return (vec![to], 1.0, false);
        }
        Exit::Backward(surface) => (engine[surface].before, 1.0, false),
        Exit::Forward(surface) => {
            let surface = &engine[surface];
            match surface.beyond {
                Beyond::Phase(to) => (to, 1.0, surface.is_clearance),
                Beyond::Wall { restitution } => {
                    (surface.before, -restitution, surface.is_clearance)
                }
            }
        }
    };
    // Where a stop may let go, it may have let go already.
    let released = engine[to].exits.iter().filter_map(|exit| match exit {
        Exit::Switch(released) => Some(*released),
        _ => None,
    });
    ([to].into_iter().chain(released).collect(), factor, impact)
}
