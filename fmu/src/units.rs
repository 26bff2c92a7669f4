//! Units, with their base units, and the named types of the variables.

/// A physical quantity: the named type, its unit and how that unit is made of base units.
#[derive(Debug, PartialEq)]
pub struct Quantity {
    /// Name of the type in `TypeDefinitions`.
    pub type_name: &'static str,
    /// Physical quantity, as `quantity` of the type.
    pub quantity: &'static str,
    /// Name of the unit.
    pub unit: &'static str,
    /// Exponents of the base units: (name, exponent).
    pub base: &'static [(&'static str, i32)],
    /// Further units to show values in: (name, factor), shown value = factor * value.
    pub display: &'static [(&'static str, f64)],
}

macro_rules! quantities {
    ($($(#[$doc:meta])* $id:ident = $type_name:literal, $quantity:literal, $unit:literal,
        $base:expr, $display:expr;)*) => {
        $($(#[$doc])* pub static $id: Quantity = Quantity {
            type_name: $type_name,
            quantity: $quantity,
            unit: $unit,
            base: &$base,
            display: &$display,
        };)*
        /// All quantities in use, each with a unit of its own.
        pub static QUANTITIES: &[&Quantity] = &[$(&$id),*];
    };
}

quantities! {
    /// Mass, kg.
    MASS = "Mass", "Mass", "kg", [("kg", 1)], [("g", 1e3)];
    /// Spring constant, N/m.
    STIFFNESS = "Stiffness", "TranslationalSpringConstant", "N/m",
        [("kg", 1), ("s", -2)], [("N/mm", 1e-3)];
    /// Damping constant, N.s/m.
    DAMPING = "Damping", "TranslationalDampingConstant", "N.s/m", [("kg", 1), ("s", -1)], [];
    /// Force, N.
    FORCE = "Force", "Force", "N", [("kg", 1), ("m", 1), ("s", -2)], [("kN", 1e-3)];
    /// Length, m.
    LENGTH = "Length", "Length", "m", [("m", 1)], [("mm", 1e3)];
    /// Velocity, m/s.
    VELOCITY = "Velocity", "Velocity", "m/s", [("m", 1), ("s", -1)], [("mm/s", 1e3)];
    /// Acceleration, m/s2.
    ACCELERATION = "Acceleration", "Acceleration", "m/s2", [("m", 1), ("s", -2)], [];
    /// Angular frequency, rad/s.
    ANGULAR_FREQUENCY = "AngularFrequency", "AngularVelocity", "rad/s",
        [("rad", 1), ("s", -1)], [("Hz", 0.5 * std::f64::consts::FRAC_1_PI)];
    /// Angle, rad.
    ANGLE = "Angle", "Angle", "rad", [("rad", 1)], [("deg", 180.0 * std::f64::consts::FRAC_1_PI)];
    /// Time, s.
    TIME = "Time", "Time", "s", [("s", 1)], [("ms", 1e3)];
    /// Energy, J.
    ENERGY = "Energy", "Energy", "J", [("kg", 1), ("m", 2), ("s", -2)], [];
}

/// One item of an enumeration.
#[derive(Debug, PartialEq)]
pub struct Item {
    /// Value by which importers set and read it.
    pub value: i32,
    /// Name.
    pub name: &'static str,
    /// What it means.
    pub description: &'static str,
}

/// An enumeration type: what is available, and what is only reserved.
#[derive(Debug, PartialEq)]
pub struct Enumeration {
    /// Name of the type in `TypeDefinitions`.
    pub type_name: &'static str,
    /// What the type is about.
    pub description: &'static str,
    /// The items that can be had.
    pub items: &'static [Item],
    /// Values kept for items to come: (value, name).
    pub reserved: &'static [(i32, &'static str)],
}

const fn item(value: i32, name: &'static str, description: &'static str) -> Item {
    Item {
        value,
        name,
        description,
    }
}

/// `stop.model` without a stop.
pub const STOP_NONE: i32 = 1;
/// `stop.model` of the preloaded stop.
pub const STOP_PRELOADED: i32 = 5;

/// The type of `stop.model`.
pub static STOP_MODEL: Enumeration = Enumeration {
    type_name: "StopModel",
    description: "Force law of the stop",
    items: &[
        item(STOP_NONE, "none", "no stop"),
        item(
            STOP_PRELOADED,
            "preloaded",
            "linear spring that is preloaded against its seat: the force jumps to the preload at first touch",
        ),
    ],
    reserved: &[
        (2, "kelvinVoigt"),
        (3, "piecewiseLinear"),
        (4, "hertz"),
        (6, "rigid"),
    ],
};

/// The type of `phase`.
pub static PHASE: Enumeration = Enumeration {
    type_name: "Phase",
    description: "Smooth law that the mass moves under",
    items: &[
        item(1, "free", "no contact"),
        item(2, "pierce", "phase I: the strip is pressed and cut into"),
        item(3, "cut", "phase II: travel through the cut strip"),
        item(
            4,
            "gap",
            "beyond the clearance without a strip, before the stop",
        ),
        item(5, "stop", "contact with the stop"),
        item(6, "stuck", "held at rest by dry friction"),
        item(7, "resting", "resting on the edge of a preloaded body"),
    ],
    reserved: &[],
};

/// All enumeration types.
pub static ENUMERATIONS: &[&Enumeration] = &[&STOP_MODEL, &PHASE];
