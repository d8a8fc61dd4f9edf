//! Masks floating-point traps of the host during a call.
//!
//! A host may let the processor trap invalid operations, divisions by zero and overflows, to find its own mistakes. Valid
//! scenes compute no such value on purpose. But compilers assume that nothing traps: they may divide before the
//! program checks the divisor, and then discard the quotient. Only a mask prevents a trap in such code.

/// Traps that were masked for a call. Dropping it restores them. Rounding mode and exception flags are not changed.
#[must_use = "traps are masked until it is dropped"]
pub struct MaskedTraps {
    /// Mask bits that the host had cleared.
    #[cfg(target_arch = "x86_64")]
    cleared: u32,
}

#[cfg(not(target_arch = "x86_64"))]
impl MaskedTraps {
    /// Does nothing on this processor.
    pub fn new() -> Self {
        Self {}
    }
}

#[cfg(target_arch = "x86_64")]
impl MaskedTraps {
    /// Masks the traps that the host has enabled. Without such traps, this only reads the control register.
    #[inline]
    pub fn new() -> Self {
        let cleared = !mxcsr::read() & mxcsr::MASKS;
        if cleared != 0 {
            mxcsr::change(|control| control | mxcsr::MASKS);
        }
        Self { cleared }
    }
}

#[cfg(target_arch = "x86_64")]
impl Drop for MaskedTraps {
    #[inline]
    fn drop(&mut self) {
        if self.cleared != 0 {
            let cleared = self.cleared;
            mxcsr::change(|control| control & !cleared);
        }
    }
}

/// Control and status register of vector instructions, which are used for all floating-point numbers.
#[cfg(target_arch = "x86_64")]
mod mxcsr {
    use std::arch::asm;

    /// Bits that mask the traps.
    pub const MASKS: u32 = 0x1f80;

    #[inline]
    pub fn read() -> u32 {
        let mut control = 0u32;
        // SAFETY: stores four bytes at this address
        unsafe { asm!("stmxcsr [{}]", in(reg) &raw mut control, options(nostack, preserves_flags)) };
        control
    }

    /// Changes only mask bits. The call is not inlined, so that no floating-point operation moves across it.
    #[cold]
    #[inline(never)]
    pub fn change(masks: impl FnOnce(u32) -> u32) {
        let control = masks(read());
        // SAFETY: loads four bytes from this address; no reserved bit is set, because the bits come from the register
        unsafe { asm!("ldmxcsr [{}]", in(reg) &raw const control, options(nostack, readonly)) };
    }

    #[cfg(test)]
    mod tests {
        use super::super::MaskedTraps;
        use super::*;
        use crate::instance::catch;

        const INVALID: u32 = 1 << 7;
        const INVALID_FLAG: u32 = 1;

        #[test]
        fn traps_are_masked_in_a_call_and_restored_after_it_even_after_a_panic() {
            let before = read();
            change(|control| control & !INVALID);
            let [quiet, panicked] = [false, true].map(|panics| {
                let outcome = catch(|| {
                    assert_eq!(read() & MASKS, MASKS);
                    // a call inside a call changes nothing
                    drop(MaskedTraps::new());
                    assert!(!panics);
                    std::hint::black_box(0.0) / std::hint::black_box(0.0)
                });
                let control = read();
                assert_eq!(control & MASKS, MASKS & !INVALID);
                (outcome.is_ok_and(f64::is_nan), control & INVALID_FLAG)
            });
            change(|_| before);
            assert_eq!((quiet, panicked.0), ((true, INVALID_FLAG), false));
        }
    }
}
