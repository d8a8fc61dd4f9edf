//! Tables of docs/variables.md: the variables of the FMU by group, with start value, range, unit and description. One
//! row represents equal variables of both sides, or of all elements of an array.

use bevel_differential::variables::{Access, Causality, Variability, Variable, table};

use crate::fmu::documentation::{allowed, parameter_groups, start};

/// Intended width of a line in characters. A line is longer if even its shortened description does not fit.
const TARGET_WIDTH: usize = 160;
/// Number of characters around the last cell: a blank before it, a blank and a bar after it.
const BETWEEN: usize = 3;
/// Groups that come first; the groups of the effects follow.
const FIRST: [&str; 8] = ["geometry", "material", "inertia", "scene", "contact", "solid", "solver", "effects"];

/// Returns the groups with their tables, in Markdown.
pub fn groups() -> String {
    let mut parameters = parameter_groups();
    // a stable sort: the groups of the effects keep the order of the table
    parameters.sort_by_key(|(name, _)| FIRST.iter().position(|first| first == name).unwrap_or(FIRST.len()));
    let mut out = String::new();
    for (name, rows) in parameters {
        push_group(&mut out, &format!("Parameters: {name}"), &rows);
    }
    let of = |causality| table().rows.iter().filter(move |row| row.causality == causality).collect::<Vec<_>>();
    push_group(&mut out, "Calculated parameters", &of(Causality::CalculatedParameter));
    push_group(&mut out, "Inputs", &of(Causality::Input));
    push_group(&mut out, "Outputs", &of(Causality::Output));
    out
}

/// Appends a heading and the table of `rows`. Each description is shortened to the width that the other cells leave.
fn push_group(out: &mut String, title: &str, rows: &[&Variable]) {
    let has_start = rows.iter().any(|row| !matches!(row.access, Access::Output(_)));
    let head = if has_start {
        "| variable | start | range | unit | what it is |\n|---|---|---|---|---|"
    } else {
        "| variable | unit | what it is |\n|---|---|---|"
    };
    out.push_str(&format!("\n## {title}\n\n{head}\n"));
    for row in rows.iter().filter(|row| !is_represented_by_another(row)) {
        let name = row.name.replace("[1]", "[i]");
        let cells = match has_start {
            true => format!("| `{name}` | {} | {} | {} |", without_unit(row, start(row)), range(row), unit(row)),
            false => format!("| `{name}` | {} |", unit(row)),
        };
        let room = TARGET_WIDTH.saturating_sub(cells.chars().count() + BETWEEN);
        out.push_str(&format!("{cells} {} |\n", shortened_description(row, room)));
    }
}

/// True if another variable with the same start value and unit represents this one in the table. The left side represents
/// the right side, and the first element of an array represents the others.
fn is_represented_by_another(row: &Variable) -> bool {
    let name = row.name.replace("right", "left");
    let twin: String = match name.split_once('[') {
        Some((array, rest)) => rest.split_once(']').map_or(name.clone(), |(_, end)| format!("{array}[1]{end}")),
        None => name,
    };
    let is_alike =
        |other: &Variable| start(other) == start(row) && other.unit.map(|of| of.name) == row.unit.map(|of| of.name);
    twin != row.name && table().rows.iter().any(|other| other.name == twin && is_alike(other))
}

/// Display unit with the unit of the interface in brackets, or only the unit of the interface.
fn unit(row: &Variable) -> String {
    let unit = row.unit.map_or("", |unit| if unit.name == "1" { "" } else { unit.name });
    row.display.map_or(unit.to_owned(), |shown| format!("{} ({unit})", shown.name))
}

/// Returns `text`, as `start` and `allowed` print it, without the display unit, which has a separate column.
fn without_unit(row: &Variable, text: String) -> String {
    match row.display {
        Some(shown) => text.replace(&format!(" {}", shown.name), ""),
        None => text,
    }
}

/// Smallest and largest value, or the names of the choices.
fn range(row: &Variable) -> String {
    match row.access.enumeration() {
        Some(kind) => kind.choices.iter().map(|choice| choice.name).collect::<Vec<_>>().join(", "),
        None => without_unit(row, allowed(row)).replace(" to ", " … "),
    }
}

/// Description of a variable. If it has more than `longest` characters, it is cut before an explanation (a colon, a
/// semicolon or a bracket), or else before the first comma. The shortest such beginning may still be too long.
fn shortened_description(row: &Variable, longest: usize) -> String {
    let tunable = if row.variability == Variability::Tunable { " (tunable)" } else { "" };
    let words = row.description;
    let fits = |text: &str| text.chars().count() + tunable.len() <= longest;
    // the longest beginning that fits, else the shortest one, else the text before the first comma
    let explained = || [": ", "; ", " ("].iter().flat_map(|mark| words.match_indices(mark)).map(|(end, _)| end);
    let longest_fit = explained().filter(|&end| fits(&words[..end])).max();
    let end = longest_fit.or_else(|| explained().min()).or_else(|| words.find(", "));
    let short = end.map_or(words, |end| &words[..end]);
    format!("{}{tunable}", if fits(words) { words } else { short })
}
