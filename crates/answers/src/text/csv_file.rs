//! CSV files: a header line, and rows without empty cells.

use anyhow::{Context, Result};
use csv::Writer;

/// CSV file that is being written.
pub struct CsvFile(Writer<Vec<u8>>);

impl CsvFile {
    /// Creates a file with `columns`, separated by commas.
    pub fn new(columns: &str) -> Result<Self> {
        let mut rows = Writer::from_writer(Vec::new());
        rows.write_record(columns.split(',')).context("the head of a CSV file")?;
        Ok(Self(rows))
    }

    /// Adds a row, which must have a cell for each column. An empty cell becomes "-".
    pub fn push<T: AsRef<str>>(&mut self, cells: impl IntoIterator<Item = T>) -> Result<()> {
        for cell in cells {
            let cell = cell.as_ref();
            // a row stays on one line
            let cell = if cell.is_empty() { "-".into() } else { cell.replace('\n', " ") };
            self.0.write_field(cell)?;
        }
        self.0.write_record(None::<&[u8]>).context("a row of a CSV file")
    }

    /// Text of the file.
    pub fn text(self) -> Result<String> {
        let rows = self.0.into_inner().map_err(|error| error.into_error()).context("a CSV file")?;
        Ok(String::from_utf8(rows)?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_quoted_where_they_have_commas_and_are_never_empty() -> Result<()> {
        let mut file = CsvFile::new("a,b")?;
        file.push(["x, \"y\"\nz", ""])?;
        assert_eq!(file.text()?, "a,b\n\"x, \"\"y\"\" z\",-\n");
        Ok(())
    }

    #[test]
    fn a_row_has_as_many_cells_as_there_are_columns() -> Result<()> {
        assert!(CsvFile::new("a,b")?.push(["x"]).is_err());
        Ok(())
    }
}
