//! The registers of an instruction set on this processor: name and number of lanes.

use pulp::{Simd, WithSimd};

use super::dispatch::{REGISTERS_PER_BATCH, dispatch};
use super::lanes::Lanes;
use super::machine::Instructions;

/// The vector registers that hold the lanes: the name of their instruction set and how many motions go at once.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Registers {
    /// The instruction set's name.
    pub name: &'static str,
    /// Motions that go in lock-step.
    pub lanes: usize,
}

impl Instructions {
    /// The registers that this processor uses when it is asked for this instruction set.
    pub fn registers(self) -> Registers {
        dispatch(MeasureRegisters, self)
    }
}

struct MeasureRegisters;

impl WithSimd for MeasureRegisters {
    type Output = Registers;

    fn with_simd<S: Simd>(self, _: S) -> Registers {
        let name = match S::F64_LANES {
            8 => "AVX-512",
            4 => "AVX2",
            2 if cfg!(target_arch = "aarch64") => "NEON",
            2 => "128 bits",
            _ => "portable",
        };
        Registers {
            name,
            lanes: Lanes::<S, REGISTERS_PER_BATCH>::COUNT,
        }
    }
}
