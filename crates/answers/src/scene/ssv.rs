//! The start values of a scene as a parameter set of SSP 1.0 (System Structure Parameter Values), for hosts that read them.

use anyhow::{Context, Result};
use bevel_differential::variables::units::{Base, Unit};
use bevel_differential::variables::{Access, EnumType};

use super::Scene;
use super::set::start_values;
use super::set::{Setting, SettingValue, literal};
use crate::text::xml::Element;

/// XML namespace of parameter sets.
const SSV: &str = "http://ssp-standard.org/SSP1/SystemStructureParameterValues";
/// XML namespace of units and enumerations.
const SSC: &str = "http://ssp-standard.org/SSP1/SystemStructureCommon";
/// Version of the standard.
const VERSION: &str = "1.0";

/// Text of the file.
pub fn text(scene: &Scene) -> Result<String> {
    let values = start_values(scene);
    let root = Element::new("ssv:ParameterSet")
        .with("xmlns:ssv", SSV)
        .with("xmlns:ssc", SSC)
        .with("version", VERSION)
        .with("name", &scene.name)
        .with("description", &scene.description)
        .with("generationTool", concat!("fmu-build ", env!("CARGO_PKG_VERSION")))
        .child(Element::new("ssv:Parameters").children(values.iter().map(parameter)))
        .children(list("ssv:Enumerations", enumerations(&values).into_iter().map(enumeration)))
        .children(list("ssv:Units", units(&values).into_iter().map(|(unit, base)| unit_definition(unit, base))));
    root.document().context("the parameter set cannot be written")
}

fn parameter(setting: &Setting) -> Element {
    let (row, unit) = (setting.row, declared_unit(setting));
    let value = match setting.value {
        // shortest digits that keep all bits
        SettingValue::Real(value) => Element::new("ssv:Real")
            .with("value", format!("{value:?}"))
            .with_some("unit", unit.map(|(unit, _)| unit.name)),
        SettingValue::Integer(value) => Element::new("ssv:Integer").with("value", value),
        SettingValue::Boolean(value) => Element::new("ssv:Boolean").with("value", value),
        SettingValue::Literal(value) => Element::new("ssv:Enumeration")
            .with_some("value", literal(row, value).map(|(name, _)| name))
            .with_some("name", enumeration_of(setting).map(|kind| kind.name)),
    };
    let description = match (row.unit, unit) {
        (Some(undeclared), None) => format!("{} [{}]", row.description, undeclared.name),
        _ => row.description.to_owned(),
    };
    Element::new("ssv:Parameter").with("name", row.name).with("description", description).child(value)
}

/// Unit of a value if SSP can define it: SSP needs whole exponents, which a few units lack.
fn declared_unit(setting: &Setting) -> Option<(Unit, Base)> {
    let unit = setting.row.unit?;
    Some((unit, unit.base?))
}

fn units(values: &[Setting]) -> Vec<(Unit, Base)> {
    let mut used: Vec<(Unit, Base)> = Vec::new();
    for (unit, base) in values.iter().filter_map(declared_unit) {
        if !used.iter().any(|(known, _)| known.name == unit.name) {
            used.push((unit, base));
        }
    }
    used
}

fn unit_definition(unit: Unit, base: Base) -> Element {
    let exponents = [("kg", base.kg), ("m", base.m), ("s", base.s), ("K", base.k), ("rad", base.rad)];
    let given = exponents.into_iter().filter(|(_, exponent)| *exponent != 0);
    let base = given.fold(Element::new("ssc:BaseUnit"), |element, (name, exponent)| element.with(name, exponent));
    Element::new("ssc:Unit").with("name", unit.name).child(base)
}

fn enumeration_of(setting: &Setting) -> Option<&'static EnumType> {
    match setting.row.access {
        Access::Enumeration(kind, ..) => Some(kind),
        _ => None,
    }
}

fn enumerations(values: &[Setting]) -> Vec<&'static EnumType> {
    let mut used: Vec<&EnumType> = Vec::new();
    for kind in values.iter().filter_map(enumeration_of) {
        if !used.iter().any(|known| known.name == kind.name) {
            used.push(kind);
        }
    }
    used
}

fn enumeration(kind: &EnumType) -> Element {
    let items = kind.choices.iter();
    let items = items.map(|choice| Element::new("ssc:Item").with("name", choice.name).with("value", choice.value));
    Element::new("ssc:Enumeration").with("name", kind.name).children(items)
}

/// Creates a list, or none if it would be empty, which the schema forbids.
fn list(name: &'static str, items: impl Iterator<Item = Element>) -> Option<Element> {
    let mut items = items.peekable();
    items.peek().is_some().then(|| Element::new(name).children(items))
}
