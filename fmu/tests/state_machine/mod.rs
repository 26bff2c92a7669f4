//! Random sequences of all 34 calls, with the arguments that an importer may pass by mistake.
//!
//! A model in the test (`model.rs`) says which calls are carried out. Each refused call must
//! leave one line in the log that names it, and nothing else that could be read.
#![allow(unsafe_code, reason = "calls the C functions as an importer does")]

mod calls;
pub mod draw;
mod model;
mod perform;
mod probe;
mod slot;
mod snapshots;
mod world;

use crate::common::{OK, Unit};
use calls::Call;
use probe::{Probe, silent};
use world::World;

/// Three steps from the beginning: all that can be read after each.
fn three_steps(probe: &Probe, unit: &Unit) -> Vec<Vec<(i32, Vec<u64>)>> {
    assert_eq!(unit.reset(), OK);
    unit.begin();
    let steps = (0..3).map(|k| {
        assert_eq!(unit.step(4.0 * f64::from(k), 4.0), OK);
        probe.everything(unit)
    });
    steps.collect()
}

impl World {
    /// Each unit is as its shadow, and after a reset as a fresh one; snapshots are freed.
    fn end(self) {
        let fresh = silent();
        let expected = three_steps(&self.probe, &fresh);
        for slot in self.units.iter().flatten() {
            let own = self.probe.everything(&slot.unit);
            let same = own == self.probe.everything(&slot.shadow);
            let model = &slot.model;
            assert!(same, "a read or a refused call left a trace: {model:?}");
            let again = three_steps(&self.probe, &slot.unit);
            assert!(again == expected, "reset is not fresh");
        }
        for kept in self.states.into_iter().flatten() {
            fresh.free(kept.state);
            fresh.free(kept.shadow);
        }
    }
}

/// Makes calls to several units.
///
/// # Panics
/// If one does other than the model says.
pub fn run(calls: &[(usize, Call)]) {
    let mut world = World::new();
    for (index, call) in calls {
        world.run(*index, call);
    }
    world.end();
}

#[cfg(test)]
proptest::proptest! {
    #![proptest_config(softstop_testing::cases(2000))]

    #[test]
    fn all_calls_in_any_order(calls in draw::sequence()) {
        run(&calls);
    }
}
