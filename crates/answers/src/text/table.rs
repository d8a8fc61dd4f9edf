//! Tables, aligned for a terminal or as Markdown for documents, and paragraphs of a terminal's width.

use std::fmt::Write as _;

use comfy_table::presets::ASCII_MARKDOWN;
use comfy_table::{CellAlignment, LineStyle, TableStyle};

/// Width of paragraphs.
const WIDTH: usize = 118;
/// Maximum length of the line under the header of a last column with sentences, in characters.
const LAST_COLUMN: usize = 24;

/// A table of texts. Columns are right-aligned by default.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    head: Vec<String>,
    left: Vec<usize>,
    rows: Vec<Vec<String>>,
}

impl Table {
    /// Creates a table with the columns `head` and no rows.
    pub fn new<T: Into<String>>(head: impl IntoIterator<Item = T>) -> Self {
        Self { head: head.into_iter().map(Into::into).collect(), left: Vec::new(), rows: Vec::new() }
    }

    /// Aligns `columns` to the left.
    pub fn left(mut self, columns: impl IntoIterator<Item = usize>) -> Self {
        self.left.extend(columns);
        self
    }

    /// Aligns all columns to the left.
    pub fn all_left(self) -> Self {
        let columns = self.head.len();
        self.left(0..columns)
    }

    /// Adds a row.
    pub fn push<T: Into<String>>(&mut self, cells: impl IntoIterator<Item = T>) {
        self.rows.push(cells.into_iter().map(Into::into).collect());
    }

    /// Aligned columns for a terminal.
    pub fn terminal(&self) -> String {
        let rule = LineStyle::none().fill('-').junction('-');
        let mut drawn = self.drawn(TableStyle::new().header_separator(rule));
        drawn.column_iter_mut().for_each(|column| {
            column.set_padding((0, 1));
        });
        let lines = drawn.lines().map(|line| line.trim_end().to_owned()).enumerate();
        lines.fold(String::new(), |mut out, (i, line)| {
            let line = if i == 1 { "-".repeat(line.len().saturating_sub(self.beyond_rule())) } else { line };
            let _ = writeln!(out, "{line}");
            out
        })
    }

    /// Number of characters by which the line under the header is shorter than the last column, if that contains long
    /// sentences.
    fn beyond_rule(&self) -> usize {
        let Some(last) = self.head.len().checked_sub(1).filter(|last| self.left.contains(last)) else { return 1 };
        let cells = self.rows.iter().filter_map(|row| row.get(last)).chain([&self.head[last]]);
        let width = cells.map(|cell| cell.chars().count()).max().unwrap_or(0);
        1 + width.saturating_sub(LAST_COLUMN.max(self.head[last].chars().count()))
    }

    /// Markdown for a document.
    pub fn markdown(&self) -> String {
        let drawn = self.drawn(ASCII_MARKDOWN);
        let mut out = String::new();
        for (i, line) in drawn.lines().enumerate() {
            let _ = writeln!(out, "{}", if i == 1 { self.rule(&line) } else { line });
        }
        out
    }

    /// Adds the alignment of each column to the line under the header.
    fn rule(&self, line: &str) -> String {
        let dashes = line.trim_matches('|').split('|').enumerate();
        let marked = dashes.map(|(i, dashes)| {
            if self.left.contains(&i) { dashes.to_owned() } else { format!("{}:", &dashes[..dashes.len() - 1]) }
        });
        format!("|{}|", marked.collect::<Vec<_>>().join("|"))
    }

    fn drawn(&self, style: TableStyle) -> comfy_table::Table {
        let mut drawn = comfy_table::Table::new();
        drawn.load_style(style).set_header(self.head.iter().cloned());
        drawn.add_rows(self.rows.iter().map(|row| row.iter().cloned()));
        for (i, column) in drawn.column_iter_mut().enumerate() {
            let left = self.left.contains(&i);
            column.set_cell_alignment(if left { CellAlignment::Left } else { CellAlignment::Right });
        }
        drawn
    }
}

/// Wraps `text` to the terminal's width.
pub fn wrapped(text: &str) -> String {
    labelled("", text)
}

/// Wraps `text` after `label` to the terminal's width. Later lines are indented by the length of the label.
pub fn labelled(label: &str, text: &str) -> String {
    let indent = " ".repeat(label.chars().count());
    let (mut out, mut line, mut width) = (String::new(), label.to_owned(), label.chars().count());
    let mut is_begun = false;
    for word in text.split_whitespace() {
        let length = word.chars().count();
        if is_begun && width + 1 + length > WIDTH {
            let _ = writeln!(out, "{line}");
            line.clone_from(&indent);
            (width, is_begun) = (indent.len(), false);
        }
        if is_begun {
            line.push(' ');
            width += 1;
        }
        line.push_str(word);
        (width, is_begun) = (width + length, true);
    }
    let _ = writeln!(out, "{}", line.trim_end());
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> Table {
        let mut table = Table::new(["case", "error, µm"]).left([0]);
        table.push(["`turn`", "2"]);
        table.push(["straight ahead", "128"]);
        table
    }

    #[test]
    fn a_terminal_shows_aligned_columns() {
        let wanted = "case            error, µm\n---\n`turn`                  2\nstraight ahead        128\n";
        let shown = table().terminal();
        let (head, rest) = shown.split_once('\n').expect("lines");
        let (rule, rows) = rest.split_once('\n').expect("lines");
        assert_eq!(format!("{head}\n---\n{rows}"), wanted);
        assert!(rule.chars().all(|c| c == '-') && rule.len() >= head.chars().count());
    }

    #[test]
    fn markdown_states_the_alignment_of_columns() {
        let lines: Vec<String> = table().markdown().lines().map(|line| line.replace(' ', "")).collect();
        assert_eq!(lines[0], "|case|error,µm|");
        assert!(lines[1].starts_with("|--") && lines[1].ends_with("-:|"), "{}", lines[1]);
        assert_eq!(lines[3], "|straightahead|128|");
    }

    #[test]
    fn paragraphs_are_wrapped_and_indented_to_their_label() {
        let text = labelled("[1] ", &"word ".repeat(40));
        let lines: Vec<&str> = text.lines().collect();
        assert!(lines.len() == 2 && lines.iter().all(|line| line.len() <= WIDTH), "{text}");
        assert!(lines[0].starts_with("[1] word") && lines[1].starts_with("    word"), "{text}");
    }
}
