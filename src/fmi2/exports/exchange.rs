//! Model exchange.

use super::*;

macro_rules! getters {
    ($($function:ident $call:ident $method:ident;)+) => {$(
        #[doc = concat!(stringify!($function), ".")]
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $function(c: ComponentPointer, values: *mut f64, count: usize) -> Status {
            call!(c, $call, |instance, host| {
                // SAFETY: the host's promise, see the module
                let values = unsafe { host.output("the array", values, count) }?;
                instance.$method(values)
            })
        }
    )+};
}

plain! {
    fmi2EnterEventMode EnterEventMode enter_event_mode;
    fmi2EnterContinuousTimeMode EnterContinuousTimeMode enter_continuous_time_mode;
}

getters! {
    fmi2GetDerivatives GetDerivatives get_derivatives;
    fmi2GetEventIndicators GetEventIndicators get_event_indicators;
    fmi2GetContinuousStates GetContinuousStates get_continuous_states;
    fmi2GetNominalsOfContinuousStates GetNominals get_nominals;
}

/// fmi2NewDiscreteStates.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2NewDiscreteStates(c: ComponentPointer, info: *mut EventInfo) -> Status {
    call!(c, NewDiscreteStates, |instance, host| {
        // SAFETY: the host's promise, see the module
        let info = unsafe { host.output_value("fmi2EventInfo", info) }?;
        let update = instance.new_discrete_states()?;
        info.write(EventInfo {
            states_changed: Boolean::from(update.states_changed),
            next_event_defined: Boolean::from(update.next.is_some()),
            next_event: update.next.unwrap_or(0.0),
            ..EventInfo::default()
        });
        Ok(())
    })
}

/// fmi2CompletedIntegratorStep. Snapshots are complete, so it makes no difference whether the host may go back in time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2CompletedIntegratorStep(
    c: ComponentPointer,
    _never_back: Boolean,
    enter_event_mode: *mut Boolean,
    terminate_simulation: *mut Boolean,
) -> Status {
    call!(c, CompletedIntegratorStep, |instance, host| {
        // SAFETY: the host's promise, see the module
        let (event, end) = unsafe {
            (
                host.output_value("enterEventMode", enter_event_mode)?,
                host.output_value("terminateSimulation", terminate_simulation)?,
            )
        };
        event.write(Boolean::from(instance.completed_integrator_step()?));
        end.write(0);
        Ok(())
    })
}

/// fmi2SetTime.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetTime(c: ComponentPointer, time: f64) -> Status {
    call!(c, SetTime, |instance, _| instance.set_time(time))
}

/// fmi2SetContinuousStates.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetContinuousStates(c: ComponentPointer, states: *const f64, count: usize) -> Status {
    call!(c, SetContinuousStates, |instance, host| {
        // SAFETY: the host's promise, see the module
        let states = unsafe { host.input("x", states, count) }?;
        instance.set_continuous_states(states)
    })
}
