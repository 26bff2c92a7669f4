//! What an instruction set comes to on this processor.

use pulp::{Simd, WithSimd};

use super::dispatch::{ABREAST, dispatch};
use super::job::Instructions;
use super::lanes::Lanes;

/// What the lanes are made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Registers {
    /// The instruction set's name.
    pub name: &'static str,
    /// Motions that go in lock-step.
    pub lanes: usize,
}

impl Instructions {
    /// What this processor has of it.
    pub fn registers(self) -> Registers {
        let registers = dispatch(Measure, self);
        match self {
            Self::OneByOne => Registers {
                lanes: 1,
                ..registers
            },
            _ => registers,
        }
    }
}

struct Measure;

impl WithSimd for Measure {
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
            lanes: Lanes::<S, ABREAST>::COUNT,
        }
    }
}
