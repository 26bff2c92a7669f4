//! The zoo: which scenes are drawn, at which speed, under which name.

use softstop::internals::scenes;

/// One picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StopPicture {
    /// The picture's file, without `.svg`.
    pub name: &'static str,
    /// Its title.
    pub title: &'static str,
    /// Speed of the first touch in m/s.
    pub speed: f64,
    /// Whether the damping that contact adds is part of the law that is drawn.
    pub damped: bool,
    /// The laws in it: the name of each in the legend, and its scene, a file of `docs/scenes`.
    pub laws: &'static [(&'static str, &'static str)],
}

/// All pictures of the zoo.
pub const ZOO: [StopPicture; 6] = [
    StopPicture {
        name: "kelvinVoigt",
        title: "Kelvin-Voigt: spring beside damper",
        speed: 6.0,
        damped: true,
        laws: &[
            ("release at the clearance", scenes::KELVIN_VOIGT),
            ("release at zero force", scenes::KELVIN_VOIGT_ZERO_FORCE),
        ],
    },
    StopPicture {
        name: "piecewiseLinear",
        title: "Piecewise linear: a chain of slopes",
        speed: 6.0,
        damped: false,
        laws: &[
            ("one chain for both ways", scenes::PIECEWISE_LINEAR),
            (
                "another chain on the way out",
                scenes::PIECEWISE_LINEAR_UNLOADING,
            ),
        ],
    },
    StopPicture {
        name: "hertz",
        title: "Hertz: the power law of contact",
        speed: 6.0,
        damped: false,
        laws: &[
            ("Hertz", scenes::HERTZ),
            (
                "with Hunt and Crossley's dissipation",
                scenes::HUNT_CROSSLEY,
            ),
        ],
    },
    StopPicture {
        name: "preloaded",
        title: "Preloaded: a pre-stressed spring",
        speed: 20.0,
        damped: false,
        laws: &[("preload and spring", scenes::PRELOADED)],
    },
    StopPicture {
        name: "piercing",
        title: "Piercing: strip, preloaded stop, rigid stop",
        speed: 8.0,
        damped: false,
        laws: &[("phases I to IV", scenes::PIERCING)],
    },
    StopPicture {
        name: "rigid",
        title: "Rigid: Newton's restitution",
        speed: 6.0,
        damped: false,
        laws: &[("rigid stop", scenes::RIGID)],
    },
];
