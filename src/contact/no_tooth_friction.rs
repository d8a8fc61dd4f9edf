//! Stands in for tooth friction in a build that leaves it out: there is none, and no way to make one.

use crate::numeric::Scalar;

/// How two flanks slide on each other.
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs)]
pub struct Sliding<T> {
    pub sliding: T,
    pub rolling: T,
    pub load: T,
    pub curvature: [T; 2],
}

/// Friction that cannot be.
#[derive(Clone, Copy, Debug)]
pub enum ToothFriction {}

#[allow(missing_docs)]
impl ToothFriction {
    pub fn outside(&self, _: &Sliding<f64>) -> Option<String> {
        match *self {}
    }
    pub fn signed<T: Scalar>(&self, _: &Sliding<T>) -> T {
        match *self {}
    }
}
