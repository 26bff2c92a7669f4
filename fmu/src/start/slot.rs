//! Where each parameter is held.

/// Slopes that a piecewise linear stop can have for each way.
pub const SLOPES: usize = 8;

/// Position of a parameter in [`StartValues`](super::StartValues).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Slot(usize);

impl Slot {
    /// The slot of an array's element, counted from 0; this one is that of its first.
    pub const fn element(self, index: usize) -> Self {
        Self(self.0 + index)
    }

    pub(super) const fn position(self) -> usize {
        self.0
    }
}

/// Numbers the slots: name and number of values of each.
macro_rules! slots {
    ($position:expr;) => {
        /// Number of values.
        pub const SLOTS: usize = $position;
    };
    ($position:expr; $name:ident: $length:expr, $($more:tt)*) => {
        #[expect(missing_docs, reason = "each is described in the table of variables")]
        impl Slot {
            pub const $name: Self = Self($position);
        }
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
}
