//! CSV files as other programs write them: columns separated by commas, semicolons or tabs, numbers with decimal points
//! or decimal commas. Ambiguous files are refused.
//!
//! ```csv
//! # anything after a hash is a comment
//! time [s];left.load_torque [N.m]
//! 0;0
//! 0,5;835
//! ```

use std::path::Path;
use std::{fs, io};

use csv::{Position, ReaderBuilder, StringRecord, Trim};

/// Separators of columns, with their names.
const SEPARATORS: [(u8, &str); 3] = [(b',', "commas"), (b';', "semicolons"), (b'\t', "tabs")];
/// First character of comments.
const COMMENT: u8 = b'#';
/// Byte order mark, which some programs write at the start of UTF-8 files.
const MARK: char = '\u{feff}';
/// First line that names the separator for spreadsheet programs.
const SEPARATOR_LINE: &str = "sep=";

/// Cells of a file, without comments and blank lines. Numbers have decimal points.
#[derive(Debug)]
pub struct CsvInput {
    /// Line number of the header.
    pub header_line: u64,
    /// Names of the columns, with units as written.
    pub header: StringRecord,
    /// Rows with their line numbers, each with a cell for each column of the header.
    pub rows: Vec<(u64, StringRecord)>,
}

/// Reads `file`. Columns for whose header `is_text` is true may contain words, so a comma there is not a decimal comma. A
/// problem begins with its position in the file.
pub fn read(file: &Path, is_text: &dyn Fn(&str) -> bool) -> Result<CsvInput, String> {
    let text = fs::read_to_string(file).map_err(|error| match error.kind() {
        io::ErrorKind::InvalidData => format!(": it {}", super::not_text(file, "CSV")),
        io::ErrorKind::NotFound => ": there is no such file".to_owned(),
        _ => format!(": it cannot be read ({error})"),
    })?;
    parse(&text, is_text)
}

/// Reads the text of a file, as [`read`] does.
pub fn parse(text: &str, is_text: &dyn Fn(&str) -> bool) -> Result<CsvInput, String> {
    let text = text.trim_start_matches(MARK);
    let separator = separator(text)?;
    let mut reader = ReaderBuilder::new()
        .delimiter(separator)
        .comment(Some(COMMENT))
        .trim(Trim::All)
        .has_headers(false)
        .flexible(true)
        .from_reader(text.as_bytes());
    let mut rows = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|error| format!(": {error}"))?;
        let (line, rest) = start(text, record.position());
        let raw = rest.lines().next().unwrap_or_default();
        if is_data(raw) && !(line == 1 && raw.starts_with(SEPARATOR_LINE)) {
            rows.push((line, record));
        }
    }
    if rows.is_empty() {
        return Err(": it is empty; its first line names the columns".into());
    }
    let (header_line, header) = rows.remove(0);
    for (line, record) in &rows {
        if record.len() != header.len() {
            return Err(wrong_length(*line, record, &header, separator));
        }
    }
    let is_text: Vec<bool> = header.iter().map(is_text).collect();
    if has_decimal_commas(&header, &rows, &is_text, separator)? {
        for (_, record) in &mut rows {
            let cells = record.iter().zip(&is_text);
            *record = cells.map(|(cell, &text)| if text { cell.into() } else { with_points(cell) }).collect();
        }
    }
    Ok(CsvInput { header_line, header, rows })
}

/// Name in a header cell `name [unit]`.
pub fn name(head: &str) -> &str {
    head.split('[').next().unwrap_or_default().trim()
}

/// Separator of the columns, found between the names of the header.
fn separator(text: &str) -> Result<u8, String> {
    let mut lines = text.lines().zip(1..);
    if let Some(told) = text.strip_prefix(SEPARATOR_LINE).and_then(|rest| rest.bytes().next())
        && SEPARATORS.iter().any(|(known, _)| *known == told)
    {
        return Ok(told);
    }
    let Some((header, line)) = lines.find(|(line, _)| is_data(line)) else { return Ok(b',') };
    let bare = outside_quotes_and_brackets(header);
    let found: Vec<_> =
        SEPARATORS.iter().filter(|(separator, _)| bare.bytes().any(|byte| byte == *separator)).collect();
    match found.as_slice() {
        [(separator, _)] => Ok(*separator),
        [] => {
            let other = if bare.contains('|') { "vertical bars" } else { "blanks" };
            if other == "blanks" && bare.split_whitespace().count() < 2 {
                return Ok(b',');
            }
            Err(format!(
                ", line {line}: the columns seem to be separated by {other}; separate them by commas, semicolons or tabs"
            ))
        }
        several => {
            let names: Vec<_> = several.iter().map(|(_, name)| *name).collect();
            Err(format!(
                ", line {line}: the columns seem to be separated by {}; use one of them, and quotes around text that has another",
                names.join(" and by ")
            ))
        }
    }
}

/// True if a line is neither blank nor a comment.
fn is_data(line: &str) -> bool {
    let line = line.trim_start_matches(' ').trim_end();
    !line.is_empty() && !line.as_bytes().starts_with(&[COMMENT])
}

fn outside_quotes_and_brackets(header: &str) -> String {
    let (mut quoted, mut depth) = (false, 0);
    let is_outside = |letter: &char| {
        match letter {
            '"' => quoted = !quoted,
            '[' if !quoted => depth += 1,
            ']' if !quoted => depth -= 1,
            _ => return !quoted && depth <= 0,
        }
        false
    };
    header.chars().filter(is_outside).collect()
}

/// Line number of the record at `position`, and the text from there. The crate csv returns the position before comments
/// and blank lines, which it skips.
fn start<'a>(text: &'a str, position: Option<&Position>) -> (u64, &'a str) {
    let Some(position) = position else { return (0, text) };
    let mut rest = usize::try_from(position.byte()).ok().and_then(|from| text.get(from..)).unwrap_or_default();
    let mut line = position.line();
    while let Some((first, after)) = rest.split_once('\n') {
        if !first.trim_end_matches('\r').is_empty() && !first.as_bytes().starts_with(&[COMMENT]) {
            break;
        }
        (rest, line) = (after, line + 1);
    }
    (line, rest)
}

/// Problem of a row that has more or fewer cells than the header.
fn wrong_length(line: u64, record: &StringRecord, header: &StringRecord, separator: u8) -> String {
    let name_of = |wanted: u8| SEPARATORS.iter().find(|(known, _)| *known == wanted).map_or("", |(_, name)| name);
    let own = record.iter().collect::<Vec<_>>().join(&char::from(separator).to_string());
    let other = SEPARATORS.iter().find(|(other, _)| {
        let cells = own.split(char::from(*other)).count();
        *other != separator && cells == header.len() && cells > 1
    });
    let (count, expected) = (record.len(), header.len());
    let why = match other {
        Some((_, other)) => {
            let own = name_of(separator);
            format!("it seems to be separated by {other}, and the header by {own}: use the same in all lines")
        }
        None if separator == b',' && count > expected => {
            "every line needs all of them; if these are decimal commas, separate the columns by semicolons or tabs"
                .into()
        }
        None => "every line needs all of them".into(),
    };
    format!(", line {line}: has {count} cells where the header has {expected}; {why}")
}

/// Notation of a number, as far as it can be recognised.
#[derive(Clone, Copy, PartialEq)]
enum Form {
    /// A decimal comma.
    Comma,
    /// A decimal point.
    Point,
    /// A comma before three digits: 1,500 is 1.5 or 1500.
    CommaOrThousands,
    /// A point before three digits.
    PointOrThousands,
    /// Thousands separators.
    Thousands,
}

impl Form {
    /// Notation of a word; none if it is not a number or has neither commas nor points.
    fn of(word: &str) -> Option<Self> {
        let digits = word.trim_start_matches(['+', '-']);
        let (digits, exponent) = digits.split_once(['e', 'E']).map_or((digits, None), |(d, e)| (d, Some(e)));
        let is_number = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
        if exponent.is_some_and(|exponent| !is_number(exponent.strip_prefix(['+', '-']).unwrap_or(exponent))) {
            return None;
        }
        let parts: Vec<&str> = digits.split([',', '.']).collect();
        if parts.len() < 2 || !digits.bytes().any(|byte| byte.is_ascii_digit()) {
            return None;
        }
        if !parts.iter().all(|part| part.is_empty() || is_number(part)) {
            return None;
        }
        let is_grouped = |groups: &[&str]| {
            let first = groups[0];
            (1..=3).contains(&first.len())
                && !first.starts_with('0')
                && groups[1..].iter().all(|group| group.len() == 3)
        };
        if let [whole, part] = parts[..] {
            let is_group = exponent.is_none() && is_grouped(&[whole, part]);
            return Some(match (digits.contains(','), is_group) {
                (true, false) => Self::Comma,
                (true, true) => Self::CommaOrThousands,
                (false, false) => Self::Point,
                (false, true) => Self::PointOrThousands,
            });
        }
        let same = !(digits.contains(',') && digits.contains('.'));
        is_grouped(if same { &parts } else { &parts[..parts.len() - 1] }).then_some(Self::Thousands)
    }

    fn has_comma(self) -> bool {
        matches!(self, Self::Comma | Self::CommaOrThousands)
    }
}

/// True if the numbers of a file have decimal commas. Fails with the first ambiguous position.
fn has_decimal_commas(
    header: &StringRecord,
    rows: &[(u64, StringRecord)],
    is_text: &[bool],
    separator: u8,
) -> Result<bool, String> {
    // the first number with each mark, and the first one that cannot contain thousands separators
    let (mut comma, mut point, mut decided) = (None, None, false);
    for (line, record) in rows {
        for ((cell, head), _) in record.iter().zip(header).zip(is_text).filter(|(_, text)| !**text) {
            for form in cell.split_whitespace().filter_map(Form::of) {
                let place = || format!(", line {line}, column {head}, value \"{cell}\"");
                if form == Form::Thousands {
                    return Err(format!("{}: has thousands separators; write the number without them", place()));
                }
                let first = if form.has_comma() { &mut comma } else { &mut point };
                first.get_or_insert_with(place);
                decided |= matches!(form, Form::Comma | Form::Point);
            }
        }
    }
    let three = "three digits after it could be thousands";
    match (comma, point) {
        (Some(comma), Some(point)) => Err(format!(
            "{comma}: has a comma, but{} has a point; write all numbers with the same decimal sign and without thousands separators",
            point.trim_start_matches(',')
        )),
        (Some(comma), None) if !decided => {
            Err(format!("{comma}: is the comma a decimal comma? {three}; write numbers with decimal points"))
        }
        (None, Some(point)) if !decided && separator != b',' => Err(format!(
            "{point}: is the point a decimal point? {three}; write one number with other digits, or separate by commas"
        )),
        (comma, _) => Ok(comma.is_some()),
    }
}

/// Replaces the decimal commas of a cell with points.
fn with_points(cell: &str) -> String {
    let point = |word: &str| if Form::of(word).is_some() { word.replace(',', ".") } else { word.to_owned() };
    if cell.contains(',') { cell.split_whitespace().map(point).collect::<Vec<_>>().join(" ") } else { cell.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Cells of a file, header first.
    fn cells(text: &str) -> Vec<Vec<String>> {
        let found = parse(text, &|head| name(head) == "name").unwrap_or_else(|problem| panic!("{text:?}{problem}"));
        let records = std::iter::once(&found.header).chain(found.rows.iter().map(|(_, record)| record));
        records.map(|record| record.iter().map(str::to_owned).collect()).collect()
    }

    #[test]
    fn a_table_is_read_in_the_notation_of_any_country() {
        let expected = cells("name,time [s],x [N.m]\n\"a, b; c\",0.5,-1.25e3\n\"1,5\",1.500,7\n");
        assert_eq!(expected[1..], [["a, b; c", "0.5", "-1.25e3"], ["1,5", "1.500", "7"]]);
        for text in [
            "name;time [s];x [N.m]\n\"a, b; c\";0,5;-1,25e3\n1,5;1,500;7\n",
            "name;time [s];x [N.m]\n\"a, b; c\";0.5;-1.25e3\n1,5;1.500;7\n",
            "name\ttime [s]\tx [N.m]\na, b; c\t0,5\t-1,25e3\n1,5\t1,500\t7\n",
            "name\ttime [s]\tx [N.m]\na, b; c\t0.5\t-1.25e3\n1,5\t1.500\t7\n",
            "name,time [s],x [N.m]\n\"a, b; c\",\"0,5\",\"-1,25e3\"\n\"1,5\",\"1,500\",7\n",
            "\u{feff}sep=;\r\n# 5\" wheels, wet\r\n\r\nname; time [s] ;x [N.m]\r\n\"a, b; c\"; 0,5 ;-1,25e3\r\n  # c\r\n1,5;1,500;7\r\n",
            "name,\"time [s]\",x [N.m]\n   \n\"a, b; c\",0.5,-1.25e3\n\"1,5\",1.500,7",
        ] {
            assert_eq!(cells(text), expected, "{text}");
        }
        // blanks separate the elements of an array
        assert_eq!(cells("time;x\n0;0,5 1,25\n")[1], ["0", "0.5 1.25"]);
        // one column has no separator
        assert_eq!(cells("time [s]\n0\n0.25\n"), [["time [s]"], ["0"], ["0.25"]]);
    }

    #[test]
    fn rows_keep_their_line_numbers() {
        let found = parse("# c\n\ntime;x\n0;1\n\n   \n# c\n1;2\n", &|_| false).expect("a table");
        assert_eq!((found.header_line, found.rows[0].0, found.rows[1].0), (3, 4, 8));
    }

    #[test]
    fn ambiguous_files_are_refused_with_the_position() {
        for (text, parts) in [
            ("time;x\n0;1,500\n1;2,250\n", &["line 2, column x, value \"1,500\"", "decimal comma?", "thousands"][..]),
            ("time;x\n0;1.500\n", &["line 2, column x, value \"1.500\"", "decimal point?", "thousands"]),
            ("time\tx\n0\t-100.000\n", &["line 2, column x, value \"-100.000\"", "separate by commas"]),
            ("time,x\n0,\"1,500\"\n", &["line 2, column x, value \"1,500\"", "decimal comma?"]),
            (
                "time;x\n0,5;1\n1;2.5\n",
                &["line 2, column time, value \"0,5\"", "line 3, column x, value \"2.5\"", "same"],
            ),
            ("time,x\n0.5,\"1,500\"\n", &["line 2, column x, value \"1,500\"", "value \"0.5\"", "thousands"]),
            ("time;x\n0,5;1.500\n", &["value \"0,5\"", "value \"1.500\"", "thousands"]),
            ("time;x\n0;1\n1;1.234,5\n", &["line 3, column x, value \"1.234,5\"", "thousands separators"]),
            ("time,x\n0,\"1,234.5\"\n", &["line 2, column x, value \"1,234.5\"", "thousands separators"]),
            ("time;x\n0;1.234.567\n", &["line 2", "thousands separators"]),
            (
                "time,x\n0;1\n",
                &["line 2", "1 cells where the header has 2", "separated by semicolons, and the header by commas"],
            ),
            ("time;x\n0\t1\n", &["line 2", "separated by tabs, and the header by semicolons"]),
            ("time;x\n0,1\n", &["line 2", "separated by commas, and the header by semicolons"]),
            (
                "time,x\n0,5,1,25\n",
                &["line 2", "4 cells where the header has 2", "decimal commas", "semicolons or tabs"],
            ),
            ("time;x\n0;1;2\n", &["line 2", "3 cells where the header has 2", "every line"]),
            ("# c\ntime;x,y\n", &["line 2", "separated by commas and by semicolons", "use one"]),
            ("time|x\n0|1\n", &["line 1", "separated by vertical bars", "commas, semicolons or tabs"]),
            ("time x\n0 1\n", &["line 1", "separated by blanks", "commas, semicolons or tabs"]),
            ("\n# c\n", &["is empty"]),
        ] {
            let problem = parse(text, &|_| false).expect_err(text);
            for part in parts {
                assert!(problem.contains(part), "\"{part}\" is not in: {text:?}{problem}");
            }
        }
    }
}
