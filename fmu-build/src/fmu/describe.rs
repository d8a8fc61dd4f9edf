//! modelDescription.xml of FMI 2.0, from the table of variables.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result, bail};
use bevel_differential::fmi2::{Category, EVENT_INDICATORS, OUTPUT_ORDER};
use bevel_differential::model::{Inputs, Parameters};
use bevel_differential::variables::units::{self, DisplayUnit, Unit};
use bevel_differential::variables::{
    Access, Causality, EnumType, MODEL_NAME, OutputSource, Table, Variability, Variable, guid, real_start, table,
    value_of,
};
use clap::Args;

use crate::fmu::dependencies::{initial_unknowns, of_derivative, of_output};
use crate::fmu::effect_list;
use crate::tools::files::write_whole;
use crate::tools::paths;
use answers::text::xml::Element;

/// Fixed time, so that the same sources give the same bytes.
const GENERATION_TIME: &str = "2026-01-01T00:00:00Z";
/// The study's duration and output interval [s].
const STOP_TIME: f64 = 0.5;
const STEP_SIZE: f64 = 0.001;
/// Name of the type of temperature differences.
pub(super) const DIFFERENCE: &str = "TemperatureDifference";
const DERIVATIVE: &str = "providesDirectionalDerivative";

/// Writes modelDescription/modelDescription.xml, and the lists of effects in README.md and docs/effects.md
#[derive(Args, Clone, Debug)]
pub struct DescribeCommand {
    /// Only check whether the files are up to date
    #[arg(long)]
    check: bool,
}

impl DescribeCommand {
    /// Writes or checks the files.
    pub fn run(&self) -> Result<()> {
        let file = paths::model_description();
        let files = format!("{} and the lists of effects in the documents", paths::shown(&file));
        if !self.check {
            write(&file)?;
            effect_list::write()?;
            println!("written: {files}");
        } else if let Some(stale) = stale_document(&file)? {
            bail!("{stale} is out of date; renew it: cargo run --release -- describe");
        } else {
            println!("up to date: {files}");
        }
        Ok(())
    }
}

/// Returns the first file that is out of date: the model description in `file`, or a document with a list of effects.
pub fn stale_document(file: &Path) -> Result<Option<String>> {
    if fs::read_to_string(file).ok() != Some(model_description(Choices::Enumerations)?) {
        return Ok(Some(paths::shown(file).to_string()));
    }
    Ok(effect_list::stale()?.map(str::to_owned))
}

/// Declaration of variables with named choices in the model description. Hosts set both kinds with fmi2SetInteger.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Choices {
    /// Enumerations.
    Enumerations,
    /// Integers, for hosts without enumerations. The description of a variable names its choices.
    Integers,
}

/// Returns the model description as XML. `choices` selects the declaration of named choices.
pub fn model_description(choices: Choices) -> Result<String> {
    let root = root("2.0", "guid", guid())
        .with("numberOfEventIndicators", EVENT_INDICATORS)
        .child(
            kind_element("ModelExchange", |kind| kind.with("completedIntegratorStepNotNeeded", false))
                .with(DERIVATIVE, true),
        )
        .child(kind_element("CoSimulation", |kind| co_simulation(kind, OUTPUT_ORDER)).with(DERIVATIVE, true));
    described(root, choices, Part::Whole)
}

/// Returns the model description of the sources in C, of which `files` are compiled. Features that real-time targets do
/// not need are left out.
pub fn model_description_of_sources<'a>(files: impl Iterator<Item = &'a str>) -> Result<String> {
    let files = files.map(|name| Element::new("File").with("name", name));
    let kind = kind_element("CoSimulation", |kind| co_simulation(kind, 0))
        .with(DERIVATIVE, false)
        .child(Element::new("SourceFiles").children(files));
    described(root("2.0", "guid", guid()).child(kind), Choices::Enumerations, Part::RealTime)
}

/// Extent of a description.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Part {
    /// The whole unit.
    Whole,
    /// Features for real-time targets.
    RealTime,
}

/// Adds the attributes that only co-simulation has.
fn co_simulation(kind: Element, output_order: i32) -> Element {
    kind.with("canHandleVariableCommunicationStepSize", true)
        .with("canInterpolateInputs", true)
        .with("maxOutputDerivativeOrder", output_order)
        .with("canRunAsynchronuously", false)
}

/// Completes the description after the elements for the kinds of simulation.
fn described(root: Element, choices: Choices, part: Part) -> Result<String> {
    let table = table();
    let variables = table.rows.iter().enumerate();
    let root = root
        .child(Element::new("UnitDefinitions").children(units_in_use(table).map(unit)))
        .children((choices == Choices::Enumerations).then(|| {
            Element::new("TypeDefinitions")
                .child(temperature_difference())
                .children(enumerations(table).map(enumeration))
        }))
        .child(log_categories())
        .child(default_experiment())
        .child(
            Element::new("ModelVariables").children(variables.map(|(i, row)| scalar_variable(i, row, (choices, part)))),
        )
        .child(structure(table));
    root.document().context("the model description cannot be written")
}

/// Creates the root of a model description of the FMI version `version`. The attribute `token` identifies the sources
/// of the FMU.
pub(super) fn root(version: &str, token: &'static str, guid: &str) -> Element {
    Element::new("fmiModelDescription")
        .with("fmiVersion", version)
        .with("modelName", MODEL_NAME)
        .with(token, guid)
        .with("description", "Dynamics of a bevel gear differential with tooth contact, pair by pair")
        .with("author", "The bevel-differential project")
        .with("version", env!("CARGO_PKG_VERSION"))
        .with("copyright", "The BevelDifferential authors")
        .with("license", "MIT OR Apache-2.0")
        .with("generationTool", concat!("fmu-build ", env!("CARGO_PKG_VERSION")))
        .with("generationDateAndTime", GENERATION_TIME)
        .with("variableNamingConvention", "structured")
}

/// Log categories.
pub(super) fn log_categories() -> Element {
    Element::new("LogCategories").children(Category::ALL.map(|(category, description)| {
        Element::new("Category").with("name", category.name().to_string_lossy()).with("description", description)
    }))
}

/// Default experiment: the study's duration and output interval.
pub(super) fn default_experiment() -> Element {
    Element::new("DefaultExperiment")
        .with("startTime", number(0.0))
        .with("stopTime", number(STOP_TIME))
        .with("stepSize", number(STEP_SIZE))
}

/// Writes the model description to `file`.
pub fn write(file: &Path) -> Result<()> {
    write_whole(file, model_description(Choices::Enumerations)?.as_bytes())
}

/// Creates the element for co-simulation or model exchange. `own` adds the attributes that only this kind has.
fn kind_element(name: &'static str, own: impl FnOnce(Element) -> Element) -> Element {
    own(Element::new(name).with("modelIdentifier", MODEL_NAME).with("needsExecutionTool", false))
        .with("canBeInstantiatedOnlyOncePerProcess", false)
        .with("canNotUseMemoryManagementFunctions", true)
        .with("canGetAndSetFMUstate", true)
        .with("canSerializeFMUstate", true)
}

pub(super) fn units_in_use(table: &'static Table) -> impl Iterator<Item = &'static Unit> {
    let used = |unit: &Unit| table.rows.iter().any(|row| row.unit.is_some_and(|u| u.name == unit.name));
    units::ALL.iter().filter(move |unit| used(unit))
}

pub(super) fn unit(unit: &Unit) -> Element {
    let base = unit.base.map(|base| {
        let exponents = [("kg", base.kg), ("m", base.m), ("s", base.s), ("K", base.k), ("rad", base.rad)];
        let given = exponents.into_iter().filter(|(_, exponent)| *exponent != 0);
        given.fold(Element::new("BaseUnit"), |element, (name, exponent)| element.with(name, exponent))
    });
    let display = |shown: &DisplayUnit| {
        let element = Element::new("DisplayUnit").with("name", shown.name).with("factor", number(shown.factor));
        if shown.offset == 0.0 { element } else { element.with("offset", number(shown.offset)) }
    };
    Element::new("Unit").with("name", unit.name).children(base).children(unit.display.iter().map(display))
}

/// Returns true for differences, which hosts convert without the offset of a display unit.
pub(super) fn is_relative(row: &Variable) -> bool {
    row.unit.is_some_and(|unit| unit.is_relative)
}

/// Type of temperature differences. fmpy reads `relativeQuantity` only from types, other hosts from variables.
fn temperature_difference() -> Element {
    let real = Element::new("Real").with("unit", units::KELVIN_DIFFERENCE.name).with("relativeQuantity", true);
    Element::new("SimpleType").with("name", DIFFERENCE).child(real)
}

/// Enumeration types in the order of their first use.
pub(super) fn enumerations(table: &'static Table) -> impl Iterator<Item = &'static EnumType> {
    let mut seen: Vec<&EnumType> = Vec::new();
    for kind in table.rows.iter().filter_map(|row| row.access.enumeration()) {
        if !seen.iter().any(|k| k.name == kind.name) {
            seen.push(kind);
        }
    }
    seen.into_iter()
}

fn enumeration(kind: &EnumType) -> Element {
    Element::new("SimpleType")
        .with("name", kind.name)
        .child(Element::new("Enumeration").children(enumeration_items(kind)))
}

/// Items of an enumeration.
pub(super) fn enumeration_items(kind: &EnumType) -> impl Iterator<Item = Element> {
    kind.choices.iter().map(|choice| {
        Element::new("Item")
            .with("name", choice.name)
            .with("value", choice.value)
            .with("description", choice.description)
    })
}

/// Causality in FMI's spelling.
pub(super) fn causality(row: &Variable) -> &'static str {
    match row.causality {
        Causality::Parameter => "parameter",
        Causality::CalculatedParameter => "calculatedParameter",
        Causality::Input => "input",
        Causality::Output => "output",
        Causality::Local => "local",
    }
}

/// Variability in FMI's spelling.
pub(super) fn variability(row: &Variable) -> &'static str {
    match row.variability {
        Variability::Fixed => "fixed",
        Variability::Tunable => "tunable",
        Variability::Continuous if row.access.enumeration().is_some() => "discrete",
        Variability::Continuous => "continuous",
    }
}

fn scalar_variable(reference: usize, row: &Variable, (choices, part): (Choices, Part)) -> Element {
    let initial = match row.causality {
        Causality::Parameter => Some("exact"),
        Causality::Input => None,
        Causality::CalculatedParameter | Causality::Output | Causality::Local => Some("calculated"),
    };
    Element::new("ScalarVariable")
        .with("name", row.name)
        .with("valueReference", reference)
        .with("description", description(row, choices))
        .with("causality", causality(row))
        .with("variability", variability(row))
        .with_some("initial", initial)
        .child(variable_type(row, part == Part::Whole && table().is_velocity(reference as u32), choices))
}

/// Description of a variable. If its choices are integers, the description names the choice of each number.
fn description(row: &Variable, choices: Choices) -> String {
    match row.access.enumeration() {
        Some(kind) if choices == Choices::Integers => {
            let named = kind.choices.iter().map(|choice| format!("{} = {}", choice.value, choice.name));
            format!("{}: {}", row.description, named.collect::<Vec<_>>().join(", "))
        }
        _ => row.description.to_owned(),
    }
}

fn variable_type(row: &Variable, is_reinit: bool, choices: Choices) -> Element {
    let mut defaults = Parameters::default();
    match row.access {
        Access::Enumeration(kind, ..) | Access::Output(OutputSource::Choice(kind, _)) => {
            let values = || kind.choices.iter().map(|choice| choice.value);
            let element = match choices {
                Choices::Integers => {
                    Element::new("Integer").with_some("min", values().min()).with_some("max", values().max())
                }
                Choices::Enumerations => Element::new("Enumeration").with("declaredType", kind.name),
            };
            element.with_some("start", value_of(row, &defaults, &Inputs::ZERO))
        }
        Access::Real(_) | Access::Input(_) | Access::Output(_) => Element::new("Real")
            .with_some("declaredType", (is_relative(row) && choices == Choices::Enumerations).then_some(DIFFERENCE))
            .with_some("unit", row.unit.map(|unit| unit.name))
            .with_some("displayUnit", row.display.map(|shown| shown.name))
            .with_some("relativeQuantity", is_relative(row).then_some(true))
            .with_some("min", row.range.map(|range| number(range.min)))
            .with_some("max", row.range.map(|range| number(range.max)))
            .with_some("nominal", row.nominal.map(number))
            .with_some("reinit", is_reinit.then_some(true))
            .with_some("derivative", row.derivative_of.map(|index| index + 1))
            .with_some("start", real_start(row).map(number)),
        Access::Integer(access) => Element::new("Integer")
            .with_some("min", row.range.map(|range| range.min))
            .with_some("max", row.range.map(|range| range.max))
            .with("start", *access(&mut defaults)),
        Access::Boolean(access) => Element::new("Boolean").with("start", *access(&mut defaults)),
    }
}

/// Model structure: outputs and state derivatives with their direct dependencies, and the initial unknowns.
fn structure(table: &Table) -> Element {
    let unknown = |index: usize, mut known: Vec<usize>| {
        known.sort_unstable();
        let known: Vec<String> = known.iter().map(|i| (i + 1).to_string()).collect();
        Element::new("Unknown").with("index", index + 1).with("dependencies", known.join(" "))
    };
    let outputs = table.outputs.iter().map(|&index| unknown(index, of_output(table, index)));
    let derivatives = table.derivatives.iter().enumerate().map(|(k, &index)| unknown(index, of_derivative(table, k)));
    let initial = initial_unknowns(table).into_iter().map(|index| Element::new("Unknown").with("index", index + 1));
    Element::new("ModelStructure")
        .child(Element::new("Outputs").children(outputs))
        .child(Element::new("Derivatives").children(derivatives))
        .child(Element::new("InitialUnknowns").children(initial))
}

/// Shortest decimal number that keeps all bits.
pub(super) fn number(value: f64) -> String {
    format!("{value:?}")
}
