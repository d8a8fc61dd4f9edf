//! Model exchange.

use super::*;

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

host_solver!(fmi2CompletedIntegratorStep fmi2SetTime fmi2SetContinuousStates "x");
