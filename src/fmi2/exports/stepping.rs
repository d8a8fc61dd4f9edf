//! Steps and their status.

use crate::fmi2::c_types::c_int;

use super::super::calls::Call;
use super::super::component::run;
use super::super::host_memory::HostMemory;
use super::super::instance::{Instance, no_such_status};
use super::super::types::{Boolean, ComponentPointer, PENDING_STATUS, Status, Text};

/// fmi2DoStep. Snapshots are complete, so it makes no difference whether the host may go back in time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2DoStep(c: ComponentPointer, point: f64, size: f64, _never_back: Boolean) -> Status {
    // SAFETY: the host's promise, see the module
    unsafe { run(c, Call::DoStep, |instance, _| instance.do_step(point, size)) }
}

/// fmi2CancelStep. Steps are synchronous, so there is never one to cancel.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2CancelStep(c: ComponentPointer) -> Status {
    // SAFETY: the host's promise, see the module
    unsafe { run(c, Call::CancelStep, |_, _| Ok(())) }
}

/// fmi2GetStatus.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetStatus(c: ComponentPointer, kind: c_int, value: *mut Status) -> Status {
    let body = |instance: &mut Instance, host: &HostMemory| {
        // SAFETY: the host's promise, see the module
        unsafe { host.output_value("value", value) }?.write(instance.status(kind)?);
        Ok(())
    };
    // SAFETY: the host's promise, see the module
    unsafe { run(c, Call::GetStatus, body) }
}

/// fmi2GetRealStatus.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetRealStatus(c: ComponentPointer, kind: c_int, value: *mut f64) -> Status {
    let body = |instance: &mut Instance, host: &HostMemory| {
        // SAFETY: the host's promise, see the module
        unsafe { host.output_value("value", value) }?.write(instance.real_status(kind)?);
        Ok(())
    };
    // SAFETY: the host's promise, see the module
    unsafe { run(c, Call::GetRealStatus, body) }
}

/// fmi2GetIntegerStatus. FMI defines no integer status.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetIntegerStatus(c: ComponentPointer, kind: c_int, _value: *mut c_int) -> Status {
    // SAFETY: the host's promise, see the module
    unsafe { run(c, Call::GetIntegerStatus, |_, _| Err(no_such_status(kind))) }
}

/// fmi2GetBooleanStatus.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetBooleanStatus(c: ComponentPointer, kind: c_int, value: *mut Boolean) -> Status {
    let body = |instance: &mut Instance, host: &HostMemory| {
        // SAFETY: the host's promise, see the module
        unsafe { host.output_value("value", value) }?.write(Boolean::from(instance.boolean_status(kind)?));
        Ok(())
    };
    // SAFETY: the host's promise, see the module
    unsafe { run(c, Call::GetBooleanStatus, body) }
}

/// fmi2GetStringStatus. Nothing is ever pending.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetStringStatus(c: ComponentPointer, kind: c_int, value: *mut Text) -> Status {
    let body = |_: &mut Instance, host: &HostMemory| {
        // SAFETY: the host's promise, see the module
        let value = unsafe { host.output_value("value", value) }?;
        if kind != PENDING_STATUS {
            return Err(no_such_status(kind));
        }
        value.write(c"no step is pending".as_ptr());
        Ok(())
    };
    // SAFETY: the host's promise, see the module
    unsafe { run(c, Call::GetStringStatus, body) }
}
