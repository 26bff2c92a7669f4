//! What the units' packages have in common.

pub(crate) const COPYRIGHT: &str = concat!("Copyright (c) 2026 ", env!("CARGO_PKG_AUTHORS"));
pub(crate) const DATE: &str = "2026-11-23T00:00:00Z";

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
