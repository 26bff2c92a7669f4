//! Pointers of the importer as slices and strings.

use std::borrow::Cow;
use std::ffi::CStr;

use libc::c_char;

use crate::fault::Fault;

fn check<T>(argument: &'static str, pointer: *const T, length: usize) -> Result<(), Fault> {
    if pointer.is_null() {
        return Err(Fault::Null { argument });
    }
    if length > isize::MAX as usize / size_of::<T>() {
        return Err(Fault::Length { argument, length });
    }
    Ok(())
}

/// An array to read; without elements NULL is fine.
///
/// # Safety
/// A pointer other than NULL must point to `length` values that live as long as the call.
pub(crate) unsafe fn read<'a, T>(
    argument: &'static str,
    pointer: *const T,
    length: usize,
) -> Result<&'a [T], Fault> {
    if length == 0 {
        return Ok(&[]);
    }
    check(argument, pointer, length)?;
    // SAFETY: not NULL, not too long, and valid by this function's contract.
    Ok(unsafe { std::slice::from_raw_parts(pointer, length) })
}

/// An array to write; without elements NULL is fine.
///
/// # Safety
/// As [`read`], and nothing else may use the array during the call.
pub(crate) unsafe fn write<'a, T>(
    argument: &'static str,
    pointer: *mut T,
    length: usize,
) -> Result<&'a mut [T], Fault> {
    if length == 0 {
        return Ok(&mut []);
    }
    check(argument, pointer, length)?;
    // SAFETY: not NULL, not too long, and valid by this function's contract.
    Ok(unsafe { std::slice::from_raw_parts_mut(pointer, length) })
}

/// A single value to write.
///
/// # Safety
/// As [`write`] with one element.
pub(crate) unsafe fn write_one<'a, T>(
    argument: &'static str,
    pointer: *mut T,
) -> Result<&'a mut T, Fault> {
    // SAFETY: NULL, or valid by this function's contract.
    unsafe { pointer.as_mut() }.ok_or(Fault::Null { argument })
}

/// A string; what is not UTF-8 in it is replaced.
///
/// # Safety
/// A pointer other than NULL must point to a string that ends with NUL.
pub(crate) unsafe fn string<'a>(
    argument: &'static str,
    pointer: *const c_char,
) -> Result<Cow<'a, str>, Fault> {
    if pointer.is_null() {
        return Err(Fault::Null { argument });
    }
    // SAFETY: not NULL, and valid by this function's contract.
    Ok(unsafe { CStr::from_ptr(pointer) }.to_string_lossy())
}
