//! The macros that make C functions.

/// Makes of each function of a standard's module a generic one and, in a macro of the given name, the C function of a
/// unit. Behind the semicolon stand the calls on an instance: a fault in one becomes its status
/// and one log line.
macro_rules! functions {
    ($dollar:tt $export:ident $module:ident; $(
        $(#[$doc:meta])*
        fn $name:ident<$unit:ident>($($argument:ident: $type:ty),*) -> $result:ty $body:block
    )* ; $(
        $(#[$call_doc:meta])*
        fn $call:ident<$call_unit:ident>(
            $component:ident $(, $call_argument:ident: $call_type:ty)*
        ) $call_body:block
    )*) => {
        $(
            $(#[$doc])*
            pub unsafe fn $name<$unit: Unit>($($argument: $type),*) -> $result {
                // SAFETY: by the standard the pointers are NULL or point to what they say.
                #[allow(unused_unsafe, reason = "not every function takes a pointer")]
                unsafe { $body }
            }
        )*
        $(
            $(#[$call_doc])*
            pub unsafe fn $call<$call_unit: Unit>(
                component: *mut c_void $(, $call_argument: $call_type)*
            ) -> c_int {
                // SAFETY: the importer passes NULL or what instantiation gave it.
                let component = unsafe { component.cast::<Component<$call_unit>>().as_mut() };
                guarded(component, stringify!($call), &mut |$component| {
                    // SAFETY: by the standard arrays are as long as the importer says; NULL is
                    // refused where there is something to read or to write.
                    #[allow(unused_unsafe, reason = "not every function takes an array")]
                    unsafe { $call_body }
                })
            }
        )*
        c_functions! { $dollar $export $module
            $(fn $name($($argument: $type),*) -> $result;)*
            $(fn $call(component: *mut c_void $(, $call_argument: $call_type)*) -> c_int;)*
        }
    };
}

macro_rules! c_functions {
    ($dollar:tt $export:ident $module:ident
        $(fn $name:ident($($argument:ident: $type:ty),*) -> $result:ty;)*) => {
        #[doc(hidden)]
        #[macro_export]
        macro_rules! $export {
            (of $dollar unit_type:ty) => {
                $(
                    #[doc = concat!("`", stringify!($name), "` for this unit.")]
                    #[allow(
                        unsafe_code,
                        non_snake_case,
                        clippy::missing_safety_doc,
                        clippy::too_many_arguments,
                        reason = "as in the standard"
                    )]
                    pub unsafe fn $name($($argument: $type),*) -> $result {
                        // SAFETY: the importer keeps to the standard.
                        unsafe { $crate::$module::$name::<$dollar unit_type>($($argument),*) }
                    }
                )*
            };
            ($dollar functions:ident) => {
                $(
                    #[doc = concat!("`", stringify!($name), "` of the standard.")]
                    #[allow(
                        unsafe_code,
                        clippy::missing_safety_doc,
                        clippy::too_many_arguments,
                        reason = "as in the standard"
                    )]
                    #[unsafe(no_mangle)]
                    pub unsafe extern "C" fn $name($($argument: $type),*) -> $result {
                        // SAFETY: the importer keeps to the standard.
                        unsafe { $dollar functions::$name($($argument),*) }
                    }
                )*
            };
        }
    };
}

/// The functions of FMI 2.0 for one type that is a [`Unit`](crate::Unit), in a module of their own: here they are compiled,
/// in Rust.
#[macro_export]
macro_rules! fmi2_functions {
    ($unit_type:ty) => {
        use $crate::abi::{c_char, c_int, c_uint, c_void, size_t};
        use $crate::v2::{CallbackFunctions, EventInfo};

        $crate::export_v2!(of $unit_type);
        $crate::export_v2_shared!(of $unit_type);
    };
}

/// The C functions of FMI 2.0, which call those of a module of [`fmi2_functions`], with the types of their callbacks. To be
/// called once in a library, in a module of its own.
#[macro_export]
macro_rules! export_fmi2 {
    ($functions:ident) => {
        use $crate::abi::{c_char, c_int, c_uint, c_void, size_t};
        pub use $crate::v2::{CallbackFunctions, EventInfo, Logger};

        $crate::export_v2!($functions);
        $crate::export_v2_shared!($functions);
    };
}

/// The functions of FMI 3.0, as [`fmi2_functions`] those of FMI 2.0.
#[macro_export]
macro_rules! fmi3_functions {
    ($unit_type:ty) => {
        use $crate::abi::{c_char, c_int, c_uint, c_void, size_t};
        use $crate::v3::{
            ClockUpdateCallback, IntermediateUpdateCallback, LogMessageCallback, PreemptionCallback,
        };

        $crate::export_v3!(of $unit_type);
        $crate::export_v3_shared!(of $unit_type);
        $crate::export_v3_values!(of $unit_type);
        $crate::export_v3_absent!(of $unit_type);
    };
}

/// The C functions of FMI 3.0, as [`export_fmi2`] those of FMI 2.0.
#[macro_export]
macro_rules! export_fmi3 {
    ($functions:ident) => {
        use $crate::abi::{c_char, c_int, c_uint, c_void, size_t};
        pub use $crate::v3::{
            ClockUpdateCallback, IntermediateUpdateCallback, LogMessageCallback, PreemptionCallback,
        };

        $crate::export_v3!($functions);
        $crate::export_v3_shared!($functions);
        $crate::export_v3_values!($functions);
        $crate::export_v3_absent!($functions);
    };
}
