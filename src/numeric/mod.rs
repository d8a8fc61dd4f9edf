//! Elementary functions with the same bits on every system, from the `libm` crate, and numbers that carry derivatives.

mod elementary;
mod jet;
mod scalar;
mod smooth;

pub use elementary::{FRAC_PI_2, PI, TAU, acos, asin, atan2, cos, frac, pow, sin, sqrt, tan};
pub use jet::Jet;
pub use scalar::{Dual, Scalar};
pub use smooth::{Curved, Partials, Smooth};
