//! What a host sets before the start to get a scene.

use bevel_differential::model::{Inputs, Parameters};
use bevel_differential::variables::{Access, Variable, table, value_of};

use super::Scene;
use super::set::Setting;

/// Start values of `scene` in the order of the FMU's variables: parameters that it names or that differ from the FMU's own,
/// then all inputs.
pub fn start_values(scene: &Scene) -> Vec<Setting> {
    let all = table().rows.iter();
    all.filter(|row| matches!(row.access, Access::Input(_)) || is_of_scene(scene, row))
        .filter_map(|row| Setting::of(row, &scene.parameters, &scene.inputs))
        .collect()
}

/// Those of them that the scene names or that differ from the FMU's own.
pub fn changed_values(scene: &Scene) -> Vec<Setting> {
    start_values(scene).into_iter().filter(|setting| is_of_scene(scene, setting.row)).collect()
}

/// Whether `scene` names a variable or has another value than the FMU.
fn is_of_scene(scene: &Scene, row: &'static Variable) -> bool {
    let named = scene.settings.iter().any(|setting| setting.row.name == row.name);
    let value = |p: &Parameters, i: &Inputs| value_of(row, p, i);
    named || value(&scene.parameters, &scene.inputs) != value(&Parameters::default(), &Inputs::default())
}
