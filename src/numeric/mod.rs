//! Elementary functions with the same bits on every system, from the `libm` crate, numbers that carry derivatives, cells of
//! tables, and the search for a minimum.

mod elementary;
mod jet;
mod minimum;
mod quintic;
mod scalar;
mod smooth;

pub use elementary::{FRAC_PI_2, PI, TAU, acos, asin, atan2, cos, frac, pow, sin, sqrt, tan};
pub use jet::Jet;
pub use minimum::{Landscape, Search};
pub use quintic::{Quintic, quintic, quintic_hermite};
pub use scalar::{Dual, Scalar};
pub use smooth::{Curved, Partials, Smooth};
