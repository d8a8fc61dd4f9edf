//! CSV files: what they are about in comments, no empty cells.

use anyhow::{Context, Result, bail, ensure};

use super::measure::machine;

/// Comments and the head line.
pub fn head(columns: &str, comments: &[&str]) -> String {
    let mut out = format!("# machine: {}\n", machine());
    for comment in comments {
        out.push_str(&format!("# {comment}\n"));
    }
    out.push_str(columns);
    out.push('\n');
    out
}

/// A text as a cell: in quotes if it has to be.
pub fn text(cell: &str) -> String {
    match cell {
        "" => "-".into(),
        cell if cell.contains([',', '"', '\n']) => format!("\"{}\"", cell.replace('"', "'").replace('\n', " ")),
        cell => cell.into(),
    }
}

/// Makes sure that each row of `file` has all cells and none is empty: readers of a file do not look for holes.
pub fn ensure_whole(file: &str, text: &str) -> Result<()> {
    let mut rows = text.lines().filter(|line| !line.starts_with('#')).map(cells);
    let head = rows.next().with_context(|| format!("{file} has no head"))?;
    for (i, row) in rows.enumerate() {
        ensure!(row.len() == head.len(), "{file}: row {} has {} cells, not {}", i + 1, row.len(), head.len());
        if let Some(hole) = row.iter().position(String::is_empty) {
            bail!("{file}: row {} has nothing under {}", i + 1, head[hole]);
        }
    }
    Ok(())
}

/// Cells of a line, quotes taken off.
fn cells(line: &str) -> Vec<String> {
    let (mut cells, mut quoted) = (vec![String::new()], false);
    for letter in line.chars() {
        match (letter, cells.last_mut()) {
            ('"', _) => quoted = !quoted,
            (',', _) if !quoted => cells.push(String::new()),
            (letter, Some(cell)) => cell.push(letter),
            (_, None) => {}
        }
    }
    cells
}

#[cfg(test)]
mod tests {
    use super::{ensure_whole, text};

    #[test]
    fn cells_are_quoted_where_they_have_commas_and_are_never_empty() {
        assert_eq!(text("a, \"b\"\nc"), "\"a, 'b' c\"");
        assert_eq!([text("plain"), text("")], ["plain", "-"]);
    }

    #[test]
    fn a_file_with_a_hole_is_not_whole() {
        assert!(ensure_whole("f", "# c\na,b\n1,\"x, y\"\n").is_ok());
        for (text, told) in [("a,b\n1,\n", "under b"), ("a,b\n1\n", "has 1 cells"), ("# c\n", "no head")] {
            let problem = ensure_whole("f", text).expect_err(text).to_string();
            assert!(problem.contains(told), "{problem}");
        }
    }
}
