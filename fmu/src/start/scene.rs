//! Start values and scenes: the one from the other, both ways.

use softstop::{
    Below, MotionError, Release, RigidStop, Scene, SceneError, Simulation, Slope, Start, Stop,
    Strip,
};
use softstop_fmi::variable::{Access, Slot};
use thiserror::Error;

use super::StartValues;
use super::slot::{self, PARAMETERS, SLOPES};
use crate::table;
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
    /// A value that the variable of the unit cannot have.
    #[error("{name} = {value:?}: must be {range} in an FMU")]
    OutOfRange {
        /// The variable.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What it can have, in words.
        range: String,
    },
    /// A start from which the machine cannot move.
    #[error("initial.{0}")]
    Start(MotionError),
}

/// A list of slopes: its name in a machine file, and the slot of their number, which their deflections and then their
/// stiffnesses follow, with room for [`SLOPES`] of each.
type SlopeSlots = (&'static str, Slot);

/// The slots of what of a stop is no parameter.
struct Laws {
    model: Slot,
    release: Slot,
    loading: SlopeSlots,
    unloading: SlopeSlots,
}

const ABOVE: Laws = Laws {
    model: slot::STOP_MODEL,
    release: slot::STOP_RELEASE,
    loading: ("stop.loading", slot::LOADING_COUNT),
    unloading: ("stop.unloading", slot::UNLOADING_COUNT),
};

const BELOW: Laws = Laws {
    model: slot::BELOW_MODEL,
    release: slot::BELOW_RELEASE,
    loading: ("stop.below.loading", slot::BELOW_LOADING_COUNT),
    unloading: ("stop.below.unloading", slot::BELOW_UNLOADING_COUNT),
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
        let mut served = scene.clone();
        match (&scene.stop, scene.rigid) {
            (Stop::None, Some(_)) => return Err(NotServed::NothingInFront),
            (Stop::Rigid { .. }, _) => served.rigid = None,
            _ => {}
        }
        let mut values = Self::DEFAULT;
        values.set_stop(&ABOVE, &scene.stop)?;
        if let Some(below) = &scene.below {
            values.set_stop(&BELOW, &below.stop)?;
        }
        let has_rigid = u8::from(served.rigid.is_some());
        values.set(slot::RIGID_PRESENT, f64::from(has_rigid));
        if scene.piercing.is_none() {
            values.set(slot::PIERCING_THICKNESS, 0.0);
            values.set(slot::PIERCING_TRAVEL, 0.0);
        }
        for &(parameter, place) in PARAMETERS {
            if let Some(value) = parameter.get(&served) {
                values.set(place, value);
            }
        }
        values.set(slot::INITIAL_POSITION, start.position);
        values.set(slot::INITIAL_VELOCITY, start.velocity);
        Simulation::new(scene, start).map_err(NotServed::Start)?;
        values.within_ranges()
    }

    /// These values, if each is one that its parameter can have.
    fn within_ranges(self) -> Result<Self, NotServed> {
        for parameter in table().rows() {
            if let Access::Parameter { slot, .. } = parameter.access
                && let value = self.0[slot.0]
                && !parameter.kind.contains(value)
            {
                return Err(NotServed::OutOfRange {
                    name: parameter.name,
                    value,
                    range: parameter.kind.range(),
                });
            }
        }
        Ok(self)
    }

    /// Sets what of a stop is no parameter.
    fn set_stop(&mut self, laws: &Laws, stop: &Stop) -> Result<(), NotServed> {
        let model = match stop {
            Stop::None => number::NONE,
            Stop::KelvinVoigt { release, .. } => {
                let release = match release {
                    Release::Clearance => number::CLEARANCE,
                    Release::ZeroForce => number::ZERO_FORCE,
                };
                self.set(laws.release, f64::from(release));
                number::KELVIN_VOIGT
            }
            Stop::PiecewiseLinear { loading, unloading } => {
                self.set_slopes(laws.loading, loading)?;
                self.set_slopes(laws.unloading, unloading)?;
                number::PIECEWISE_LINEAR
            }
            Stop::Hertz { .. } => number::HERTZ,
            Stop::Preloaded { .. } => number::PRELOADED,
            Stop::Rigid { .. } => number::RIGID,
        };
        self.set(laws.model, f64::from(model));
        Ok(())
    }

    fn set_slopes(&mut self, (list, place): SlopeSlots, slopes: &[Slope]) -> Result<(), NotServed> {
        let count = slopes.len();
        if count > SLOPES {
            return Err(NotServed::TooManySlopes { list, count });
        }
        self.set(place, count as f64);
        for (index, slope) in slopes.iter().enumerate() {
            self.set(place.element(1 + index), slope.from);
            self.set(place.element(1 + SLOPES + index), slope.stiffness);
        }
        Ok(())
    }

    /// The scene that these values describe; it has a strip if thickness or travel is positive.
    pub fn scene(&self) -> Scene {
        let stop = self.stop(&ABOVE);
        let below = self.stop(&BELOW);
        let yields = !matches!(stop, Stop::None | Stop::Rigid { .. });
        let has_rigid = yields && self.get(slot::RIGID_PRESENT) != 0.0;
        let extent = [slot::PIERCING_THICKNESS, slot::PIERCING_TRAVEL];
        let has_strip = extent.into_iter().any(|place| self.get(place) > 0.0);
        let mut scene = Scene {
            rigid: has_rigid.then_some(RigidStop {
                travel: 0.0,
                restitution: 0.0,
            }),
            piercing: has_strip.then_some(Strip::PAPER),
            below: (below != Stop::None).then(|| {
                Box::new(Below {
                    clearance: 0.0,
                    stop: below,
                })
            }),
            ..Scene::of_stop(stop)
        };
        for &(parameter, place) in PARAMETERS {
            parameter.set(&mut scene, self.get(place));
        }
        scene
    }

    /// The law of a stop, without its parameters.
    fn stop(&self, laws: &Laws) -> Stop {
        let (stiffness, preload) = (0.0, 0.0);
        match self.number(laws.model) {
            number::KELVIN_VOIGT => Stop::KelvinVoigt {
                stiffness,
                release: match self.number(laws.release) {
                    number::ZERO_FORCE => Release::ZeroForce,
                    _ => Release::Clearance,
                },
            },
            number::PIECEWISE_LINEAR => Stop::PiecewiseLinear {
                loading: self.slopes(laws.loading),
                unloading: self.slopes(laws.unloading),
            },
            number::HERTZ => Stop::Hertz {
                stiffness,
                exponent: 0.0,
                dissipation: 0.0,
            },
            number::PRELOADED => Stop::Preloaded { stiffness, preload },
            number::RIGID => Stop::Rigid { restitution: 0.0 },
            _ => Stop::None,
        }
    }

    fn slopes(&self, (_, place): SlopeSlots) -> Vec<Slope> {
        let slope = |index| Slope {
            from: self.get(place.element(1 + index)),
            stiffness: self.get(place.element(1 + SLOPES + index)),
        };
        let count = self.get(place) as usize;
        (0..count.min(SLOPES)).map(slope).collect()
    }

    /// The state at the start time.
    pub fn start(&self) -> Start {
        Start::new(
            self.get(slot::INITIAL_POSITION),
            self.get(slot::INITIAL_VELOCITY),
        )
    }
}
