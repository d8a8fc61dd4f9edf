//! Vector instructions: the same arithmetic in fewer instructions.
//!
//! Every x86-64 processor adds and multiplies two numbers at a time. Where a number that was written alone is read as one of
//! two, or the other way round, a processor waits: what is worked on two by two is so throughout.
//!
//! Wider ones are used where the processor has them. A task is compiled twice, for what every processor of its kind has and for AVX2. Neither fuses or reorders operations, so
//! that both give the same bits.

#[cfg(target_arch = "x86_64")]
use std::sync::atomic::{AtomicU8, Ordering::Relaxed};

/// Adds `x` times the numbers `of` to those of `to`, two by two.
#[inline(always)]
pub fn add_times(to: &mut [f64], x: f64, of: &[f64]) {
    let (mut to, mut of) = (to.chunks_exact_mut(2), of.chunks_exact(2));
    for (to, of) in (&mut to).zip(&mut of) {
        #[cfg(target_arch = "x86_64")]
        #[allow(unsafe_code)]
        // SAFETY: both are two numbers.
        unsafe {
            use std::arch::x86_64::{_mm_add_pd, _mm_loadu_pd, _mm_mul_pd, _mm_set1_pd, _mm_storeu_pd};
            let (to, of) = (to.as_mut_ptr(), of.as_ptr());
            _mm_storeu_pd(to, _mm_add_pd(_mm_loadu_pd(to), _mm_mul_pd(_mm_set1_pd(x), _mm_loadu_pd(of))));
        }
        #[cfg(not(target_arch = "x86_64"))]
        for (to, of) in to.iter_mut().zip(of) {
            *to += x * of;
        }
    }
    for (to, of) in to.into_remainder().iter_mut().zip(of.remainder()) {
        *to += x * of;
    }
}

/// Multiplies the numbers `of` by `x`, two by two.
#[inline(always)]
pub fn multiply(of: &mut [f64], x: f64) {
    let mut of = of.chunks_exact_mut(2);
    for of in &mut of {
        #[cfg(target_arch = "x86_64")]
        #[allow(unsafe_code)]
        // SAFETY: they are two numbers.
        unsafe {
            use std::arch::x86_64::{_mm_loadu_pd, _mm_mul_pd, _mm_set1_pd, _mm_storeu_pd};
            _mm_storeu_pd(of.as_mut_ptr(), _mm_mul_pd(_mm_loadu_pd(of.as_ptr()), _mm_set1_pd(x)));
        }
        #[cfg(not(target_arch = "x86_64"))]
        of.iter_mut().for_each(|of| *of *= x);
    }
    of.into_remainder().iter_mut().for_each(|of| *of *= x);
}

/// Writes numbers two by two.
#[inline(always)]
pub fn write<const N: usize>(from: [f64; N], to: &mut [f64; N]) {
    for (from, to) in from.chunks(2).zip(to.chunks_mut(2)) {
        match (from, to) {
            #[cfg(target_arch = "x86_64")]
            (&[first, second], to @ [_, _]) => {
                use std::arch::x86_64::{_mm_set_pd, _mm_storeu_pd};
                #[allow(unsafe_code)]
                // SAFETY: they are two numbers.
                unsafe {
                    _mm_storeu_pd(to.as_mut_ptr(), _mm_set_pd(second, first));
                }
            }
            (from, to) => to.copy_from_slice(from),
        }
    }
}

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
