//! Vector instructions, which do the same arithmetic with fewer instructions.
//!
//! Every x86-64 processor adds and multiplies two numbers at a time. If two numbers are written individually and then
//! read as a pair, store-to-load forwarding fails and the processor stalls. Data processed in pairs is therefore always
//! read and written in pairs.
//!
//! Wider instructions are used if the processor has them. A task is compiled twice: for the baseline instruction set
//! and for AVX2. Neither version fuses or reorders operations, so both produce the same bits.

#[cfg(target_arch = "x86_64")]
use std::sync::atomic::{AtomicU8, Ordering::Relaxed};

/// Adds `x` times the numbers `of` to the numbers `to`, two at a time.
#[inline(always)]
pub fn add_times(to: &mut [f64], x: f64, of: &[f64]) {
    let (mut to, mut of) = (to.chunks_exact_mut(2), of.chunks_exact(2));
    for (to, of) in (&mut to).zip(&mut of) {
        #[cfg(target_arch = "x86_64")]
        #[allow(unsafe_code)]
        // SAFETY: both chunks contain two numbers.
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

/// Multiplies the numbers `of` by `x`, two at a time.
#[inline(always)]
pub fn multiply(of: &mut [f64], x: f64) {
    let mut of = of.chunks_exact_mut(2);
    for of in &mut of {
        #[cfg(target_arch = "x86_64")]
        #[allow(unsafe_code)]
        // SAFETY: the chunk contains two numbers.
        unsafe {
            use std::arch::x86_64::{_mm_loadu_pd, _mm_mul_pd, _mm_set1_pd, _mm_storeu_pd};
            _mm_storeu_pd(of.as_mut_ptr(), _mm_mul_pd(_mm_loadu_pd(of.as_ptr()), _mm_set1_pd(x)));
        }
        #[cfg(not(target_arch = "x86_64"))]
        of.iter_mut().for_each(|of| *of *= x);
    }
    of.into_remainder().iter_mut().for_each(|of| *of *= x);
}

/// Writes numbers two at a time.
#[inline(always)]
pub fn write<const N: usize>(from: [f64; N], to: &mut [f64; N]) {
    for (from, to) in from.chunks(2).zip(to.chunks_mut(2)) {
        match (from, to) {
            #[cfg(target_arch = "x86_64")]
            (&[first, second], to @ [_, _]) => {
                use std::arch::x86_64::{_mm_set_pd, _mm_storeu_pd};
                #[allow(unsafe_code)]
                // SAFETY: the chunk contains two numbers.
                unsafe {
                    _mm_storeu_pd(to.as_mut_ptr(), _mm_set_pd(second, first));
                }
            }
            (from, to) => to.copy_from_slice(from),
        }
    }
}

/// Work that benefits from wider vectors. Its `run` and the functions called by it must be inlined to benefit.
pub trait Task {
    /// Result of the task.
    type Output;
    /// Runs the task.
    fn run(self) -> Self::Output;
}

/// Environment variable that disables wider instructions if its value is "narrow". It serves tools that do not support
/// all instructions, and comparisons of results.
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
        // SAFETY: the processor has AVX2.
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
