//! Elementary functions with the same bits on every system, from the `libm` crate, numbers that carry derivatives, and the
//! search for a minimum.

mod elementary;
mod jet;
mod minimum;
mod scalar;

pub use elementary::{FRAC_PI_2, PI, TAU, acos, asin, atan2, cos, frac, pow, sin, sqrt, tan};
pub use jet::Jet;
pub use minimum::{Landscape, Search};
pub use scalar::{Dual, Scalar};
