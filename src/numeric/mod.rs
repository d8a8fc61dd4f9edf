//! Elementary functions with the same bits on every system, from the `libm` crate; numbers with derivatives; search for
//! roots and minima.

mod elementary;
mod finite;
mod jet;
pub mod lanes;
mod minimum;
mod root;
mod scalar;

pub use elementary::{FRAC_PI_2, PI, TAU, acos, asin, atan2, cos, frac, pow, quotient, sin, sin_cos, sqrt, tan};
pub use finite::Finite;
pub(crate) use finite::finite;
pub use jet::Jet;
pub use minimum::{Landscape, Search};
pub use root::{quadratic_roots, rising_root};
pub use scalar::{Dual, Scalar};
