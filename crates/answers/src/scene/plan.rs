//! Plan of a scene: a description of what it will simulate, from its parameters before the first step.

use std::fmt::Write as _;

use bevel_differential::model::{CostClass, Inputs, Parameters, Plan, Simulation, effects};
use bevel_differential::variables::effective::{Situation, acts};
use bevel_differential::variables::{Causality, Variable, index_of, named, unset, value_of};
use cpu_time::ThreadTime;

use super::run::SceneRun;
use super::set::literal;
use super::warnings::set_values;
use super::{InputTable, Scene, units};
use crate::text::{numbers, shown};

/// Description of a cost class.
fn meaning(cost: CostClass) -> &'static str {
    match cost {
        CostClass::ClosedForm => "closed form: no teeth, a step of any length is a formula",
        CostClass::Ideal => "effects without teeth: integrated, with no motion faster than the effects' own",
        CostClass::Teeth => "plain teeth: stiff, integrated step by step; only the tooth pairs are evaluated",
        CostClass::TeethAndBodies => "teeth and effects on bodies: plain teeth and torques on bodies",
        CostClass::TeethInDetail => "teeth in detail: errors, friction or pins, evaluated slice by slice of the face",
    }
}

/// Processor time of the first piece of the scene, from which its cost is extrapolated [s].
const PIECE: f64 = 0.05;

/// Expected cost of the scene on this machine, extrapolated from its first piece; none if that fails.
fn cost(scene: &Scene) -> Option<String> {
    let begun = ThreadTime::now();
    let mut run = SceneRun::start(scene, scene.step).ok()?;
    let started = begun.elapsed();
    // a scene of zero duration has no cost
    if run.is_over() {
        return None;
    }
    while !run.is_over() && begun.elapsed().as_secs_f64() < PIECE {
        run.advance().ok()?;
    }
    let (simulated, taken) = (run.time(), (begun.elapsed() - started).as_secs_f64().max(f64::MIN_POSITIVE));
    let ratio = numbers::significant(simulated / taken, 2);
    let all = numbers::significant(scene.stop_time * taken / simulated, 2);
    Some(format!(
        "{ratio} x real time on this machine without reading outputs, {all} s for the whole scene, extrapolated from the \
         first {} s",
        units::six_digits(simulated)
    ))
}

/// Plan of `scene`, whose simulation is about to start.
pub fn text(scene: &Scene, simulation: &Simulation) -> String {
    let plan = simulation.plan();
    let mut out = format!("{}: {}\n", scene.name, scene.description);
    let mut line = |title: &str, text: &str| {
        let _ = writeln!(out, "  {title:<13} {text}");
    };
    line("file", &shown(&scene.file));
    line("time", &format!("{} s, communication step {} s", scene.stop_time, scene.step));
    for name in ["scene.gear_contact", "contact.law", "scene.start"] {
        if name == "contact.law" && scene.parameters.scene.gear_contact != bevel_differential::model::GearContact::Tooth
        {
            continue;
        }
        line(name.rsplit('.').next().unwrap_or(name).replace('_', " ").as_str(), &choice(scene, name));
    }
    line("planets", &format!("{} planets simulated in {}", plan.planets, plan.describe_groups()));
    for (i, drive) in drives(scene, plan).into_iter().enumerate() {
        line(if i == 0 { "drives" } else { "" }, &drive);
    }
    let (freedoms, imposed) = (plan.degrees_of_freedom(), plan.imposed());
    line("size", &format!("{freedoms} degrees of freedom, {imposed} of them imposed; {} states", 2 * freedoms));
    line("cost class", meaning(simulation.cost()));
    if let Some(cost) = cost(scene) {
        line("cost", &cost);
    }
    let mut active: Vec<String> = simulation
        .active_effects()
        .map(|name| format!("{name}: {}{}", description(name), commands(scene, name)))
        .collect();
    if scene.inputs.lock > 0.0 {
        active.push(format!("lock.command: the lock holds at {} of its torque", scene.inputs.lock));
    }
    if active.is_empty() {
        active.push("none".into());
    }
    for (i, effect) in active.iter().enumerate() {
        line(if i == 0 { "effects" } else { "" }, effect);
    }
    let j = simulation.inertias();
    let own = |s: usize| units::six_digits(j.side[s] - j.end[s]);
    line(
        "inertias",
        &format!(
            "carrier with planets {}, side gears {} and {}, their ends {} and {}, planet {}{} kg.m2",
            units::six_digits(j.carrier - plan.on_carrier),
            own(0),
            own(1),
            units::six_digits(j.end[0]),
            units::six_digits(j.end[1]),
            units::six_digits(j.planet),
            in_front(plan)
        ),
    );
    for event in &scene.events {
        let settings: Vec<String> =
            event.settings.iter().map(|s| format!("{} = {}", s.row.name, s.text_in(&scene.display_units))).collect();
        line("later", &format!("at {} s {}", event.time, settings.join(", ")));
    }
    for InputTable { row, table } in &scene.input_tables {
        let period = table.period.map_or(String::new(), |period| format!(", again every {period} s"));
        let slopes = if scene.input_slopes { "" } else { ", held within steps" };
        line("table", &format!("{} from {} points{period}{slopes}", row.name, table.times.len()));
    }
    let shown = |row: &Variable| scene.display_units.row(row);
    for group in unset::unset_as_shown(&scene.parameters, &scene.inputs, &set_values(scene), shown) {
        line("not set", &format!("{}: {}", group.group, group.values.join(", ")));
    }
    out
}

/// Value of an enumeration in `scene`, with its meaning.
fn choice(scene: &Scene, name: &str) -> String {
    let known = named(name).and_then(|row| literal(row, value_of(row, &scene.parameters, &scene.inputs)? as i32));
    known.map_or(String::new(), |(literal, meaning)| format!("{literal}: {meaning}"))
}

/// Inertias of the bodies in front of the carrier, at their own speeds.
fn in_front(plan: &Plan) -> String {
    let Some(ratio) = plan.drive_ratio else { return String::new() };
    let own = |referred: f64| units::six_digits(referred / (ratio * ratio));
    let end = plan.propeller_inertia();
    let end = end.map_or(String::new(), |end| format!(", end of the propeller shaft {}", own(end)));
    format!(", pinion {}{end}", own(plan.pinion_inertia()))
}

/// Text `name = value` with the value of a variable at the start in its unit, and the value in SI.
fn value(scene: &Scene, name: &str) -> Option<(String, f64)> {
    let row = named(name)?;
    let value = value_of(row, &scene.parameters, &scene.inputs)?;
    Some((format!("{name} = {}", units::text(&scene.display_units.row(row), value)), value))
}

/// Drive of each shaft, with the values at the start.
fn drives(scene: &Scene, plan: &Plan) -> Vec<String> {
    let value = |name: &str| value(scene, name).map_or(String::new(), |(text, _)| text);
    let driven = |name: &str| choice(scene, name).split(':').next().unwrap_or_default().to_owned();
    let by = driven("scene.carrier_drive");
    let command = if by == "torque" { "torque_command" } else { "speed_command" };
    let mut drives = vec![match plan.drive_ratio {
        None => format!("carrier by {by}, {}", value(&format!("carrier.{command}"))),
        Some(ratio) => {
            let port = if plan.propeller_inertia().is_some() { "propeller shaft" } else { "pinion" };
            let ratio = units::six_digits(ratio);
            format!(
                "{port} by {by}, {}, at {ratio} times the speed of the carrier",
                value(&format!("pinion.{command}"))
            )
        }
    }];
    for side in ["left", "right"] {
        let by = driven(&format!("scene.{side}_drive"));
        let command = if by == "speed" { "speed_command" } else { "load_torque" };
        drives.push(format!("{side} by {by}, {}", value(&format!("{side}.{command}"))));
    }
    let spin = driven("scene.planet_spin");
    let command = if spin == "imposed" { format!(", {}", value("spin.command")) } else { String::new() };
    drives.push(format!("planet spin {spin}{command}"));
    drives
}

/// Inputs of the effect with the switch `name` that act and are not 0 at the start, for the end of a line.
fn commands(scene: &Scene, name: &str) -> String {
    let acts = |name: &str| index_of(name).is_some_and(|index| acts(index, &scene.parameters, Situation::START));
    let rows = effects::inputs_of(name.trim_start_matches("effects."));
    let acting = rows.iter().filter(|row| acts(row.name)).filter_map(|row| value(scene, row.name));
    acting.filter(|&(_, value)| value != 0.0).fold(String::new(), |all, (text, _)| format!("{all}; {text}"))
}

/// Description of the effect of a switch.
fn description(name: &str) -> String {
    let text = named(name).filter(|row| row.causality == Causality::Parameter).map_or("", |row| row.description);
    // the text after the semicolon describes the model without the effect
    let on = text.split(';').next().unwrap_or(text);
    let start = named(name).and_then(|row| value_of(row, &Parameters::default(), &Inputs::ZERO));
    if start == Some(1.0) { format!("{on} (on unless switched off)") } else { on.to_owned() }
}
