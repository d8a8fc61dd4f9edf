//! Declaration of interface variables: name, unit, range, description, and access to the value.
//!
//! Each part of the model declares its own variables with these rows, next to the quantities that they represent. The
//! table in `variables` collects the rows. This module contains the type of a row, the units, and short notations for
//! rows.

mod access;
mod row;
pub mod units;

pub use crate::spec::{Choice, EnumType};
pub use access::{Field, GetChoice, Parameter, SetChoice};
pub use row::{Causality, Range, Row, Variability, row};
pub use units::{DisplayUnit, Shown, Unit};
