//! The terminals: what is connected together.

use softstop_fmi::Flow::{Inflow, Signal};
use softstop_fmi::Terminal;

/// Those of drive and strip have the members of the units beside this one.
pub(crate) const TERMINALS: &[Terminal] = &[
    Terminal {
        name: "flange",
        description: "Flange at the mass: its motion, and the external force on it",
        members: &[
            ("position", Signal, "position"),
            ("velocity", Signal, "velocity"),
            ("acceleration", Signal, "acceleration"),
            ("force", Inflow, "force"),
        ],
    },
    Terminal {
        name: "drive",
        description: "Rotating unbalance that drives the mass",
        members: &[
            ("speed", Signal, "drive.speed"),
            ("amplitude", Signal, "drive.amplitude"),
            ("angle", Signal, "drive.angle"),
            ("work", Signal, "drive.work"),
        ],
    },
    Terminal {
        name: "strip",
        description: "Feed of strips",
        members: &[
            ("material", Signal, "material"),
            ("material_real", Signal, "material_real"),
        ],
    },
];
