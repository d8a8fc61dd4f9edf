//! modelDescription.xml of FMI 2.0, all of it from the one table of variables.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result};
use bevel_differential::fmi2::Category;
use bevel_differential::model::Parameters;
use bevel_differential::variables::units::{self, DisplayUnit, Unit};
use bevel_differential::variables::{
    Access, Causality, EnumType, MODEL_NAME, OutputSource, Table, Variability, Variable, guid, real_start, table,
};

use crate::xml::Element;

/// Fixed, so that the same sources give the same bytes.
const GENERATION_TIME: &str = "2026-01-01T00:00:00Z";
/// The study's duration and output interval [s].
const STOP_TIME: f64 = 0.5;
const STEP_SIZE: f64 = 0.001;

/// The model description as a text.
pub fn model_description() -> Result<String> {
    let table = table();
    let root = Element::new("fmiModelDescription")
        .with("fmiVersion", "2.0")
        .with("modelName", MODEL_NAME)
        .with("guid", guid())
        .with("description", "Dynamics of a bevel gear differential with tooth contact, pair by pair")
        .with("author", "The bevel-differential project")
        .with("version", env!("CARGO_PKG_VERSION"))
        .with("copyright", "The BevelDifferential authors")
        .with("license", "MIT OR Apache-2.0")
        .with("generationTool", concat!("fmu-build ", env!("CARGO_PKG_VERSION")))
        .with("generationDateAndTime", GENERATION_TIME)
        .with("variableNamingConvention", "structured")
        .with("numberOfEventIndicators", 0)
        .child(co_simulation())
        .child(Element::new("UnitDefinitions").children(units_in_use(table).map(unit)))
        .child(Element::new("TypeDefinitions").children(enumerations(table).map(enumeration)))
        .child(Element::new("LogCategories").children(Category::ALL.map(|(category, description)| {
            Element::new("Category").with("name", category.name().to_string_lossy()).with("description", description)
        })))
        .child(
            Element::new("DefaultExperiment")
                .with("startTime", number(0.0))
                .with("stopTime", number(STOP_TIME))
                .with("stepSize", number(STEP_SIZE)),
        )
        .child(Element::new("ModelVariables").children(table.rows.iter().enumerate().map(scalar_variable)))
        .child(structure(table));
    root.document().context("the model description cannot be written")
}

/// Whether `file` holds something else than the present model description.
pub fn is_stale(file: &Path) -> Result<bool> {
    Ok(fs::read_to_string(file).ok() != Some(model_description()?))
}

/// Writes the model description to `file`.
pub fn write(file: &Path) -> Result<()> {
    if let Some(folder) = file.parent() {
        fs::create_dir_all(folder)?;
    }
    fs::write(file, model_description()?).with_context(|| format!("{} cannot be written", file.display()))
}

fn co_simulation() -> Element {
    Element::new("CoSimulation")
        .with("modelIdentifier", MODEL_NAME)
        .with("needsExecutionTool", false)
        .with("canHandleVariableCommunicationStepSize", true)
        .with("canInterpolateInputs", false)
        .with("maxOutputDerivativeOrder", 0)
        .with("canRunAsynchronuously", false)
        .with("canBeInstantiatedOnlyOncePerProcess", false)
        .with("canNotUseMemoryManagementFunctions", true)
        .with("canGetAndSetFMUstate", true)
        .with("canSerializeFMUstate", true)
        .with("providesDirectionalDerivative", false)
}

fn units_in_use(table: &'static Table) -> impl Iterator<Item = &'static Unit> {
    let used = |unit: &Unit| table.rows.iter().any(|row| row.unit.is_some_and(|u| u.name == unit.name));
    units::ALL.iter().filter(move |unit| used(unit))
}

fn unit(unit: &Unit) -> Element {
    let base = unit.base.map(|base| {
        let exponents = [("kg", base.kg), ("m", base.m), ("s", base.s), ("rad", base.rad)];
        let given = exponents.into_iter().filter(|(_, exponent)| *exponent != 0);
        given.fold(Element::new("BaseUnit"), |element, (name, exponent)| element.with(name, exponent))
    });
    let display =
        |shown: &DisplayUnit| Element::new("DisplayUnit").with("name", shown.name).with("factor", number(shown.factor));
    Element::new("Unit").with("name", unit.name).children(base).children(unit.display.iter().map(display))
}

fn enumeration_of(row: &Variable) -> Option<&'static EnumType> {
    match row.access {
        Access::Enumeration(kind, ..) => Some(kind),
        _ => None,
    }
}

/// Enumeration types in the order of their first use.
fn enumerations(table: &'static Table) -> impl Iterator<Item = &'static EnumType> {
    let mut seen: Vec<&EnumType> = Vec::new();
    for kind in table.rows.iter().filter_map(enumeration_of) {
        if !seen.iter().any(|k| k.name == kind.name) {
            seen.push(kind);
        }
    }
    seen.into_iter()
}

fn enumeration(kind: &EnumType) -> Element {
    let items = kind.choices.iter().map(|choice| {
        Element::new("Item")
            .with("name", choice.name)
            .with("value", choice.value)
            .with("description", choice.description)
    });
    Element::new("SimpleType").with("name", kind.name).child(Element::new("Enumeration").children(items))
}

fn scalar_variable((reference, row): (usize, &Variable)) -> Element {
    let causality = match row.causality {
        Causality::Parameter => "parameter",
        Causality::Input => "input",
        Causality::Output => "output",
    };
    let variability = match row.variability {
        Variability::Fixed => "fixed",
        Variability::Tunable => "tunable",
        Variability::Continuous => "continuous",
    };
    let initial = match row.causality {
        Causality::Parameter => Some("exact"),
        Causality::Input => None,
        Causality::Output => Some("calculated"),
    };
    Element::new("ScalarVariable")
        .with("name", row.name)
        .with("valueReference", reference)
        .with("description", row.description)
        .with("causality", causality)
        .with("variability", variability)
        .with_some("initial", initial)
        .child(variable_type(row))
}

fn variable_type(row: &Variable) -> Element {
    let mut defaults = Parameters::default();
    match row.access {
        Access::Real(_) | Access::Input(_) | Access::Output(_) => Element::new("Real")
            .with_some("unit", row.unit.map(|unit| unit.name))
            .with_some("displayUnit", row.display.map(|shown| shown.name))
            .with_some("min", row.range.map(|range| number(range.min)))
            .with_some("max", row.range.map(|range| number(range.max)))
            .with_some("start", real_start(row).map(number)),
        Access::Integer(access) => Element::new("Integer")
            .with_some("min", row.range.map(|range| range.min))
            .with_some("max", row.range.map(|range| range.max))
            .with("start", *access(&mut defaults)),
        Access::Boolean(access) => Element::new("Boolean").with("start", *access(&mut defaults)),
        Access::Enumeration(kind, value, _) => {
            Element::new("Enumeration").with("declaredType", kind.name).with("start", value(&defaults))
        }
    }
}

/// Outputs with what they depend on within a communication point, and what has to be computed at the start.
fn structure(table: &Table) -> Element {
    let outputs = table.outputs.iter().map(|&index| {
        let known = dependencies(table, index).iter().map(|i| (i + 1).to_string()).collect::<Vec<_>>();
        Element::new("Unknown").with("index", index + 1).with("dependencies", known.join(" "))
    });
    // at the start everything may depend on everything, which is what no list means
    let initial = table.outputs.iter().map(|&index| Element::new("Unknown").with("index", index + 1));
    Element::new("ModelStructure")
        .child(Element::new("Outputs").children(outputs))
        .child(Element::new("InitialUnknowns").children(initial))
}

/// Parts of names of forces' companions that follow from positions and speeds alone.
const BY_MOTION: [&str; 3] = ["transmission_error", "power.loss", "stress."];
/// Ending of names of what depends on the load of its own side alone.
const BY_OWN_LOAD: &str = ".twist";

/// Inputs that output `index` depends on without a step in between, over all scenes; tests/python checks it.
///
/// Torques act at once on accelerations and, without teeth, on all forces. Imposed speeds act through the step only,
/// and so does everything on angles, speeds and the books.
pub fn dependencies(table: &Table, index: usize) -> Vec<usize> {
    let row = &table.rows[index];
    let of_forces = matches!(row.access, Access::Output(OutputSource::Forces(_)));
    if !of_forces || BY_MOTION.iter().any(|part| row.name.contains(part)) {
        return Vec::new();
    }
    let own_side = row.name.strip_suffix(BY_OWN_LOAD);
    let is_torque = |i: &usize| {
        let input = &table.rows[*i];
        input.unit == Some(units::NEWTON_METRE) && own_side.is_none_or(|side| input.name.starts_with(side))
    };
    table.inputs.iter().copied().filter(is_torque).collect()
}

/// A number such that reading it gives the same bits again.
fn number(value: f64) -> String {
    format!("{value:?}")
}
