//! documentation/index.html of the FMU: what it is, and its variables, from the table.

use anyhow::{Context, Result};
use bevel_differential::model::Parameters;
use bevel_differential::variables::{Access, Causality, MODEL_NAME, Variability, Variable, real_start, table};

use crate::xml::Element;

const STYLE: &str = "body{font:15px/1.5 sans-serif;max-width:70em;margin:2em auto;padding:0 1em}\
                     table{border-collapse:collapse;width:100%;font-size:14px}\
                     td,th{border-bottom:1px solid #ddd;padding:.25em .6em;text-align:left;vertical-align:top}\
                     td:first-child{font-family:monospace;white-space:nowrap}";
const INTRODUCTION: [&str; 4] = [
    "Dynamics of a bevel gear differential as a co-simulation FMU: carrier, two to four planets and two side gears \
     with straight spherical-involute teeth, in contact pair by pair along the exact path of contact, with backlash \
     and tip-corner contact.",
    "A host that sets nothing simulates a passenger car's differential driving straight ahead at 60 km/h with 835 \
     N.m on each half-shaft. For a turn, set scene.planet_spin to imposed (2) and planet.spin_command to the spin \
     of the planets.",
    "Values are SI; the units in brackets are what hosts show. Load torques are positive where they resist positive \
     rotation; a positive planet spin speeds the left side up.",
    "The FMU writes warnings and errors through the host's logger, each with the variable, its value and what would \
     be allowed.",
];

/// The page.
pub fn page() -> Result<String> {
    let groups = [(Causality::Parameter, "Parameters"), (Causality::Input, "Inputs"), (Causality::Output, "Outputs")];
    let mut body = Element::new("body")
        .child(Element::new("h1").text(MODEL_NAME))
        .child(Element::new("p").text(concat!("Version ", env!("CARGO_PKG_VERSION"), ", FMI 2.0 co-simulation.")))
        .children(INTRODUCTION.map(|text| Element::new("p").text(text)));
    for (causality, title) in groups {
        let rows = table().rows.iter().filter(|row| row.causality == causality);
        body = body
            .child(Element::new("h2").text(title))
            .child(Element::new("table").child(head(causality)).children(rows.map(row)));
    }
    let head = Element::new("head")
        .child(Element::new("meta").with("charset", "utf-8"))
        .child(Element::new("title").text(MODEL_NAME))
        .child(Element::new("style").text(STYLE));
    let html = Element::new("html").with("lang", "en").child(head).child(body);
    html.page().context("the documentation cannot be written")
}

fn head(causality: Causality) -> Element {
    let mut titles = vec!["Name", "Unit"];
    if causality != Causality::Output {
        titles.extend(["Start", "Allowed"]);
    }
    titles.push("Meaning");
    Element::new("tr").children(titles.into_iter().map(|title| Element::new("th").text(title)))
}

fn row(row: &Variable) -> Element {
    let mut cells = vec![row.name.to_owned(), unit(row)];
    if row.causality != Causality::Output {
        cells.extend([start(row), allowed(row)]);
    }
    let mut meaning = row.description.to_owned();
    if row.variability == Variability::Tunable {
        meaning.push_str(" (tunable)");
    }
    if let Access::Enumeration(kind, ..) = row.access {
        for choice in kind.choices {
            meaning.push_str(&format!("; {} = {}: {}", choice.value, choice.name, choice.description));
        }
    }
    cells.push(meaning);
    Element::new("tr").children(cells.into_iter().map(|cell| Element::new("td").text(cell)))
}

fn unit(row: &Variable) -> String {
    let unit = row.unit.map_or("", |unit| if unit.name == "1" { "" } else { unit.name });
    row.display.map_or(unit.to_owned(), |shown| format!("{unit} [{}]", shown.name))
}

/// A number in the unit people think in.
fn shown(row: &Variable, value: f64) -> String {
    let Some(display) = row.display else { return short(value) };
    format!("{} {}", short(value * display.factor), display.name)
}

/// A number without the digits that a change of unit leaves.
fn short(value: f64) -> String {
    let rounded = format!("{value:.9e}").parse().unwrap_or(value);
    if rounded == 0.0 || (1e-3..1e6).contains(&f64::abs(rounded)) {
        format!("{rounded}")
    } else {
        format!("{rounded:e}")
    }
}

fn start(row: &Variable) -> String {
    let mut defaults = Parameters::default();
    match row.access {
        Access::Real(_) | Access::Input(_) => real_start(row).map_or(String::new(), |value| shown(row, value)),
        Access::Integer(access) => access(&mut defaults).to_string(),
        Access::Boolean(access) => access(&mut defaults).to_string(),
        Access::Enumeration(kind, value, _) => {
            let value = value(&defaults);
            kind.choices.iter().find(|choice| choice.value == value).map_or(String::new(), |c| c.name.to_owned())
        }
        Access::Output(_) => String::new(),
    }
}

fn allowed(row: &Variable) -> String {
    row.range.map_or(String::new(), |range| format!("{} to {}", shown(row, range.min), shown(row, range.max)))
}
