//! Curves of bifurcations over frequency and clearance.

use anyhow::{Context, Result};
use softstop::{Parameter, Ratios};
use softstop_dynamics::continuation::{Curve, Region, SpecialKind, curve};
use softstop_dynamics::{Along, BranchPoint};

use softstop_console::interrupt;

/// The curve through a special point of z = 1 of a machine.
pub fn critical(
    machine: &Ratios,
    special: (SpecialKind, &BranchPoint),
    region: &Region,
) -> Result<Curve> {
    let family = Along::new(
        machine.scene()?,
        [Parameter::Frequency, Parameter::Clearance],
    )?;
    let at = [special.1.parameter, machine.clearance];
    let found = curve(&family, 1, special, at, region, |_| interrupt::go_on());
    found.with_context(|| format!("no curve of the {}", special.0.name()))
}
