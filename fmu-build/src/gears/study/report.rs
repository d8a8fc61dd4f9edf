//! The comparison as an aligned table and as Markdown.

use std::fmt::Write as _;

/// Width of the notes under the table.
const WIDTH: usize = 110;

/// A cell: a number with its decimals, a text, or nothing to say.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// A number and how many decimals to show.
    Number(f64, usize),
    /// A large or small number as d.ddde±x.
    Power(f64),
    /// A text.
    Text(String),
    /// Nothing.
    Empty,
}

impl Cell {
    fn value(&self) -> Option<f64> {
        match self {
            Self::Number(value, _) | Self::Power(value) => Some(*value),
            _ => None,
        }
    }

    fn text(&self) -> String {
        match self {
            Self::Number(value, decimals) => format!("{value:.decimals$}"),
            Self::Power(value) => format!("{value:.3e}"),
            Self::Text(text) => text.clone(),
            Self::Empty => "–".to_owned(),
        }
    }
}

/// A row of the comparison.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// What, with its unit.
    pub quantity: &'static str,
    /// The study's number.
    pub study: Cell,
    /// Theory.
    pub theory: Cell,
    /// This program.
    pub program: Cell,
    /// Number of the note that belongs to it, counted from 1.
    pub note: Option<usize>,
}

impl Row {
    /// Relative difference of the program from theory.
    fn difference(&self) -> String {
        match (self.theory.value(), self.program.value()) {
            (Some(theory), Some(program)) if theory != 0.0 => signed_percent(program / theory - 1.0),
            _ => String::new(),
        }
    }

    fn cells(&self) -> [String; 5] {
        let note = self.note.map_or(String::new(), |n| format!(" [{n}]"));
        [
            format!("{}{note}", self.quantity),
            self.study.text(),
            self.theory.text(),
            self.program.text(),
            self.difference(),
        ]
    }
}

/// A fraction in percent with two significant digits and its sign.
fn signed_percent(fraction: f64) -> String {
    let percent = fraction * 100.0;
    if percent.abs() < 1e-12 {
        return "0 %".to_owned();
    }
    let decimals = (1.0 - percent.abs().log10().floor()).max(0.0) as usize;
    if decimals > 5 { format!("{percent:+.1e} %") } else { format!("{percent:+.decimals$} %") }
}

/// The comparison.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// Its rows.
    pub rows: Vec<Row>,
    /// Notes, numbered from 1.
    pub notes: Vec<String>,
}

const HEAD: [&str; 5] = ["quantity", "study", "theory", "this program", "program / theory"];

impl Report {
    /// For the terminal.
    pub fn terminal(&self) -> String {
        let rows: Vec<[String; 5]> =
            std::iter::once(HEAD.map(str::to_owned)).chain(self.rows.iter().map(Row::cells)).collect();
        let width: [usize; 5] = std::array::from_fn(|i| rows.iter().map(|r| r[i].chars().count()).max().unwrap_or(0));
        let mut out = String::new();
        for (i, row) in rows.iter().enumerate() {
            let mut line = format!("{:<w$}", row[0], w = width[0]);
            for (cell, w) in row.iter().zip(width).skip(1) {
                let _ = write!(line, "  {cell:>w$}");
            }
            let _ = writeln!(out, "{}", line.trim_end());
            if i == 0 {
                let _ = writeln!(out, "{}", "-".repeat(width.iter().sum::<usize>() + 2 * (width.len() - 1)));
            }
        }
        out.push('\n');
        for (i, note) in self.notes.iter().enumerate() {
            out.push_str(&wrapped(&format!("[{}] ", i + 1), note));
        }
        out
    }

    /// For the README.
    pub fn markdown(&self) -> String {
        let mut out = format!("| {} |\n|---|---:|---:|---:|---:|\n", HEAD.join(" | "));
        for row in &self.rows {
            let _ = writeln!(out, "| {} |", row.cells().join(" | "));
        }
        out.push('\n');
        for (i, note) in self.notes.iter().enumerate() {
            let _ = writeln!(out, "{}. {note}", i + 1);
        }
        out
    }
}

/// `text` broken into lines, the later ones indented to the first one's `label`.
fn wrapped(label: &str, text: &str) -> String {
    let indent = " ".repeat(label.chars().count());
    let (mut out, mut line) = (String::new(), label.to_owned());
    for word in text.split_whitespace() {
        if line.chars().count() + word.chars().count() > WIDTH {
            let _ = writeln!(out, "{}", line.trim_end());
            line.clone_from(&indent);
        }
        line.push_str(word);
        line.push(' ');
    }
    let _ = writeln!(out, "{}", line.trim_end());
    out
}

#[cfg(test)]
mod tests {
    use super::signed_percent;

    #[test]
    fn differences_show_two_digits() {
        assert_eq!(signed_percent(0.0), "0 %");
        assert_eq!(signed_percent(0.1234), "+12 %");
        assert_eq!(signed_percent(-0.000_123_4), "-0.012 %");
        assert_eq!(signed_percent(1.2e-9), "+1.2e-7 %");
    }
}
