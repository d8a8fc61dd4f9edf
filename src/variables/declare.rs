//! Rows of parameters, declared in one line each.

use super::row::{Access, Causality, Range, RealParameter, Variability, Variable};
use super::units::{DisplayUnit, Unit};
use crate::model::Parameters;

pub(super) fn row(name: &'static str, access: Access, description: &'static str) -> Variable {
    Variable {
        name,
        description,
        causality: Causality::Parameter,
        variability: Variability::Fixed,
        unit: None,
        display: None,
        range: None,
        nominal: None,
        derivative_of: None,
        access,
    }
}

pub(super) fn real(
    name: &'static str,
    unit: Unit,
    display: Option<DisplayUnit>,
    (min, max): (f64, f64),
    at: RealParameter,
    description: &'static str,
) -> Variable {
    Variable { unit: Some(unit), display, range: Some(Range { min, max }), ..row(name, Access::Real(at), description) }
}

pub(super) fn integer(
    name: &'static str,
    (min, max): (i32, i32),
    at: fn(&mut Parameters) -> &mut i32,
    description: &'static str,
) -> Variable {
    let range = Some(Range { min: f64::from(min), max: f64::from(max) });
    Variable { range, ..row(name, Access::Integer(at), description) }
}

pub(super) fn switch(name: &'static str, at: fn(&mut Parameters) -> &mut bool, description: &'static str) -> Variable {
    row(name, Access::Boolean(at), description)
}
