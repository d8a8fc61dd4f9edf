//! Shape of a table row: what a variable is called, what it may be, and the way to its value.

use super::units::{DisplayUnit, Unit};
use crate::model::{Books, Forces, Inputs, Motion, Parameters};

/// Access to a real parameter.
pub type RealParameter = fn(&mut Parameters) -> &mut f64;

/// FMI causality of a variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Causality {
    Parameter,
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

/// Where an output's value is read.
#[derive(Clone, Copy)]
pub enum OutputSource {
    /// From angles and speeds.
    Motion(fn(&Motion) -> f64),
    /// From forces, which cost one evaluation of the teeth.
    Forces(fn(&Forces) -> f64),
    /// From the ledger and the solver's statistics.
    Books(fn(&Books) -> f64),
    /// A continuous state, by its number.
    State(usize),
    /// The rate of one.
    Rate(usize),
}

/// Type of a variable and the way to its value.
#[derive(Clone, Copy)]
pub enum Access {
    /// A real parameter.
    Real(RealParameter),
    /// An integer parameter.
    Integer(fn(&mut Parameters) -> &mut i32),
    /// A Boolean parameter.
    Boolean(fn(&mut Parameters) -> &mut bool),
    /// An enumeration parameter: type, value, and assignment of a value that is one of its choices.
    Enumeration(&'static EnumType, fn(&Parameters) -> i32, fn(&mut Parameters, i32)),
    /// A real input.
    Input(fn(&mut Inputs) -> &mut f64),
    /// A real output, or a local variable.
    Output(OutputSource),
}

/// A row of the table.
#[derive(Clone, Copy)]
pub struct Variable {
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
    /// Magnitude that errors of a continuous state are to be measured by.
    pub nominal: Option<f64>,
    /// Index of the variable that this one is the time derivative of.
    pub derivative_of: Option<usize>,
    /// Type and access.
    pub access: Access,
}
