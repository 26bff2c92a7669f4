//! The machine as its outputs see it.

use std::cell::OnceCell;

use serde::{Deserialize, Deserializer, Serialize, Serializer};
use softstop::{Energy, Impact, PhaseKind, Rates, Sample, Simulation, Snapshot};

/// A running machine: sampled once at each time, however many outputs are read.
#[derive(Debug, Clone)]
pub struct Machine {
    simulation: Simulation,
    seen: Seen,
}

/// What was computed of the present state.
#[derive(Debug, Clone, Default)]
struct Seen {
    sample: OnceCell<Sample>,
    energy: OnceCell<Energy>,
    rates: OnceCell<Rates>,
}

impl Machine {
    pub(crate) fn new(simulation: Simulation) -> Self {
        Self {
            simulation,
            seen: Seen::default(),
        }
    }

    pub(crate) fn simulation(&self) -> &Simulation {
        &self.simulation
    }

    /// The simulation, to be changed: what was seen of it holds no more.
    pub(crate) fn change(&mut self) -> &mut Simulation {
        self.seen = Seen::default();
        &mut self.simulation
    }

    pub(crate) fn sample(&self) -> &Sample {
        self.seen.sample.get_or_init(|| self.simulation.sample())
    }

    pub(crate) fn rates(&self) -> &Rates {
        self.seen.rates.get_or_init(|| self.simulation.rates())
    }

    pub(crate) fn energy(&self) -> &Energy {
        self.seen.energy.get_or_init(|| self.simulation.energy())
    }

    /// The last impact; before the first one, zeros.
    pub(crate) fn last_impact(&self) -> Impact {
        self.simulation.last_impact().unwrap_or_default()
    }

    /// Number of the present phase, as in the enumeration [`PHASE`](crate::units::PHASE).
    pub(crate) fn phase(&self) -> i32 {
        match self.sample().phase {
            PhaseKind::Free => 1,
            PhaseKind::Pierce => 2,
            PhaseKind::Cut => 3,
            PhaseKind::Gap => 4,
            PhaseKind::Stop => 5,
            PhaseKind::Stuck => 6,
            PhaseKind::Resting => 7,
            PhaseKind::Released => 8,
            PhaseKind::Chatter => 9,
        }
    }
}

impl Serialize for Machine {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.simulation.snapshot().serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Machine {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let snapshot = Snapshot::deserialize(deserializer)?;
        let simulation = Simulation::restored(&snapshot);
        simulation.map(Self::new).map_err(serde::de::Error::custom)
    }
}
