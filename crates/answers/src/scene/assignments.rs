//! Changes of a scene on the command line, each `name=value`, with the same checks as the values in a file.

use std::path::Path;

use super::set::variable;
use super::times::{check_step, duration, span};
use super::value::of_text;
use super::{Scene, curve};
use crate::problem::{Problem, Problems};
use crate::text::near;

/// Names that can be set in addition to the variables of the FMU.
const TIMES: [&str; 2] = ["stop_time", "step"];

/// Changes `scene` by `assignments`. Fails with all problems of the assignments. Times have options of their own besides
/// `--set`, so their messages name no option.
pub fn apply<T: AsRef<str>>(scene: &mut Scene, assignments: &[T]) -> Result<(), Problems> {
    let mut problems = Problems::default();
    let mut named: Vec<&str> = Vec::new();
    for assignment in assignments.iter().map(|text| -> &str { text.as_ref() }) {
        let Some((name, text)) = assignment.split_once('=') else {
            let form = "is not of the form name=value, such as left.load_torque=\"400 N.m\"";
            problems.push(format!("--set: \"{assignment}\" {form}"));
            continue;
        };
        let (name, text) = (name.trim(), text.trim());
        if let Some(problem) = curve::set_twice(name, &named) {
            problems.push(format!("--set: {problem}"));
            continue;
        }
        named.push(name);
        let option = if TIMES.contains(&name) { "" } else { "--set: " };
        let found = assign(scene, name, text).err().into_iter().flat_map(|of_value| of_value.0);
        problems.extend(found.map(|problem| problem.prefixed(option)));
    }
    if problems.0.is_empty() && named.iter().any(|name| TIMES.contains(name)) {
        problems.extend(check_step(scene.step, scene.stop_time).err());
    }
    problems.or(())?;
    // a run that ends earlier does not reach later changes
    let stop_time = scene.stop_time;
    scene.events.retain(|event| event.time <= stop_time);
    Ok(())
}

fn assign(scene: &mut Scene, name: &str, text: &str) -> Result<(), Problems> {
    let value = of_text(text);
    match name {
        "stop_time" => scene.stop_time = duration(name, &value).map_err(Problem::from)?,
        "step" => scene.step = span(name, &value).map_err(Problem::from)?,
        _ => {
            let time = near::hint(name, TIMES);
            if variable(name).is_err() && !time.is_empty() {
                return Err(Problem::from(format!("there is no variable \"{name}\"{time}")).into());
            }
            // paths on a command line are relative to the working folder
            let settings = curve::settings(name, &value, Path::new(""))?;
            if scene.input_tables.iter().any(|table| table.row.name == name) {
                let message = "follows a table in the scene, which overrides a value; change the table";
                return Err(Problem::of(name, text, format!("{name} {message}")).into());
            }
            for setting in settings {
                setting.apply(&mut scene.parameters, &mut scene.inputs);
                scene.settings.retain(|known| known.row.name != setting.row.name);
                scene.settings.push(setting);
            }
        }
    }
    Ok(())
}
