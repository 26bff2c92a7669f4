//! Where each value is held among the start values.
#![expect(missing_docs, reason = "each is described in the table of variables")]

use softstop_fmi::variable::Slot;

/// Slopes that a piecewise linear stop can have for each way.
pub const SLOPES: usize = 8;

/// Numbers the slots: name and number of values of each.
macro_rules! slots {
    ($position:expr;) => {
        /// Number of values.
        pub const SLOTS: usize = $position;
    };
    ($position:expr; $name:ident: $length:expr, $($more:tt)*) => {
        pub const $name: Slot = Slot($position);
        slots! { $position + $length; $($more)* }
    };
}

slots! {
    0;
    MASS: 1,
    STIFFNESS: 1,
    DAMPING: 1,
    AMPLITUDE: 1,
    FREQUENCY: 1,
    DRIVE_PHASE: 1,
    CLEARANCE: 1,
    CONTACT_DAMPING: 1,
    STOP_MODEL: 1,
    STOP_STIFFNESS: 1,
    STOP_PRELOAD: 1,
    STOP_RELEASE: 1,
    STOP_EXPONENT: 1,
    STOP_DISSIPATION: 1,
    STOP_RESTITUTION: 1,
    LOADING_COUNT: 1,
    LOADING_FROM: SLOPES,
    LOADING_STIFFNESS: SLOPES,
    UNLOADING_COUNT: 1,
    UNLOADING_FROM: SLOPES,
    UNLOADING_STIFFNESS: SLOPES,
    RIGID_PRESENT: 1,
    RIGID_TRAVEL: 1,
    PIERCING_STIFFNESS: 1,
    PIERCING_FRICTION: 1,
    PIERCING_THICKNESS: 1,
    PIERCING_TRAVEL: 1,
    INITIAL_POSITION: 1,
    INITIAL_VELOCITY: 1,
    MATERIAL: 1,
    TAKES_SPEED: 1,
    TAKES_AMPLITUDE: 1,
    MATERIAL_SHARE: 1,
    BELOW_MODEL: 1,
    BELOW_CLEARANCE: 1,
    BELOW_STIFFNESS: 1,
    BELOW_PRELOAD: 1,
    BELOW_RELEASE: 1,
    BELOW_EXPONENT: 1,
    BELOW_DISSIPATION: 1,
    BELOW_RESTITUTION: 1,
    BELOW_LOADING_COUNT: 1,
    BELOW_LOADING_FROM: SLOPES,
    BELOW_LOADING_STIFFNESS: SLOPES,
    BELOW_UNLOADING_COUNT: 1,
    BELOW_UNLOADING_FROM: SLOPES,
    BELOW_UNLOADING_STIFFNESS: SLOPES,
}
