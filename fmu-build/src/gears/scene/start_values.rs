//! What a host sets before the start to get a scene: the parameters that the scene sets, and all inputs.

use bevel_differential::model::Parameters;
use bevel_differential::variables::{Access, Variable, table};

use super::Scene;
use super::set::{Setting, SettingValue};

/// Start values of `scene` in the order of the FMU's variables: parameters that it names or that differ from the FMU's own,
/// then all inputs.
pub fn start_values(scene: &Scene) -> Vec<Setting> {
    let named = |row: &Variable| scene.settings.iter().any(|setting| setting.row.name == row.name);
    let usual = Parameters::default();
    let rows = table().rows.iter();
    rows.filter_map(|row| {
        let value = value(scene, &scene.parameters, row)?;
        let is_input = matches!(row.access, Access::Input(_));
        let differs = self::value(scene, &usual, row) != Some(value);
        (is_input || named(row) || differs).then_some(Setting { row, value })
    })
    .collect()
}

/// Value of a parameter among `parameters`, or of an input of `scene` at its start; outputs have none.
fn value(scene: &Scene, parameters: &Parameters, row: &Variable) -> Option<SettingValue> {
    let (mut parameters, mut inputs) = (*parameters, scene.inputs);
    Some(match row.access {
        Access::Real(access) => SettingValue::Real(*access(&mut parameters)),
        Access::Input(access) => SettingValue::Real(*access(&mut inputs)),
        Access::Integer(access) => SettingValue::Integer(*access(&mut parameters)),
        Access::Boolean(access) => SettingValue::Boolean(*access(&mut parameters)),
        Access::Enumeration(_, get, _) => SettingValue::Literal(get(&parameters)),
        Access::Output(_) => return None,
    })
}
