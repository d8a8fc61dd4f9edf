//! Integration of second-order systems M v̇ = f(q, v), q̇ = B v: stiff, small, without heap allocation.

mod driver;
mod linear;
mod rodas;
mod system;

pub use driver::{Control, Failure, Statistics, Step, advance};
pub use rodas::{Trial, step};
pub use system::{Linearisation, MAX_DOF, Matrix, Point, Power, SecondOrder, Vector, ZERO};
