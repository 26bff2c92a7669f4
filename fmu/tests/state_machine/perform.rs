//! Calls as C calls.

use std::ffi::{CString, c_char, c_int, c_void};
use std::ptr;

use softstop_fmi2::*;

use super::calls::{Call, Null, StatusOf, Type};
use crate::common::call;

/// Name and status of a C function, and the values that it gave.
pub type Answer = ((&'static str, c_int), Vec<f64>);

/// Makes a call that needs nothing but the instance.
pub fn perform(component: *mut c_void, call: &Call) -> Answer {
    // SAFETY: the component is NULL or alive, arrays are as long as they are said to be or NULL.
    let done = unsafe {
        match call {
            Call::SetDebugLogging(on, names, null) => {
                set_debug_logging(component, *on, names, *null)
            }
            Call::SetupExperiment(tolerance, start, stop) => call!(fmi2SetupExperiment(
                component,
                tolerance.is_some().into(),
                tolerance.unwrap_or(f64::NAN),
                *start,
                stop.is_some().into(),
                stop.unwrap_or(f64::NAN),
            )),
            Call::EnterInitializationMode => call!(fmi2EnterInitializationMode(component)),
            Call::ExitInitializationMode => call!(fmi2ExitInitializationMode(component)),
            Call::Terminate => call!(fmi2Terminate(component)),
            Call::Reset => call!(fmi2Reset(component)),
            Call::Get(kind, references, null) => return get(component, *kind, references, *null),
            Call::Set(kind, pairs, null) => set(component, *kind, pairs, *null),
            Call::Directional(unknowns, knowns, null) => {
                let (by, seed): (Vec<_>, Vec<_>) = knowns.iter().copied().unzip();
                let mut values = vec![f64::NAN; unknowns.len()];
                let done = call!(fmi2GetDirectionalDerivative(
                    component,
                    null.first(unknowns.as_ptr()),
                    unknowns.len(),
                    by.as_ptr(),
                    by.len(),
                    null.second(seed.as_ptr()),
                    values.as_mut_ptr(),
                ));
                return (done, values);
            }
            Call::SetInputDerivatives(rows, null) => {
                let references: Vec<_> = rows.iter().map(|row| row.0).collect();
                let (orders, values): (Vec<_>, Vec<_>) =
                    rows.iter().map(|row| (row.1, row.2)).unzip();
                call!(fmi2SetRealInputDerivatives(
                    component,
                    null.first(references.as_ptr()),
                    rows.len(),
                    null.second(orders.as_ptr()),
                    values.as_ptr(),
                ))
            }
            Call::GetOutputDerivatives(rows, null) => {
                let (references, orders): (Vec<_>, Vec<_>) = rows.iter().copied().unzip();
                let mut values = vec![f64::NAN; rows.len()];
                let done = call!(fmi2GetRealOutputDerivatives(
                    component,
                    null.first(references.as_ptr()),
                    rows.len(),
                    orders.as_ptr(),
                    null.second(values.as_mut_ptr()).cast_mut(),
                ));
                return (done, values);
            }
            Call::CancelStep => call!(fmi2CancelStep(component)),
            Call::Status(of, kind, null) => status(component, *of, *kind, *null),
            other => unreachable!("{other:?} needs more than the instance"),
        }
    };
    (done, vec![])
}

unsafe fn set_debug_logging(
    component: *mut c_void,
    on: c_int,
    names: &[&str],
    null: Null,
) -> (&'static str, c_int) {
    let texts = names
        .iter()
        .map(|name| CString::new(*name).expect("no NUL"));
    let texts: Vec<_> = texts.collect();
    let pointers = texts.iter().map(|text| match text.as_bytes() {
        b"NULL" => ptr::null(),
        _ => text.as_ptr(),
    });
    let pointers: Vec<_> = pointers.collect();
    let array = null.first(pointers.as_ptr());
    unsafe { call!(fmi2SetDebugLogging(component, on, names.len(), array)) }
}

unsafe fn get(component: *mut c_void, kind: Type, references: &[u32], null: Null) -> Answer {
    let count = references.len();
    let vr = null.first(references.as_ptr());
    let (mut reals, mut numbers) = (vec![f64::NAN; count], vec![c_int::MIN; count]);
    let mut texts = vec![ptr::null::<c_char>(); count];
    let real = null.second(reals.as_mut_ptr()).cast_mut();
    let number = null.second(numbers.as_mut_ptr()).cast_mut();
    let text = null.second(texts.as_mut_ptr()).cast_mut();
    let done = unsafe {
        match kind {
            Type::Real => return (call!(fmi2GetReal(component, vr, count, real)), reals),
            Type::Integer => call!(fmi2GetInteger(component, vr, count, number)),
            Type::Boolean => call!(fmi2GetBoolean(component, vr, count, number)),
            Type::String => call!(fmi2GetString(component, vr, count, text)),
        }
    };
    (done, numbers.into_iter().map(f64::from).collect())
}

unsafe fn set(
    component: *mut c_void,
    kind: Type,
    pairs: &[(u32, f64)],
    null: Null,
) -> (&'static str, c_int) {
    let (references, reals): (Vec<_>, Vec<_>) = pairs.iter().copied().unzip();
    let numbers: Vec<_> = reals.iter().map(|value| *value as c_int).collect();
    let texts = vec![c"text".as_ptr(); pairs.len()];
    let (count, vr) = (pairs.len(), null.first(references.as_ptr()));
    let (real, text) = (null.second(reals.as_ptr()), null.second(texts.as_ptr()));
    let number = null.second(numbers.as_ptr());
    unsafe {
        match kind {
            Type::Real => call!(fmi2SetReal(component, vr, count, real)),
            Type::Integer => call!(fmi2SetInteger(component, vr, count, number)),
            Type::Boolean => call!(fmi2SetBoolean(component, vr, count, number)),
            Type::String => call!(fmi2SetString(component, vr, count, text)),
        }
    }
}

unsafe fn status(
    component: *mut c_void,
    of: StatusOf,
    kind: c_int,
    null: Null,
) -> (&'static str, c_int) {
    let (mut number, mut real, mut text) = (c_int::MIN, f64::NAN, ptr::null::<c_char>());
    let value = null.first(&raw mut number).cast_mut();
    let real = null.first(&raw mut real).cast_mut();
    let text = null.first(&raw mut text).cast_mut();
    unsafe {
        match of {
            StatusOf::Step => call!(fmi2GetStatus(component, kind, value)),
            StatusOf::Integer => call!(fmi2GetIntegerStatus(component, kind, value)),
            StatusOf::Boolean => call!(fmi2GetBooleanStatus(component, kind, value)),
            StatusOf::Real => call!(fmi2GetRealStatus(component, kind, real)),
            StatusOf::String => call!(fmi2GetStringStatus(component, kind, text)),
        }
    }
}
