//! Reading and setting variables, for all types of the standard.

use libc::{c_char, c_int, c_uint, c_void, size_t};

use super::arrays::expanded;
use crate::abi::component::Component;
use crate::abi::guard::guarded;
use crate::abi::pointers::{read, write};
use crate::fault::Fault;
use crate::reading::{Type, find};
use crate::standard::Standard::Fmi3;
use crate::unit::{Clock, Unit};

/// Refuses another number of values than of scalars.
pub(super) fn check_count(
    argument: &'static str,
    value: usize,
    wanted: usize,
) -> Result<(), Fault> {
    match value == wanted {
        true => Ok(()),
        false => Err(Fault::Count {
            argument,
            value,
            wanted,
        }),
    }
}

/// What FMI 3.0 makes of reading where that is allowed, but outputs have no values yet.
fn not_yet(fault: Fault) -> Fault {
    match fault {
        Fault::WrongState { .. } => Fault::Refused(fault.into()),
        other => other,
    }
}

/// The clock with this value reference, if the FMU tells of it.
fn find_clock<U: Unit>(
    component: &Component<U>,
    reference: u32,
) -> Result<&'static Clock<U>, Fault> {
    let is_told =
        |clock: &&Clock<U>| component.importer.options.clock && clock.reference == reference;
    match U::about().clock.filter(is_told) {
        Some(clock) => Ok(clock),
        None => find::<U>(reference, Type::of(Fmi3, "Clock"))
            .and(Err(Fault::UnknownReference { reference })),
    }
}

/// Reads or sets values of a type of which there are no variables.
///
/// # Safety
/// As [`read`].
unsafe fn access_none<U: Unit>(
    component: &Component<U>,
    (references, count): (*const u32, usize),
    value_count: usize,
    type_name: &'static str,
) -> Result<(), Fault> {
    check_count("nValues", value_count, count)?;
    // SAFETY: by this function's contract.
    let references = unsafe { read("valueReferences", references, count) }?;
    let instance = &component.instance;
    instance.none_of(Type::of(Fmi3, type_name), references)
}

/// The functions of the types of which there are variables, with its name and how a value and a number become
/// each other, and of those of which there are none.
macro_rules! typed_functions {
    ($dollar:tt
        some { $($get:ident $set:ident $type:ty: $type_name:literal, $typed:expr, $number:expr;)* }
        none { $($get_none:ident $set_none:ident $none_type:ty: $name:literal $($sizes:ident)?;)* }
    ) => {
        functions! { $dollar export_v3_values v3; ;
            $(
                /// Reads values of this type.
                fn $get<U>(
                    component, references: *const c_uint, count: size_t, values: *mut $type,
                    value_count: size_t
                ) {
                    let references = read("valueReferences", references, count)?;
                    let values = write("values", values, value_count)?;
                    let references = expanded(component, references)?;
                    check_count("nValues", value_count, references.len())?;
                    let read = component.instance.read(&references, values, Type::of(Fmi3, $type_name), $typed);
                    read.map_err(not_yet)
                }

                /// Sets values of this type.
                fn $set<U>(
                    component, references: *const c_uint, count: size_t, values: *const $type,
                    value_count: size_t
                ) {
                    let references = read("valueReferences", references, count)?;
                    let values = read("values", values, value_count)?;
                    let references = expanded(component, references)?;
                    check_count("nValues", value_count, references.len())?;
                    let set = component.instance.set(&references, values, Type::of(Fmi3, $type_name), $number);
                    set.map_err(Fault::refused)
                }
            )*
            $(
                /// Reads values of this type, of which there are none.
                fn $get_none<U>(
                    component, references: *const c_uint, count: size_t $(, $sizes: *mut size_t)?,
                    _values: *mut $none_type, value_count: size_t
                ) {
                    access_none(component, (references, count), value_count, $name)
                }

                /// Sets values of this type, of which there are none.
                fn $set_none<U>(
                    component, references: *const c_uint, count: size_t $(, $sizes: *const size_t)?,
                    _values: *const $none_type, value_count: size_t
                ) {
                    access_none(component, (references, count), value_count, $name)
                }
            )*

            /// Whether clocks tick.
            fn fmi3GetClock<U>(
                component, references: *const c_uint, count: size_t, values: *mut u8
            ) {
                let references = read("valueReferences", references, count)?;
                let values = write("values", values, count)?;
                for (&reference, value) in references.iter().zip(values) {
                    let clock = find_clock(component, reference)?;
                    let ticks = component.instance.is_ticking(clock).map_err(not_yet)?;
                    *value = ticks.into();
                }
                Ok(())
            }

            /// Sets clocks, of which the importer has none.
            fn fmi3SetClock<U>(
                component, references: *const c_uint, count: size_t, _values: *const u8
            ) {
                let mut references = read("valueReferences", references, count)?.iter();
                references.try_for_each(|&reference| {
                    Err(Fault::Output(find_clock(component, reference)?.name))
                })
            }
        }
    };
}

typed_functions! { $
    some {
        fmi3GetFloat64 fmi3SetFloat64 f64: "Float64", |value| value, |value| value;
        fmi3GetInt32 fmi3SetInt32 c_int: "Int32", |value| value as c_int, f64::from;
        fmi3GetInt64 fmi3SetInt64 i64: "Int64", |value| value as i64, |value| value as f64;
        fmi3GetBoolean fmi3SetBoolean u8: "Boolean", |value| u8::from(value != 0.0),
            |value| f64::from(u8::from(value != 0));
    }
    none {
        fmi3GetFloat32 fmi3SetFloat32 f32: "Float32";
        fmi3GetInt8 fmi3SetInt8 i8: "Int8";
        fmi3GetUInt8 fmi3SetUInt8 u8: "UInt8";
        fmi3GetInt16 fmi3SetInt16 i16: "Int16";
        fmi3GetUInt16 fmi3SetUInt16 u16: "UInt16";
        fmi3GetUInt32 fmi3SetUInt32 u32: "UInt32";
        fmi3GetUInt64 fmi3SetUInt64 u64: "UInt64";
        fmi3GetString fmi3SetString *const c_char: "String";
        fmi3GetBinary fmi3SetBinary *const u8: "Binary" _sizes;
    }
}
