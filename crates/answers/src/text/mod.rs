//! Texts of answers: tables, numbers, CSV, XML, JSON, and their files. Texts from users: CSV files, misspelt names.

pub mod csv_file;
pub mod csv_input;
pub mod near;
pub mod numbers;
pub mod table;
pub mod whole_file;
pub mod xml;

use std::env;
use std::fs::File;
use std::io::Read as _;
use std::path::Path;

/// First bytes of files from spreadsheet programs: archives (.xlsx, .ods) and the older format (.xls).
const SPREADSHEETS: [&[u8]; 2] = [b"PK\x03\x04", b"\xd0\xcf\x11\xe0"];
/// Length of the longest of these.
const LONGEST_MARK: u64 = 4;

/// Returns `path` for messages: relative to the current folder if it is inside.
pub fn shown(path: &Path) -> String {
    let here = env::current_dir().unwrap_or_default();
    path.strip_prefix(&here).unwrap_or(path).display().to_string()
}

/// Reason and remedy, as a clause, if `file` is not UTF-8 and should be a `wanted` file.
pub fn not_text(file: &Path, wanted: &str) -> String {
    let mut begin = Vec::new();
    let read = File::open(file).and_then(|opened| opened.take(LONGEST_MARK).read_to_end(&mut begin));
    if read.is_ok() && SPREADSHEETS.iter().any(|mark| begin.starts_with(mark)) {
        return format!("is a spreadsheet; save it there as {wanted}, and name that file");
    }
    format!("is not UTF-8; save it as {wanted} in UTF-8")
}
