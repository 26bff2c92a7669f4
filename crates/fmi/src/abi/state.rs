//! Snapshots that the importer holds, by a handle each.

use libc::c_void;

use super::component::{Component, Host};
use super::pointers::{read, write, write_one};
use crate::fault::Fault;
use crate::instance::Instance;
use crate::lifecycle::Lifecycle;
use crate::unit::Unit;

/// What a snapshot's handle points to.
///
/// # Safety
/// NULL, or what [`keep`] or [`restore`] gave and nobody has freed.
unsafe fn kept<'a, U: Unit>(state: *mut c_void) -> Result<&'a Instance<U>, Fault> {
    // SAFETY: by this function's contract.
    unsafe { state.cast::<Instance<U>>().as_ref() }.ok_or(Fault::Null {
        argument: "FMUstate",
    })
}

/// Keeps a snapshot; one that was kept before is overwritten.
///
/// # Safety
/// NULL, or a place that holds NULL or a handle as [`kept`] takes.
pub(crate) unsafe fn keep<U: Unit, H: Host>(
    component: &Component<U, H>,
    state: *mut *mut c_void,
) -> Result<(), Fault> {
    // SAFETY: by this function's contract.
    let (state, kept) = unsafe {
        let state = write_one("FMUstate", state)?;
        let kept = state.cast::<Instance<U>>().as_mut();
        (state, kept)
    };
    match kept {
        Some(kept) => kept.clone_from(&component.instance),
        None => *state = Box::into_raw(Box::new(component.instance.clone())).cast(),
    }
    Ok(())
}

/// Goes back to a snapshot.
///
/// # Safety
/// As [`kept`].
pub(crate) unsafe fn go_back<U: Unit, H: Host>(
    component: &mut Component<U, H>,
    state: *mut c_void,
) -> Result<(), Fault> {
    // SAFETY: by this function's contract.
    let kept = unsafe { kept::<U>(state) }?;
    let is_other = match component.host.is_for_exchange() {
        true => kept.exchange.is_none() && !kept.lifecycle.is_before_start(),
        false => kept.exchange.is_some(),
    };
    if is_other {
        return Err(Fault::Blob("is of another interface type"));
    }
    let in_event_mode = kept.lifecycle == Lifecycle::Event || kept.awaits;
    if in_event_mode && !component.host.has_event_mode() {
        return Err(Fault::Blob("stands at an event, which is for event mode"));
    }
    component.instance.clone_from(kept);
    Ok(())
}

/// Frees a snapshot and sets its handle to NULL; NULL is allowed.
///
/// # Safety
/// As [`keep`].
pub(crate) unsafe fn free<U: Unit>(state: *mut *mut c_void) {
    // SAFETY: by this function's contract; the handle is gone afterwards.
    unsafe {
        if let Some(state) = state.as_mut()
            && !state.is_null()
        {
            drop(Box::from_raw(state.cast::<Instance<U>>()));
            *state = std::ptr::null_mut();
        }
    }
}

/// How many bytes a snapshot takes.
///
/// # Safety
/// As [`kept`]; `size` is NULL or a place for a number.
pub(crate) unsafe fn measure<U: Unit>(state: *mut c_void, size: *mut usize) -> Result<(), Fault> {
    // SAFETY: by this function's contract.
    unsafe { *write_one("size", size)? = kept::<U>(state)?.size_in_bytes()? };
    Ok(())
}

/// Writes a snapshot as bytes; what is left of them becomes zero.
///
/// # Safety
/// As [`kept`]; `bytes` is NULL or a place for `size` bytes.
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
    *state = Box::into_raw(Box::new(Instance::<U>::from_bytes(bytes)?)).cast();
    Ok(())
}
