//! Short ways to write rows.

use super::access::{Parameter, keep};
use super::row::{Causality, EnumType, Range, Row, Variability};
use super::units::{self, DisplayUnit, Unit};

fn row<A>(name: &'static str, causality: Causality, access: A, description: &'static str) -> Row<A> {
    let variability = if causality == Causality::Parameter { Variability::Fixed } else { Variability::Continuous };
    Row {
        name,
        description,
        causality,
        variability,
        unit: None,
        display: None,
        range: None,
        nominal: None,
        derivative_of: None,
        switch: None,
        when: None,
        access,
    }
}

/// A real parameter.
pub fn real<P: 'static>(
    name: &'static str,
    unit: Unit,
    display: Option<DisplayUnit>,
    (min, max): (f64, f64),
    at: fn(&mut P) -> &mut f64,
    description: &'static str,
) -> Row<Parameter<P>> {
    let row = row(name, Causality::Parameter, Parameter::Real(keep(at)), description);
    Row { unit: Some(unit), display, range: Some(Range { min, max }), ..row }
}

/// An integer parameter.
pub fn integer<P: 'static>(
    name: &'static str,
    (min, max): (i32, i32),
    at: fn(&mut P) -> &mut i32,
    description: &'static str,
) -> Row<Parameter<P>> {
    let range = Some(Range { min: f64::from(min), max: f64::from(max) });
    Row { range, ..row(name, Causality::Parameter, Parameter::Integer(keep(at)), description) }
}

/// A Boolean parameter.
pub fn switch<P: 'static>(
    name: &'static str,
    at: fn(&mut P) -> &mut bool,
    description: &'static str,
) -> Row<Parameter<P>> {
    row(name, Causality::Parameter, Parameter::Boolean(keep(at)), description)
}

/// A parameter that is one of several choices; see the macro `choice`.
pub fn enumeration<P: 'static>(
    name: &'static str,
    kind: &'static EnumType,
    get: fn(&P) -> i32,
    set: fn(&mut P, i32),
    description: &'static str,
) -> Row<Parameter<P>> {
    let access = Parameter::Enumeration(kind, keep(get), keep(set));
    row(name, Causality::Parameter, access, description)
}

/// The same parameter, to be changed while a simulation runs as well.
pub fn tunable<P>(row: Row<Parameter<P>>) -> Row<Parameter<P>> {
    Row { variability: Variability::Tunable, ..row }
}

/// The same variable, whose value a scene feels under `condition` alone (`variables::felt`).
pub fn when<A>(condition: &'static str, row: Row<A>) -> Row<A> {
    Row { when: Some(condition), ..row }
}

/// An input between −`limit` and `limit`.
pub fn input<A>(
    name: &'static str,
    unit: Unit,
    display: Option<DisplayUnit>,
    limit: f64,
    at: A,
    description: &'static str,
) -> Row<A> {
    let range = Some(Range { min: -limit, max: limit });
    Row { unit: Some(unit), display, range, ..row(name, Causality::Input, at, description) }
}

/// A command between 0 and 1.
pub fn command<A>(name: &'static str, at: A, description: &'static str) -> Row<A> {
    Row { range: Some(Range { min: 0.0, max: 1.0 }), ..input(name, units::ONE, None, 1.0, at, description) }
}

/// A parameter that follows from others.
pub fn calculated<A>(
    name: &'static str,
    unit: Unit,
    display: Option<DisplayUnit>,
    of: A,
    description: &'static str,
) -> Row<A> {
    Row {
        causality: Causality::CalculatedParameter,
        variability: Variability::Fixed,
        ..output(name, unit, display, of, description)
    }
}

/// An output.
pub fn output<A>(
    name: &'static str,
    unit: Unit,
    display: Option<DisplayUnit>,
    of: A,
    description: &'static str,
) -> Row<A> {
    Row { unit: Some(unit), display, ..row(name, Causality::Output, of, description) }
}
