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
mod variables;
mod world;

use std::ffi::c_void;

use crate::common::OK;
use calls::{Call, UNITS};
use perform::perform;
use probe::{Probe, silent};
use softstop_fmi2::*;
use world::World;

/// Three steps from the beginning: all that can be read after each.
fn three_steps(probe: &Probe, component: *mut c_void) -> Vec<Vec<(i32, u64)>> {
    for call in [
        Call::Reset,
        Call::SetupExperiment(None, 0.0, None),
        Call::EnterInitializationMode,
        Call::ExitInitializationMode,
    ] {
        assert_eq!(perform(component, &call).0, OK, "{call:?}");
    }
    (0..3)
        .map(|k| {
            // SAFETY: the instance is alive.
            let status = unsafe { fmi2DoStep(component, 4.0 * f64::from(k), 4.0, 1) };
            assert_eq!(status, OK);
            probe.everything(component)
        })
        .collect()
}

impl World {
    /// Each unit is as its shadow, and after a reset as a fresh one; then everything is freed.
    fn end(mut self) {
        let fresh = silent();
        let expected = three_steps(&self.probe, fresh);
        for slot in self.units.iter().flatten() {
            let own = self.probe.everything(slot.component);
            let same = own == self.probe.everything(slot.shadow);
            assert!(
                same,
                "a read or a refused call left a trace: {:?}",
                slot.model
            );
            assert!(
                three_steps(&self.probe, slot.component) == expected,
                "reset is not fresh"
            );
        }
        for mut kept in self.states.iter_mut().filter_map(Option::take) {
            // SAFETY: each snapshot is freed once, by any instance.
            unsafe {
                assert_eq!(fmi2FreeFMUstate(fresh, &raw mut kept.state), OK);
                assert_eq!(fmi2FreeFMUstate(fresh, &raw mut kept.shadow), OK);
            }
        }
        (0..UNITS).for_each(|index| self.free(index));
        // SAFETY: made above and freed once.
        unsafe { fmi2FreeInstance(fresh) };
    }
}

/// Makes calls to several units.
///
/// # Panics
/// If one does other than the model says.
pub fn run(calls: &[(usize, Call)]) {
    let mut world = World::new();
    for index in 0..UNITS {
        world.run(index, &Call::Instantiate(calls::Birth::Plain));
    }
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
