//! Serialized states of the FMU.
#![allow(unsafe_code, reason = "calls the C functions as an importer does")]

use std::ffi::c_char;
use std::ptr;

use softstop_fmu::ffi::*;
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
    let (mut kept, mut size) = (ptr::null_mut(), 0);
    // SAFETY: the instance is alive, the bytes are as long as said, and the state is freed once.
    unsafe {
        assert_eq!(fmi2GetFMUstate(unit.component, &raw mut kept), OK);
        assert_eq!(
            fmi2SerializedFMUstateSize(unit.component, kept, &raw mut size),
            OK
        );
        let mut bytes = vec![0u8; size];
        let place = bytes.as_mut_ptr().cast::<c_char>();
        assert_eq!(fmi2SerializeFMUstate(unit.component, kept, place, size), OK);
        assert_eq!(fmi2FreeFMUstate(unit.component, &raw mut kept), OK);
        bytes
    }
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
    let mut kept = ptr::null_mut();
    // SAFETY: the instance is alive, the bytes are as long as said, and the state is freed once.
    unsafe {
        let from = bytes.as_ptr().cast::<c_char>();
        let status = fmi2DeSerializeFMUstate(unit.component, from, bytes.len(), &raw mut kept);
        if status != OK {
            assert_eq!(status, ERROR);
            assert!(kept.is_null());
        } else if fmi2SetFMUstate(unit.component, kept) == OK {
            let _ = unit.step(12.0, 1.0);
        }
        if !kept.is_null() {
            assert_eq!(fmi2FreeFMUstate(unit.component, &raw mut kept), OK);
        }
        assert_eq!(fmi2Reset(unit.component), OK);
    }
    unit.begin();
    assert_eq!(unit.step(0.0, 1.0), OK);
}
