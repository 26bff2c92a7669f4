//! The scenes of `docs/scenes` that pictures of the stops show.

macro_rules! scenes {
    ($($name:ident $file:literal),+ $(,)?) => {
        $(
            #[doc = concat!("The text of `docs/scenes/", $file, ".toml`.")]
            pub const $name: &str = include_str!(concat!("../../docs/scenes/", $file, ".toml"));
        )+
    };
}

scenes! {
    HERTZ "hertz",
    HUNT_CROSSLEY "hunt-crossley",
    KELVIN_VOIGT "kelvin-voigt",
    KELVIN_VOIGT_ZERO_FORCE "kelvin-voigt-zero-force",
    PIECEWISE_LINEAR "piecewise-linear",
    PIECEWISE_LINEAR_UNLOADING "piecewise-linear-unloading",
    PIERCING "piercing",
    PRELOADED "preloaded",
    RIGID "rigid",
}
