//! Step-size control: Gustafsson's predictive controller (Hairer & Wanner, section IV.8). It also remembers step sizes
//! that were right after kinks and after jumps of the inputs.

use serde::{Deserialize, Serialize};

use super::Method;
use super::method::fifth_root;
use crate::numeric::{Finite, finite};

pub(super) const SAFETY: f64 = 0.9;
const LARGEST_GROWTH: f64 = 6.0;
/// Maximum factor by which a rejected attempt, or the prediction after a step, shortens the next one.
pub(super) const LARGEST_SHRINK: f64 = 5.0;
/// Maximum growth of the first step after a kink, from one kink to the next.
const AFTER_KINK_GROWTH: f64 = 4.0;
/// Smallest error that is remembered. A smaller one would make the predictive controller too cautious.
const LEAST_REMEMBERED_ERROR: f64 = 1e-2;
/// Number of steps after a jump whose sizes are remembered.
const STEPS_AFTER_JUMP: usize = 8;
/// Fraction of the step size before the jump up to which a step counts as short. Until a step is longer, the memory of
/// jumps stays in use.
const SHORT: f64 = 0.5;
/// Target error of steps after jumps, as a fraction of the tolerance.
const AFTER_JUMP_ERROR: f64 = 0.3;
/// Maximum growth of a step after a jump, from one jump to the next.
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
    /// True if the last accepted step ended on a kink.
    pub on_kink: bool,
    /// Step size that was right after the last kink [s]. Motion after a kink is faster than before it.
    pub after_kink: f64,
    /// Step sizes that were right after the last jumps of the inputs.
    pub after_jump: AfterJump,
}

finite!(Control { next, last, last_error; on_kink, after_kink, after_jump });

/// Memory of the steps after jumps of the inputs. A jump starts a fast motion that decays within a few steps, and a
/// host that holds inputs causes a jump at every communication point. The k-th step after a jump is therefore tried
/// with the size that was right for the k-th step after the previous jump. The memory is used until steps are about as
/// long as before the jump.
///
/// The error of these steps is proportional to the jump and to the fifth power of the step size. The memory therefore
/// holds the right sizes for the first jump, and scales them by the fifth root of the ratio of the two jumps.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct AfterJump {
    /// Number of steps since the jump; [`STEPS_AFTER_JUMP`] when the memory is not used any more.
    step: u32,
    /// True if the memory determines step sizes. It does not after a jump too small to shorten the next step.
    decides: bool,
    /// First jump of the accelerations [rad/s²]; 0 before the first jump.
    first: f64,
    /// Fifth root of the ratio of the last jump to the first.
    root: f64,
    /// Step size predicted before the jump [s].
    before: f64,
    /// Right step sizes for a jump as large as the first [s]; 0 if unknown.
    sizes: [f64; STEPS_AFTER_JUMP],
}

finite!(AfterJump { first, root, before, sizes; step, decides });

impl AfterJump {
    /// Memory before the first jump.
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

    /// Scales the memory for a jump of the accelerations by `jump` [rad/s²].
    fn scale(&mut self, jump: f64) {
        if self.first == 0.0 {
            self.first = jump;
        }
        self.root = fifth_root(jump / self.first);
    }

    /// Remembered size of the next step [s]. `None` if the memory does not determine step sizes or no size is known.
    #[inline]
    fn size(&self) -> Option<f64> {
        let size = *self.sizes.get(self.step as usize).filter(|_| self.decides)?;
        (size > 0.0).then(|| size / self.root)
    }

    /// Limits the remembered size of a rejected step to `next` [s], the size of the next attempt.
    fn learn_of_rejection(&mut self, next: f64) {
        if let Some(size) = self.sizes.get_mut(self.step as usize) {
            *size = size.min(next * self.root);
            self.decides |= self.step == 0;
        }
    }

    /// Remembers that `right` [s] would have been the right size of an accepted step of size `h` [s]. `cut` is true if
    /// the step was shorter than its error required.
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
    /// Returns a controller that tries the first step with size `first` [s].
    pub fn new(first: f64) -> Self {
        let after_jump = AfterJump::NONE;
        Self { next: first, last: 0.0, last_error: 1.0, on_kink: false, after_kink: f64::MAX, after_jump }
    }

    /// True if all numbers are finite, future step sizes are positive and the last one is not negative. The size after
    /// a kink may be unbounded. `AfterJump::is_valid` checks the memory of jumps.
    pub fn is_valid(&self) -> bool {
        self.is_finite() && self.next > 0.0 && self.last >= 0.0 && self.after_kink > 0.0
    }

    /// Reacts to a jump of the inputs. `jump` is the change of the accelerations [rad/s²], or `None` if it is unknown.
    /// A jump of 0 has no effect.
    pub fn jump(&mut self, jump: Option<f64>) {
        match jump {
            Some(0.0) => return,
            Some(jump) => self.after_jump.scale(jump),
            None => {}
        }
        self.after_jump.start(self.next);
    }

    /// True in steps whose sizes come from the memory of jumps, while a fast motion decays.
    #[inline]
    pub(super) fn follows_jump(&self) -> bool {
        self.after_jump.decides && self.after_jump.step < STEPS_AFTER_JUMP as u32
    }

    /// Size to try for the next step [s]. `again` is true after a rejected attempt.
    #[inline]
    pub(super) fn wanted(&self, again: bool) -> f64 {
        let next = if again { self.next } else { self.after_jump.size().unwrap_or(self.next) };
        if self.on_kink { next.min(self.after_kink) } else { next }
    }

    /// Sets the size of the next attempt to `next` [s] after a rejected one.
    pub(super) fn reject(&mut self, next: f64) {
        self.next = next;
        self.after_jump.learn_of_rejection(next);
    }

    /// Predicts the step after an accepted one of size `h` [s], whose `error` is a fraction of the tolerance. `cut` is
    /// true if the step was shorter than its error required. `just_rejected` is true if the previous attempt was
    /// rejected.
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
