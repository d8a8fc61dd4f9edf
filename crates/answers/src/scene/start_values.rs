//! What a host sets before the start to get a scene.

use bevel_differential::model::{Inputs, Parameters};
use bevel_differential::variables::{Access, Variable, table};

use super::Scene;
use super::set::{Setting, SettingValue};

/// Start values of `scene` in the order of the FMU's variables: parameters that it names or that differ from the FMU's own,
/// then all inputs.
pub fn start_values(scene: &Scene) -> Vec<Setting> {
    let all = table().rows.iter();
    all.filter(|row| matches!(row.access, Access::Input(_)) || is_of_scene(scene, row))
        .filter_map(|row| Some(Setting { row, value: value(scene.parameters, scene.inputs, row)? }))
        .collect()
}

/// Those of them that the scene names or that differ from the FMU's own.
pub fn changed_values(scene: &Scene) -> Vec<Setting> {
    start_values(scene).into_iter().filter(|setting| is_of_scene(scene, setting.row)).collect()
}

/// Whether `scene` names a variable or has another value than the FMU.
fn is_of_scene(scene: &Scene, row: &Variable) -> bool {
    let named = scene.settings.iter().any(|setting| setting.row.name == row.name);
    named || value(scene.parameters, scene.inputs, row) != value(Parameters::default(), Inputs::default(), row)
}

/// Value of a parameter or of an input at the start; outputs have none.
fn value(mut parameters: Parameters, mut inputs: Inputs, row: &Variable) -> Option<SettingValue> {
    Some(match row.access {
        Access::Real(access) => SettingValue::Real(*access(&mut parameters)),
        Access::Input(access) => SettingValue::Real(*access(&mut inputs)),
        Access::Integer(access) => SettingValue::Integer(*access(&mut parameters)),
        Access::Boolean(access) => SettingValue::Boolean(*access(&mut parameters)),
        Access::Enumeration(_, get, _) => SettingValue::Literal(get(&parameters)),
        Access::Output(_) => return None,
    })
}
