//! The functions of the standard for model exchange.
#![expect(
    clippy::missing_safety_doc,
    non_snake_case,
    reason = "names and contracts are those of the FMI 2.0 standard"
)]

use libc::{c_int, c_void, size_t};

use super::host::Importer;
use crate::abi::component::Component;
use crate::abi::guard::guarded;
use crate::abi::pointers::{read, write, write_one};
use crate::unit::Unit;

/// `fmi2EventInfo`.
#[derive(Debug, Clone, Copy)]
#[repr(C)]
pub struct EventInfo {
    /// Another iteration is needed.
    pub new_discrete_states_needed: c_int,
    /// The unit asks to end the simulation.
    pub terminate_simulation: c_int,
    /// What is much of a state has changed.
    pub nominals_of_continuous_states_changed: c_int,
    /// States have changed.
    pub values_of_continuous_states_changed: c_int,
    /// There is a next event.
    pub next_event_time_defined: c_int,
    /// When it comes, in s.
    pub next_event_time: f64,
}

functions! { $ export_v2_exchange v2 Importer; ;
    /// Enters event mode.
    fn fmi2EnterEventMode<U>(component) {
        component.require_exchange()?;
        component.instance.enter_event_mode_of_exchange()
    }

    /// Lets the event happen, and tells when the next one comes.
    fn fmi2NewDiscreteStates<U>(component, event_info: *mut EventInfo) {
        let info = write_one("fmi2eventInfo", event_info)?;
        component.require_exchange()?;
        let iteration = component.update_discrete_states()?;
        *info = EventInfo {
            new_discrete_states_needed: iteration.is_unfinished.into(),
            terminate_simulation: 0,
            nominals_of_continuous_states_changed: iteration.has_new_nominals.into(),
            values_of_continuous_states_changed: iteration.has_new_states.into(),
            next_event_time_defined: iteration.next.is_some().into(),
            next_event_time: iteration.next.unwrap_or(0.0),
        };
        Ok(())
    }

    /// Leaves event mode.
    fn fmi2EnterContinuousTimeMode<U>(component) {
        component.require_exchange()?;
        component.instance.enter_continuous_time_mode()
    }

    /// Takes an integrator step that is accepted.
    fn fmi2CompletedIntegratorStep<U>(
        component, _no_set_state_prior: c_int, enter_event_mode: *mut c_int,
        terminate_simulation: *mut c_int
    ) {
        let enter = write_one("enterEventMode", enter_event_mode)?;
        let terminate = write_one("terminateSimulation", terminate_simulation)?;
        component.require_exchange()?;
        (*enter, *terminate) = (component.instance.complete_step()?.into(), 0);
        Ok(())
    }

    /// Sets the time.
    fn fmi2SetTime<U>(component, time: f64) {
        component.require_exchange()?;
        component.instance.set_time(time)
    }

    /// Sets the states.
    fn fmi2SetContinuousStates<U>(component, states: *const f64, count: size_t) {
        component.require_exchange()?;
        component.instance.set_states(read("x", states, count)?)
    }

    /// Reads the derivatives of the states.
    fn fmi2GetDerivatives<U>(component, derivatives: *mut f64, count: size_t) {
        component.require_exchange()?;
        component.instance.get_state_derivatives(write("derivatives", derivatives, count)?)
    }

    /// Reads the event indicators.
    fn fmi2GetEventIndicators<U>(component, indicators: *mut f64, count: size_t) {
        component.require_exchange()?;
        component.instance.get_indicators(write("eventIndicators", indicators, count)?)
    }

    /// Reads the states.
    fn fmi2GetContinuousStates<U>(component, states: *mut f64, count: size_t) {
        component.require_exchange()?;
        component.instance.get_states(write("x", states, count)?)
    }

    /// Reads what is much of each state.
    fn fmi2GetNominalsOfContinuousStates<U>(component, nominals: *mut f64, count: size_t) {
        component.require_exchange()?;
        component.instance.get_nominals(write("x_nominal", nominals, count)?)
    }
}
