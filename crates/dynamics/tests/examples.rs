//! The examples hold what they assert.

softstop_testing::examples! {
    simulate: "../examples/simulate.rs",
    orbit: "../examples/orbit.rs",
    zone: "../examples/zone.rs",
    continuation: "../examples/continuation.rs",
    basin: "../examples/basin.rs"
}
