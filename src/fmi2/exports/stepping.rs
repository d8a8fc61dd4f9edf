//! Steps and their status.

use super::*;
use crate::instance::Phase;

/// fmi2DoStep. The flag `_never_back` is ignored, because snapshots are complete even if the host goes back in time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2DoStep(c: ComponentPointer, point: f64, size: f64, _never_back: Boolean) -> Status {
    call!(c, DoStep, |instance, _| instance.do_step(point, size))
}

/// fmi2CancelStep. Steps are synchronous, so there is never a step to cancel.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2CancelStep(c: ComponentPointer) -> Status {
    call!(c, CancelStep, |_, _| Ok(()))
}

/// fmi2GetStatus.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetStatus(c: ComponentPointer, kind: c_int, value: *mut Status) -> Status {
    call!(c, GetStatus, |instance, host| {
        // SAFETY: the host's promise, see the module
        let value = unsafe { host.output_value("value", value) }?;
        if kind != DO_STEP_STATUS {
            return Err(no_such_status(kind));
        }
        value.write(if instance.now.phase == Phase::StepFailed { Status::Discard } else { Status::Ok });
        Ok(())
    })
}

/// fmi2GetRealStatus. The only real status is the last successful time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetRealStatus(c: ComponentPointer, kind: c_int, value: *mut f64) -> Status {
    call!(c, GetRealStatus, |instance, host| {
        // SAFETY: the host's promise, see the module
        let value = unsafe { host.output_value("value", value) }?;
        match (kind, &instance.now.simulation) {
            (LAST_SUCCESSFUL_TIME, Some(simulation)) => value.write(simulation.time()),
            _ => return Err(no_such_status(kind)),
        }
        Ok(())
    })
}

/// fmi2GetIntegerStatus. FMI defines no integer status.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetIntegerStatus(c: ComponentPointer, kind: c_int, _value: *mut c_int) -> Status {
    call!(c, GetIntegerStatus, |_, _| Err(no_such_status(kind)))
}

/// fmi2GetBooleanStatus. The FMU never requests the end of the simulation.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetBooleanStatus(c: ComponentPointer, kind: c_int, value: *mut Boolean) -> Status {
    call!(c, GetBooleanStatus, |_, host| {
        // SAFETY: the host's promise, see the module
        let value = unsafe { host.output_value("value", value) }?;
        if kind != TERMINATED {
            return Err(no_such_status(kind));
        }
        value.write(Boolean::from(false));
        Ok(())
    })
}

/// fmi2GetStringStatus. Nothing is ever pending.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetStringStatus(c: ComponentPointer, kind: c_int, value: *mut Text) -> Status {
    call!(c, GetStringStatus, |_, host| {
        // SAFETY: the host's promise, see the module
        let value = unsafe { host.output_value("value", value) }?;
        if kind != PENDING_STATUS {
            return Err(no_such_status(kind));
        }
        value.write(c"no step is pending".as_ptr());
        Ok(())
    })
}

/// Returns the error for an unavailable status. FMI requires fmi2Discard.
fn no_such_status(kind: i32) -> CallError {
    CallError::discard(format!("the status of kind {kind} is not available"))
}
