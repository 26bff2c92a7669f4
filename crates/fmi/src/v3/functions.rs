//! The functions of the standard for the life of an instance, its states, its derivatives and its steps.
//!
//! Each turns pointers into slices, calls the safe [`Instance`](crate::instance::Instance) and turns a [`Fault`] into a
//! status and one log line. Enumerations and Booleans of the importer come in as plain integers, since a number out of
//! their range must not be undefined behaviour.

use libc::{c_char, c_int, c_uint, c_void, size_t};

use super::arrays::expanded;
use super::host::{
    ClockUpdateCallback, IntermediateUpdateCallback, LogMessageCallback, PreemptionCallback,
    instantiate, sink,
};
use super::intermediate::tell_events_of_step;
use super::values::check_count;
use crate::abi::component::{Component, Importer, refuse};
use crate::abi::guard::{guarded, handle, silent};
use crate::abi::pointers::{read, string, write, write_one};
use crate::abi::state;
use crate::event::Handling;
use crate::fault::Fault;
use crate::instance::Instance;
use crate::solving::space_of;
use crate::unit::Unit;

functions! { $ export_v3 v3;
    /// The version of the standard.
    fn fmi3GetVersion<U>() -> *const c_char {
        c"3.0".as_ptr()
    }

    /// Makes an instance, or returns NULL after one log line.
    fn fmi3InstantiateCoSimulation<U>(
        instance_name: *const c_char, instantiation_token: *const c_char,
        _resource_path: *const c_char, _visible: u8, logging_on: u8, event_mode_used: u8,
        early_return_allowed: u8, _required_intermediate_variables: *const c_uint,
        _required_count: size_t, environment: *mut c_void, log_message: LogMessageCallback,
        intermediate_update: IntermediateUpdateCallback
    ) -> *mut c_void {
        let (in_event_mode, early) = (event_mode_used != 0, early_return_allowed != 0);
        let update = intermediate_update.filter(|_| !early);
        let importer = Importer {
            handling: Handling { in_event_mode, early },
            update: update.map(|callback| (callback, environment)),
            ..Importer::default()
        };
        let sink = sink(environment, log_message);
        handle(|| {
            instantiate::<U>(instance_name, instantiation_token, logging_on != 0, importer, sink)
        })
    }

    /// Makes an instance for model exchange, or returns NULL after one log line.
    fn fmi3InstantiateModelExchange<U>(
        instance_name: *const c_char, instantiation_token: *const c_char,
        _resource_path: *const c_char, _visible: u8, logging_on: u8, environment: *mut c_void,
        log_message: LogMessageCallback
    ) -> *mut c_void {
        let sink = sink(environment, log_message);
        let importer = Importer { integrates: true, ..Importer::default() };
        handle(|| {
            instantiate::<U>(instance_name, instantiation_token, logging_on != 0, importer, sink)
        })
    }

    /// There are no instances for scheduled execution.
    fn fmi3InstantiateScheduledExecution<U>(
        _instance_name: *const c_char, _instantiation_token: *const c_char,
        _resource_path: *const c_char, _visible: u8, _logging_on: u8, environment: *mut c_void,
        log_message: LogMessageCallback, _clock_update: ClockUpdateCallback,
        _lock_preemption: PreemptionCallback, _unlock_preemption: PreemptionCallback
    ) -> *mut c_void {
        let fault = Fault::NotOffered("the unit is not for scheduled execution");
        let sink = sink(environment, log_message);
        let refused = silent(|| refuse(&sink, "fmi3InstantiateScheduledExecution", &fault));
        debug_assert!(refused.is_ok());
        std::ptr::null_mut()
    }

    /// Carries the motion on by one communication step, or to an event on the way.
    fn fmi3DoStep<U>(
        component: *mut c_void, current_communication_point: f64, communication_step_size: f64,
        _no_set_state_prior: u8, event_handling_needed: *mut u8, terminate_simulation: *mut u8,
        early_return: *mut u8, last_successful_time: *mut f64
    ) -> c_int {
        let component = component.cast::<Component<U>>();
        let (point, step) = (current_communication_point, communication_step_size);
        tell_events_of_step(component, point, step);
        guarded(component.as_mut(), "fmi3DoStep", &mut |component| {
            let event = write_one("eventHandlingNeeded", event_handling_needed)?;
            let terminate = write_one("terminateSimulation", terminate_simulation)?;
            let early = write_one("earlyReturn", early_return)?;
            let time = write_one("lastSuccessfulTime", last_successful_time)?;
            component.co_simulation()?;
            let handling = component.importer.handling;
            let ending = component.reported(|instance, report| {
                instance.do_step_to_event(point, step, handling, report)
            })?;
            (*event, *terminate) = (u8::from(ending.event), 0);
            (*early, *time) = (u8::from(ending.early), component.instance.time());
            Ok(())
        })
    }

    ;

    /// Sets start time, stop time and tolerance, of which the last is of no use to an exact solution, and enters
    /// initialisation.
    fn fmi3EnterInitializationMode<U>(
        component, tolerance_defined: u8, tolerance: f64, start_time: f64, stop_time_defined: u8,
        stop_time: f64
    ) {
        let tolerance = (tolerance_defined != 0).then_some(tolerance);
        let stop = (stop_time_defined != 0).then_some(stop_time);
        component.setup(tolerance, start_time, stop)?;
        component.instance.enter_initialization()
    }

    /// Enters event mode.
    fn fmi3EnterEventMode<U>(component) {
        if component.importer.integrates {
            return component.instance.enter_event_mode_of_exchange();
        }
        if !component.importer.has_event_mode() {
            return Err(Fault::NotOffered("eventModeUsed was false"));
        }
        component.instance.enter_event_mode()
    }

    /// Lets the event happen, and tells when the next one comes.
    fn fmi3UpdateDiscreteStates<U>(
        component, discrete_states_need_update: *mut u8, terminate_simulation: *mut u8,
        nominals_of_continuous_states_changed: *mut u8,
        values_of_continuous_states_changed: *mut u8, next_event_time_defined: *mut u8,
        next_event_time: *mut f64
    ) {
        let need_update = write_one("discreteStatesNeedUpdate", discrete_states_need_update)?;
        let terminate = write_one("terminateSimulation", terminate_simulation)?;
        let nominals =
            write_one("nominalsOfContinuousStatesChanged", nominals_of_continuous_states_changed)?;
        let values =
            write_one("valuesOfContinuousStatesChanged", values_of_continuous_states_changed)?;
        let defined = write_one("nextEventTimeDefined", next_event_time_defined)?;
        let time = write_one("nextEventTime", next_event_time)?;
        let iteration = component.reported(Instance::update_discrete_states)?;
        (*need_update, *terminate) = (iteration.is_unfinished.into(), 0);
        *nominals = iteration.has_new_nominals.into();
        *values = iteration.has_new_states.into();
        *defined = iteration.next.is_some().into();
        *time = iteration.next.unwrap_or(0.0);
        Ok(())
    }

    /// Enters step mode.
    fn fmi3EnterStepMode<U>(component) {
        component.co_simulation()?.enter_step_mode()
    }

    /// Derivatives of outputs along a direction of inputs.
    fn fmi3GetDirectionalDerivative<U>(
        component, unknowns: *const c_uint, unknown_count: size_t, knowns: *const c_uint,
        known_count: size_t, seed: *const f64, seed_count: size_t, sensitivity: *mut f64,
        sensitivity_count: size_t
    ) {
        let unknowns = read("unknowns", unknowns, unknown_count)?;
        let knowns = expanded(component, read("knowns", knowns, known_count)?)?;
        let seed = read("seed", seed, seed_count)?;
        let sensitivity = write("sensitivity", sensitivity, sensitivity_count)?;
        check_count("nSeed", seed_count, knowns.len())?;
        check_count("nSensitivity", sensitivity_count, unknown_count)?;
        component.instance.directional_derivative(unknowns, &knowns, seed, sensitivity)
    }

    /// Derivatives of a sum of outputs by each input.
    fn fmi3GetAdjointDerivative<U>(
        component, unknowns: *const c_uint, unknown_count: size_t, knowns: *const c_uint,
        known_count: size_t, seed: *const f64, seed_count: size_t, sensitivity: *mut f64,
        sensitivity_count: size_t
    ) {
        let unknowns = read("unknowns", unknowns, unknown_count)?;
        let knowns = expanded(component, read("knowns", knowns, known_count)?)?;
        let seed = read("seed", seed, seed_count)?;
        let sensitivity = write("sensitivity", sensitivity, sensitivity_count)?;
        check_count("nSeed", seed_count, unknown_count)?;
        check_count("nSensitivity", sensitivity_count, knowns.len())?;
        component.instance.adjoint_derivative(unknowns, &knowns, seed, sensitivity)
    }

    /// Reads time derivatives of outputs.
    fn fmi3GetOutputDerivatives<U>(
        component, references: *const c_uint, count: size_t, orders: *const c_int,
        values: *mut f64, value_count: size_t
    ) {
        check_count("nValues", value_count, count)?;
        let references = read("valueReferences", references, count)?;
        let orders = read("orders", orders, count)?;
        let values = write("values", values, count)?;
        component.co_simulation()?.get_output_derivatives(references, orders, values)
    }

    /// How many event indicators there are.
    fn fmi3GetNumberOfEventIndicators<U>(component, count: *mut size_t) {
        component.exchange()?;
        *write_one("nEventIndicators", count)? = space_of::<U>().indicators.len();
        Ok(())
    }

    /// How many states there are.
    fn fmi3GetNumberOfContinuousStates<U>(component, count: *mut size_t) {
        component.exchange()?;
        *write_one("nContinuousStates", count)? = space_of::<U>().states.len();
        Ok(())
    }
}

shared_functions! { $ export_v3_shared v3 u8, u8, "continuousStates", "nominals";
    fmi3FreeInstance fmi3SetDebugLogging fmi3ExitInitializationMode fmi3Terminate fmi3Reset
    fmi3GetFMUState fmi3SetFMUState fmi3FreeFMUState fmi3SerializedFMUStateSize fmi3SerializeFMUState
    fmi3DeserializeFMUState
    fmi3EnterContinuousTimeMode fmi3CompletedIntegratorStep fmi3SetTime fmi3SetContinuousStates
    fmi3GetContinuousStateDerivatives fmi3GetEventIndicators fmi3GetContinuousStates
    fmi3GetNominalsOfContinuousStates
}
