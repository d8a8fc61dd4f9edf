//! Control of the step size: Gustafsson's predictive controller (Hairer & Wanner, section IV.8), and what was learned of motion
//! after kinks and after jumps of the inputs.

use serde::{Deserialize, Serialize};

use super::Method;
use super::driver::LARGEST_SHRINK;
use super::method::fifth_root;
use crate::numeric::{Finite, finite};

pub(super) const SAFETY: f64 = 0.9;
const LARGEST_GROWTH: f64 = 6.0;
/// Growth of the step that is tried after kinks, from one kink to the next.
const AFTER_KINK_GROWTH: f64 = 4.0;
/// Least error remembered: a smaller one would make the predictive controller too cautious.
const LEAST_REMEMBERED_ERROR: f64 = 1e-2;
/// Number of steps after a jump whose sizes are remembered.
const STEPS_AFTER_JUMP: usize = 8;
/// Part of the size before the jump below which a step is short.
const SHORT: f64 = 0.5;
/// Error aimed at in steps after jumps, as a fraction of the tolerance.
const AFTER_JUMP_ERROR: f64 = 0.3;
/// Growth of such a step from one jump to the next.
const AFTER_JUMP_GROWTH: f64 = 2.0;

/// State of the step-size controller between calls.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Control {
    /// Predicted size of the next step [s].
    pub next: f64,
    /// Size of the last accepted step [s]; 0 before the first.
    pub last: f64,
    /// Error of the last accepted step, as a fraction of the tolerance.
    pub last_error: f64,
    /// Whether the last accepted step ended on a kink.
    pub on_kink: bool,
    /// Size of step [s] that was right after the last kink: motion after a kink is faster than before.
    pub after_kink: f64,
    /// Sizes of the steps that were right after the last jumps of the inputs.
    pub after_jump: AfterJump,
}

finite!(Control { next, last, last_error; on_kink, after_kink, after_jump });

/// Memory of the steps after jumps of the inputs. Such a jump starts fast motion that decays within a few steps, and hosts that hold
/// inputs make a jump at every communication point. So the k-th step after a jump is tried with the size that was right for the k-th
/// step after the last one, until steps are about as long again as before the jump.
///
/// At these sizes the error grows in proportion to the jump and with the fifth power of the size. So the memory holds the right size
/// for a jump as large as the first, and the fifth root of the ratio of both scales it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct AfterJump {
    /// Number of steps since the jump; [`STEPS_AFTER_JUMP`] where none follows a jump any more.
    step: u32,
    /// Whether the memory decides on sizes. A jump that is too small to cut the next step short leaves the control as it is.
    decides: bool,
    /// First jump of the accelerations [rad/s²]; 0 before.
    first: f64,
    /// Fifth root of the last jump over the first.
    root: f64,
    /// Size predicted before the jump [s].
    before: f64,
    /// Right sizes for a jump as large as the first [s]; 0 where none is known.
    sizes: [f64; STEPS_AFTER_JUMP],
}

finite!(AfterJump { first, root, before, sizes; step, decides });

impl AfterJump {
    /// No jump yet.
    const NONE: Self = Self {
        step: STEPS_AFTER_JUMP as u32,
        decides: false,
        first: 0.0,
        root: 1.0,
        before: 0.0,
        sizes: [0.0; STEPS_AFTER_JUMP],
    };

    /// True if all numbers are finite and in their ranges.
    pub fn is_valid(&self) -> bool {
        let Self { first, root, before, .. } = *self;
        self.is_finite() && first >= 0.0 && root > 0.0 && before >= 0.0 && self.sizes.iter().all(|&size| size >= 0.0)
    }

    fn start(&mut self, before: f64) {
        (self.step, self.before, self.decides) = (0, before, true);
        self.decides = self.size().is_some_and(|size| size < SHORT * before);
    }

    /// Takes a jump of the accelerations by `jump` [rad/s²].
    fn scale(&mut self, jump: f64) {
        if self.first == 0.0 {
            self.first = jump;
        }
        self.root = fifth_root(jump / self.first);
    }

    /// Size of the next step [s], where it is known.
    #[inline]
    fn size(&self) -> Option<f64> {
        let size = *self.sizes.get(self.step as usize).filter(|_| self.decides)?;
        (size > 0.0).then(|| size / self.root)
    }

    /// Forgets sizes above `next` [s], with which the step is tried again.
    fn learn_of_rejection(&mut self, next: f64) {
        if let Some(size) = self.sizes.get_mut(self.step as usize) {
            *size = size.min(next * self.root);
            self.decides |= self.step == 0;
        }
    }

    /// Remembers an accepted step of size `h` in whose place one of size `right` would have been right; `cut` if it was shorter than its
    /// error demands.
    #[inline]
    fn learn(&mut self, h: f64, right: f64, cut: bool) {
        let Some(size) = self.sizes.get_mut(self.step as usize) else { return };
        if self.decides {
            let right = right * self.root;
            *size = if cut { right.max(*size) } else { right };
        }
        let is_over = !self.decides || h > SHORT * self.before;
        self.step = if is_over { STEPS_AFTER_JUMP as u32 } else { self.step + 1 };
    }
}

impl Control {
    /// A controller whose first step is tried with `first` [s].
    pub fn new(first: f64) -> Self {
        let after_jump = AfterJump::NONE;
        Self { next: first, last: 0.0, last_error: 1.0, on_kink: false, after_kink: f64::MAX, after_jump }
    }

    /// True if all numbers are finite and no step size is negative; those of steps to come are positive. The size after a kink may be
    /// without bound. What was learned of jumps is checked apart.
    pub fn is_valid(&self) -> bool {
        self.is_finite() && self.next > 0.0 && self.last >= 0.0 && self.after_kink > 0.0
    }

    /// Inputs jump: accelerations change at once by `jump` [rad/s²], if that is known.
    pub fn jump(&mut self, jump: Option<f64>) {
        match jump {
            Some(0.0) => return,
            Some(jump) => self.after_jump.scale(jump),
            None => {}
        }
        self.after_jump.start(self.next);
    }

    /// True in steps whose size was learned of jumps: a fast motion decays in them.
    #[inline]
    pub(super) fn follows_jump(&self) -> bool {
        self.after_jump.decides && self.after_jump.step < STEPS_AFTER_JUMP as u32
    }

    /// Size to try the next step with [s]; `again` after an attempt that was rejected.
    #[inline]
    pub(super) fn wanted(&self, again: bool) -> f64 {
        let next = if again { self.next } else { self.after_jump.size().unwrap_or(self.next) };
        if self.on_kink { next.min(self.after_kink) } else { next }
    }

    /// Tries the step with size `next` [s] again after an attempt was rejected.
    pub(super) fn reject(&mut self, next: f64) {
        self.next = next;
        self.after_jump.learn_of_rejection(next);
    }

    /// Predicts the step after an accepted one of size `h` with `error` as a fraction of the tolerance.
    #[inline(never)]
    pub(super) fn accept(&mut self, method: &impl Method, h: f64, cut: bool, error: f64, just_rejected: bool) {
        let by_error = method.root(error) / SAFETY;
        let mut factor = by_error;
        if self.last > 0.0 && !self.on_kink && !just_rejected {
            let predictive = (self.last / h) * method.root(error * error / self.last_error) / SAFETY;
            factor = factor.max(predictive);
        }
        let mut next = h / factor.clamp(1.0 / LARGEST_GROWTH, LARGEST_SHRINK);
        if just_rejected {
            next = next.min(h);
        }
        if self.on_kink {
            self.after_kink = if cut { next.max(self.after_kink) } else { h.max(next.min(h * AFTER_KINK_GROWTH)) };
        }
        if self.after_jump.step < STEPS_AFTER_JUMP as u32 {
            let by_error = method.root(error / AFTER_JUMP_ERROR);
            self.after_jump.learn(h, h / by_error.clamp(1.0 / AFTER_JUMP_GROWTH, LARGEST_SHRINK), cut);
        }
        self.next = if cut { next.max(self.next) } else { next };
        self.last = h;
        self.last_error = error.max(LEAST_REMEMBERED_ERROR);
    }
}
