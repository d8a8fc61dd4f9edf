//! A step that is over.

use crate::integrate::{Pending, Step};
use crate::model::dynamics::power::Power;

/// A completed step, and the same while it was pending.
pub type CompletedStep<'a, 'b, const N: usize> = (&'a Step<'b, N, Power>, Option<&'a Pending<N, Power>>);
