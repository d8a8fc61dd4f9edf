//! How softly the greatest overlap of a section is taken: see [`super::overlap`].

use crate::numeric::{TAU, sqrt};

/// Weights below e to this power are left out: of a parabola's integral they are erfc √18 = 2·10⁻⁹, of the force less
/// by the depth in ε.
const NEGLIGIBLE: f64 = -18.0;

/// Softness of the greatest overlap.
#[derive(Clone, Copy, Debug)]
pub struct Softness {
    /// ε [rad].
    pub width: f64,
    /// √(2π ρ ε) [rad].
    pub measure: f64,
    /// Largest excess of the soft maximum over the greatest overlap [rad].
    pub excess: f64,
}

impl Softness {
    /// Height of the patch: what overlaps less than the greatest by this contributes nothing [rad].
    pub fn deep(&self) -> f64 {
        -NEGLIGIBLE * self.width
    }

    /// Softness ε of overlaps between flanks of relative radius of curvature ρ that face each other over `length`, all [rad].
    pub fn new(width: f64, relative: f64, length: f64) -> Self {
        let measure = sqrt(TAU * relative * width);
        Self { width, measure, excess: width * libm::log(1.0 + length / measure) }
    }
}
