//! Softness of the maximum overlap of a section; see [`super::overlap`].

use crate::numeric::{TAU, sqrt};

/// Weights below e to this power are neglected. Their fraction of a parabola's integral is erfc √18 = 2·10⁻⁹. Their
/// fraction of the force is smaller still, by the ratio of the depth to ε.
const NEGLIGIBLE: f64 = -18.0;

/// Softness of the maximum overlap.
#[derive(Clone, Copy, Debug)]
pub struct Softness {
    /// ε [rad].
    pub width: f64,
    /// √(2π ρ ε) [rad].
    pub measure: f64,
    /// Largest excess of the soft maximum over the maximum overlap [rad].
    pub excess: f64,
}

impl Softness {
    /// Height of the patch [rad]. Points whose overlap is smaller than the maximum by more than this contribute
    /// nothing.
    pub fn deep(&self) -> f64 {
        -NEGLIGIBLE * self.width
    }

    /// Returns the softness ε = `width` of overlaps between flanks of relative radius of curvature ρ that face each
    /// other over `length`, all [rad].
    pub fn new(width: f64, relative: f64, length: f64) -> Self {
        let measure = sqrt(TAU * relative * width);
        Self { width, measure, excess: width * libm::log(1.0 + length / measure) }
    }
}
