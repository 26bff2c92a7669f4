//! Snapshots as bytes: a header that tells where they come from, and the instance's data.
//!
//! ```text
//! "softstop" | format | GUID of the unit | fingerprint of the data | length of the data | data
//!      8          4          16                     16                      8
//! ```
//!
//! The data are MessagePack. The fingerprint is a name-based UUID (SHA-1) in the unit's own namespace,
//! so bytes that were altered, cut off or left behind by another unit are refused before anything is
//! read out of them.

use serde::{Deserialize, Serialize};
use softstop::{Simulation, Snapshot};
use uuid::Uuid;

use crate::error::Fault;
use crate::guid::library_uuid;
use crate::instance::{Experiment, Force, Instance, Lifecycle, Pending};
use crate::start::{SLOTS, StartValues, library_start_values};

const MAGIC: &[u8; 8] = b"softstop";
const FORMAT: u32 = 1;
const HEADER: usize = 8 + 4 + 16 + 16 + 8;

/// An instance as data. What a reset leads back to is the library's own.
#[derive(Serialize, Deserialize)]
struct Kept {
    parameters: Vec<f64>,
    lifecycle: Lifecycle,
    force: Force,
    material: bool,
    experiment: Option<Experiment>,
    simulation: Option<Snapshot>,
    pending: Pending,
    discarded: Option<(Snapshot, Force)>,
}

impl Instance {
    fn data(&self) -> Result<Vec<u8>, Fault> {
        let discarded = self.discarded.as_deref();
        let kept = Kept {
            parameters: self.parameters.values().to_vec(),
            lifecycle: self.lifecycle(),
            force: self.force,
            material: self.material,
            experiment: self.experiment,
            simulation: self.simulation.as_ref().map(Simulation::snapshot),
            pending: self.pending,
            discarded: discarded.map(|(simulation, force)| (simulation.snapshot(), *force)),
        };
        rmp_serde::to_vec_named(&kept).map_err(|error| Fault::Internal(error.to_string()))
    }

    /// How many bytes this instance takes.
    ///
    /// # Errors
    /// If its data cannot be written to memory.
    pub fn size_in_bytes(&self) -> Result<usize, Fault> {
        Ok(HEADER + self.data()?.len())
    }

    /// This instance as bytes.
    ///
    /// # Errors
    /// If its data cannot be written to memory, or the library's own GUID cannot be computed.
    pub fn to_bytes(&self) -> Result<Vec<u8>, Fault> {
        let data = self.data()?;
        let guid = own_uuid()?;
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
    ///
    /// # Errors
    /// [`Fault::Blob`] if the bytes were altered, cut off, or are those of another unit.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, Fault> {
        let data = checked(bytes)?;
        let kept: Kept = rmp_serde::from_slice(data).map_err(|_| blob("cannot be read"))?;
        let values: [f64; SLOTS] = kept
            .parameters
            .try_into()
            .map_err(|_| blob("has another set of parameters"))?;
        let simulation = kept.simulation.as_ref().map(Simulation::restored);
        let mut instance = Self::new(library_start_values());
        instance.parameters = StartValues::from_values(values);
        instance.lifecycle = kept.lifecycle;
        instance.force = kept.force;
        instance.material = kept.material;
        instance.experiment = kept.experiment;
        instance.simulation = simulation.transpose()?;
        instance.pending = kept.pending;
        if let Some((snapshot, force)) = &kept.discarded {
            instance.discarded = Some(Box::new((Simulation::restored(snapshot)?, *force)));
        }
        Ok(instance)
    }
}

/// The data behind a header that holds.
fn checked(bytes: &[u8]) -> Result<&[u8], Fault> {
    let (head, rest) = bytes
        .split_at_checked(HEADER)
        .ok_or_else(|| blob("is too short"))?;
    let (magic, head) = head.split_at(8);
    let (format, head) = head.split_at(4);
    let (guid, head) = head.split_at(16);
    let (fingerprint, length) = head.split_at(16);
    if magic != MAGIC {
        return Err(blob("was not written by softstop"));
    }
    if format != FORMAT.to_le_bytes() {
        return Err(blob("was written by another version of softstop"));
    }
    let own = own_uuid()?;
    if guid != own.as_bytes() {
        return Err(blob("was written by a unit with another GUID"));
    }
    let length = length.iter().rev().fold(0, |n, b| n << 8 | u64::from(*b));
    let (data, beyond) = usize::try_from(length)
        .ok()
        .and_then(|length| rest.split_at_checked(length))
        .ok_or_else(|| blob("is cut off"))?;
    if beyond.iter().any(|byte| *byte != 0) {
        return Err(blob("goes on after its end"));
    }
    if fingerprint != Uuid::new_v5(&own, data).as_bytes() {
        return Err(blob("was altered"));
    }
    Ok(data)
}

fn own_uuid() -> Result<Uuid, Fault> {
    library_uuid().ok_or_else(|| Fault::Internal("the GUID cannot be computed".to_owned()))
}

fn blob(what: &'static str) -> Fault {
    Fault::Blob { what }
}
