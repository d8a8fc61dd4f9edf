//! Table of all derived dimensions. Text, JSON and documentation are generated from its rows.
//!
//! Each row names the standard of its term and symbol, if there is one: ISO 23509:2016, or ISO 10300-1 for virtual
//! cylindrical gears. In the standard's terms, these are straight bevel gears (β = 0) without offset.
//! Their tip, pitch and root cones meet in one apex, which is the crossing point of the axes.

pub use super::dimension::{Dimension, DimensionGroup, QuantityKind};
use super::{gear_rows, pair_rows, tooth_rows};

/// Dimensions of each gear.
pub fn of_gears() -> Vec<DimensionGroup> {
    let mut groups = gear_rows::groups();
    groups.extend(tooth_rows::groups());
    groups
}

/// Dimensions of the pair.
pub fn of_pair() -> Vec<DimensionGroup> {
    pair_rows::groups()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn keys_are_snake_case_end_in_their_symbols_and_are_unique() {
        for groups in [of_gears(), of_pair()] {
            let mut seen = HashSet::new();
            for row in groups.iter().flat_map(|group| &group.rows) {
                assert!(row.key.chars().all(|c| c.is_ascii_alphanumeric() || c == '_'), "{}", row.key);
                assert!(seen.insert(row.key), "{} occurs twice", row.key);
                assert!(row.symbol.is_empty() || row.term().replace(' ', "_") != row.key, "{}", row.key);
                assert!(row.standard.is_none() || !row.symbol.is_empty(), "{}", row.key);
                assert!(!row.meaning.is_empty() && !row.meaning.ends_with('.'), "{}", row.key);
            }
        }
    }
}
