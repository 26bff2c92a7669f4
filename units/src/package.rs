//! What the units' packages have in common.

pub(crate) const LICENSE: &str = "MIT OR Apache-2.0";
pub(crate) const AUTHOR: &str = "the softstop authors";
pub(crate) const COPYRIGHT: &str = "Copyright (c) 2026 the softstop authors";
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
        b"softstop is licensed under either of the MIT licence (LICENSE-MIT.txt) or the Apache\n\
          licence, version 2.0 (LICENSE-APACHE.txt), at your option. Its libraries hold parts of\n\
          others: see third-party.txt.\n",
    ),
    (
        "documentation/licenses/LICENSE-MIT.txt",
        include_bytes!("../../LICENSE-MIT"),
    ),
    (
        "documentation/licenses/LICENSE-APACHE.txt",
        include_bytes!("../../LICENSE-APACHE"),
    ),
    (
        "documentation/licenses/third-party.txt",
        include_bytes!("../../fmu/assets/third-party.txt"),
    ),
];
