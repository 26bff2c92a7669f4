//! Serialized states of the FMU.

use softstop_fmu::library_guid;
use uuid::Uuid;

use crate::common::{ERROR, OK, Unit};

/// Bytes of a header: magic word, format, GUID, fingerprint, length.
const HEADER: usize = 8 + 4 + 16 + 16 + 8;

/// A unit some steps from the beginning as bytes.
///
/// # Panics
/// If a call is refused.
pub fn serialized() -> Vec<u8> {
    let unit = Unit::new();
    unit.begin();
    assert_eq!(unit.step(0.0, 12.0), OK);
    unit.serialized()
}

/// A serialized state, as it is and behind a header that fits: it is refused, or the unit goes on from it, and after a
/// reset begins anew.
///
/// # Panics
/// If not.
pub fn state(data: &[u8]) {
    take_up(data);
    if let Some((head, body)) = data.split_at_checked(HEADER) {
        take_up(&behind_fitting_header(head, body));
    }
}

/// Data behind a header that fits them, with magic word and format of another header.
///
/// # Panics
/// If the unit has no GUID.
pub fn behind_fitting_header(head: &[u8], body: &[u8]) -> Vec<u8> {
    let guid = library_guid();
    let own = Uuid::parse_str(guid.trim_matches(['{', '}'])).expect("a GUID");
    let mut bytes = head[..12].to_vec();
    bytes.extend(own.as_bytes());
    bytes.extend(Uuid::new_v5(&own, body).as_bytes());
    bytes.extend((body.len() as u64).to_le_bytes());
    bytes.extend(body);
    bytes
}

/// The status of a unit that takes up these bytes: it goes on from them, or refuses them, and after a reset begins anew.
///
/// # Panics
/// If not.
pub fn take_up(bytes: &[u8]) -> i32 {
    let unit = Unit::new();
    unit.begin();
    let taken = unit.take_up(bytes);
    match taken {
        OK => drop(unit.step(12.0, 1.0)),
        status => assert_eq!(status, ERROR),
    }
    assert_eq!(unit.reset(), OK);
    unit.begin();
    assert_eq!(unit.step(0.0, 1.0), OK);
    taken
}
