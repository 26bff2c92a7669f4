//! Intermediate update: what the importer sees of a step that goes through events.

use crate::abi::component::Component;
use crate::abi::guard::silent;
use crate::lifecycle::Lifecycle;
use crate::unit::Unit;

/// Goes through a step beforehand, if it may not end early and the importer has a callback for it, and calls that right
/// after each event on the way. The unit is then as it was.
///
/// # Safety
/// `component` is NULL or what instantiation gave the importer, and nothing else refers to it.
pub(super) unsafe fn tell_events_of_step<U: Unit>(
    component: *mut Component<U>,
    point: f64,
    step: f64,
) {
    // SAFETY: by this function's contract; the callback comes to the instance by the importer's own handle, so no reference
    // lives while it is called.
    unsafe {
        let Some(of) = component.as_ref() else {
            return;
        };
        let Some((callback, environment)) = of.importer.update else {
            return;
        };
        if of.instance.awaits {
            return;
        }
        let before = of.instance.clone();
        let mut time = point;
        while let Ok(Ok(true)) = silent(|| (*component).instance.go_to_event(time, point + step)) {
            let instance = &mut (*component).instance;
            (time, instance.lifecycle) = (instance.time(), Lifecycle::Intermediate);
            let (mut is_asked_to_return, mut return_time) = (0, 0.0);
            callback(
                environment,
                time,
                0,
                1,
                1,
                0,
                &raw mut is_asked_to_return,
                &raw mut return_time,
            );
            let instance = &mut (*component).instance;
            if instance.lifecycle != Lifecycle::Intermediate {
                // A call that was wrong there ends the simulation.
                return;
            }
            instance.lifecycle = Lifecycle::Running;
        }
        (*component).instance = before;
    }
}
