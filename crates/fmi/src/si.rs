//! Quantities in SI units.

use crate::quantity::Quantity;

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
    };
}

quantities! {
    /// Mass, kg.
    MASS = "Mass", "Mass", "kg", [("kg", 1)], [];
    /// Spring constant, N/m.
    STIFFNESS = "Stiffness", "TranslationalSpringConstant", "N/m",
        [("kg", 1), ("s", -2)], [];
    /// Damping constant, N.s/m.
    DAMPING = "Damping", "TranslationalDampingConstant", "N.s/m", [("kg", 1), ("s", -1)], [];
    /// Force, N.
    FORCE = "Force", "Force", "N", [("kg", 1), ("m", 1), ("s", -2)], [("kN", 1e-3)];
    /// Length, m.
    LENGTH = "Length", "Length", "m", [("m", 1)], [("mm", 1e3)];
    /// Velocity, m/s.
    VELOCITY = "Velocity", "Velocity", "m/s", [("m", 1), ("s", -1)], [];
    /// Acceleration, m/s2.
    ACCELERATION = "Acceleration", "Acceleration", "m/s2", [("m", 1), ("s", -2)], [];
    /// Angular frequency, rad/s.
    ANGULAR_FREQUENCY = "AngularFrequency", "AngularVelocity", "rad/s",
        [("rad", 1), ("s", -1)], [("Hz", 0.5 * std::f64::consts::FRAC_1_PI)];
    /// Angle, rad.
    ANGLE = "Angle", "Angle", "rad", [("rad", 1)], [("deg", 180.0 * std::f64::consts::FRAC_1_PI)];
    /// Time, s.
    TIME = "Time", "Time", "s", [("s", 1)], [];
    /// Hunt and Crossley's dissipation factor, s/m.
    DISSIPATION = "Dissipation", "InverseVelocity", "s/m", [("s", 1), ("m", -1)], [];
    /// Energy, J.
    ENERGY = "Energy", "Energy", "J", [("kg", 1), ("m", 2), ("s", -2)], [];
    /// Power, W.
    POWER = "Power", "Power", "W", [("kg", 1), ("m", 2), ("s", -3)], [];
    /// Impulse, N.s.
    IMPULSE = "Impulse", "Impulse", "N.s", [("kg", 1), ("m", 1), ("s", -1)], [];
    /// Torque, N.m.
    TORQUE = "Torque", "Torque", "N.m", [("kg", 1), ("m", 2), ("s", -2)], [];
    /// Moment of inertia, kg.m2.
    INERTIA = "MomentOfInertia", "MomentOfInertia", "kg.m2", [("kg", 1), ("m", 2)], [];
    /// Damping constant of a rotation, N.m.s/rad.
    ROTATIONAL_DAMPING = "RotationalDamping", "RotationalDampingConstant", "N.m.s/rad",
        [("kg", 1), ("m", 2), ("s", -1), ("rad", -1)], [];
    /// Unbalance, kg.m.
    UNBALANCE = "Unbalance", "Unbalance", "kg.m", [("kg", 1), ("m", 1)], [];
}
