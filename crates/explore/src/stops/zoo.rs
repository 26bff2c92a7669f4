//! The zoo: which scenes are drawn, at which speed, under which name.

use softstop::Scene;
use softstop::internals::scenes;

use softstop_console::failure::Failure;

/// One picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Exhibit {
    /// The picture's file, without `.svg`.
    pub name: &'static str,
    /// Its title.
    pub title: &'static str,
    /// Speed of the first touch in m/s.
    pub speed: f64,
    /// Whether the damping that contact adds is part of the law that is drawn.
    pub damped: bool,
    /// The laws in it.
    pub laws: &'static [Specimen],
}

/// One law in a picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Specimen {
    /// Its name in the legend.
    pub label: &'static str,
    /// Its scene, a file of `docs/scenes`.
    pub scene: &'static str,
}

macro_rules! specimen {
    ($scene:ident, $label:literal) => {
        Specimen {
            label: $label,
            scene: scenes::$scene,
        }
    };
}

/// All pictures of the zoo.
pub const ZOO: [Exhibit; 6] = [
    Exhibit {
        name: "kelvinVoigt",
        title: "Kelvin-Voigt: spring beside damper",
        speed: 6.0,
        damped: true,
        laws: &[
            specimen!(KELVIN_VOIGT, "release at the clearance"),
            specimen!(KELVIN_VOIGT_ZERO_FORCE, "release at zero force"),
        ],
    },
    Exhibit {
        name: "piecewiseLinear",
        title: "Piecewise linear: a chain of slopes",
        speed: 6.0,
        damped: false,
        laws: &[
            specimen!(PIECEWISE_LINEAR, "one chain for both ways"),
            specimen!(PIECEWISE_LINEAR_UNLOADING, "another chain on the way out"),
        ],
    },
    Exhibit {
        name: "hertz",
        title: "Hertz: the power law of contact",
        speed: 6.0,
        damped: false,
        laws: &[
            specimen!(HERTZ, "Hertz"),
            specimen!(HUNT_CROSSLEY, "with Hunt and Crossley's dissipation"),
        ],
    },
    Exhibit {
        name: "preloaded",
        title: "Preloaded: a pre-stressed spring",
        speed: 20.0,
        damped: false,
        laws: &[specimen!(PRELOADED, "preload and spring")],
    },
    Exhibit {
        name: "piercing",
        title: "Piercing: strip, preloaded stop, rigid stop",
        speed: 8.0,
        damped: false,
        laws: &[specimen!(PIERCING, "phases I to IV")],
    },
    Exhibit {
        name: "rigid",
        title: "Rigid: Newton's restitution",
        speed: 6.0,
        damped: false,
        laws: &[specimen!(RIGID, "rigid stop")],
    },
];

impl Specimen {
    /// The scene.
    pub fn scene(&self) -> Result<Scene, Failure> {
        Scene::from_toml(self.scene)
            .map_err(|error| Failure::usage(format!("{}: {error}", self.label)))
    }
}
