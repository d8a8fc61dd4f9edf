//! Variables that have an influence in a scene, and the scene reduced to them.

use bevel_differential::model::{Inputs, Parameters};
use bevel_differential::variables::effective::{self, Situation};
use bevel_differential::variables::{Variable, assign, index_of, table, value_of};

use super::{Scene, off};

/// Returns `scene` without values that change nothing: they have their start values and are not set explicitly.
pub fn acting(scene: &Scene) -> Scene {
    let mut found = scene.clone();
    for row in table().rows.iter().filter(|row| !acts(row, scene, Situation::START)) {
        if let Some(start) = value_of(row, &Parameters::default(), &Inputs::default()) {
            // start values are within their ranges
            let fits = assign(row, start, &mut found.parameters, &mut found.inputs);
            debug_assert_eq!(fits, Ok(()));
        }
    }
    found.settings.retain(|setting| acts(setting.row, scene, Situation::START));
    for event in &mut found.events {
        event.settings.retain(|setting| acts(setting.row, scene, Situation::RUNNING));
    }
    found.events.retain(|event| !event.settings.is_empty());
    found.input_tables.retain(|table| acts(table.row, scene, Situation::START));
    found
}

/// Names of the variables whose values take effect in `scene`, and of outputs other than those of inactive effects.
pub fn names(scene: &Scene) -> Vec<&'static str> {
    let parameters = scene.parameters;
    let acts = |index: usize| effective::acts(index, &parameters, Situation::START);
    let rows =
        table().rows.iter().enumerate().filter(|(index, row)| acts(*index) && !off::is_switched_off(row.name, scene));
    rows.map(|(_, row)| row.name).collect()
}

/// True if something in `scene` depends on the value of `row`. A value that outputs only repeat has an influence if the
/// scene has an output of the same unit.
pub fn acts(row: &Variable, scene: &Scene, situation: Situation) -> bool {
    let Some(index) = index_of(row.name) else { return true };
    let parameters = scene.parameters;
    let unit = |row: &Variable| row.unit.map(|unit| unit.name);
    let is_repeated = || scene.outputs.iter().any(|output| unit(output) == unit(row));
    effective::acts(index, &parameters, situation)
        || effective::has_effect(index, &parameters, situation) && is_repeated()
}
