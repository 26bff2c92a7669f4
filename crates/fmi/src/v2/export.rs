//! The macros that make C functions.

/// Makes of each function a generic one and, in the macro `export`, the C function of a unit. Behind the
/// semicolon stand the calls on an instance: a fault in one becomes its status and one log line.
macro_rules! functions {
    ($dollar:tt $(
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
                // SAFETY: the importer passes NULL or what fmi2Instantiate gave it.
                let component = unsafe { component.cast::<Component<$call_unit>>().as_mut() };
                guarded(component, stringify!($call), |$component| {
                    // SAFETY: by the standard arrays are as long as the importer says; NULL is
                    // refused where there is something to read or to write.
                    #[allow(unused_unsafe, reason = "not every function takes an array")]
                    unsafe { $call_body }
                })
            }
        )*
        c_functions! { $dollar
            $(fn $name($($argument: $type),*) -> $result;)*
            $(fn $call(component: *mut c_void $(, $call_argument: $call_type)*) -> c_int;)*
        }
    };
}

macro_rules! c_functions {
    ($dollar:tt $(fn $name:ident($($argument:ident: $type:ty),*) -> $result:ty;)*) => {
        /// The C functions of the standard for one type that is a [`Unit`](crate::Unit), with the types
        /// of their callbacks. To be called once in a library, in a module of its own.
        #[macro_export]
        macro_rules! export {
            ($dollar unit_type:ty) => {
                pub use $crate::v2::{CallbackFunctions, Logger};
                use $crate::v2::{c_char, c_int, c_uint, c_void, size_t};

                $(
                    #[doc = concat!("`", stringify!($name), "` of the standard.")]
                    #[allow(unsafe_code, clippy::missing_safety_doc, reason = "as in the standard")]
                    #[unsafe(no_mangle)]
                    pub unsafe extern "C" fn $name($($argument: $type),*) -> $result {
                        // SAFETY: the importer keeps to the standard.
                        unsafe { $crate::v2::$name::<$dollar unit_type>($($argument),*) }
                    }
                )*
            };
        }
    };
}
