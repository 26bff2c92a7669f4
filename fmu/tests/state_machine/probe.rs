//! All that can be read of an instance, read without touching it.

use softstop_fmi2::*;
use softstop_fmu::table;

use super::calls::{Call, Null, Type};
use super::model::is;
use super::perform::perform;
use crate::common::{InstantiateArguments, OK, Unit, reference};

/// An instance without a log.
pub fn silent() -> Unit {
    let arguments = InstantiateArguments {
        has_callbacks: false,
        ..InstantiateArguments::plain()
    };
    Unit::instantiate(&arguments).expect("an instance")
}

/// An instance that takes up the state of another one to be read in its place.
pub struct Probe {
    unit: Unit,
    calls: Vec<Call>,
}

impl Probe {
    pub fn new() -> Self {
        let mut calls = Vec::new();
        for kind in [Type::Real, Type::Integer, Type::Boolean] {
            // Apart from each other, since outputs cannot always be read.
            for is_calculated in [false, true] {
                let rows = table().rows().filter(|row| is(&row.kind, kind));
                let rows = rows.filter(|row| row.is_calculated() == is_calculated);
                let references = rows.map(|row| row.reference).collect();
                calls.push(Call::Get(kind, references, Null::Nothing));
            }
        }
        let (velocity, by) = (reference("velocity"), (reference("force"), 1.0));
        let none = Null::Nothing;
        calls.push(Call::GetOutputDerivatives(vec![(velocity, 2)], none));
        calls.push(Call::Directional(vec![velocity], vec![by], none));
        Self {
            unit: silent(),
            calls,
        }
    }

    fn take_up(&self, unit: &Unit) {
        let state = unit.keep();
        // SAFETY: both are alive.
        assert_eq!(unsafe { fmi2SetFMUstate(self.unit.component, state) }, OK);
        unit.free(state);
    }

    /// Status and bits of everything that can be read.
    pub fn everything(&self, unit: &Unit) -> Vec<(i32, Vec<u64>)> {
        self.take_up(unit);
        let read = self.calls.iter().map(|call| {
            let ((_, status), values) = perform(self.unit.component, call);
            (status, values.into_iter().map(f64::to_bits).collect())
        });
        let time = self.unit.last_successful_time().to_bits();
        read.chain([(self.unit.step_status(), vec![time])])
            .collect()
    }

    pub fn position(&self, unit: &Unit) -> f64 {
        self.take_up(unit);
        self.unit.get("position")
    }
}
