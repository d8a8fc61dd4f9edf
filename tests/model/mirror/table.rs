//! Table of symmetries, `tests/data/symmetry.csv`: the parity of each variable in a reflected differential.

use std::sync::OnceLock;

use bevel_differential::variables::{Access, Causality, table};

/// Parity of a variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parity {
    /// The variable keeps its value.
    Even,
    /// The variable changes its sign.
    Odd,
    /// The variable is odd about minus half the backlash.
    Lash,
    /// Gears and teeth are renumbered.
    Teeth,
    /// Ramps of clutch packs for drive and coast change places.
    Ramp,
    /// Flanks, hand, phases and side of the final drive change.
    Drive,
    /// Left and right change places in the value.
    Sides,
}

/// Line of the table.
#[derive(Debug)]
pub struct Line {
    /// Pattern of the variables to which the line applies.
    pub pattern: &'static str,
    /// Parities of these variables if rotation is reversed, and if sides are swapped.
    pub parity: [Parity; 2],
}

fn parity(text: &str) -> Parity {
    match text {
        "+" => Parity::Even,
        "-" => Parity::Odd,
        "lash" => Parity::Lash,
        "teeth" => Parity::Teeth,
        "ramp" => Parity::Ramp,
        "drive" => Parity::Drive,
        "sides" => Parity::Sides,
        other => panic!("{other} is not a parity"),
    }
}

/// All lines of the table.
pub fn lines() -> &'static [Line] {
    static LINES: OnceLock<Vec<Line>> = OnceLock::new();
    LINES.get_or_init(|| {
        let text = include_str!("../../data/symmetry.csv").lines().filter(|line| !line.starts_with('#'));
        text.skip(1)
            .map(|line| {
                let [pattern, reversed, swapped] = line.split(',').collect::<Vec<_>>().try_into().expect(line);
                Line { pattern, parity: [parity(reversed), parity(swapped)] }
            })
            .collect()
    })
}

/// Name with placeholders for sides and planets. A derivative has the name of its state.
fn open(name: &str) -> String {
    let state = name.strip_prefix("der(").and_then(|rest| rest.strip_suffix(')')).unwrap_or(name);
    let open = state.replace("left", "SIDE").replace("right", "SIDE");
    (1..=4).fold(open, |open, i| open.replace(&format!("planet[{i}]"), "planet[I]"))
}

/// Index of the line of a variable: a line for the variable itself, or else for its group.
pub fn line_of(name: &str) -> Option<usize> {
    let open = open(name);
    let find = |matches: &dyn Fn(&Line) -> bool| lines().iter().position(matches);
    find(&|line| line.pattern == open)
        .or_else(|| find(&|line| line.pattern.strip_suffix('*').is_some_and(|group| open.starts_with(group))))
}

#[test]
fn every_variable_has_an_entry_and_every_entry_a_variable() {
    let rows = &table().rows;
    let missing: Vec<&str> = rows.iter().map(|row| row.name).filter(|name| line_of(name).is_none()).collect();
    assert!(missing.is_empty(), "without an entry in tests/data/symmetry.csv: {missing:?}");
    let used: Vec<usize> = rows.iter().filter_map(|row| line_of(row.name)).collect();
    let idle: Vec<_> = (0..lines().len()).filter(|line| !used.contains(line)).map(|i| lines()[i].pattern).collect();
    assert!(idle.is_empty(), "entries without a variable: {idle:?}");
}

#[test]
fn outputs_and_inputs_have_separate_entries() {
    let is_parameter = |causality| matches!(causality, Causality::Parameter | Causality::CalculatedParameter);
    for row in table().rows.iter().filter(|row| !is_parameter(row.causality)) {
        let pattern = line_of(row.name).map_or("*", |line| lines()[line].pattern);
        assert!(!pattern.ends_with('*'), "{}", row.name);
    }
}

#[test]
fn only_numbers_change_their_sign() {
    for row in table().rows {
        let odd = line_of(row.name).is_some_and(|line| lines()[line].parity.contains(&Parity::Odd));
        let real = matches!(row.access, Access::Real(_) | Access::Input(_) | Access::Output(_));
        let both = row.range.is_none_or(|range| range.min < 0.0 && range.max == -range.min);
        assert!(!odd || real && both, "{}", row.name);
    }
}
