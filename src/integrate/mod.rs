//! Integration of small stiff second-order systems M v̇ = f(q, v), q̇ = B v, without heap allocation.
//!
//! This module contains the interface of a system, one-step methods (one per file), their linear algebra, and drivers
//! with adaptive and fixed steps. Nothing here is specific to gears.

mod block;
mod complex;
mod control;
mod curve;
mod driver;
mod fixed;
mod linear;
mod method;
mod radau;
mod rodas5p;
mod statistics;
mod system;
mod trajectory;

pub use control::Control;
pub use curve::Curve;
pub use driver::{Failure, Judged, Solver, SolverContext, Step};
pub use fixed::FixedSteps;
pub use method::{ErrorNorm, Method, StepOutput, Trial, size_for};
pub use radau::Radau;
pub use rodas5p::Rodas5P;
pub use statistics::Statistics;
pub use system::{Imbalance, Linearisation, Matrix, POSITION_ROUNDING, Point, SecondOrder, TimedPoint};
pub use trajectory::{Extension, Part, Pending, Trajectory, extended};
