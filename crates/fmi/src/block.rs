//! The block of start values in a library.
//!
//! A packaged design must start with its own values, and know its own GUID, even if the importer sets
//! nothing and passes no resource folder. So the library carries name, description and start values in
//! one block of plain bytes behind a marker, and the packager patches these bytes in its copy.
#![allow(
    unsafe_code,
    reason = "a patched static must not be read as the known constant it was"
)]

/// Longest name in bytes.
pub(crate) const NAME: usize = 64;
/// Longest description in bytes.
pub(crate) const DESCRIPTION: usize = 256;

/// Marker, name, description and start values, as they lie in a library's read-only data.
#[repr(C)]
pub struct Block<V: ?Sized = [u64]> {
    marker: [u8; 16],
    name: [u8; NAME],
    description: [u8; DESCRIPTION],
    /// Bits of the start values, little-endian in memory whatever the machine.
    values: V,
}

impl<const N: usize> Block<[u64; N]> {
    /// The block of the unit with this `modelIdentifier`. Another unit, or one with another number of
    /// values, has another marker, so that its library is not taken for this one.
    pub const fn new(identifier: &str, name: &str, description: &str, values: &[f64; N]) -> Self {
        let mut bits = [0; N];
        let mut slot = 0;
        while slot < N {
            bits[slot] = values[slot].to_bits().to_le();
            slot += 1;
        }
        Self {
            marker: marker(identifier, N),
            name: padded(name),
            description: padded(description),
            values: bits,
        }
    }
}

impl Block {
    /// The marker. It is read from the block itself, lest a second copy of it lie in the library and be
    /// found in its stead.
    pub(crate) fn marker(&self) -> Vec<u8> {
        as_in_file(&self.marker)
    }

    pub(crate) fn name(&self) -> String {
        text(&self.name)
    }

    pub(crate) fn description(&self) -> String {
        text(&self.description)
    }

    pub(crate) fn values(&self) -> Vec<f64> {
        let bits = as_in_file(&self.values).into_iter();
        bits.map(|bits| f64::from_bits(u64::from_le(bits)))
            .collect()
    }
}

/// Sixteen bytes that nothing else holds by chance: a tag, and the identifier hashed (FNV-1a, 64 bits).
const fn marker(identifier: &str, values: usize) -> [u8; 16] {
    const TAG: [u8; 8] = [0x9d, b's', b't', b'a', b'r', b't', 0xf7, 0x02];
    let mut hash = 0xcbf2_9ce4_8422_2325 ^ values as u64;
    let mut place = 0;
    while place < identifier.len() {
        hash = (hash ^ identifier.as_bytes()[place] as u64).wrapping_mul(0x0100_0000_01b3);
        place += 1;
    }
    let (hash, mut marker) = (hash.to_le_bytes(), [0; 16]);
    let mut place = 0;
    while place < 8 {
        marker[place] = TAG[place];
        marker[place + 8] = hash[place];
        place += 1;
    }
    marker
}

/// A text that is not too long, followed by zeros.
const fn padded<const N: usize>(text: &str) -> [u8; N] {
    let mut bytes = [0; N];
    let mut place = 0;
    while place < text.len() {
        bytes[place] = text.as_bytes()[place];
        place += 1;
    }
    bytes
}

fn text(bytes: &[u8]) -> String {
    let bytes = as_in_file(bytes);
    let end = bytes.iter().position(|byte| *byte == 0);
    String::from_utf8_lossy(&bytes[..end.unwrap_or(bytes.len())]).into_owned()
}

/// What lies there now, which may differ from what the compiler saw.
fn as_in_file<T: Copy>(part: &[T]) -> Vec<T> {
    part.iter()
        // SAFETY: the pointer comes from a reference.
        .map(|item| unsafe { std::ptr::read_volatile(item) })
        .collect()
}
