//! Wider vector instructions, where the processor has them: the same arithmetic in fewer instructions.
//!
//! A task is compiled twice, for what every processor of its kind has and for AVX2. Neither fuses or reorders operations, so
//! that both give the same bits.

#[cfg(target_arch = "x86_64")]
use std::sync::atomic::{AtomicU8, Ordering::Relaxed};

/// Work that gains from wider vectors. Its `run` is to be inlined, and what it calls too, as far as it is to gain.
pub trait Task {
    /// What it gives.
    type Output;
    /// Does it.
    fn run(self) -> Self::Output;
}

/// Environment variable that keeps tasks from wider instructions where it is "narrow": for tools that do not know all of
/// them, and to compare results.
pub const VARIABLE: &str = "BEVEL_DIFFERENTIAL_VECTORS";

#[cfg(target_arch = "x86_64")]
const UNKNOWN: u8 = 0;
#[cfg(target_arch = "x86_64")]
const NARROW: u8 = 1;
#[cfg(target_arch = "x86_64")]
const WIDE: u8 = 2;
#[cfg(target_arch = "x86_64")]
static LANES: AtomicU8 = AtomicU8::new(UNKNOWN);

/// Runs `task` with the widest instructions that the processor has.
#[inline(always)]
pub fn in_lanes<T: Task>(task: T) -> T::Output {
    #[cfg(target_arch = "x86_64")]
    if are_wide() {
        #[allow(unsafe_code)]
        // SAFETY: the processor has the instructions.
        return unsafe { wide(task) };
    }
    narrow(task)
}

#[cfg(target_arch = "x86_64")]
#[inline(always)]
fn are_wide() -> bool {
    match LANES.load(Relaxed) {
        UNKNOWN => detect(),
        lanes => lanes == WIDE,
    }
}

#[cfg(target_arch = "x86_64")]
#[cold]
fn detect() -> bool {
    let forbidden = std::env::var_os(VARIABLE).is_some_and(|value| value == "narrow");
    let wide = !forbidden && std::arch::is_x86_feature_detected!("avx2");
    LANES.store(if wide { WIDE } else { NARROW }, Relaxed);
    wide
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn wide<T: Task>(task: T) -> T::Output {
    task.run()
}

#[inline(never)]
fn narrow<T: Task>(task: T) -> T::Output {
    task.run()
}
