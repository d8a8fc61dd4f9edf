//! docs/variables.md: every variable of the FMU by group, with start value, range, unit and one sentence.

use bevel_differential::variables::{Access, Causality, Variability, Variable, table};

use crate::fmu::documentation::{allowed, parameter_groups, start};

/// Maximum number of letters of a line.
const WIDEST: usize = 160;
/// Letters around a cell.
const BETWEEN: usize = 3;
/// Groups that come first; the groups of the effects follow.
const FIRST: [&str; 8] = ["geometry", "material", "inertia", "scene", "contact", "solid", "solver", "effects"];

/// The groups with their tables, in Markdown.
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

/// Appends a heading and the table of `rows`. A sentence fills the line that the other cells of its row leave.
fn push_group(out: &mut String, title: &str, rows: &[&Variable]) {
    let has_start = rows.iter().any(|row| !matches!(row.access, Access::Output(_)));
    let head = if has_start {
        "| variable | start | range | unit | what it is |\n|---|---|---|---|---|"
    } else {
        "| variable | unit | what it is |\n|---|---|---|"
    };
    out.push_str(&format!("\n## {title}\n\n{head}\n"));
    for row in rows.iter().filter(|row| !has_twin(row)) {
        let name = row.name.replace("[1]", "[i]");
        let cells = match has_start {
            true => format!("| `{name}` | {} | {} | {} |", without_unit(row, start(row)), range(row), unit(row)),
            false => format!("| `{name}` | {} |", unit(row)),
        };
        let room = WIDEST.saturating_sub(cells.chars().count() + BETWEEN);
        out.push_str(&format!("{cells} {} |\n", sentence(row, room)));
    }
}

/// True if another variable represents this one: the right side by the left side, elements of arrays by the first one.
fn has_twin(row: &Variable) -> bool {
    let name = row.name.replace("right", "left");
    let twin: String = match name.split_once('[') {
        Some((array, rest)) => rest.split_once(']').map_or(name.clone(), |(_, end)| format!("{array}[1]{end}")),
        None => name,
    };
    let is_alike =
        |other: &Variable| start(other) == start(row) && other.unit.map(|of| of.name) == row.unit.map(|of| of.name);
    twin != row.name && table().rows.iter().any(|other| other.name == twin && is_alike(other))
}

/// The unit that people use, and in brackets that of the interface if it is another.
fn unit(row: &Variable) -> String {
    let unit = row.unit.map_or("", |unit| if unit.name == "1" { "" } else { unit.name });
    row.display.map_or(unit.to_owned(), |shown| format!("{} ({unit})", shown.name))
}

/// A number as `start` and `allowed` print it, without its unit, which has a column.
fn without_unit(row: &Variable, text: String) -> String {
    row.display.map_or(text.clone(), |shown| text.replace(&format!(" {}", shown.name), ""))
}

/// Smallest and largest value, or the choices.
fn range(row: &Variable) -> String {
    match row.access {
        Access::Enumeration(kind, ..) => kind.choices.iter().map(|choice| choice.name).collect::<Vec<_>>().join(", "),
        _ => without_unit(row, allowed(row)).replace(" to ", " … "),
    }
}

/// The description; up to its explanation, if it is longer than `longest` letters.
fn sentence(row: &Variable, longest: usize) -> String {
    let tunable = if row.variability == Variability::Tunable { " (tunable)" } else { "" };
    let words = row.description;
    let fits = |text: &str| text.chars().count() + tunable.len() <= longest;
    // the longest beginning that ends before an explanation, else what is before the first comma
    let explained = || [": ", "; ", " ("].iter().flat_map(|mark| words.match_indices(mark)).map(|(end, _)| end);
    let longest_fit = explained().filter(|&end| fits(&words[..end])).max();
    let end = longest_fit.or_else(|| explained().min()).or_else(|| words.find(", "));
    let short = end.map_or(words, |end| &words[..end]);
    format!("{}{tunable}", if fits(words) { words } else { short })
}
