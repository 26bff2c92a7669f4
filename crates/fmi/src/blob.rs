//! Snapshots as bytes: a header that tells where they come from, and the instance's data.
//!
//! ```text
//! "softstop" | format | GUID of the unit | fingerprint of the data | length of the data | data
//!      8          4          16                     16                      8
//! ```
//!
//! The data are CBOR (RFC 8949). The fingerprint is a name-based UUID (SHA-1) in the unit's own namespace,
//! so bytes that were altered, cut off or left behind by another unit are refused before anything is
//! read out of them.

use uuid::Uuid;

use crate::fault::Fault;
use crate::guid::library_uuid;
use crate::instance::Instance;
use crate::unit::Unit;

const MAGIC: &[u8; 8] = b"softstop";
const FORMAT: u32 = 3;
const HEADER: usize = 8 + 4 + 16 + 16 + 8;

impl<U: Unit> Instance<U> {
    fn data(&self) -> Result<Vec<u8>, Fault> {
        let mut data = Vec::new();
        ciborium::into_writer(self, &mut data)
            .map_err(|error| Fault::Internal(error.to_string()))?;
        Ok(data)
    }

    /// How many bytes this instance takes.
    pub(crate) fn size_in_bytes(&self) -> Result<usize, Fault> {
        Ok(HEADER + self.data()?.len())
    }

    /// This instance as bytes.
    pub(crate) fn to_bytes(&self) -> Result<Vec<u8>, Fault> {
        let data = self.data()?;
        let guid = library_uuid::<U>();
        let mut bytes = Vec::with_capacity(HEADER + data.len());
        bytes.extend(MAGIC);
        bytes.extend(FORMAT.to_le_bytes());
        bytes.extend(guid.as_bytes());
        bytes.extend(Uuid::new_v5(&guid, &data).as_bytes());
        bytes.extend((data.len() as u64).to_le_bytes());
        bytes.extend(data);
        Ok(bytes)
    }

    /// The instance that was written as these bytes. Zeros after its end are passed over.
    pub(crate) fn from_bytes(bytes: &[u8]) -> Result<Self, Fault> {
        let data = checked(bytes, library_uuid::<U>())?;
        let instance: Self =
            ciborium::from_reader(data).map_err(|_| Fault::Blob("cannot be read"))?;
        let sizes = |instance: &Self| (instance.values.len(), instance.signals.len());
        let sound = instance
            .sound
            .as_ref()
            .map_or(instance.values.len(), Vec::len);
        if sizes(&instance) != sizes(&Self::new()) || sound != instance.values.len() {
            return Err(Fault::Blob("has another set of variables"));
        }
        Ok(instance)
    }
}

/// The data behind a header that holds.
fn checked(bytes: &[u8], own: Uuid) -> Result<&[u8], Fault> {
    let (head, rest) = bytes
        .split_at_checked(HEADER)
        .ok_or(Fault::Blob("is too short"))?;
    let (magic, head) = head.split_at(8);
    let (format, head) = head.split_at(4);
    let (guid, head) = head.split_at(16);
    let (fingerprint, length) = head.split_at(16);
    if magic != MAGIC {
        return Err(Fault::Blob("was not written by softstop"));
    }
    if format != FORMAT.to_le_bytes() {
        return Err(Fault::Blob("was written by another version of softstop"));
    }
    if guid != own.as_bytes() {
        return Err(Fault::Blob("was written by a unit with another GUID"));
    }
    let length = length.iter().rev().fold(0, |n, b| n << 8 | u64::from(*b));
    let (data, beyond) = usize::try_from(length)
        .ok()
        .and_then(|length| rest.split_at_checked(length))
        .ok_or(Fault::Blob("is cut off"))?;
    if beyond.iter().any(|byte| *byte != 0) {
        return Err(Fault::Blob("goes on after its end"));
    }
    if fingerprint != Uuid::new_v5(&own, data).as_bytes() {
        return Err(Fault::Blob("was altered"));
    }
    Ok(data)
}
