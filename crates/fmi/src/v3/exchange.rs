//! The functions of the standard for model exchange.
#![expect(
    clippy::missing_safety_doc,
    non_snake_case,
    reason = "names and contracts are those of the FMI 3.0 standard"
)]

use libc::{c_int, c_void, size_t};

use super::host::Importer;
use crate::abi::component::Component;
use crate::abi::guard::guarded;
use crate::abi::pointers::{read, write, write_one};
use crate::solving::space_of;
use crate::unit::Unit;

functions! { $ export_v3_exchange v3 Importer; ;
    /// Leaves event mode.
    fn fmi3EnterContinuousTimeMode<U>(component) {
        component.require_exchange()?;
        component.instance.enter_continuous_time_mode()
    }

    /// Takes an integrator step that is accepted.
    fn fmi3CompletedIntegratorStep<U>(
        component, _no_set_state_prior: u8, enter_event_mode: *mut u8, terminate_simulation: *mut u8
    ) {
        let enter = write_one("enterEventMode", enter_event_mode)?;
        let terminate = write_one("terminateSimulation", terminate_simulation)?;
        component.require_exchange()?;
        (*enter, *terminate) = (component.instance.complete_step()?.into(), 0);
        Ok(())
    }

    /// Sets the time.
    fn fmi3SetTime<U>(component, time: f64) {
        component.require_exchange()?;
        component.instance.set_time(time)
    }

    /// Sets the states.
    fn fmi3SetContinuousStates<U>(component, states: *const f64, count: size_t) {
        component.require_exchange()?;
        component.instance.set_states(read("continuousStates", states, count)?)
    }

    /// Reads the derivatives of the states.
    fn fmi3GetContinuousStateDerivatives<U>(component, derivatives: *mut f64, count: size_t) {
        component.require_exchange()?;
        component.instance.get_state_derivatives(write("derivatives", derivatives, count)?)
    }

    /// Reads the event indicators.
    fn fmi3GetEventIndicators<U>(component, indicators: *mut f64, count: size_t) {
        component.require_exchange()?;
        component.instance.get_indicators(write("eventIndicators", indicators, count)?)
    }

    /// Reads the states.
    fn fmi3GetContinuousStates<U>(component, states: *mut f64, count: size_t) {
        component.require_exchange()?;
        component.instance.get_states(write("continuousStates", states, count)?)
    }

    /// Reads what is much of each state.
    fn fmi3GetNominalsOfContinuousStates<U>(component, nominals: *mut f64, count: size_t) {
        component.require_exchange()?;
        component.instance.get_nominals(write("nominals", nominals, count)?)
    }

    /// How many event indicators there are.
    fn fmi3GetNumberOfEventIndicators<U>(component, count: *mut size_t) {
        component.require_exchange()?;
        *write_one("nEventIndicators", count)? = space_of::<U>().indicators.len();
        Ok(())
    }

    /// How many states there are.
    fn fmi3GetNumberOfContinuousStates<U>(component, count: *mut size_t) {
        component.require_exchange()?;
        *write_one("nContinuousStates", count)? = space_of::<U>().states.len();
        Ok(())
    }
}
