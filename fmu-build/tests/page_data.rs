//! Data of the page: all variables of the table and all scenes.

use std::collections::BTreeMap;

use answers::scene;
use anyhow::Result;
use bevel_differential::variables::table;
use fmu_build::fmu::page::data::data;
use fmu_build::tools::paths;
use serde_json::Value;

fn page() -> Result<Value> {
    Ok(serde_json::to_value(data()?)?)
}

#[test]
fn every_variable_is_at_its_value_reference() -> Result<()> {
    let page = page()?;
    let variables = page["variables"].as_array().expect("a list");
    assert_eq!(variables.len(), table().rows.len());
    for (reference, (variable, row)) in variables.iter().zip(table().rows).enumerate() {
        assert_eq!(variable["name"], row.name);
        assert_eq!(variable["reference"], reference);
        assert_eq!(variable["min"].as_f64(), row.range.map(|range| range.min), "{}", row.name);
        let settable = matches!(variable["causality"].as_str(), Some("parameter" | "input"));
        assert_eq!(!variable["start"].is_null(), settable, "{}", row.name);
    }
    Ok(())
}

#[test]
fn every_scene_sets_variables_that_the_page_knows() -> Result<()> {
    let page = page()?;
    let kinds: BTreeMap<&str, &str> = page["variables"]
        .as_array()
        .expect("a list")
        .iter()
        .filter_map(|variable| Some((variable["name"].as_str()?, variable["kind"].as_str()?)))
        .collect();
    let scenes = page["scenes"].as_array().expect("a list");
    assert_eq!(scenes.len(), scene::files(&paths::scenes())?.len());
    for scene in scenes {
        for (name, value) in scene["set"].as_object().expect("values by name") {
            let fits = match kinds[name.as_str()] {
                "Boolean" => value.is_boolean(),
                "Real" => value.is_f64(),
                _ => value.is_i64(),
            };
            assert!(fits, "{}: {name} = {value}", scene["name"]);
        }
        assert!(scene["outputs"].as_array().is_some_and(|outputs| !outputs.is_empty()));
    }
    Ok(())
}

#[test]
fn every_effect_that_was_measured_has_its_price() -> Result<()> {
    let page = page()?;
    let prices = page["prices"].as_array().expect("a list");
    let switches = table().rows.iter().map(|row| row.name).filter(|name| name.starts_with("effects."));
    // both are part of plain teeth
    for switch in switches.filter(|name| !["effects.backlash", "effects.corner_contact"].contains(name)) {
        let price = prices.iter().find(|price| price["effect"] == switch).unwrap_or_else(|| panic!("{switch}"));
        assert!(price["factor"].as_f64().is_some_and(|factor| factor > 1.0), "{price}");
    }
    Ok(())
}
