//! CSV files: what they are about in comments, no empty cells.

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

#[cfg(test)]
mod tests {
    use super::text;

    #[test]
    fn cells_are_quoted_where_they_have_commas_and_are_never_empty() {
        assert_eq!(text("a, \"b\"\nc"), "\"a, 'b' c\"");
        assert_eq!([text("plain"), text("")], ["plain", "-"]);
    }
}
