//! The motions beside which a design is set: the paper's points, or the machine as it was given.

use anyhow::Context;
use softstop::Machine;
use softstop_console::failure::Failure;
use softstop_console::interrupt;
use softstop_console::machine::PaperMachine;
use softstop_dynamics::{Orbit, orbit, zone};

/// A motion and its machine.
#[derive(Debug, Clone)]
pub struct Reference {
    /// A, B, or `given`.
    pub name: &'static str,
    /// The machine.
    pub machine: Machine,
    /// Its z = 1 motion.
    pub orbit: Orbit,
}

impl Reference {
    /// A point of the paper, or the machine as it was given.
    pub fn title(&self) -> String {
        match self.name {
            "given" => "as given".to_owned(),
            point => format!("paper's {point}"),
        }
    }
}

/// The references of a machine: both points of the paper for one that is stated in its ratios, otherwise the
/// machine itself, if it has a stable z = 1 motion as it is.
pub(super) fn references(machine: &Machine) -> Result<Vec<Reference>, Failure> {
    if machine.ratios().is_none() {
        let found = zone::find_with_monitor(&machine.scene, &interrupt::watch).ok();
        return Ok(Vec::from_iter(found.map(|orbit| Reference {
            name: "given",
            machine: machine.clone(),
            orbit,
        })));
    }
    [PaperMachine::Unloaded, PaperMachine::Loaded]
        .into_iter()
        .map(|regime| {
            let point = || format!("the paper's point {}", regime.point());
            let machine = Machine::named(regime.name()).with_context(point)?;
            let orbit =
                orbit::find_with_monitor(&machine.scene, &interrupt::watch).with_context(point)?;
            Ok(Reference {
                name: regime.point(),
                machine,
                orbit,
            })
        })
        .collect()
}
