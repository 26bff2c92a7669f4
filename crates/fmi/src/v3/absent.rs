//! Functions of the standard for what no unit has: they answer with an error and one log line.

use libc::{c_int, c_uint, c_void, size_t};

use crate::abi::component::Component;
use crate::abi::guard::guarded;
use crate::fault::Fault;
use crate::unit::Unit;

macro_rules! absent_functions {
    ($dollar:tt $($why:literal: $($name:ident($($argument:ident: $type:ty),*);)*)*) => {
        functions! { $dollar export_v3_absent v3; ;
            $($(
                /// Not offered.
                #[allow(unused_variables, reason = "nothing is done with any argument")]
                fn $name<U>(component $(, $argument: $type)*) {
                    Err(Fault::NotOffered($why))
                }
            )*)*
        }
    };
}

absent_functions! { $
    "dependencies stand in the model description":
    fmi3GetNumberOfVariableDependencies(reference: c_uint, dependencies: *mut size_t);
    fmi3GetVariableDependencies(
        dependent: c_uint, elements: *mut size_t, independents: *mut c_uint,
        independent_elements: *mut size_t, kinds: *mut c_int, count: size_t
    );
    "the unit has no structural parameters":
    fmi3EnterConfigurationMode();
    fmi3ExitConfigurationMode();
    "the unit has no time-based clocks":
    fmi3GetIntervalDecimal(
        references: *const c_uint, count: size_t, intervals: *mut f64, qualifiers: *mut c_int
    );
    fmi3GetIntervalFraction(
        references: *const c_uint, count: size_t, counters: *mut u64, resolutions: *mut u64,
        qualifiers: *mut c_int
    );
    fmi3GetShiftDecimal(references: *const c_uint, count: size_t, shifts: *mut f64);
    fmi3GetShiftFraction(
        references: *const c_uint, count: size_t, counters: *mut u64, resolutions: *mut u64
    );
    fmi3SetIntervalDecimal(references: *const c_uint, count: size_t, intervals: *const f64);
    fmi3SetIntervalFraction(
        references: *const c_uint, count: size_t, counters: *const u64, resolutions: *const u64
    );
    fmi3SetShiftDecimal(references: *const c_uint, count: size_t, shifts: *const f64);
    fmi3SetShiftFraction(
        references: *const c_uint, count: size_t, counters: *const u64, resolutions: *const u64
    );
    "providesEvaluateDiscreteStates is false":
    fmi3EvaluateDiscreteStates();
    "the unit is not for scheduled execution":
    fmi3ActivateModelPartition(clock: c_uint, time: f64);
}
