//! The functions that both standards have, each under its own names.

/// Makes those functions of a standard: the export macro and the module; the types of a Boolean and of a byte; what the
/// arguments for states and for nominals are called; the names of the functions, in the order of the list below.
macro_rules! shared_functions {
    ($dollar:tt $export:ident $module:ident $boolean:ty, $byte:ty, $states:literal, $nominals:literal;
        $free:ident $log:ident $exit:ident $terminate:ident $reset:ident
        $keep:ident $go_back:ident $free_state:ident $measure:ident $store:ident $restore:ident
        $continuous:ident $complete:ident $set_time:ident $set_states:ident
        $derivatives:ident $indicators:ident $get_states:ident $get_nominals:ident
    ) => {
        functions! { $dollar $export $module;
            /// Frees an instance, once; NULL is allowed.
            fn $free<U>(component: *mut c_void) -> () {
                if !component.is_null() {
                    let instance = component.cast::<Component<U>>();
                    let freed = silent(|| drop(Box::from_raw(instance)));
                    debug_assert!(freed.is_ok());
                }
            }

            ;

            /// Switches categories of log lines.
            fn $log<U>(
                component, logging_on: $boolean, count: size_t, categories: *const *const c_char
            ) {
                let names = read("categories", categories, count)?;
                let names = names.iter().map(|&name| string("categories", name));
                let names = names.collect::<Result<Vec<_>, _>>()?;
                component.wanted.switch(logging_on != 0, &names)
            }

            /// Leaves initialisation, for event mode if there is one.
            fn $exit<U>(component) {
                component.exit_initialization()
            }

            /// Ends the experiment.
            fn $terminate<U>(component) {
                component.instance.terminate()
            }

            /// Leads back to the state right after instantiation.
            fn $reset<U>(component) {
                component.reset();
                Ok(())
            }

            /// Keeps a snapshot; one that was kept before is overwritten.
            fn $keep<U>(component, state: *mut *mut c_void) {
                state::keep(component, state)
            }

            /// Goes back to a snapshot.
            fn $go_back<U>(component, state: *mut c_void) {
                state::go_back(component, state)
            }

            /// Frees a snapshot and sets its pointer to NULL; NULL is allowed.
            fn $free_state<U>(_component, state: *mut *mut c_void) {
                state::free::<U>(state)
            }

            /// How many bytes a snapshot takes.
            fn $measure<U>(_component, state: *mut c_void, size: *mut size_t) {
                state::measure::<U>(state, size)
            }

            /// Writes a snapshot as bytes; what is left of them becomes zero.
            fn $store<U>(_component, state: *mut c_void, bytes: *mut $byte, size: size_t) {
                state::store::<U>(state, bytes.cast(), size)
            }

            /// Makes a snapshot of bytes. The pointer's old content is not looked at.
            fn $restore<U>(
                _component, bytes: *const $byte, size: size_t, state: *mut *mut c_void
            ) {
                state::restore::<U>(bytes.cast(), size, state)
            }

            /// Leaves event mode for continuous-time mode.
            fn $continuous<U>(component) {
                component.exchange()?.enter_continuous_time_mode()
            }

            /// Takes an integrator step that is accepted.
            fn $complete<U>(
                component, _no_set_state_prior: $boolean, enter_event_mode: *mut $boolean,
                terminate_simulation: *mut $boolean
            ) {
                let enter = write_one("enterEventMode", enter_event_mode)?;
                let terminate = write_one("terminateSimulation", terminate_simulation)?;
                (*enter, *terminate) = (component.exchange()?.complete_step()?.into(), 0);
                Ok(())
            }

            /// Sets the time.
            fn $set_time<U>(component, time: f64) {
                component.exchange()?.set_time(time)
            }

            /// Sets the states.
            fn $set_states<U>(component, states: *const f64, count: size_t) {
                component.exchange()?.set_states(read($states, states, count)?)
            }

            /// Reads the derivatives of the states.
            fn $derivatives<U>(component, derivatives: *mut f64, count: size_t) {
                let instance = component.exchange()?;
                instance.get_state_derivatives(write("derivatives", derivatives, count)?)
            }

            /// Reads the event indicators.
            fn $indicators<U>(component, indicators: *mut f64, count: size_t) {
                let instance = component.exchange()?;
                instance.get_indicators(write("eventIndicators", indicators, count)?)
            }

            /// Reads the states.
            fn $get_states<U>(component, states: *mut f64, count: size_t) {
                component.exchange()?.get_states(write($states, states, count)?)
            }

            /// Reads what is much of each state.
            fn $get_nominals<U>(component, nominals: *mut f64, count: size_t) {
                component.exchange()?.get_nominals(write($nominals, nominals, count)?)
            }
        }
    };
}
