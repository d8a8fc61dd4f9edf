//! Derivatives of outputs with respect to time, and directional and adjoint derivatives.

use super::*;

/// fmi3GetOutputDerivatives.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetOutputDerivatives(
    c: ComponentPointer,
    references: *const ValueReference,
    count: usize,
    orders: *const c_int,
    values: *mut f64,
    value_count: usize,
) -> Status {
    call!(c, GetOutputDerivatives, |instance, host| {
        // SAFETY: the host's promise, see the module
        let (references, orders) =
            unsafe { (host.input("valueReferences", references, count)?, host.input("orders", orders, count)?) };
        // SAFETY: as above
        let values = unsafe { host.output("values", values, value_count) }?;
        values::output_derivatives(instance, references, orders, values)
    })
}

macro_rules! sensitivities {
    ($($function:ident $call:ident $method:ident;)+) => {$(
        #[doc = concat!(stringify!($function), ".")]
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $function(
            c: ComponentPointer,
            unknowns: *const ValueReference,
            unknown_count: usize,
            knowns: *const ValueReference,
            known_count: usize,
            seed: *const f64,
            seed_count: usize,
            sensitivity: *mut f64,
            sensitivity_count: usize,
        ) -> Status {
            call!(c, $call, |instance, host| {
                // SAFETY: the host's promise, see the module
                let (unknowns, knowns) = unsafe {
                    (host.input("unknowns", unknowns, unknown_count)?, host.input("knowns", knowns, known_count)?)
                };
                // SAFETY: as above
                let (seed, sensitivity) = unsafe {
                    (host.input("seed", seed, seed_count)?, host.output("sensitivity", sensitivity, sensitivity_count)?)
                };
                values::$method(instance, [unknowns, knowns], seed, sensitivity)
            })
        }
    )+};
}

sensitivities! {
    fmi3GetDirectionalDerivative GetDirectionalDerivative directional_derivative;
    fmi3GetAdjointDerivative GetAdjointDerivative adjoint_derivative;
}
