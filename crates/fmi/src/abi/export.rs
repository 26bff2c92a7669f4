//! The macros that make C functions.

/// Makes of each function of a standard's module a generic one and, in a macro of the given name, the C function of a unit.
/// Behind the semicolon stand the calls on an instance: a fault in one becomes its status and one log line.
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

/// Makes the two macros of a standard, of these types and parts.
macro_rules! standard {
    ($dollar:tt $version:literal $functions:ident $export:ident $module:ident
        { $($type:ident)* } $($part:ident)*) => {
        #[doc = concat!("The functions of FMI ", $version, " for one type that is a [`Unit`](crate::Unit), in a module of")]
        /// their own: here they are compiled, in Rust.
        #[macro_export]
        macro_rules! $functions {
            ($dollar unit_type:ty) => {
                use $crate::abi::{c_char, c_int, c_uint, c_void, size_t};
                use $crate::$module::{$($type),*};

                $($crate::$part!(of $dollar unit_type);)*
            };
        }

        #[doc = concat!("The C functions of FMI ", $version, ", which call those of a module of the functions for a unit, with")]
        /// the types of their callbacks. To be called once in a library, in a module of its own.
        #[macro_export]
        macro_rules! $export {
            ($dollar functions:ident) => {
                use $crate::abi::{c_char, c_int, c_uint, c_void, size_t};
                pub use $crate::$module::{$($type),*};

                $($crate::$part!($dollar functions);)*
            };
        }
    };
}

standard! { $ "2.0" fmi2_functions export_fmi2 v2
    { CallbackFunctions EventInfo Logger }
    export_v2 export_v2_shared
}
standard! { $ "3.0" fmi3_functions export_fmi3 v3
    { ClockUpdateCallback IntermediateUpdateCallback LogMessageCallback PreemptionCallback }
    export_v3 export_v3_shared export_v3_values export_v3_absent
}
