//! How a variable of the interface is declared: name, unit, range, description, and the way to its value.
//!
//! Each part of the model declares its own variables with these rows, next to the quantities they stand for; the table in
//! `variables` collects them. What belongs here: the shape of a row, units, and short ways to write rows.

/// Declares an enumeration type and its row: the literals and their Rust counterparts stand side by side once.
#[macro_export]
#[doc(hidden)]
macro_rules! choice {
    ($row:expr, $type:literal, $parameters:ty, $at:expr,
     $($value:path => $literal:literal $meaning:literal),+) => {{
        static TYPE: $crate::declaration::EnumType = $crate::declaration::EnumType {
            name: $type,
            choices: &[
                $($crate::declaration::Choice { value: $value as i32, name: $literal, description: $meaning }),+
            ],
        };
        fn get(p: &$parameters) -> i32 {
            let at: fn(&mut $parameters) -> &mut _ = $at;
            *at(&mut { *p }) as i32
        }
        fn set(p: &mut $parameters, value: i32) {
            let at: fn(&mut $parameters) -> &mut _ = $at;
            $(if value == $value as i32 { *at(p) = $value; })+
        }
        $row.enumeration(&TYPE, get, set)
    }};
}

mod access;
mod row;
mod rows;
pub mod units;

pub use access::{Field, GetChoice, Parameter, SetChoice};
pub use choice;
pub use row::{Causality, Choice, EnumType, Range, Row, Variability};
pub use rows::row;
