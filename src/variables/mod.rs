//! The one table of FMI variables: names, units, starts, ranges and access to the model's quantities.
//! The model description, value references and the C ABI all come from it.

/// Declares an enumeration type and its row: the literals and their Rust counterparts stand side by side once.
macro_rules! choice {
    ($name:literal, $type:literal, $group:ident . $field:ident, $description:literal,
     $($value:path => $literal:literal $meaning:literal),+) => {{
        static TYPE: super::row::EnumType = super::row::EnumType {
            name: $type,
            choices: &[$(super::row::Choice { value: $value as i32, name: $literal, description: $meaning }),+],
        };
        fn set(p: &mut crate::model::Parameters, value: i32) {
            $(if value == $value as i32 { p.$group.$field = $value; })+
        }
        super::declare::row($name, super::row::Access::Enumeration(&TYPE, |p| p.$group.$field as i32, set), $description)
    }};
}

mod declare;
mod effects;
mod inputs;
mod outputs;
mod parameters;
mod row;
mod states;
mod table;
pub mod units;

pub use row::{Access, Causality, Choice, EnumType, OutputSource, Range, RealParameter, Variability, Variable};
pub use table::{Table, check_ranges, check_value, fnv1a, guid, real_start, table};

/// FMI model identifier and model name.
pub const MODEL_NAME: &str = "BevelDifferential";
