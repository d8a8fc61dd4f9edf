//! Row of the table of dimensions, and the macro that declares rows.

use super::design::Design;

/// Standard of the terms of bevel gears.
pub const ISO_23509: Option<&str> = Some("ISO 23509");
/// Standard of the terms of virtual cylindrical gears.
pub const ISO_10300: Option<&str> = Some("ISO 10300-1");

/// Greek letters of the symbols, with their spelling in keys.
const GREEK: [(&str, &str); 11] = [
    ("α", "alpha"),
    ("γ", "gamma"),
    ("δ", "delta"),
    ("ε", "epsilon"),
    ("θ", "theta"),
    ("Λ", "Lambda"),
    ("ρ", "rho"),
    ("Σ", "Sigma"),
    ("τ", "tau"),
    ("φ", "phi"),
    ("ψ", "psi"),
];

/// Kind of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum QuantityKind {
    /// A length [m], shown in mm.
    Length,
    /// An angle, or an arc on the unit sphere [rad], shown in degrees.
    Angle,
    /// A ratio.
    Ratio,
    /// A whole number.
    Count,
}

impl QuantityKind {
    /// Unit of displayed values.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Length => "mm",
            Self::Angle => "deg",
            Self::Ratio | Self::Count => "1",
        }
    }

    /// Converts an SI value to that unit.
    pub fn shown(self, value: f64) -> f64 {
        match self {
            Self::Length => value * 1e3,
            Self::Angle => value.to_degrees(),
            Self::Ratio | Self::Count => value,
        }
    }

    /// Formats a value in that unit.
    pub fn text(self, shown: f64) -> String {
        let text = if self == Self::Count { format!("{shown:.0}") } else { format!("{shown:.4}") };
        // no "-0.0000"
        if text.trim_start_matches(['-', '0', '.']).is_empty() { text.trim_start_matches('-').to_owned() } else { text }
    }
}

/// Function for the SI value of a dimension.
#[derive(Clone, Copy)]
pub enum DimensionValue {
    /// Value of one gear: planet (0) or side gear (1).
    Gear(fn(&Design, usize) -> f64),
    /// Value of the pair.
    Pair(fn(&Design) -> f64),
}

/// A dimension.
#[derive(Clone, Copy)]
pub struct Dimension {
    /// Term and symbol in snake case.
    pub key: &'static str,
    /// Symbol, or an empty text.
    pub symbol: &'static str,
    /// Kind of the number.
    pub kind: QuantityKind,
    /// Standard that has the term.
    pub standard: Option<&'static str>,
    /// Short description.
    pub meaning: &'static str,
    /// Value.
    pub of: DimensionValue,
}

impl Dimension {
    /// Term with spaces instead of underscores.
    pub fn term(&self) -> String {
        let symbol = GREEK.iter().fold(self.symbol.to_owned(), |text, (letter, name)| text.replace(letter, name));
        let term = if symbol.is_empty() { None } else { self.key.strip_suffix(&format!("_{symbol}")) };
        term.unwrap_or(self.key).replace('_', " ")
    }

    /// Value for gear `i` in the displayed unit. For the pair, `i` does not matter.
    pub fn shown(&self, design: &Design, i: usize) -> f64 {
        self.kind.shown(match self.of {
            DimensionValue::Gear(value) => value(design, i),
            DimensionValue::Pair(value) => value(design),
        })
    }
}

/// Rows that belong together.
pub struct DimensionGroup {
    /// Heading of the group.
    pub title: &'static str,
    /// The rows.
    pub rows: Vec<Dimension>,
}

/// Declares a group of rows: key, symbol, kind, standard, meaning, value.
macro_rules! dimensions {
    ($title:literal, $of:path,
     $($key:literal $symbol:literal $kind:ident $standard:expr, $meaning:literal, $value:expr;)+) => {
        $crate::geometry::dimension::DimensionGroup {
            title: $title,
            rows: vec![$($crate::geometry::dimension::Dimension {
                key: $key,
                symbol: $symbol,
                kind: $crate::geometry::dimension::QuantityKind::$kind,
                standard: $standard,
                meaning: $meaning,
                of: $of($value),
            }),+],
        }
    };
}
pub(super) use dimensions;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_shown_to_a_tenth_of_a_micrometre_and_without_a_negative_zero() {
        assert_eq!(QuantityKind::Length.text(QuantityKind::Length.shown(0.045)), "45.0000");
        assert_eq!(QuantityKind::Count.text(10.0), "10");
        assert_eq!(QuantityKind::Ratio.text(-1e-9), "0.0000");
        assert_eq!(QuantityKind::Ratio.text(-0.01), "-0.0100");
    }
}
