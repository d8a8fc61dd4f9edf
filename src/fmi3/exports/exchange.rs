//! Events, and model exchange.

use super::*;
use crate::instance::{EVENT_INDICATORS, Iteration};
use crate::model::STATES;

getters! {
    fmi3GetContinuousStateDerivatives GetContinuousStateDerivatives get_derivatives;
    fmi3GetEventIndicators GetEventIndicators get_event_indicators;
    fmi3GetContinuousStates GetContinuousStates get_continuous_states;
    fmi3GetNominalsOfContinuousStates GetNominals get_nominals;
}

plain! {
    fmi3EnterEventMode EnterEventMode enter_event_mode_of_either_kind;
    fmi3EnterStepMode EnterStepMode enter_step_mode;
    fmi3EvaluateDiscreteStates EvaluateDiscreteStates evaluate_discrete_states;
}

plain! {
    fmi3EnterContinuousTimeMode EnterContinuousTimeMode enter_continuous_time_mode_of_exchange;
}

macro_rules! counts {
    ($($function:ident $call:ident $count:expr;)+) => {$(
        #[doc = concat!(stringify!($function), ".")]
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $function(c: ComponentPointer, count: *mut usize) -> Status {
            call!(c, $call, |_, host| {
                // SAFETY: the host's promise, see the module
                unsafe { host.output_value("the number", count) }?.write($count);
                Ok(())
            })
        }
    )+};
}

counts! {
    fmi3GetNumberOfEventIndicators GetNumberOfEventIndicators EVENT_INDICATORS;
    fmi3GetNumberOfContinuousStates GetNumberOfContinuousStates STATES;
}

/// fmi3UpdateDiscreteStates. Hosts iterate until all events are reported; usually there is one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3UpdateDiscreteStates(
    c: ComponentPointer,
    needs_update: *mut Boolean,
    terminate: *mut Boolean,
    nominals_changed: *mut Boolean,
    states_changed: *mut Boolean,
    next_event_defined: *mut Boolean,
    next_event: *mut f64,
) -> Status {
    call!(c, UpdateDiscreteStates, |instance, host| {
        // SAFETY: the host's promise, see the module
        let flags = unsafe {
            [
                host.output_value("discreteStatesNeedUpdate", needs_update)?,
                host.output_value("terminateSimulation", terminate)?,
                host.output_value("nominalsOfContinuousStatesChanged", nominals_changed)?,
                host.output_value("valuesOfContinuousStatesChanged", states_changed)?,
                host.output_value("nextEventTimeDefined", next_event_defined)?,
            ]
        };
        // SAFETY: as above
        let time = unsafe { host.output_value("nextEventTime", next_event)? };
        let Iteration { update, is_needed } = instance.update_discrete_states()?;
        let values = [is_needed, false, false, update.states_changed, update.next.is_some()];
        for (flag, value) in flags.into_iter().zip(values) {
            flag.write(Boolean::from(value));
        }
        time.write(update.next.unwrap_or(0.0));
        Ok(())
    })
}

host_solver!(fmi3CompletedIntegratorStep fmi3SetTime fmi3SetContinuousStates "continuousStates");
