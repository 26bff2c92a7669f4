//! Calls as C calls.

use std::ffi::{CString, c_char, c_int, c_uint, c_void};
use std::ptr;

use softstop_fmi2::*;

use super::calls::{Call, Null, StatusOf, Type};

/// The pointer to an argument unless this one is to be NULL.
fn unless<T>(null: Null, place: Null, pointer: *const T) -> *const T {
    if null == place { ptr::null() } else { pointer }
}

fn unless_mut<T>(null: Null, place: Null, pointer: *mut T) -> *mut T {
    if null == place {
        ptr::null_mut()
    } else {
        pointer
    }
}

/// Makes a call that needs nothing but the instance; returns its status and the values it gave.
pub fn perform(component: *mut c_void, call: &Call) -> (c_int, Vec<f64>) {
    // SAFETY: the component is NULL or alive, arrays are as long as they are said to be or NULL.
    unsafe {
        match call {
            Call::SetDebugLogging(on, names, null) => {
                (set_debug_logging(component, *on, names, *null), vec![])
            }
            Call::SetupExperiment(tolerance, start, stop) => (
                fmi2SetupExperiment(
                    component,
                    c_int::from(tolerance.is_some()),
                    tolerance.unwrap_or(f64::NAN),
                    *start,
                    c_int::from(stop.is_some()),
                    stop.unwrap_or(f64::NAN),
                ),
                vec![],
            ),
            Call::EnterInitializationMode => (fmi2EnterInitializationMode(component), vec![]),
            Call::ExitInitializationMode => (fmi2ExitInitializationMode(component), vec![]),
            Call::Terminate => (fmi2Terminate(component), vec![]),
            Call::Reset => (fmi2Reset(component), vec![]),
            Call::Get(kind, references, null) => get(component, *kind, references, *null),
            Call::Set(kind, pairs, null) => (set(component, *kind, pairs, *null), vec![]),
            Call::Directional(unknowns, knowns, null) => {
                directional(component, unknowns, knowns, *null)
            }
            Call::SetInputDerivatives(rows, null) => {
                (set_input_derivatives(component, rows, *null), vec![])
            }
            Call::GetOutputDerivatives(rows, null) => {
                get_output_derivatives(component, rows, *null)
            }
            Call::CancelStep => (fmi2CancelStep(component), vec![]),
            Call::Status(of, kind, null) => (status(component, *of, *kind, *null), vec![]),
            other => unreachable!("{other:?} needs more than the instance"),
        }
    }
}

unsafe fn set_debug_logging(
    component: *mut c_void,
    on: c_int,
    names: &[&str],
    null: Null,
) -> c_int {
    let texts: Vec<_> = names
        .iter()
        .map(|name| CString::new(*name).expect("no NUL"))
        .collect();
    let pointers: Vec<_> = texts
        .iter()
        .map(|text| {
            if text.as_bytes() == b"NULL" {
                ptr::null()
            } else {
                text.as_ptr()
            }
        })
        .collect();
    let array = unless(null, Null::First, pointers.as_ptr());
    unsafe { fmi2SetDebugLogging(component, on, names.len(), array) }
}

unsafe fn get(
    component: *mut c_void,
    kind: Type,
    references: &[c_uint],
    null: Null,
) -> (c_int, Vec<f64>) {
    let count = references.len();
    let vr = unless(null, Null::First, references.as_ptr());
    let (mut reals, mut numbers) = (vec![f64::NAN; count], vec![c_int::MIN; count]);
    let mut texts: Vec<*const c_char> = vec![ptr::null(); count];
    unsafe {
        let value = unless_mut(null, Null::Second, numbers.as_mut_ptr());
        let status = match kind {
            Type::Real => {
                let value = unless_mut(null, Null::Second, reals.as_mut_ptr());
                return (fmi2GetReal(component, vr, count, value), reals);
            }
            Type::Integer => fmi2GetInteger(component, vr, count, value),
            Type::Boolean => fmi2GetBoolean(component, vr, count, value),
            Type::String => {
                let value = unless_mut(null, Null::Second, texts.as_mut_ptr());
                fmi2GetString(component, vr, count, value)
            }
        };
        (status, numbers.into_iter().map(f64::from).collect())
    }
}

unsafe fn set(component: *mut c_void, kind: Type, pairs: &[(u32, f64)], null: Null) -> c_int {
    let (references, reals): (Vec<_>, Vec<_>) = pairs.iter().copied().unzip();
    let numbers: Vec<_> = reals.iter().map(|value| *value as c_int).collect();
    let texts = vec![c"text".as_ptr(); pairs.len()];
    let (count, vr) = (pairs.len(), unless(null, Null::First, references.as_ptr()));
    unsafe {
        let value = unless(null, Null::Second, numbers.as_ptr());
        match kind {
            Type::Real => fmi2SetReal(
                component,
                vr,
                count,
                unless(null, Null::Second, reals.as_ptr()),
            ),
            Type::Integer => fmi2SetInteger(component, vr, count, value),
            Type::Boolean => fmi2SetBoolean(component, vr, count, value),
            Type::String => fmi2SetString(
                component,
                vr,
                count,
                unless(null, Null::Second, texts.as_ptr()),
            ),
        }
    }
}

unsafe fn directional(
    component: *mut c_void,
    unknowns: &[u32],
    knowns: &[(u32, f64)],
    null: Null,
) -> (c_int, Vec<f64>) {
    let (by, seed): (Vec<_>, Vec<_>) = knowns.iter().copied().unzip();
    let mut values = vec![f64::NAN; unknowns.len()];
    let status = unsafe {
        fmi2GetDirectionalDerivative(
            component,
            unless(null, Null::First, unknowns.as_ptr()),
            unknowns.len(),
            by.as_ptr(),
            by.len(),
            unless(null, Null::Second, seed.as_ptr()),
            values.as_mut_ptr(),
        )
    };
    (status, values)
}

unsafe fn set_input_derivatives(
    component: *mut c_void,
    rows: &[(u32, c_int, f64)],
    null: Null,
) -> c_int {
    let references: Vec<_> = rows.iter().map(|row| row.0).collect();
    let orders: Vec<_> = rows.iter().map(|row| row.1).collect();
    let values: Vec<_> = rows.iter().map(|row| row.2).collect();
    unsafe {
        fmi2SetRealInputDerivatives(
            component,
            unless(null, Null::First, references.as_ptr()),
            rows.len(),
            unless(null, Null::Second, orders.as_ptr()),
            values.as_ptr(),
        )
    }
}

unsafe fn get_output_derivatives(
    component: *mut c_void,
    rows: &[(u32, c_int)],
    null: Null,
) -> (c_int, Vec<f64>) {
    let (references, orders): (Vec<_>, Vec<_>) = rows.iter().copied().unzip();
    let mut values = vec![f64::NAN; rows.len()];
    let status = unsafe {
        fmi2GetRealOutputDerivatives(
            component,
            unless(null, Null::First, references.as_ptr()),
            rows.len(),
            orders.as_ptr(),
            unless_mut(null, Null::Second, values.as_mut_ptr()),
        )
    };
    (status, values)
}

unsafe fn status(component: *mut c_void, of: StatusOf, kind: c_int, null: Null) -> c_int {
    let (mut number, mut real, mut text) = (c_int::MIN, f64::NAN, ptr::null());
    unsafe {
        let value = unless_mut(null, Null::First, &raw mut number);
        match of {
            StatusOf::Step => fmi2GetStatus(component, kind, value),
            StatusOf::Integer => fmi2GetIntegerStatus(component, kind, value),
            StatusOf::Boolean => fmi2GetBooleanStatus(component, kind, value),
            StatusOf::Real => {
                let value = unless_mut(null, Null::First, &raw mut real);
                fmi2GetRealStatus(component, kind, value)
            }
            StatusOf::String => {
                let value = unless_mut(null, Null::First, &raw mut text);
                fmi2GetStringStatus(component, kind, value)
            }
        }
    }
}

/// The name of the C function.
pub fn name_of(call: &Call) -> &'static str {
    match call {
        Call::Texts => "fmi2GetVersion",
        Call::Instantiate(_) => "fmi2Instantiate",
        Call::FreeInstance => "fmi2FreeInstance",
        Call::SetDebugLogging(..) => "fmi2SetDebugLogging",
        Call::SetupExperiment(..) => "fmi2SetupExperiment",
        Call::EnterInitializationMode => "fmi2EnterInitializationMode",
        Call::ExitInitializationMode => "fmi2ExitInitializationMode",
        Call::Terminate => "fmi2Terminate",
        Call::Reset => "fmi2Reset",
        Call::Get(Type::Real, ..) => "fmi2GetReal",
        Call::Get(Type::Integer, ..) => "fmi2GetInteger",
        Call::Get(Type::Boolean, ..) => "fmi2GetBoolean",
        Call::Get(Type::String, ..) => "fmi2GetString",
        Call::Set(Type::Real, ..) => "fmi2SetReal",
        Call::Set(Type::Integer, ..) => "fmi2SetInteger",
        Call::Set(Type::Boolean, ..) => "fmi2SetBoolean",
        Call::Set(Type::String, ..) => "fmi2SetString",
        Call::GetState(..) => "fmi2GetFMUstate",
        Call::SetState(_) => "fmi2SetFMUstate",
        Call::FreeState(..) => "fmi2FreeFMUstate",
        Call::SerializedSize(..) => "fmi2SerializedFMUstateSize",
        Call::Serialize(..) => "fmi2SerializeFMUstate",
        Call::DeSerialize(..) => "fmi2DeSerializeFMUstate",
        Call::Directional(..) => "fmi2GetDirectionalDerivative",
        Call::SetInputDerivatives(..) => "fmi2SetRealInputDerivatives",
        Call::GetOutputDerivatives(..) => "fmi2GetRealOutputDerivatives",
        Call::DoStep(..) => "fmi2DoStep",
        Call::CancelStep => "fmi2CancelStep",
        Call::Status(StatusOf::Step, ..) => "fmi2GetStatus",
        Call::Status(StatusOf::Real, ..) => "fmi2GetRealStatus",
        Call::Status(StatusOf::Integer, ..) => "fmi2GetIntegerStatus",
        Call::Status(StatusOf::Boolean, ..) => "fmi2GetBooleanStatus",
        Call::Status(StatusOf::String, ..) => "fmi2GetStringStatus",
    }
}
