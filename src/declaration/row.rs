//! A row: what a variable is named, what it may be, and `A`, the way to its value.

use super::{DisplayUnit, Unit};

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
    /// Switch of the effect that the variable belongs to, where nothing else can make it felt.
    pub switch: Option<&'static str>,
    /// Condition on other variables under which a scene can feel the value, as `variables::felt` reads it; none: always.
    pub when: Option<&'static str>,
    /// The way to its value.
    pub access: A,
}

impl<A> Row<A> {
    /// The same row with another way to its value.
    pub fn map<B>(self, to: impl FnOnce(A) -> B) -> Row<B> {
        Row {
            name: self.name,
            description: self.description,
            causality: self.causality,
            variability: self.variability,
            unit: self.unit,
            display: self.display,
            range: self.range,
            nominal: self.nominal,
            derivative_of: self.derivative_of,
            switch: self.switch,
            when: self.when,
            access: to(self.access),
        }
    }
}
