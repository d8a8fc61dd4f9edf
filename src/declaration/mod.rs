//! How a variable of the interface is declared: name, unit, range, description, and the way to its value.
//!
//! Each part of the model declares its own variables with these rows, next to the quantities they stand for; the table
//! in `variables` collects them. This module has the shape of a row, units, and short ways to write rows.

mod access;
mod row;
pub mod units;

pub use crate::spec::{Choice, EnumType};
pub use access::{Field, GetChoice, Parameter, SetChoice};
pub use row::{Causality, Range, Row, Variability, row};
pub use units::{DisplayUnit, Shown, Unit};
