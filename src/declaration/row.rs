//! A row: what a variable is named, what it may be, and `A`, the way to its value.

use super::units::{DisplayUnit, Unit};

/// FMI causality of a variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Causality {
    Parameter,
    CalculatedParameter,
    Input,
    Output,
    Local,
}

/// FMI variability of a variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Variability {
    Fixed,
    Tunable,
    Continuous,
}

/// Allowed values, both ends included [unit of the variable].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// Smallest allowed value.
    pub min: f64,
    /// Largest allowed value.
    pub max: f64,
}

/// One literal of an enumeration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Choice {
    /// Value at the FMI boundary.
    pub value: i32,
    /// Literal.
    pub name: &'static str,
    /// What it means.
    pub description: &'static str,
}

/// An enumeration type.
#[derive(Debug, PartialEq, Eq)]
pub struct EnumType {
    /// Name of the type.
    pub name: &'static str,
    /// Its literals.
    pub choices: &'static [Choice],
}

/// A row of the table.
#[derive(Clone, Copy, Debug)]
pub struct Row<A> {
    /// Dotted name.
    pub name: &'static str,
    /// What it is.
    pub description: &'static str,
    /// FMI causality.
    pub causality: Causality,
    /// FMI variability.
    pub variability: Variability,
    /// Unit of a real variable.
    pub unit: Option<Unit>,
    /// Unit to show it in, where people think in another.
    pub display: Option<DisplayUnit>,
    /// Allowed values of a number.
    pub range: Option<Range>,
    /// Typical magnitude of a continuous state, for the host's error control.
    pub nominal: Option<f64>,
    /// Index of the variable of which this one is the time derivative.
    pub derivative_of: Option<usize>,
    /// The way to its value.
    pub access: A,
}

impl<A> Row<A> {
    /// The same row with another way to its value.
    pub fn map<B>(self, to: impl FnOnce(A) -> B) -> Row<B> {
        let Self { name, description, causality, variability, unit, display, range, nominal, derivative_of, access } =
            self;
        let access = to(access);
        Row { name, description, causality, variability, unit, display, range, nominal, derivative_of, access }
    }
}
