//! The design as an FMU: the packaged library with the design's machine as start values.

use std::slice;

use anyhow::{Context, Result};
use softstop::Start;
use softstop_fmu::package::{self, Library};
use softstop_fmu::start::StartValues;

use crate::design::Design;

/// The bytes of the FMU that runs the design's machine (m = 1 kg, k1 = 1 N/m, F0 = 1 N) from
/// the stroboscopic state of its z = 1 motion.
pub(super) fn archive(library: &Library, design: &Design) -> Result<Vec<u8>> {
    let scene = design.ratios.scene()?;
    let start = Start {
        position: design.orbit.position,
        velocity: design.orbit.velocity,
    };
    let values = StartValues::from_scene(&scene, start)?;
    package::archive(&values, slice::from_ref(library)).context("cannot make the FMU")
}
