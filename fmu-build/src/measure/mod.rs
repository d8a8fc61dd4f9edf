//! What measures: time and error of this program's fidelities and methods, of solid teeth, of couplings of FMUs, and of other
//! programs on the same cases. Each command writes figures, and a document with `--write`.

pub mod compare_simulators;
pub mod compare_solvers;
pub mod cost;
pub mod drivetrain;
pub mod solids;
