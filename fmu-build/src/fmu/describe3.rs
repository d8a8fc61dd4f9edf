//! modelDescription.xml of FMI 3.0, from the same table of variables.

use anyhow::{Context, Result};
use bevel_differential::fmi3::variables::{Added, HAPPENINGS, Item, added, held, planet_count};
use bevel_differential::instance::OUTPUT_ORDER;
use bevel_differential::model::{Inputs, Parameters};
use bevel_differential::variables::{
    Access, Causality, MODEL_NAME, OutputSource, Table, Variable, guid, real_start, table, units, value_of,
};

use super::dependencies::{initial_unknowns, of_derivative, of_output};
use super::describe::{
    DIFFERENCE, causality, default_experiment, enumeration_items, enumerations, is_relative, log_categories, number,
    root, unit, units_in_use, variability,
};
use answers::text::xml::Element;

/// Name of the enumeration of events.
const EVENT: &str = "Event";

/// Returns the model description as XML.
pub fn model_description() -> Result<String> {
    let table = table();
    let kinds = enumerations(table)
        .map(|kind| Element::new("EnumerationType").with("name", kind.name).children(enumeration_items(kind)));
    let events = HAPPENINGS.iter().map(|(name, text, what)| {
        Element::new("Item")
            .with("name", *name)
            .with("value", *what as u8)
            .with("description", text.to_string_lossy().into_owned())
    });
    let rows = table.rows.iter().enumerate().map(|(reference, row)| variable(reference, row));
    let own = added().iter().enumerate().map(|(k, added)| added_variable(table.rows.len() + k, added));
    root("3.0", "instantiationToken", guid())
        .child(interface("ModelExchange").with("needsCompletedIntegratorStep", true))
        .child(
            interface("CoSimulation")
                .with("canHandleVariableCommunicationStepSize", true)
                .with("maxOutputDerivativeOrder", OUTPUT_ORDER)
                .with("providesIntermediateUpdate", true)
                .with("mightReturnEarlyFromDoStep", true)
                .with("canReturnEarlyAfterIntermediateUpdate", true)
                .with("hasEventMode", true),
        )
        .child(Element::new("UnitDefinitions").children(units_in_use(table).map(unit)))
        .child(
            Element::new("TypeDefinitions")
                .child(
                    Element::new("Float64Type")
                        .with("name", DIFFERENCE)
                        .with("unit", units::KELVIN_DIFFERENCE.name)
                        .with("relativeQuantity", true),
                )
                .children(kinds)
                .child(Element::new("EnumerationType").with("name", EVENT).children(events)),
        )
        .child(log_categories())
        .child(default_experiment())
        .child(Element::new("ModelVariables").children(rows).children(own))
        .child(structure(table))
        .document()
        .context("the model description of FMI 3.0 cannot be written")
}

/// Creates the element for co-simulation or model exchange, with the attributes of both.
fn interface(name: &'static str) -> Element {
    Element::new(name)
        .with("modelIdentifier", MODEL_NAME)
        .with("canGetAndSetFMUState", true)
        .with("canSerializeFMUState", true)
        .with("providesDirectionalDerivatives", true)
        .with("providesAdjointDerivatives", true)
        .with("providesEvaluateDiscreteStates", true)
}

fn named(kind: &'static str, reference: usize, name: &str, description: &str) -> Element {
    Element::new(kind).with("name", name).with("valueReference", reference).with("description", description)
}

/// Declares a variable of the table.
fn variable(reference: usize, row: &Variable) -> Element {
    let is_structural = reference == planet_count() as usize;
    let kind = match row.access {
        Access::Enumeration(..) | Access::Output(OutputSource::Choice(..)) => "Enumeration",
        Access::Real(_) | Access::Input(_) | Access::Output(_) => "Float64",
        Access::Integer(_) if is_structural => "UInt64",
        Access::Integer(_) => "Int32",
        Access::Boolean(_) => "Boolean",
    };
    let calculated = matches!(row.causality, Causality::CalculatedParameter | Causality::Output | Causality::Local);
    let element = named(kind, reference, row.name, row.description)
        .with("causality", if is_structural { "structuralParameter" } else { causality(row) })
        .with("variability", if held(reference).is_some() { "discrete" } else { variability(row) })
        .with_some("initial", calculated.then_some("calculated"));
    let mut defaults = Parameters::default();
    match row.access {
        Access::Enumeration(kind, ..) | Access::Output(OutputSource::Choice(kind, _)) => {
            let start = value_of(row, &defaults, &Inputs::ZERO);
            element.with("declaredType", kind.name).with_some("start", start)
        }
        Access::Real(_) | Access::Input(_) | Access::Output(_) => element
            .with_some("unit", row.unit.map(|unit| unit.name))
            .with_some("displayUnit", row.display.map(|shown| shown.name))
            .with_some("declaredType", is_relative(row).then_some(DIFFERENCE))
            .with_some("relativeQuantity", is_relative(row).then_some(true))
            .with_some("min", row.range.map(|range| number(range.min)))
            .with_some("max", row.range.map(|range| number(range.max)))
            .with_some("nominal", row.nominal.map(number))
            .with_some("reinit", table().is_velocity(reference as u32).then_some(true))
            .with_some("derivative", row.derivative_of)
            .with_some("start", real_start(row).map(number)),
        Access::Integer(access) => element
            .with_some("min", row.range.map(|range| range.min))
            .with_some("max", row.range.map(|range| range.max))
            .with("start", *access(&mut defaults)),
        Access::Boolean(access) => element.with("start", *access(&mut defaults)),
    }
}

/// Declares a variable that exists only in FMI 3.0.
fn added_variable(reference: usize, added: &Added) -> Element {
    let of = |kind| named(kind, reference, added.name, added.description);
    let event =
        |kind| of(kind).with("causality", "output").with("variability", "discrete").with("initial", "calculated");
    let array = |members: &[usize], dimension: Element| {
        let row = &table().rows[members[0]];
        of("Float64")
            .with("causality", "output")
            .with("variability", variability(row))
            .with("initial", "calculated")
            .with_some("unit", row.unit.map(|unit| unit.name))
            .with_some("displayUnit", row.display.map(|shown| shown.name))
            .with_some("declaredType", is_relative(row).then_some(DIFFERENCE))
            .with_some("relativeQuantity", is_relative(row).then_some(true))
            .child(dimension)
    };
    match &added.item {
        Item::Time => of("Float64")
            .with("causality", "independent")
            .with("variability", "continuous")
            .with("unit", units::SECOND.name),
        Item::EventKind => event("Enumeration").with("declaredType", EVENT),
        Item::EventBody | Item::EventCount => event("Int32"),
        Item::EventTime => event("Float64").with("unit", units::SECOND.name),
        Item::EventText => event("String"),
        Item::Planets(members) => array(members, Element::new("Dimension").with("valueReference", planet_count())),
        Item::Pairs(members) => array(members, Element::new("Dimension").with("start", members.len())),
        Item::Indicator(_) | Item::Row(_) => {
            of("Float64").with("causality", "local").with("variability", "continuous").with("initial", "calculated")
        }
    }
}

/// Model structure: outputs and state derivatives with their direct dependencies, initial unknowns, and event
/// indicators.
fn structure(table: &Table) -> Element {
    let list = |known: &[usize]| known.iter().map(usize::to_string).collect::<Vec<_>>().join(" ");
    let unknown = |name, reference: usize, mut known: Vec<usize>| {
        known.sort_unstable();
        known.dedup();
        Element::new(name).with("valueReference", reference).with("dependencies", list(&known))
    };
    let own = || added().iter().enumerate().map(|(k, added)| (table.rows.len() + k, &added.item));
    let outputs = table.outputs.iter().map(|&index| unknown("Output", index, of_output(table, index)));
    let own_outputs = own().filter_map(|(reference, item)| match item {
        Item::Planets(members) | Item::Pairs(members) => {
            Some(unknown("Output", reference, members.iter().flat_map(|&index| of_output(table, index)).collect()))
        }
        Item::EventKind | Item::EventBody | Item::EventTime | Item::EventText | Item::EventCount => {
            Some(unknown("Output", reference, Vec::new()))
        }
        _ => None,
    });
    let derivatives = table.derivatives.iter().enumerate();
    let derivatives =
        derivatives.map(|(k, &index)| unknown("ContinuousStateDerivative", index, of_derivative(table, k)));
    let mut initial = initial_unknowns(table);
    initial.extend(own().filter(|(_, item)| !matches!(item, Item::Time | Item::Indicator(_))).map(|(at, _)| at));
    let initial = initial.into_iter().map(|index| Element::new("InitialUnknown").with("valueReference", index));
    let indicators = own()
        .filter(|(_, item)| matches!(item, Item::Indicator(_)))
        .map(|(reference, _)| Element::new("EventIndicator").with("valueReference", reference));
    Element::new("ModelStructure")
        .children(outputs)
        .children(own_outputs)
        .children(derivatives)
        .children(initial)
        .children(indicators)
}
