//! The comparison as an aligned table and as Markdown.

use crate::text::numbers::signed_percent;
use crate::text::table::{Table, labelled};

/// A cell: a number with its decimals, a text, or nothing to say.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// A number and how many decimals to show.
    Number(f64, usize),
    /// A number in scientific notation: d.ddde±x.
    Scientific(f64),
    /// A text.
    Text(String),
    /// Nothing.
    Empty,
}

impl Cell {
    fn value(&self) -> Option<f64> {
        match self {
            Self::Number(value, _) | Self::Scientific(value) => Some(*value),
            _ => None,
        }
    }

    fn text(&self) -> String {
        match self {
            Self::Number(value, decimals) => format!("{value:.decimals$}"),
            Self::Scientific(value) => format!("{value:.3e}"),
            Self::Text(text) => text.clone(),
            Self::Empty => "–".to_owned(),
        }
    }
}

/// A row of the comparison.
#[derive(Clone, Debug, PartialEq)]
pub struct ComparisonRow {
    /// What, with its unit.
    pub quantity: &'static str,
    /// The study's number, theory, this program.
    pub cells: [Cell; 3],
    /// Number of the note that belongs to it, counted from 1.
    pub note: Option<usize>,
}

impl ComparisonRow {
    /// Relative difference of the program from theory.
    fn difference(&self) -> String {
        match self.cells.each_ref().map(Cell::value) {
            [_, Some(theory), Some(program)] if theory != 0.0 => signed_percent(program / theory - 1.0),
            _ => String::new(),
        }
    }

    fn texts(&self) -> [String; 5] {
        let note = self.note.map_or(String::new(), |n| format!(" [{n}]"));
        let [study, theory, program] = self.cells.each_ref().map(Cell::text);
        [format!("{}{note}", self.quantity), study, theory, program, self.difference()]
    }
}

/// The comparison.
#[derive(Clone, Debug, PartialEq)]
pub struct ComparisonReport {
    /// Its rows.
    pub rows: Vec<ComparisonRow>,
    /// Notes, numbered from 1.
    pub notes: Vec<String>,
}

const HEAD: [&str; 5] = ["quantity", "study", "theory", "this program", "program / theory"];

impl ComparisonReport {
    /// For the terminal.
    pub fn terminal(&self) -> String {
        let notes = self.notes.iter().enumerate().map(|(i, note)| labelled(&format!("[{}] ", i + 1), note));
        format!("{}\n{}", self.table().terminal(), notes.collect::<String>())
    }

    /// For docs/study.md: the whole table and its notes.
    pub fn markdown(&self) -> String {
        let notes = self.notes.iter().enumerate().map(|(i, note)| format!("{}. {note}\n", i + 1));
        format!("{}\n{}", self.table().markdown(), notes.collect::<String>())
    }

    fn table(&self) -> Table {
        let mut table = Table::new(HEAD).left([0]);
        self.rows.iter().for_each(|row| table.push(row.texts()));
        table
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_name_their_notes() {
        let row = |quantity, note| ComparisonRow {
            quantity,
            cells: [Cell::Empty, Cell::Number(2.0, 0), Cell::Number(3.0, 0)],
            note,
        };
        let report = ComparisonReport { rows: vec![row("a", Some(1)), row("b", None)], notes: vec!["why".into()] };
        assert!(report.markdown().contains("| a [1] ") && report.markdown().ends_with("\n1. why\n"));
    }
}
