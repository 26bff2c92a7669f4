//! The examples hold what they assert.

/// Each runs as a test.
macro_rules! examples {
    ($($name:ident: $path:literal),*) => {
        $(
            #[path = $path]
            mod $name;
        )*
        $(
            #[test]
            fn $name() -> Result<(), Box<dyn std::error::Error>> {
                $name::main()
            }
        )*
    };
}

examples! {
    simulate: "../examples/simulate.rs",
    orbit: "../examples/orbit.rs",
    zone: "../examples/zone.rs",
    continuation: "../examples/continuation.rs",
    basin: "../examples/basin.rs"
}
