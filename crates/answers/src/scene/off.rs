//! Outputs that no effect changes in a scene, because all effects with these outputs are off.

use bevel_differential::model::EFFECTS;
use bevel_differential::model::effects::EffectEntry;
use bevel_differential::variables::effective::{Situation, acts};
use bevel_differential::variables::{Access, Causality, Variable, table};

use super::Scene;

/// Returns the reason why no effect changes `output` in `scene`, with the remedy. Returns `None` if an effect does.
pub fn reason(output: &str, scene: &Scene) -> Option<String> {
    let owners = owners(output);
    if owners.is_empty() || owners.iter().any(|effect| is_active(effect, scene)) {
        return None;
    }
    let several = |of: fn(&EffectEntry) -> Vec<String>, word: &str| {
        owners.iter().flat_map(|effect| of(effect)).collect::<Vec<_>>().join(word)
    };
    let (states, remedies) = (several(states, " and "), several(remedies, " or "));
    Some(format!("{states}, so nothing changes it; set {remedies}"))
}

/// True if no effect can change `output` in `scene`, whatever its inputs command.
pub fn is_switched_off(output: &str, scene: &Scene) -> bool {
    let owners = owners(output);
    !owners.is_empty() && owners.iter().all(|effect| effect.switch.is_some() && !is_active(effect, scene))
}

/// Warnings about outputs of `scene` that no effect changes, one for each reason.
pub fn warnings(scene: &Scene) -> Vec<String> {
    let mut found: Vec<(String, Vec<&str>)> = Vec::new();
    for output in &scene.outputs {
        let Some(why) = reason(output.name, scene) else { continue };
        match found.iter_mut().find(|(known, _)| *known == why) {
            Some((_, names)) => names.push(output.name),
            None => found.push((why, vec![output.name])),
        }
    }
    found.into_iter().map(|(why, names)| format!("{}: {why}", names.join(", "))).collect()
}

/// Effects with this output.
fn owners(output: &str) -> Vec<&'static EffectEntry> {
    let has_output = |effect: &&EffectEntry| {
        effect.heat.is_some_and(|heat| heat.output == output) || effect.readings.iter().any(|one| one.name == output)
    };
    EFFECTS.iter().filter(has_output).collect()
}

/// True if the effect acts in `scene`: its switch is on, its command is not always zero, or its parameters have an
/// influence although its switch is off.
fn is_active(effect: &EffectEntry, scene: &Scene) -> bool {
    let Some(switch) = effect.switch else { return commands(effect).any(|row| is_commanded(row, scene)) };
    let parameters = scene.parameters;
    scene.parameters.effects.active().any(|on| on == switch)
        || effect.may_act_unswitched
            && rows(effect, Causality::Parameter).any(|(index, _)| acts(index, &parameters, Situation::START))
}

/// True if `input` has a value other than zero at any time.
fn is_commanded(input: &Variable, scene: &Scene) -> bool {
    let Access::Input(access) = input.access else { return false };
    let (mut parameters, mut inputs) = (scene.parameters, scene.inputs);
    let mut is_set = *access(&mut inputs) != 0.0;
    for setting in scene.events.iter().flat_map(|event| &event.settings) {
        setting.apply(&mut parameters, &mut inputs);
        is_set |= *access(&mut inputs) != 0.0;
    }
    let mut tables = scene.input_tables.iter().filter(|driven| driven.row.name == input.name);
    is_set || tables.any(|driven| driven.table.values.iter().any(|&value| value != 0.0))
}

/// Inputs that command the effect.
fn commands(effect: &EffectEntry) -> impl Iterator<Item = &'static Variable> {
    rows(effect, Causality::Input).map(|(_, row)| row)
}

/// Rows of the effect's own variables of this causality, with their indices.
fn rows(effect: &EffectEntry, causality: Causality) -> impl Iterator<Item = (usize, &'static Variable)> {
    let name = effect.name;
    let is_own = move |row: &Variable| row.name.strip_prefix(name).is_some_and(|rest| rest.starts_with('.'));
    table().rows.iter().enumerate().filter(move |(_, row)| row.causality == causality && is_own(row))
}

fn states(effect: &EffectEntry) -> Vec<String> {
    match effect.switch {
        Some(switch) => vec![format!("{switch} is off")],
        None => commands(effect).map(|row| format!("{} is 0", row.name)).collect(),
    }
}

fn remedies(effect: &EffectEntry) -> Vec<String> {
    match effect.switch {
        Some(switch) => vec![format!("{switch} = true")],
        None => commands(effect).map(|row| format!("{} above 0", row.name)).collect(),
    }
}
