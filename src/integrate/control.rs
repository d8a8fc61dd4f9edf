//! Step-size control: Gustafsson's predictive controller (Hairer & Wanner, section IV.8). It also remembers step sizes
//! that were right after kinks and after discontinuities of the inputs.

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
/// Number of steps after a discontinuity whose sizes are remembered.
const STEPS_AFTER: usize = 8;
/// Fraction of the step size before the discontinuity up to which a step counts as short. Until a step is longer, the
/// memory of discontinuities stays in use.
const SHORT: f64 = 0.5;
/// Target error of steps after discontinuities, as a fraction of the tolerance.
const AFTER_DISCONTINUITY_ERROR: f64 = 0.3;
/// Maximum growth of a step after a discontinuity, from one discontinuity to the next.
const AFTER_DISCONTINUITY_GROWTH: f64 = 2.0;

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
    /// Step sizes that were right after the last discontinuities of the inputs.
    pub after_discontinuity: AfterDiscontinuity,
}

finite!(Control { next, last, last_error; on_kink, after_kink, after_discontinuity });

/// Memory of the steps after discontinuities of the inputs. A discontinuity starts a fast motion that decays within a
/// few steps, and a host that holds inputs causes a discontinuity at every communication point. The k-th step after a
/// discontinuity is therefore tried with the size that was right for the k-th step after the previous discontinuity.
/// The memory is used until steps are about as long as before the discontinuity.
///
/// The error of these steps is proportional to the change of the accelerations and to the fifth power of the step size.
/// The memory therefore holds the right sizes for the first discontinuity, and scales them by the fifth root of the
/// ratio of the two changes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct AfterDiscontinuity {
    /// Number of steps since the discontinuity; [`STEPS_AFTER`] when the memory is not used any more.
    step: u32,
    /// True if the memory determines step sizes. It does not after a discontinuity too small to shorten the next step.
    decides: bool,
    /// First change of the accelerations [rad/s²]; 0 before the first discontinuity.
    first: f64,
    /// Fifth root of the ratio of the last change to the first.
    root: f64,
    /// Step size predicted before the discontinuity [s].
    before: f64,
    /// Right step sizes for a discontinuity as large as the first [s]; 0 if unknown.
    sizes: [f64; STEPS_AFTER],
}

finite!(AfterDiscontinuity { first, root, before, sizes; step, decides });

impl AfterDiscontinuity {
    /// Memory before the first discontinuity.
    const NONE: Self = Self {
        step: STEPS_AFTER as u32,
        decides: false,
        first: 0.0,
        root: 1.0,
        before: 0.0,
        sizes: [0.0; STEPS_AFTER],
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

    /// Scales the memory for a `change` of the accelerations [rad/s²].
    fn scale(&mut self, change: f64) {
        if self.first == 0.0 {
            self.first = change;
        }
        self.root = fifth_root(change / self.first);
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
        self.step = if is_over { STEPS_AFTER as u32 } else { self.step + 1 };
    }
}

impl Control {
    /// Returns a controller that tries the first step with size `first` [s].
    pub fn new(first: f64) -> Self {
        let after_discontinuity = AfterDiscontinuity::NONE;
        Self { next: first, last: 0.0, last_error: 1.0, on_kink: false, after_kink: f64::MAX, after_discontinuity }
    }

    /// True if all numbers are finite, future step sizes are positive and the last one is not negative. The size after
    /// a kink may be unbounded. `AfterDiscontinuity::is_valid` checks the memory of discontinuities.
    pub fn is_valid(&self) -> bool {
        self.is_finite() && self.next > 0.0 && self.last >= 0.0 && self.after_kink > 0.0
    }

    /// Reacts to a discontinuity of the inputs. `change` is the change of the accelerations [rad/s²], or `None` if it
    /// is unknown. A change of 0 has no effect.
    pub fn discontinuity(&mut self, change: Option<f64>) {
        match change {
            Some(0.0) => return,
            Some(change) => self.after_discontinuity.scale(change),
            None => {}
        }
        self.after_discontinuity.start(self.next);
    }

    /// True in steps whose sizes come from the memory of discontinuities, while a fast motion decays.
    #[inline]
    pub(super) fn follows_discontinuity(&self) -> bool {
        self.after_discontinuity.decides && self.after_discontinuity.step < STEPS_AFTER as u32
    }

    /// Size to try for the next step [s]. `again` is true after a rejected attempt.
    #[inline]
    pub(super) fn wanted(&self, again: bool) -> f64 {
        let next = if again { self.next } else { self.after_discontinuity.size().unwrap_or(self.next) };
        if self.on_kink { next.min(self.after_kink) } else { next }
    }

    /// Sets the size of the next attempt to `next` [s] after a rejected one.
    pub(super) fn reject(&mut self, next: f64) {
        self.next = next;
        self.after_discontinuity.learn_of_rejection(next);
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
        if self.after_discontinuity.step < STEPS_AFTER as u32 {
            let by_error = method.root(error / AFTER_DISCONTINUITY_ERROR);
            let right = h / by_error.clamp(1.0 / AFTER_DISCONTINUITY_GROWTH, LARGEST_SHRINK);
            self.after_discontinuity.learn(h, right, cut);
        }
        self.next = if cut { next.max(self.next) } else { next };
        self.last = h;
        self.last_error = error.max(LEAST_REMEMBERED_ERROR);
    }
}
