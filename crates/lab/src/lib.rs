//! The commands of the laboratory that call the library directly. `crates/lab/lab.py` lists all commands and starts
//! these. Users do not need the laboratory, and their commands do not compile it.
//!
//! - [`fuzz`]: random calls of the C functions
//! - [`questions`]: random questions to the library of answers
//! - [`stiffness`]: stiffness of the contact laws compared with finite elements

#![warn(missing_docs)]

pub mod fuzz;
pub mod questions;
#[path = "../../../tests/common/random.rs"]
pub mod random;
pub mod stiffness;
