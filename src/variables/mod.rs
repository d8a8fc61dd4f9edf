//! Table of all FMI variables: names, units, start values, ranges and access, collected from their declarations. The
//! model description, the value references and the C ABI are derived from this table.

mod access;
mod calculated;
pub mod effective;
mod inputs;
mod named;
mod outputs;
mod states;
mod table;
pub mod unset;
mod written;

pub use crate::declaration::{Causality, Choice, EnumType, Range, Variability, units};
pub use access::{Access, OutputSource, Variable};
pub use named::{assign, index_of, named, number, number_of, value_of};
pub use table::{Table, accepted, check_ranges, check_value, fnv1a, guid, real_start, table, tuned};

/// FMI model identifier and model name.
pub const MODEL_NAME: &str = "BevelDifferential";
