//! Integration of second-order systems M v̇ = f(q, v), q̇ = B v: stiff, small, without heap allocation.
//!
//! The interface of a system, one-step methods (one a file), their linear algebra, and the drivers with adaptive and fixed
//! steps. Nothing here is specific to gears.

mod any_method;
mod block;
mod complex;
mod course;
mod curve;
mod dormand_prince;
mod driver;
mod fixed;
mod linear;
mod method;
mod radau;
mod rodas4;
mod rodas5p;
mod rosenbrock;
mod statistics;
mod system;

pub use any_method::AnyMethod;
pub use course::{Attempt, Course, Extension, Pending, extended};
pub use curve::Curve;
pub use dormand_prince::DormandPrince;
pub use driver::{AfterStep, Control, Failure, SolverContext, Step, advance, proceed};
pub use fixed::advance_fixed;
pub use method::{ErrorNorm, Method, Trial};
pub use radau::Radau;
pub use rodas4::Rodas4;
pub use rodas5p::Rodas5P;
pub use statistics::Statistics;
pub use system::{Imbalance, Linearisation, Matrix, POSITION_ROUNDING, Point, SecondOrder};
