//! Snapshots that the importer holds, by a handle each.
//!
//! What a handle points to begins with the GUID of the unit: an importer may run several FMUs, and hand the state of one to
//! another.

use std::ptr::NonNull;

use libc::c_void;
use uuid::Uuid;

use super::component::Component;
use super::pointers::{read, write, write_one};
use crate::fault::Fault;
use crate::guid::library_uuid;
use crate::instance::Instance;
use crate::lifecycle::Lifecycle;
use crate::unit::Unit;

/// Which unit a snapshot is of.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Origin {
    marker: [u8; 8],
    guid: Uuid,
}

impl Origin {
    /// That of the snapshots of this library.
    fn of_library<U: Unit>() -> Self {
        Self {
            marker: *b"softstop",
            guid: library_uuid::<U>(),
        }
    }
}

/// What a snapshot's handle points to.
#[repr(C)]
struct Snapshot<U: Unit> {
    origin: Origin,
    instance: Instance<U>,
}

impl<U: Unit> Snapshot<U> {
    /// A handle of a new snapshot.
    fn handle(instance: Instance<U>) -> *mut c_void {
        let origin = Origin::of_library::<U>();
        Box::into_raw(Box::new(Self { origin, instance })).cast()
    }

    /// What a handle points to; none if it is NULL.
    ///
    /// # Errors
    /// [`Fault::ForeignState`] if it is of another unit.
    ///
    /// # Safety
    /// NULL, or what [`keep`] or [`restore`] of any unit gave and nobody has freed.
    unsafe fn of_handle(state: *mut c_void) -> Result<Option<NonNull<Self>>, Fault> {
        let Some(origin) = NonNull::new(state.cast::<Origin>()) else {
            return Ok(None);
        };
        // SAFETY: by this function's contract; snapshots of all units begin with their origin.
        match unsafe { *origin.as_ref() } == Origin::of_library::<U>() {
            true => Ok(Some(origin.cast())),
            false => Err(Fault::ForeignState),
        }
    }
}

/// The instance of a snapshot.
///
/// # Safety
/// As [`Snapshot::of_handle`].
unsafe fn kept<'a, U: Unit>(state: *mut c_void) -> Result<&'a Instance<U>, Fault> {
    // SAFETY: by this function's contract.
    let snapshot = unsafe { Snapshot::<U>::of_handle(state)?.map(|it| it.as_ref()) };
    let snapshot = snapshot.ok_or(Fault::Null {
        argument: "FMUstate",
    })?;
    Ok(&snapshot.instance)
}

/// Keeps a snapshot; one that was kept before is overwritten.
///
/// # Safety
/// NULL, or a place that holds NULL or a handle as [`Snapshot::of_handle`] takes.
pub(crate) unsafe fn keep<U: Unit>(
    component: &Component<U>,
    state: *mut *mut c_void,
) -> Result<(), Fault> {
    // SAFETY: by this function's contract.
    let (state, kept) = unsafe {
        let state = write_one("FMUstate", state)?;
        let kept = Snapshot::<U>::of_handle(*state)?.map(|mut it| it.as_mut());
        (state, kept)
    };
    match kept {
        Some(kept) => kept.instance.clone_from(&component.instance),
        None => *state = Snapshot::handle(component.instance.clone()),
    }
    Ok(())
}

/// Goes back to a snapshot.
///
/// # Safety
/// As [`Snapshot::of_handle`].
pub(crate) unsafe fn go_back<U: Unit>(
    component: &mut Component<U>,
    state: *mut c_void,
) -> Result<(), Fault> {
    // SAFETY: by this function's contract.
    let kept = unsafe { kept::<U>(state) }?;
    let is_other = match component.importer.integrates {
        true => kept.exchange.is_none() && !kept.lifecycle.is_before_start(),
        false => kept.exchange.is_some(),
    };
    if is_other {
        return Err(Fault::Blob("is of another interface type"));
    }
    let in_event_mode = kept.lifecycle == Lifecycle::Event || kept.awaits;
    if in_event_mode && !component.importer.has_event_mode() {
        return Err(Fault::Blob("stands at an event, which is for event mode"));
    }
    component.instance.clone_from(kept);
    Ok(())
}

/// Frees a snapshot and sets its handle to NULL; NULL is allowed.
///
/// # Safety
/// As [`keep`].
pub(crate) unsafe fn free<U: Unit>(state: *mut *mut c_void) -> Result<(), Fault> {
    // SAFETY: by this function's contract; the handle is gone afterwards.
    unsafe {
        if let Some(state) = state.as_mut()
            && let Some(snapshot) = Snapshot::<U>::of_handle(*state)?
        {
            drop(Box::from_raw(snapshot.as_ptr()));
            *state = std::ptr::null_mut();
        }
    }
    Ok(())
}

/// How many bytes a snapshot takes.
///
/// # Safety
/// As [`Snapshot::of_handle`]; `size` is NULL or a place for a number.
pub(crate) unsafe fn measure<U: Unit>(state: *mut c_void, size: *mut usize) -> Result<(), Fault> {
    // SAFETY: by this function's contract.
    unsafe { *write_one("size", size)? = kept::<U>(state)?.size_in_bytes()? };
    Ok(())
}

/// Writes a snapshot as bytes; what is left of them becomes zero.
///
/// # Safety
/// As [`Snapshot::of_handle`]; `bytes` is NULL or a place for `size` bytes.
pub(crate) unsafe fn store<U: Unit>(
    state: *mut c_void,
    bytes: *mut u8,
    size: usize,
) -> Result<(), Fault> {
    // SAFETY: by this function's contract.
    let written = unsafe { kept::<U>(state) }?.to_bytes()?;
    let needed = written.len();
    if size < needed {
        return Err(Fault::Room { size, needed });
    }
    // SAFETY: by this function's contract.
    let bytes = unsafe { write("serializedState", bytes, size) }?;
    let (room, beyond) = bytes.split_at_mut(needed);
    room.copy_from_slice(&written);
    beyond.fill(0);
    Ok(())
}

/// Makes a snapshot of bytes. The handle's old content is not looked at.
///
/// # Safety
/// `bytes` is NULL or points to `size` bytes, `state` is NULL or a place for a handle.
pub(crate) unsafe fn restore<U: Unit>(
    bytes: *const u8,
    size: usize,
    state: *mut *mut c_void,
) -> Result<(), Fault> {
    // SAFETY: by this function's contract.
    let (state, bytes) = unsafe {
        let state = write_one("FMUstate", state)?;
        (state, read("serializedState", bytes, size)?)
    };
    *state = Snapshot::handle(Instance::<U>::from_bytes(bytes)?);
    Ok(())
}
