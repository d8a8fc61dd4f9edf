//! Text that answers are given in: tables, numbers, CSV, XML; and text from users: CSV files, names with slips.

pub mod csv_file;
pub mod csv_input;
pub mod near;
pub mod numbers;
pub mod table;
pub mod xml;

use std::env;
use std::path::Path;

/// `path` as messages show it: relative to the current folder where it lies in it.
pub fn shown(path: &Path) -> String {
    let here = env::current_dir().unwrap_or_default();
    path.strip_prefix(&here).unwrap_or(path).display().to_string()
}
