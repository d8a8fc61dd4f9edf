//! Derivatives of inputs and outputs with respect to time, and directional derivatives.

use super::*;
use crate::instance::values::all_or_none;

/// fmi2GetDirectionalDerivative.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetDirectionalDerivative(
    c: ComponentPointer,
    unknown: *const ValueReference,
    unknown_count: usize,
    known: *const ValueReference,
    known_count: usize,
    known_values: *const f64,
    unknown_values: *mut f64,
) -> Status {
    call!(c, GetDirectionalDerivative, |instance, host| {
        // SAFETY: the host's promise, see the module
        let (unknown, known) = unsafe {
            (host.input("vUnknown_ref", unknown, unknown_count)?, host.input("vKnown_ref", known, known_count)?)
        };
        // SAFETY: as above
        let (change, values) = unsafe {
            (
                host.input("dvKnown", known_values, known_count)?,
                host.output("dvUnknown", unknown_values, unknown_count)?,
            )
        };
        instance.get_directional_derivative(unknown.iter(), known.iter().zip(change.iter()), values.iter())
    })
}

/// fmi2SetRealInputDerivatives.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetRealInputDerivatives(
    c: ComponentPointer,
    references: *const ValueReference,
    count: usize,
    orders: *const c_int,
    values: *const f64,
) -> Status {
    call!(c, SetRealInputDerivatives, |instance, host| {
        // SAFETY: the host's promise, see the module
        let (references, orders) =
            unsafe { (host.input("vr", references, count)?, host.input("order", orders, count)?) };
        // SAFETY: as above
        let values = unsafe { host.input("value", values, count) }?;
        all_or_none(count, instance.set_input_derivatives(references, orders, values))
    })
}

/// fmi2GetRealOutputDerivatives.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetRealOutputDerivatives(
    c: ComponentPointer,
    references: *const ValueReference,
    count: usize,
    orders: *const c_int,
    values: *mut f64,
) -> Status {
    call!(c, GetRealOutputDerivatives, |instance, host| {
        // SAFETY: the host's promise, see the module
        let (references, orders) =
            unsafe { (host.input("vr", references, count)?, host.input("order", orders, count)?) };
        // SAFETY: as above
        let values = unsafe { host.output("value", values, count) }?;
        instance.get_output_derivatives(references.iter().zip(orders.iter()), values.iter())
    })
}
