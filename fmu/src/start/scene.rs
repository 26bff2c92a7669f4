//! Start values and scenes: the one from the other, both ways.

use softstop::{Excitation, Piercing, Release, RigidStop, Scene, SceneError, Slope, Start, Stop};
use softstop_fmi::variable::Slot;
use thiserror::Error;

use super::StartValues;
use super::slot::{self, SLOPES};
use crate::units::number;

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
    count: slot::LOADING_COUNT,
    from: slot::LOADING_FROM,
    stiffness: slot::LOADING_STIFFNESS,
};

const UNLOADING: Chain = Chain {
    name: "stop.unloading",
    count: slot::UNLOADING_COUNT,
    from: slot::UNLOADING_FROM,
    stiffness: slot::UNLOADING_STIFFNESS,
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
        values.set(slot::INITIAL_POSITION, start.position);
        values.set(slot::INITIAL_VELOCITY, start.velocity);
        Ok(values)
    }

    fn set_machine(&mut self, scene: &Scene) {
        self.set(slot::MASS, scene.mass);
        self.set(slot::STIFFNESS, scene.stiffness);
        self.set(slot::DAMPING, scene.damping);
        self.set(slot::AMPLITUDE, scene.excitation.amplitude);
        self.set(slot::FREQUENCY, scene.excitation.frequency);
        self.set(slot::DRIVE_PHASE, scene.excitation.phase);
        self.set(slot::CLEARANCE, scene.clearance);
        self.set(slot::CONTACT_DAMPING, scene.contact_damping);
    }

    fn set_stop(&mut self, stop: &Stop) -> Result<(), NotServed> {
        let model = match stop {
            Stop::None => number::NONE,
            Stop::KelvinVoigt { stiffness, release } => {
                self.set(slot::STOP_STIFFNESS, *stiffness);
                let release = match release {
                    Release::Clearance => number::CLEARANCE,
                    Release::ZeroForce => number::ZERO_FORCE,
                };
                self.set(slot::STOP_RELEASE, f64::from(release));
                number::KELVIN_VOIGT
            }
            Stop::PiecewiseLinear { loading, unloading } => {
                self.set_slopes(&LOADING, loading)?;
                self.set_slopes(&UNLOADING, unloading)?;
                number::PIECEWISE_LINEAR
            }
            Stop::Hertz {
                stiffness,
                exponent,
                dissipation,
            } => {
                self.set(slot::STOP_STIFFNESS, *stiffness);
                self.set(slot::STOP_EXPONENT, *exponent);
                self.set(slot::STOP_DISSIPATION, *dissipation);
                number::HERTZ
            }
            Stop::Preloaded { stiffness, preload } => {
                self.set(slot::STOP_STIFFNESS, *stiffness);
                self.set(slot::STOP_PRELOAD, *preload);
                number::PRELOADED
            }
            Stop::Rigid { restitution } => {
                self.set(slot::STOP_RESTITUTION, *restitution);
                number::RIGID
            }
        };
        self.set(slot::STOP_MODEL, f64::from(model));
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
            slot::RIGID_PRESENT,
            f64::from(u8::from(reachable.is_some())),
        );
        if let Some(rigid) = reachable {
            self.set(slot::RIGID_TRAVEL, rigid.travel);
            self.set(slot::STOP_RESTITUTION, rigid.restitution);
        }
        Ok(())
    }

    fn set_strip(&mut self, strip: Option<Piercing>) {
        let strip = strip.unwrap_or(Piercing {
            thickness: 0.0,
            travel: 0.0,
            ..self.strip()
        });
        self.set(slot::PIERCING_STIFFNESS, strip.stiffness);
        self.set(slot::PIERCING_FRICTION, strip.friction);
        self.set(slot::PIERCING_THICKNESS, strip.thickness);
        self.set(slot::PIERCING_TRAVEL, strip.travel);
    }

    /// The scene that these values describe; it has a strip if thickness or travel is positive.
    pub fn scene(&self) -> Scene {
        let strip = self.strip();
        let stop = self.stop();
        Scene {
            mass: self.get(slot::MASS),
            stiffness: self.get(slot::STIFFNESS),
            damping: self.get(slot::DAMPING),
            excitation: Excitation {
                amplitude: self.get(slot::AMPLITUDE),
                frequency: self.get(slot::FREQUENCY),
                phase: self.get(slot::DRIVE_PHASE),
            },
            clearance: self.get(slot::CLEARANCE),
            contact_damping: self.get(slot::CONTACT_DAMPING),
            rigid: self.rigid_behind(&stop),
            stop,
            piercing: (strip.thickness > 0.0 || strip.travel > 0.0).then_some(strip),
        }
    }

    fn strip(&self) -> Piercing {
        Piercing {
            stiffness: self.get(slot::PIERCING_STIFFNESS),
            friction: self.get(slot::PIERCING_FRICTION),
            thickness: self.get(slot::PIERCING_THICKNESS),
            travel: self.get(slot::PIERCING_TRAVEL),
        }
    }

    fn stop(&self) -> Stop {
        let stiffness = self.get(slot::STOP_STIFFNESS);
        match self.number(slot::STOP_MODEL) {
            number::KELVIN_VOIGT => Stop::KelvinVoigt {
                stiffness,
                release: match self.number(slot::STOP_RELEASE) {
                    number::ZERO_FORCE => Release::ZeroForce,
                    _ => Release::Clearance,
                },
            },
            number::PIECEWISE_LINEAR => Stop::PiecewiseLinear {
                loading: self.slopes(&LOADING),
                unloading: self.slopes(&UNLOADING),
            },
            number::HERTZ => Stop::Hertz {
                stiffness,
                exponent: self.get(slot::STOP_EXPONENT),
                dissipation: self.get(slot::STOP_DISSIPATION),
            },
            number::PRELOADED => Stop::Preloaded {
                stiffness,
                preload: self.get(slot::STOP_PRELOAD),
            },
            number::RIGID => Stop::Rigid {
                restitution: self.get(slot::STOP_RESTITUTION),
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
        (yields && self.get(slot::RIGID_PRESENT) != 0.0).then(|| RigidStop {
            travel: self.get(slot::RIGID_TRAVEL),
            restitution: self.get(slot::STOP_RESTITUTION),
        })
    }

    /// The state at the start time.
    pub fn start(&self) -> Start {
        Start::new(
            self.get(slot::INITIAL_POSITION),
            self.get(slot::INITIAL_VELOCITY),
        )
    }
}
