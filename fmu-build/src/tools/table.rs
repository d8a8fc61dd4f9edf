//! Columns in line and sentences in lines, for the terminal.

use std::fmt::Write as _;

/// Width of the sentences.
const WIDTH: usize = 118;

/// Columns in line, those of `left` to the left; a line under the head.
pub fn aligned<R: AsRef<[String]>>(rows: &[R], left: &[usize]) -> String {
    let columns = rows.first().map_or(0, |row| row.as_ref().len());
    let width = |i: usize| rows.iter().map(|row| row.as_ref()[i].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let mut out = String::new();
    for (k, row) in rows.iter().enumerate() {
        let cells = row.as_ref().iter().zip(&widths).enumerate();
        let cells =
            cells.map(|(i, (cell, &w))| if left.contains(&i) { format!("{cell:<w$}") } else { format!("{cell:>w$}") });
        let line = cells.collect::<Vec<_>>().join("  ");
        let _ = writeln!(out, "{}", line.trim_end());
        if k == 0 {
            // the last column is as long as it is
            let shown = widths.iter().take(columns - 1).sum::<usize>() + 2 * (columns - 1);
            let last = row.as_ref().last().map_or(0, |cell| cell.chars().count());
            let _ = writeln!(
                out,
                "{}",
                "-".repeat(shown + last.max(if left.contains(&(columns - 1)) { 24 } else { widths[columns - 1] }))
            );
        }
    }
    out
}

/// `text` in lines of the terminal's width.
pub fn wrapped(text: &str) -> String {
    let (mut out, mut line) = (String::new(), String::new());
    for word in text.split_whitespace() {
        if !line.is_empty() && line.chars().count() + 1 + word.chars().count() > WIDTH {
            let _ = writeln!(out, "{line}");
            line.clear();
        }
        if !line.is_empty() {
            line.push(' ');
        }
        line.push_str(word);
    }
    let _ = writeln!(out, "{line}");
    out
}
