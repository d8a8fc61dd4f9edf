//! Steps of a co-simulation.

use super::*;
use crate::instance::{Ended, Phase};

/// fmi3DoStep. The flag `_never_back` is ignored, because snapshots are complete even if the host goes back in time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3DoStep(
    c: ComponentPointer,
    point: f64,
    size: f64,
    _never_back: Boolean,
    event_needed: *mut Boolean,
    terminate: *mut Boolean,
    early_return: *mut Boolean,
    last_time: *mut f64,
) -> Status {
    // the end of the step stays the host's value, to avoid rounding over several parts
    let (mut begin, mut size, until) = (point, size, point + size);
    loop {
        // SAFETY: the host's promise, see the module
        let (status, part) =
            unsafe { part(c, [begin, size, until], [event_needed, terminate, early_return], last_time) };
        let Some(Part { ended, update, environment, may_return }) = part else { return status };
        let is_last = ended.is_done;
        let may_return = may_return && !is_last;
        let (mut wants_return, mut return_time) = (0, ended.time);
        // SAFETY: the host keeps its function valid; the instance accepts calls while the function runs
        unsafe {
            update(
                environment,
                ended.time,
                Boolean::from(!is_last),
                1,
                Boolean::from(!is_last),
                Boolean::from(may_return),
                &mut wants_return,
                &mut return_time,
            );
        }
        let returns = wants_return != 0 && may_return;
        // SAFETY: the host's promise, see the module
        let status = unsafe { end_update(c, returns, early_return) };
        if status != Status::Ok || is_last || returns {
            return status;
        }
        (begin, size) = (ended.time, until - ended.time);
    }
}

/// A part of a step, after which the host is called back.
struct Part {
    ended: Ended,
    update: IntermediateUpdate,
    environment: *mut c_void,
    may_return: bool,
}

/// Advances by a part of a step and writes the outputs as if the step ended here. Without a callback function, the part
/// is the whole step.
unsafe fn part(
    c: ComponentPointer,
    [point, size, until]: [f64; 3],
    flags: [*mut Boolean; 3],
    last_time: *mut f64,
) -> (Status, Option<Part>) {
    let mut part = None;
    let status = call!(c, DoStep, |instance, host| {
        // SAFETY: the host's promise, see the module
        let [event, terminate, early] = unsafe {
            [
                host.output_value("eventHandlingNeeded", flags[0])?,
                host.output_value("terminateSimulation", flags[1])?,
                host.output_value("earlyReturn", flags[2])?,
            ]
        };
        // SAFETY: as above
        let last = unsafe { host.output_value("lastSuccessfulTime", last_time)? };
        terminate.write(0);
        event.write(0);
        early.write(0);
        last.write(instance.now.simulation.as_ref().map_or(point, |simulation| simulation.time()));
        let [update, environment] = instance.allowed.update;
        let ended = instance.step_to_event([point, size, until], update != 0).inspect_err(|_| {
            // a discarded step has advanced to where it failed
            last.write(instance.now.simulation.as_ref().map_or(point, |simulation| simulation.time()));
        })?;
        event.write(Boolean::from(ended.event));
        early.write(Boolean::from(ended.early));
        last.write(ended.time);
        if update != 0 {
            instance.now.phase = Phase::IntermediateUpdate;
            // SAFETY: the address of the host's function, from fmi3InstantiateCoSimulation
            let update = unsafe { std::mem::transmute::<usize, IntermediateUpdate>(update) };
            let may_return = instance.allowed.early_return;
            part = Some(Part { ended, update, environment: environment as *mut c_void, may_return });
        }
        Ok(())
    });
    (status, part)
}

/// Ends the host's intermediate update within a step.
unsafe fn end_update(c: ComponentPointer, returns: bool, early_return: *mut Boolean) -> Status {
    call!(c, EndIntermediateUpdate, |instance, host| {
        instance.now.phase = Phase::StepComplete;
        if returns {
            // SAFETY: the host's promise, see the module
            unsafe { host.output_value("earlyReturn", early_return) }?.write(1);
        }
        Ok(())
    })
}
