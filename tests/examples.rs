//! The examples hold what they assert.

softstop_testing::examples! {
    press: "../examples/press.rs",
    observer: "../examples/observer.rs"
}
