//! documentation/index.html of the FMU: an introduction, and its variables from the table.

use anyhow::{Context, Result};
use bevel_differential::model::Parameters;
use bevel_differential::variables::{Access, Causality, MODEL_NAME, Variability, Variable, real_start, table};

use crate::fmu::libraries::Library;
use crate::fmu::licences::LinkedPart;
use answers::text::numbers::short;
use answers::text::xml::Element;

/// Significant digits of start values.
const START_DIGITS: u32 = 6;
/// Significant digits of limits.
const LIMIT_DIGITS: u32 = 4;
const STYLE: &str = "body{font:15px/1.5 sans-serif;max-width:70em;margin:2em auto;padding:0 1em}\
                     table{border-collapse:collapse;width:100%;font-size:14px}\
                     td,th{border-bottom:1px solid #ddd;padding:.25em .6em;text-align:left;vertical-align:top}\
                     td:first-child{font-family:monospace;white-space:nowrap}\
                     figure{margin:1.5em 0}img{max-width:100%}figcaption{font-size:14px}";
const INTRODUCTION: &str = "Dynamics of a bevel gear differential as an FMU for co-simulation and model exchange: carrier, two \
     to four planets and two side gears with straight spherical-involute teeth, in contact pair by pair along the exact path \
     of contact, with backlash and tip-corner contact.";
const LIVE: &str = "The differential live in a browser: scenes, parameters and effects, with the gears in motion.";
const TESTS: &str = "Scenes with expected results in the FMU, and how to test with them.";
const USE: [&str; 5] = [
    "Import the FMU into any host of its FMI version, 2.0 or 3.0, on one of the platforms below.",
    "Without any setting it simulates a passenger car's differential driving straight ahead at 60 km/h with 835 N.m on each \
     half-shaft.",
    "For a turn, set scene.planet_spin to imposed (2) and spin.command to the spin of the planets.",
    "Parameters of the group effects switch effects on and off; the group with the name of an effect contains its parameters.",
    "Read the host's log: each warning and error names the variable, its value and the allowed values.",
];
const UNITS: [&str; 3] = [
    "Values are in SI units. The tables give the unit of the interface and, in brackets, the unit that hosts show. Start \
     values and limits are rounded, and in the unit that hosts show.",
    "Speeds and angles are positive forwards. Load torques are positive if they resist positive rotation. The half-shaft \
     delivers shaft_torque to the wheel, and the drive delivers carrier.torque to the carrier; both are positive when \
     driving forwards. A positive planet spin speeds the left side up.",
    "Normal forces are magnitudes; the sign of the transmission error shows which flank is loaded. Outputs of planets that a \
     scene does not have and of effects that are off are 0.",
];
const LIMITATIONS: [&str; 4] = [
    "The shaft angle is 90 degrees. The end of initialisation checks each parameter and their combinations, and reports \
     each error with the name of its variable.",
    "In co-simulation, inputs are constant over a communication step, unless solver.input_ramp is on or the host sets \
     their first or second derivatives (only in FMI 2.0: fmi2SetRealInputDerivatives).",
    "Published laws of friction and strength are also used beyond the ranges in which they were measured, without a warning.",
    "A step that cannot be completed returns fmi2Discard or fmi3Discard. The log and, in FMI 2.0, \
     fmi2LastSuccessfulTime give the time that was reached. Restore a state or reset the instance to continue.",
];

/// A picture of the page.
pub struct Figure {
    /// File of the picture, as parts of its path in the workspace.
    pub file: [&'static str; 3],
    caption: &'static str,
}

impl Figure {
    /// Name of the file next to the page.
    pub fn name(&self) -> &'static str {
        self.file[2]
    }
}

/// Pictures: the study's two cases, simulated with this program.
pub const FIGURES: [Figure; 3] = [
    Figure {
        file: ["docs", "figures", "speeds.png"],
        caption: "Speeds of both half-shafts over time, straight ahead (start values) and in the turn.",
    },
    Figure {
        file: ["docs", "figures", "tooth_forces.png"],
        caption: "Tooth forces in the same cases: straight ahead, the first touch of the teeth, and the turn.",
    },
    Figure { file: ["docs", "figures", "ripple.png"], caption: "Ripple in the turn, from pair to pair of teeth." },
];

/// Optional files of an archive next to the page.
pub struct Beside {
    /// Page with the differential in motion.
    pub live: Option<&'static str>,
    /// Page that explains how to test with the scenes and expected results in the FMU.
    pub tests: Option<&'static str>,
}

/// Page of an archive with `libraries`, into which the parts in `linked` are linked.
pub fn page(libraries: &[Library], linked: &[LinkedPart], beside: &Beside) -> Result<String> {
    let mut body = Element::new("body")
        .child(Element::new("h1").text(MODEL_NAME))
        .child(Element::new("p").text(concat!(
            "Version ",
            env!("CARGO_PKG_VERSION"),
            ", co-simulation and model exchange with FMI 2.0 and FMI 3.0."
        )))
        .child(paragraph(INTRODUCTION))
        .children(beside.live.map(|file| link(file, LIVE)))
        .child(title("Use"))
        .child(Element::new("ol").children(USE.map(|step| Element::new("li").text(step))))
        .child(table_of(&["Platform", "Needs"], libraries.iter().map(platform)))
        .child(title("Results"))
        .children(FIGURES.iter().map(figure))
        .children(beside.tests.map(|file| link(file, TESTS)))
        .child(title("Units and signs"))
        .children(UNITS.map(paragraph))
        .child(title("Limitations"))
        .children(LIMITATIONS.map(paragraph))
        .child(title("Parameters"));
    for (name, rows) in parameter_groups() {
        body = body.child(Element::new("h3").text(name)).child(variables(Causality::Parameter, rows));
    }
    let others = [
        (Causality::CalculatedParameter, "Calculated parameters"),
        (Causality::Input, "Inputs"),
        (Causality::Output, "Outputs"),
    ];
    for (causality, name) in others {
        body = body.child(title(name)).child(variables(causality, of(causality).collect()));
    }
    body = body
        .child(title("Licences"))
        .child(paragraph("Parts that are linked into the libraries, with the texts of their licences:"))
        .child(table_of(&["Part", "Licence", "Texts"], linked.iter().map(licences)));
    let head = Element::new("head")
        .child(Element::new("meta").with("charset", "utf-8"))
        .child(Element::new("title").text(MODEL_NAME))
        .child(Element::new("style").text(STYLE));
    let html = Element::new("html").with("lang", "en").child(head).child(body);
    html.page().context("the documentation cannot be written")
}

/// Variables of a causality, in the order of the table.
fn of(causality: Causality) -> impl Iterator<Item = &'static Variable> {
    table().rows.iter().filter(move |row| row.causality == causality)
}

/// Parameters, grouped by the first part of their names.
pub(super) fn parameter_groups() -> Vec<(&'static str, Vec<&'static Variable>)> {
    let mut groups: Vec<(&str, Vec<&Variable>)> = Vec::new();
    for row in of(Causality::Parameter) {
        let name = row.name.split('.').next().unwrap_or(row.name);
        match groups.iter_mut().find(|(known, _)| *known == name) {
            Some((_, rows)) => rows.push(row),
            None => groups.push((name, vec![row])),
        }
    }
    groups
}

fn variables(causality: Causality, rows: Vec<&Variable>) -> Element {
    let titles: &[&str] = match has_start(causality) {
        true => &["Name", "Unit", "Start", "Allowed", "Meaning"],
        false => &["Name", "Unit", "Meaning"],
    };
    table_of(titles, rows.into_iter().map(row))
}

fn title(text: &str) -> Element {
    Element::new("h2").text(text)
}

fn paragraph(text: &str) -> Element {
    Element::new("p").text(text)
}

fn link(file: &str, text: &str) -> Element {
    Element::new("p").child(Element::new("a").with("href", file).text(text))
}

fn figure(figure: &Figure) -> Element {
    Element::new("figure")
        .child(Element::new("img").with("src", figure.name()).with("alt", figure.caption))
        .child(Element::new("figcaption").text(figure.caption))
}

/// Row of a table with a cell for each text. `kind` is th in the header and td below it.
fn row_of(kind: &'static str, cells: impl IntoIterator<Item = impl AsRef<str>>) -> Element {
    Element::new("tr").children(cells.into_iter().map(|cell| Element::new(kind).text(cell.as_ref())))
}

fn table_of(titles: &[&str], rows: impl Iterator<Item = Element>) -> Element {
    Element::new("table").child(row_of("th", titles)).children(rows)
}

fn platform(library: &Library) -> Element {
    row_of("td", [library.platform, &library.needs])
}

fn licences(linked: &LinkedPart) -> Element {
    let links = linked.files.iter().map(|file| {
        let link = Element::new("a").with("href", format!("licenses/{file}"));
        Element::new("div").child(link.text(file.rsplit('/').next().unwrap_or(file)))
    });
    row_of("td", [&linked.name, &linked.licence]).child(Element::new("td").children(links))
}

/// True if variables of a causality have start values and ranges.
fn has_start(causality: Causality) -> bool {
    matches!(causality, Causality::Parameter | Causality::Input)
}

fn row(row: &Variable) -> Element {
    let mut cells = vec![row.name.to_owned(), unit(row)];
    if has_start(row.causality) {
        cells.extend([start(row), allowed(row)]);
    }
    let mut meaning = row.description.to_owned();
    if row.variability == Variability::Tunable {
        meaning.push_str(" (tunable)");
    }
    if let Some(kind) = row.access.enumeration() {
        for choice in kind.choices {
            meaning.push_str(&format!("; {} = {}: {}", choice.value, choice.name, choice.description));
        }
    }
    cells.push(meaning);
    row_of("td", cells)
}

/// Unit of a variable, with the unit that hosts show.
fn unit(row: &Variable) -> String {
    let unit = row.unit.map_or("", |unit| if unit.name == "1" { "" } else { unit.name });
    row.display.map_or(unit.to_owned(), |shown| format!("{unit} [{}]", shown.name))
}

/// A number in the unit that hosts show, rounded to `digits` significant digits.
fn shown(row: &Variable, value: f64, digits: u32) -> String {
    let Some(display) = row.display else { return short(value, digits) };
    format!("{} {}", short(display.show(value), digits), display.name)
}

/// Start value of a variable, as hosts show it.
pub fn start(row: &Variable) -> String {
    let mut defaults = Parameters::default();
    match row.access {
        Access::Real(_) | Access::Input(_) => {
            real_start(row).map_or(String::new(), |value| shown(row, value, START_DIGITS))
        }
        Access::Integer(access) => access(&mut defaults).to_string(),
        Access::Boolean(access) => access(&mut defaults).to_string(),
        Access::Enumeration(kind, value, _) => {
            let value = value(&defaults);
            kind.choices.iter().find(|choice| choice.value == value).map_or(String::new(), |c| c.name.to_owned())
        }
        Access::Output(_) => String::new(),
    }
}

/// Range of a variable, as hosts show it.
pub(super) fn allowed(row: &Variable) -> String {
    row.range
        .map_or(String::new(), |range| [range.min, range.max].map(|limit| shown(row, limit, LIMIT_DIGITS)).join(" to "))
}
