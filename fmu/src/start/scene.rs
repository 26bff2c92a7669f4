//! Start values and scenes: the one from the other, both ways.

use softstop::scene::{Release, RigidStop, Slope};
use softstop::{Excitation, Piercing, Scene, SceneError, Start, Stop};
use thiserror::Error;

use super::{SLOPES, Slot, StartValues};
use crate::units::{
    RELEASE_CLEARANCE, RELEASE_ZERO_FORCE, STOP_HERTZ, STOP_KELVIN_VOIGT, STOP_NONE,
    STOP_PIECEWISE_LINEAR, STOP_PRELOADED, STOP_RIGID,
};

/// Why a scene has no start values.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum NotServed {
    /// The scene does not describe a machine.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A piecewise linear stop with more slopes than the unit has room for.
    #[error("{list}: {count} slopes, the FMU has room for {SLOPES}")]
    TooManySlopes {
        /// Which of the two lists.
        list: &'static str,
        /// How many slopes it has.
        count: usize,
    },
    /// A rigid stop that stands behind no stop.
    #[error("rigid.travel: there is no stop in front; the FMU has stop.model = rigid for this")]
    NothingInFront,
}

/// The slots of one list of slopes.
struct Chain {
    name: &'static str,
    count: Slot,
    from: Slot,
    stiffness: Slot,
}

const LOADING: Chain = Chain {
    name: "stop.loading",
    count: Slot::LOADING_COUNT,
    from: Slot::LOADING_FROM,
    stiffness: Slot::LOADING_STIFFNESS,
};

const UNLOADING: Chain = Chain {
    name: "stop.unloading",
    count: Slot::UNLOADING_COUNT,
    from: Slot::UNLOADING_FROM,
    stiffness: Slot::UNLOADING_STIFFNESS,
};

impl StartValues {
    /// The start values that make the unit run `scene` from `start`.
    ///
    /// What the scene does not have (a stop, a strip) keeps the defaults of its parameters. A rigid
    /// stop behind a rigid one is out of reach and is left out.
    ///
    /// # Errors
    /// If the scene is not valid, or one that the unit has no parameters for.
    pub fn from_scene(scene: &Scene, start: Start) -> Result<Self, NotServed> {
        scene.validate()?;
        let mut values = Self::DEFAULT;
        values.set_machine(scene);
        values.set_stop(&scene.stop)?;
        values.set_rigid(scene)?;
        values.set_strip(scene.piercing);
        values.set(Slot::INITIAL_POSITION, start.position);
        values.set(Slot::INITIAL_VELOCITY, start.velocity);
        Ok(values)
    }

    fn set_machine(&mut self, scene: &Scene) {
        self.set(Slot::MASS, scene.mass);
        self.set(Slot::STIFFNESS, scene.stiffness);
        self.set(Slot::DAMPING, scene.damping);
        self.set(Slot::AMPLITUDE, scene.excitation.amplitude);
        self.set(Slot::FREQUENCY, scene.excitation.frequency);
        self.set(Slot::DRIVE_PHASE, scene.excitation.phase);
        self.set(Slot::CLEARANCE, scene.clearance);
        self.set(Slot::CONTACT_DAMPING, scene.contact_damping);
    }

    fn set_stop(&mut self, stop: &Stop) -> Result<(), NotServed> {
        let model = match stop {
            Stop::None => STOP_NONE,
            Stop::KelvinVoigt { stiffness, release } => {
                self.set(Slot::STOP_STIFFNESS, *stiffness);
                let release = match release {
                    Release::Clearance => RELEASE_CLEARANCE,
                    Release::ZeroForce => RELEASE_ZERO_FORCE,
                };
                self.set(Slot::STOP_RELEASE, f64::from(release));
                STOP_KELVIN_VOIGT
            }
            Stop::PiecewiseLinear { loading, unloading } => {
                self.set_slopes(&LOADING, loading)?;
                self.set_slopes(&UNLOADING, unloading)?;
                STOP_PIECEWISE_LINEAR
            }
            Stop::Hertz {
                stiffness,
                exponent,
                dissipation,
            } => {
                self.set(Slot::STOP_STIFFNESS, *stiffness);
                self.set(Slot::STOP_EXPONENT, *exponent);
                self.set(Slot::STOP_DISSIPATION, *dissipation);
                STOP_HERTZ
            }
            Stop::Preloaded { stiffness, preload } => {
                self.set(Slot::STOP_STIFFNESS, *stiffness);
                self.set(Slot::STOP_PRELOAD, *preload);
                STOP_PRELOADED
            }
            Stop::Rigid { restitution } => {
                self.set(Slot::STOP_RESTITUTION, *restitution);
                STOP_RIGID
            }
        };
        self.set(Slot::STOP_MODEL, f64::from(model));
        Ok(())
    }

    fn set_slopes(&mut self, chain: &Chain, slopes: &[Slope]) -> Result<(), NotServed> {
        if slopes.len() > SLOPES {
            return Err(NotServed::TooManySlopes {
                list: chain.name,
                count: slopes.len(),
            });
        }
        self.set(chain.count, slopes.len() as f64);
        for (index, slope) in slopes.iter().enumerate() {
            self.set(chain.from.element(index), slope.from);
            self.set(chain.stiffness.element(index), slope.stiffness);
        }
        Ok(())
    }

    fn set_rigid(&mut self, scene: &Scene) -> Result<(), NotServed> {
        let reachable = match (&scene.stop, scene.rigid) {
            (Stop::None, Some(_)) => return Err(NotServed::NothingInFront),
            (Stop::Rigid { .. }, _) => None,
            (_, rigid) => rigid,
        };
        self.set(
            Slot::RIGID_PRESENT,
            f64::from(u8::from(reachable.is_some())),
        );
        if let Some(rigid) = reachable {
            self.set(Slot::RIGID_TRAVEL, rigid.travel);
            self.set(Slot::STOP_RESTITUTION, rigid.restitution);
        }
        Ok(())
    }

    fn set_strip(&mut self, strip: Option<Piercing>) {
        let strip = strip.unwrap_or(Piercing {
            thickness: 0.0,
            travel: 0.0,
            ..self.strip()
        });
        self.set(Slot::PIERCING_STIFFNESS, strip.stiffness);
        self.set(Slot::PIERCING_FRICTION, strip.friction);
        self.set(Slot::PIERCING_THICKNESS, strip.thickness);
        self.set(Slot::PIERCING_TRAVEL, strip.travel);
    }

    /// The scene that these values describe; it has a strip if thickness or travel is positive.
    pub fn scene(&self) -> Scene {
        let strip = self.strip();
        let stop = self.stop();
        Scene {
            mass: self.get(Slot::MASS),
            stiffness: self.get(Slot::STIFFNESS),
            damping: self.get(Slot::DAMPING),
            excitation: Excitation {
                amplitude: self.get(Slot::AMPLITUDE),
                frequency: self.get(Slot::FREQUENCY),
                phase: self.get(Slot::DRIVE_PHASE),
            },
            clearance: self.get(Slot::CLEARANCE),
            contact_damping: self.get(Slot::CONTACT_DAMPING),
            rigid: self.rigid_behind(&stop),
            stop,
            piercing: (strip.thickness > 0.0 || strip.travel > 0.0).then_some(strip),
        }
    }

    fn strip(&self) -> Piercing {
        Piercing {
            stiffness: self.get(Slot::PIERCING_STIFFNESS),
            friction: self.get(Slot::PIERCING_FRICTION),
            thickness: self.get(Slot::PIERCING_THICKNESS),
            travel: self.get(Slot::PIERCING_TRAVEL),
        }
    }

    fn stop(&self) -> Stop {
        let stiffness = self.get(Slot::STOP_STIFFNESS);
        match self.number(Slot::STOP_MODEL) {
            STOP_KELVIN_VOIGT => Stop::KelvinVoigt {
                stiffness,
                release: match self.number(Slot::STOP_RELEASE) {
                    RELEASE_ZERO_FORCE => Release::ZeroForce,
                    _ => Release::Clearance,
                },
            },
            STOP_PIECEWISE_LINEAR => Stop::PiecewiseLinear {
                loading: self.slopes(&LOADING),
                unloading: self.slopes(&UNLOADING),
            },
            STOP_HERTZ => Stop::Hertz {
                stiffness,
                exponent: self.get(Slot::STOP_EXPONENT),
                dissipation: self.get(Slot::STOP_DISSIPATION),
            },
            STOP_PRELOADED => Stop::Preloaded {
                stiffness,
                preload: self.get(Slot::STOP_PRELOAD),
            },
            STOP_RIGID => Stop::Rigid {
                restitution: self.get(Slot::STOP_RESTITUTION),
            },
            _ => Stop::None,
        }
    }

    fn slopes(&self, chain: &Chain) -> Vec<Slope> {
        let count = self.get(chain.count) as usize;
        let slope = |index| Slope {
            from: self.get(chain.from.element(index)),
            stiffness: self.get(chain.stiffness.element(index)),
        };
        (0..count.min(SLOPES)).map(slope).collect()
    }

    fn rigid_behind(&self, stop: &Stop) -> Option<RigidStop> {
        let yields = !matches!(stop, Stop::None | Stop::Rigid { .. });
        (yields && self.get(Slot::RIGID_PRESENT) != 0.0).then(|| RigidStop {
            travel: self.get(Slot::RIGID_TRAVEL),
            restitution: self.get(Slot::STOP_RESTITUTION),
        })
    }

    /// The state at the start time.
    pub fn start(&self) -> Start {
        Start {
            position: self.get(Slot::INITIAL_POSITION),
            velocity: self.get(Slot::INITIAL_VELOCITY),
        }
    }
}
