//! Changes of a scene on the command line, each `name=value`, with the same checks as the values in a file.

use super::set::{Setting, value, variable};
use super::times::{check_step, duration, span};
use super::{Scene, former_names};
use crate::problem::{Problem, Problems};
use crate::text::near;

/// Names that can be set in addition to the variables of the FMU.
const TIMES: [&str; 2] = ["stop_time", "step"];

/// Changes `scene` by `assignments`. Fails with all problems of the assignments.
pub fn apply<T: AsRef<str>>(scene: &mut Scene, assignments: &[T]) -> Result<(), Problems> {
    let mut problems = Problems::default();
    let mut named: Vec<&str> = Vec::new();
    for assignment in assignments.iter().map(|text| -> &str { text.as_ref() }) {
        let Some((name, text)) = assignment.split_once('=') else {
            problems
                .push(format!("\"{assignment}\" is not of the form name=value, such as left.load_torque=\"400 N.m\""));
            continue;
        };
        let (name, text) = (name.trim(), text.trim());
        scene.notes.extend(former_names::notes([name]));
        let name = former_names::present(name);
        if named.contains(&name) {
            problems.push(format!("{name} is set twice; leave one out"));
            continue;
        }
        named.push(name);
        problems.extend(assign(scene, name, text).err());
    }
    if problems.0.is_empty() && named.iter().any(|name| TIMES.contains(name)) {
        problems.extend(check_step(scene.step, scene.stop_time).err());
    }
    Problems(problems.0.into_iter().map(|problem| problem.prefixed("--set: ")).collect()).or(())?;
    // a run that ends earlier does not reach later changes
    let stop_time = scene.stop_time;
    scene.events.retain(|event| event.time <= stop_time);
    Ok(())
}

fn assign(scene: &mut Scene, name: &str, text: &str) -> Result<(), Problem> {
    let value = value(text);
    match name {
        "stop_time" => scene.stop_time = duration(name, &value)?,
        "step" => scene.step = span(name, &value)?,
        _ => {
            let time = near::hint(name, TIMES);
            if variable(name).is_err() && !time.is_empty() {
                return Err(format!("there is no variable \"{name}\"{time}").into());
            }
            let setting = Setting::new(name, &value)?;
            if scene.input_tables.iter().any(|table| table.row.name == name) {
                let message = "follows a table in the scene, which overrides a value; change the table";
                return Err(Problem::of(name, text, format!("{name} {message}")));
            }
            setting.apply(&mut scene.parameters, &mut scene.inputs);
            scene.settings.retain(|known| known.row.name != name);
            scene.settings.push(setting);
        }
    }
    Ok(())
}
