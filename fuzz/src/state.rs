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
    let Some((head, body)) = data.split_at_checked(HEADER) else {
        return;
    };
    let guid = library_guid().expect("a GUID");
    let own = Uuid::parse_str(guid.trim_matches(['{', '}'])).expect("a GUID");
    let mut bytes = head[..12].to_vec();
    bytes.extend(own.as_bytes());
    bytes.extend(Uuid::new_v5(&own, body).as_bytes());
    bytes.extend((body.len() as u64).to_le_bytes());
    bytes.extend(body);
    take_up(&bytes);
}

fn take_up(bytes: &[u8]) {
    let unit = Unit::new();
    unit.begin();
    match unit.take_up(bytes) {
        OK => drop(unit.step(12.0, 1.0)),
        status => assert_eq!(status, ERROR),
    }
    assert_eq!(unit.reset(), OK);
    unit.begin();
    assert_eq!(unit.step(0.0, 1.0), OK);
}
