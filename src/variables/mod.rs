//! The one table of FMI variables: names, units, starts, ranges and access to the model's quantities.
//! The model description, value references and the C ABI all come from it.

mod inputs;
mod outputs;
mod parameters;
mod row;
mod table;
pub mod units;

pub use row::{Access, Causality, Choice, EnumType, OutputSource, Range, RealParameter, Variability, Variable};
pub use table::{Table, check_ranges, check_value, fnv1a, guid, real_start, table};

/// FMI model identifier and model name.
pub const MODEL_NAME: &str = "BevelDifferential";
