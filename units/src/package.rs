//! What the units' packages have in common.

pub(crate) const COPYRIGHT: &str = concat!("Copyright (c) 2026 ", env!("CARGO_PKG_AUTHORS"));
pub(crate) const DATE: &str = "2026-11-23T00:00:00Z";

/// A number far above any machine's.
pub(crate) const LARGE: f64 = 1e12;
/// Stands for "greater than zero" in ranges that the standard can only close.
pub(crate) const SMALL: f64 = 1e-12;

pub(crate) const EXPERIMENT: &[(&str, &str)] = &[
    ("startTime", "0"),
    ("stopTime", "100"),
    ("tolerance", "1e-10"),
    ("stepSize", "0.01"),
];

pub(crate) const FILES: [(&str, &[u8]); 4] = [
    (
        "documentation/licenses/license.txt",
        include_bytes!("../assets/license.txt"),
    ),
    (
        "documentation/licenses/LICENSE-MIT.txt",
        include_bytes!("../LICENSE-MIT"),
    ),
    (
        "documentation/licenses/LICENSE-APACHE.txt",
        include_bytes!("../LICENSE-APACHE"),
    ),
    (
        "documentation/licenses/third-party.txt",
        include_bytes!("../assets/third-party.txt"),
    ),
];
