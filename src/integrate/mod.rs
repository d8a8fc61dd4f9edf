//! Integration of second-order systems M v̇ = f(q, v), q̇ = B v: stiff, small, without heap allocation.

mod driver;
mod erased;
mod fixed;
mod linear;
mod method;
mod rodas5p;
mod rosenbrock;
mod system;

pub use driver::{Control, Effort, Failure, Flow, Statistics, Step, advance};
pub use erased::{Erased, Object};
pub use fixed::advance_fixed;
pub use method::{Aim, Method, Trial};
pub use rodas5p::{RODAS5P, Rodas5P};
pub use rosenbrock::{Tableau, step};
pub use system::{Linearisation, Matrix, Point, SecondOrder, in_pairs};
