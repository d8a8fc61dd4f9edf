//! Declaration of interface variables: name, unit, range, description, and access to the value.
//!
//! Each part of the model declares its own variables with these rows, next to the quantities that they represent. The
//! table in `variables` collects the rows. This module contains the type of a row, the units, and short notations for
//! rows.

mod access;
#[macro_use]
pub mod condition;
mod row;
mod setting;
pub mod units;

pub use crate::spec::{Choice, EnumType};
pub use access::{Field, GetChoice, Parameter, SetChoice};
pub use condition::{Condition, Group, Groups, Need, Test, all, any, end_of, group, number};
pub use row::{Causality, Range, Row, Variability, row};
pub use setting::{
    Declared, Detail, Rows, RowsOf, SIDES, Setting, TUNABLE, acts_when, add, filled, name_within, sides, when,
    when_each,
};
pub use units::{DisplayUnit, Shown, Unit};

/// What the lines of `parameters!` and `readings!` are written with.
pub mod prelude {
    pub use super::units::*;
    pub use super::{Condition, Need, TUNABLE, acts_when, all, any, when, when_each};
}
