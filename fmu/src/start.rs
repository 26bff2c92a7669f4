//! Start values of the parameters, and the block in the library that holds them.
//!
//! A packaged design must start with its own values even if the importer sets none and passes no
//! resource folder. So the library carries them in one block of plain bytes behind a marker, and
//! the packager patches these bytes in the copy that it packs.

use softstop::samples;
use softstop::{Excitation, Piercing, Scene, Start, Stop};

use crate::units::{STOP_NONE, STOP_PRELOADED};

/// Position of a parameter in [`StartValues`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(usize)]
#[expect(missing_docs, reason = "each is described in the table of variables")]
pub enum Slot {
    Mass,
    Stiffness,
    Damping,
    Amplitude,
    Frequency,
    DrivePhase,
    Clearance,
    ContactDamping,
    StopModel,
    StopStiffness,
    StopPreload,
    PiercingStiffness,
    PiercingFriction,
    PiercingThickness,
    PiercingTravel,
    InitialPosition,
    InitialVelocity,
}

/// Number of parameters.
pub const SLOTS: usize = Slot::InitialVelocity as usize + 1;

/// One value for each parameter; an enumeration is held as its number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StartValues([f64; SLOTS]);

impl StartValues {
    /// The loaded machine on its z = 1 orbit at eta = 1.15, rho = 10 (Peterka 2003, point B).
    pub const DEFAULT: Self = Self::loaded_machine();

    /// The value of one parameter.
    pub const fn get(&self, slot: Slot) -> f64 {
        self.0[slot as usize]
    }

    /// Puts in the value of one parameter.
    pub const fn set(&mut self, slot: Slot, value: f64) {
        self.0[slot as usize] = value;
    }

    /// The start values that make the unit run `scene` from `start`.
    ///
    /// What the scene does not have (a stop, a strip) keeps the defaults of its stiffnesses.
    pub fn from_scene(scene: &Scene, start: Start) -> Self {
        Self::of(scene, start)
    }

    /// [`samples::LOADED`] with m = 1 kg, k1 = 1 N/m and F0 = 1 N, so that SI units and the paper's
    /// ratios coincide; as a constant, since the library's block of start values is one.
    const fn loaded_machine() -> Self {
        let sample = samples::LOADED;
        let ratios = sample.ratios;
        let mut values = Self([0.0; SLOTS]);
        values.set(Slot::Mass, 1.0);
        values.set(Slot::Stiffness, 1.0);
        values.set(Slot::Damping, 2.0 * ratios.damping);
        values.set(Slot::Amplitude, 1.0);
        values.set(Slot::Frequency, ratios.frequency);
        values.set(Slot::Clearance, ratios.clearance);
        values.set(Slot::ContactDamping, 2.0 * ratios.contact_damping);
        values.set(Slot::StopModel, STOP_PRELOADED as f64);
        values.set(Slot::StopStiffness, ratios.stiffness);
        values.set(Slot::StopPreload, ratios.preload);
        if let Some(strip) = ratios.piercing {
            values.set(Slot::PiercingStiffness, strip.stiffness);
            values.set(Slot::PiercingFriction, strip.friction);
            values.set(Slot::PiercingThickness, strip.thickness);
            values.set(Slot::PiercingTravel, strip.travel);
        }
        values.set(Slot::InitialPosition, sample.position);
        values.set(Slot::InitialVelocity, sample.velocity);
        values
    }

    fn of(scene: &Scene, start: Start) -> Self {
        let mut values = Self::DEFAULT;
        match scene.stop {
            Stop::Preloaded { stiffness, preload } => {
                values.set(Slot::StopStiffness, stiffness);
                values.set(Slot::StopPreload, preload);
            }
            _ => values.set(Slot::StopModel, f64::from(STOP_NONE)),
        }
        let strip = scene.piercing.unwrap_or(Piercing {
            thickness: 0.0,
            travel: 0.0,
            stiffness: values.get(Slot::PiercingStiffness),
            friction: values.get(Slot::PiercingFriction),
        });
        values.set(Slot::Mass, scene.mass);
        values.set(Slot::Stiffness, scene.stiffness);
        values.set(Slot::Damping, scene.damping);
        values.set(Slot::Amplitude, scene.excitation.amplitude);
        values.set(Slot::Frequency, scene.excitation.frequency);
        values.set(Slot::DrivePhase, scene.excitation.phase);
        values.set(Slot::Clearance, scene.clearance);
        values.set(Slot::ContactDamping, scene.contact_damping);
        values.set(Slot::PiercingStiffness, strip.stiffness);
        values.set(Slot::PiercingFriction, strip.friction);
        values.set(Slot::PiercingThickness, strip.thickness);
        values.set(Slot::PiercingTravel, strip.travel);
        values.set(Slot::InitialPosition, start.position);
        values.set(Slot::InitialVelocity, start.velocity);
        values
    }

    /// The scene that these values describe; it has a strip if thickness or travel is positive.
    pub fn scene(&self) -> Scene {
        let stop = if self.get(Slot::StopModel) == f64::from(STOP_NONE) {
            Stop::None
        } else {
            Stop::Preloaded {
                stiffness: self.get(Slot::StopStiffness),
                preload: self.get(Slot::StopPreload),
            }
        };
        let strip = Piercing {
            stiffness: self.get(Slot::PiercingStiffness),
            friction: self.get(Slot::PiercingFriction),
            thickness: self.get(Slot::PiercingThickness),
            travel: self.get(Slot::PiercingTravel),
        };
        Scene {
            mass: self.get(Slot::Mass),
            stiffness: self.get(Slot::Stiffness),
            damping: self.get(Slot::Damping),
            excitation: Excitation {
                amplitude: self.get(Slot::Amplitude),
                frequency: self.get(Slot::Frequency),
                phase: self.get(Slot::DrivePhase),
            },
            clearance: self.get(Slot::Clearance),
            contact_damping: self.get(Slot::ContactDamping),
            stop,
            rigid: None,
            piercing: (strip.thickness > 0.0 || strip.travel > 0.0).then_some(strip),
        }
    }

    /// The state at the start time.
    pub fn start(&self) -> Start {
        Start {
            position: self.get(Slot::InitialPosition),
            velocity: self.get(Slot::InitialVelocity),
        }
    }

    /// The bytes that stand behind the marker.
    pub(crate) fn to_bytes(self) -> Vec<u8> {
        self.0
            .iter()
            .flat_map(|value| value.to_le_bytes())
            .collect()
    }
}

impl Default for StartValues {
    fn default() -> Self {
        Self::DEFAULT
    }
}

/// Marker and start values, as they lie in the library's read-only data.
#[repr(C)]
struct StartBlock {
    marker: [u8; 16],
    values: [u64; SLOTS],
}

/// Bits of the start values, little-endian in memory whatever the machine.
const fn bits(values: &StartValues) -> [u64; SLOTS] {
    let mut bits = [0; SLOTS];
    let mut slot = 0;
    while slot < SLOTS {
        bits[slot] = values.0[slot].to_bits().to_le();
        slot += 1;
    }
    bits
}

/// The one place that the packager patches. The marker's last byte is the number of values, so
/// that a library with another set of parameters is not taken for this one.
#[used]
static START: StartBlock = StartBlock {
    marker: [
        0x9d,
        b's',
        b'o',
        b'f',
        b't',
        b's',
        b't',
        b'o',
        b'p',
        0xe4,
        0x01,
        b's',
        b't',
        b'a',
        0xf7,
        SLOTS as u8,
    ],
    values: bits(&StartValues::DEFAULT),
};

/// The start values of this very library: the defaults, or those of the design it was packed with.
pub fn library_start_values() -> StartValues {
    // Volatile, because the bytes of the block may differ from those the compiler saw.
    #[allow(
        unsafe_code,
        reason = "a patched static must not be read as the known constant it was"
    )]
    // SAFETY: the pointer comes from a reference to a live static of that type.
    let bits = unsafe { std::ptr::read_volatile(&raw const START.values) };
    StartValues(bits.map(|value| f64::from_bits(u64::from_le(value))))
}

/// The marker of the block. It is read from the block itself, lest a second copy of it lie in the
/// library and be found in its stead.
pub(crate) fn marker() -> [u8; 16] {
    #[allow(
        unsafe_code,
        reason = "keeps the compiler from making a copy of the constant"
    )]
    // SAFETY: the pointer comes from a reference to a live static of that type.
    unsafe {
        std::ptr::read_volatile(&raw const START.marker)
    }
}
