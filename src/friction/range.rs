//! Arguments outside the published range of a law.

use std::fmt;

/// A quantity outside the published range of its law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outside {
    /// The quantity, with its symbol.
    pub quantity: &'static str,
    /// Unit of `value`, `low` and `high`.
    pub unit: &'static str,
    /// Value of the quantity.
    pub value: f64,
    /// Lower end of the range.
    pub low: f64,
    /// Upper end of the range.
    pub high: f64,
    /// Source of the range.
    pub source: &'static str,
}

impl Outside {
    /// Returns `Some` if the value is outside the range.
    pub(super) fn test(
        (quantity, unit): (&'static str, &'static str),
        value: f64,
        [low, high]: [f64; 2],
        source: &'static str,
    ) -> Option<Self> {
        if (low..=high).contains(&value) { None } else { Some(Self { quantity, unit, value, low, high, source }) }
    }
}

impl fmt::Display for Outside {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { quantity, unit, value, low, high, source } = self;
        write!(f, "{quantity} of {value:.4} {unit} is outside {low} to {high} {unit} ({source})")
    }
}
