//! What the units' packages have in common.

pub(crate) const COPYRIGHT: &str = concat!("Copyright (c) 2026 ", env!("CARGO_PKG_AUTHORS"));
pub(crate) const DATE: &str = "2026-11-23T00:00:00Z";

pub(crate) const EXPERIMENT: &[(&str, &str)] = &[
    ("startTime", "0"),
    ("stopTime", "100"),
    ("tolerance", "1e-10"),
    ("stepSize", "0.01"),
];

pub(crate) const FILES: &[(&str, &[u8])] = softstop_fmi::files! {
    "documentation/licenses/license.txt" = "../assets/license.txt";
    "documentation/licenses/LICENSE-MIT.txt" = "../LICENSE-MIT";
    "documentation/licenses/LICENSE-APACHE.txt" = "../LICENSE-APACHE";
    "documentation/licenses/third-party.txt" = "../assets/third-party.txt";
};
