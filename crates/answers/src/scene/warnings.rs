//! Warnings about a scene before its first step: unusual values, values that change nothing, and values that were not
//! set.

use bevel_differential::model::{Parameters, Simulation};
use bevel_differential::problem::Problem;
use bevel_differential::variables::effective::{self, Situation};
use bevel_differential::variables::unset::{self, SetValues};
use bevel_differential::variables::{index_of, number};

use super::accepted::Accepted;
use super::{InputTable, Scene};

/// Warnings about `scene`, whose `simulation` has started.
pub fn at_start(scene: &Scene, simulation: &Simulation) -> Vec<String> {
    let mut set = set_values(scene);
    let runaway = unset::runaway(&scene.parameters, &scene.inputs, &set);
    let problems = simulation.warnings().iter().cloned().chain(values_without_effect(scene)).chain(runaway);
    let mut found: Vec<String> = problems.map(|problem| problem.to_string()).collect();
    if scene.accepted != Accepted::All && set.describes_another_differential() {
        scene.accepted.add_to(&mut set);
        let line = unset::in_one_line(&unset::unset(&scene.parameters, &scene.inputs, &set));
        found.extend(Some(line).filter(|line| !line.is_empty()));
    }
    found
}

/// Variables that `scene` sets at any time.
pub fn set_values(scene: &Scene) -> SetValues {
    let mut set = SetValues::default();
    let later = scene.events.iter().flat_map(|event| &event.settings);
    let rows = scene.settings.iter().chain(later).map(|setting| setting.row);
    for row in rows.chain(scene.input_tables.iter().map(|table| table.row)) {
        if let Some(index) = index_of(row.name) {
            set.insert(index);
        }
    }
    set
}

/// Problems of values that change nothing in `scene`, at the start or later, at most one for each variable.
fn values_without_effect(scene: &Scene) -> Vec<Problem> {
    let (mut parameters, mut inputs) = (scene.parameters, scene.inputs);
    let mut found = effective::values_without_effect(&parameters, &inputs, Situation::START);
    let mut later = |name: &'static str, value: Option<f64>, parameters: &mut Parameters| {
        let problem = index_of(name)
            .zip(value)
            .and_then(|(i, v)| effective::value_without_effect(i, v, parameters, Situation::RUNNING));
        found.extend(problem.filter(|problem| found.iter().all(|known| known.variable != problem.variable)));
    };
    for setting in scene.events.iter().flat_map(|event| &event.settings) {
        setting.apply(&mut parameters, &mut inputs);
        later(setting.row.name, number(setting.row, &mut parameters, &mut inputs), &mut parameters);
    }
    for InputTable { row, table } in &scene.input_tables {
        table.values.iter().for_each(|&value| later(row.name, Some(value), &mut parameters));
    }
    found
}
