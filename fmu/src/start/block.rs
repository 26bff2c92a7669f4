//! The block of start values in the library.

use super::{SLOTS, StartValues};

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
