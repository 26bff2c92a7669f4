//! The design as an FMU: the packaged library with the design's machine as start values.

use std::slice;

use anyhow::{Context, Result};
use softstop::Start;
use softstop_fmu::package::{self, Library};
use softstop_fmu::{Imprint, StartValues};

use crate::design::Design;

/// The bytes of the FMU that runs the design's machine (with m = 1 kg, k1 = 1 N/m, F0 = 1 N if it speaks
/// ratios) from the stroboscopic state of its z = 1 motion.
pub(super) fn archive(library: &Library, design: &Design) -> Result<Vec<u8>> {
    let start = Start {
        position: design.orbit.position,
        velocity: design.orbit.velocity,
    };
    let values = StartValues::from_scene(&design.machine.scene, start)?;
    package::archive(&Imprint::from(values), slice::from_ref(library))
        .context("cannot make the FMU")
}
