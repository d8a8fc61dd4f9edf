//! A row declares a variable, with `A` as the access to its value. Rows of parameters follow from `parameters!`. For other
//! variables, a row starts with the name and the description; a condition follows, and finally the kind of variable and
//! the access. These functions are not inlined, because rows are created only once and inlining would add tens of
//! kilobytes.

use super::{Condition, DisplayUnit, Shown, Unit};

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

/// Rounding error of a value that is typed with seven digits, relative to the value.
const TYPED: f64 = 1e-6;

impl Range {
    /// Returns the only value of the range, if all others are rounding errors of it.
    pub fn only_value(&self) -> Option<f64> {
        (self.max - self.min < TYPED * self.max.abs()).then_some((self.min + self.max) / 2.0)
    }
}

/// A row of the table.
#[derive(Clone, Copy, Debug)]
pub struct Row<A> {
    /// Dotted name.
    pub name: &'static str,
    /// Description.
    pub description: &'static str,
    /// FMI causality.
    pub causality: Causality,
    /// FMI variability.
    pub variability: Variability,
    /// Unit of a real variable.
    pub unit: Option<Unit>,
    /// Unit in which users expect the value, if that is not the SI unit.
    pub display: Option<DisplayUnit>,
    /// Allowed values of a number.
    pub range: Option<Range>,
    /// Typical magnitude of a continuous state, for the host's error control.
    pub nominal: Option<f64>,
    /// Index of the variable whose time derivative this variable is.
    pub derivative_of: Option<usize>,
    /// Condition that the effect to which the variable belongs is on, if the variable has no effect without it.
    pub switch: Option<Condition>,
    /// Condition under which the value has an effect; `None` = always.
    pub when: Option<Condition>,
    /// Condition under which the value affects more than outputs that repeat it; `None` = as `when`.
    pub acts_when: Option<Condition>,
    /// Name of the variable that acts in scenes in which this one does not, if there is such a one.
    pub instead: Option<&'static str>,
    /// Access to the value.
    pub access: A,
}

impl<A: Copy> Row<A> {
    /// Returns the row of differences between values of this variable. They have no range. A display unit with an
    /// offset, such as degC, is dropped.
    pub fn of_differences(&self) -> Self {
        Row {
            unit: self.unit.map(Unit::of_differences),
            display: self.display.filter(|shown| shown.offset == 0.0),
            range: None,
            ..*self
        }
    }
}

impl<A> Row<A> {
    /// Returns the row with another access to its value.
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
            acts_when: self.acts_when,
            instead: self.instead,
            access: to(self.access),
        }
    }
}

/// Starts a row with a name and a description.
#[inline(never)]
pub const fn row(name: &'static str, description: &'static str) -> Row<()> {
    Row {
        name,
        description,
        causality: Causality::Parameter,
        variability: Variability::Fixed,
        unit: None,
        display: None,
        range: None,
        nominal: None,
        derivative_of: None,
        switch: None,
        when: None,
        acts_when: None,
        instead: None,
        access: (),
    }
}

impl Row<()> {
    /// Declares that the value has an effect only under `condition`.
    #[inline(never)]
    pub const fn when(self, condition: Condition) -> Self {
        Row { when: Some(condition), ..self }
    }

    /// Names the variable that acts in scenes in which this one does not.
    #[inline(never)]
    pub const fn instead(self, name: &'static str) -> Self {
        Row { instead: Some(name), ..self }
    }

    const fn number(self, Shown(unit, display): Shown, range: Option<Range>) -> Self {
        Row { unit: Some(unit), display, range, ..self }
    }

    /// An input between −`limit` and `limit`.
    #[inline(never)]
    pub fn input<A>(self, unit: impl Into<Shown>, limit: f64, at: A) -> Row<A> {
        self.of(Causality::Input).number(unit.into(), Some(Range { min: -limit, max: limit })).map(|()| at)
    }

    /// An input between 0 and `max`.
    #[inline(never)]
    pub fn command<A>(self, unit: impl Into<Shown>, max: f64, at: A) -> Row<A> {
        self.of(Causality::Input).number(unit.into(), Some(Range { min: 0.0, max })).map(|()| at)
    }

    /// An output.
    #[inline(never)]
    pub fn output<A>(self, unit: impl Into<Shown>, of: A) -> Row<A> {
        self.of(Causality::Output).number(unit.into(), None).map(|()| of)
    }

    const fn of(self, causality: Causality) -> Self {
        Row { causality, variability: Variability::Continuous, ..self }
    }
}
