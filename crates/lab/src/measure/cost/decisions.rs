//! Decisions: for a quantity of a scene and an accuracy, the cheapest setting; as the command `accuracy` finds it.

use anyhow::Result;

use super::{measured_here, titled};
use answers::accuracy::answer::Answer;
use answers::accuracy::gears::Gears;
use answers::accuracy::words::{effects_on, percent, solver, two};
use answers::accuracy::{Question, answer};
use answers::scene;
use answers::text::csv_file::{number, number_or_nan};
use answers::text::table::Table;
use answers::watch::Watch;

/// What is asked: in words, scene, wanted quantity, accuracy.
pub type Decision = (&'static str, &'static str, &'static str, f64);

/// Questions that stand for most.
pub const ALL: [Decision; 11] = [
    ("mean speed in a turn", "study_turning", "left.speed:mean", 0.01),
    ("mean force of a mesh", "study_turning", "planet[1].left_normal_force:mean", 0.01),
    ("largest force of a mesh", "study_turning", "planet[1].left_normal_force:max", 0.05),
    ("ripple of a speed", "study_turning", "left.speed:peak_to_peak", 0.05),
    ("deflection: mean transmission error", "study_turning", "planet[1].left_transmission_error:mean", 0.05),
    (
        "noise: first mesh order of the transmission error",
        "study_turning",
        "planet[1].left_transmission_error:mesh_order_1",
        0.05,
    ),
    ("torque bias", "torque_bias", "torque_bias_ratio:mean", 0.01),
    ("losses", "torque_bias", "efficiency:mean", 0.001),
    ("peak torque of a clunk", "clunk", "left.shaft_torque:max", 0.01),
    ("torque of a wheel that slips", "limited_slip", "left.shaft_torque:rms", 0.01),
    ("speed of a wheel on ice", "one_wheel_on_ice", "left.wheel_speed:max", 0.01),
];

/// The columns of the file.
const COLUMNS: &str = "quantity,scene,want,accuracy,gears,effects,solver,error,stray,real_time,price,reference_price";

/// Answers the first `count` questions. `report` receives the fraction done and the current job.
pub fn measure(count: usize, timed: bool, report: &mut dyn FnMut(f64, &str)) -> Result<(String, String)> {
    let mut file = measured_here(COLUMNS, &["error: of the chosen setting against the richest model, as a fraction"])?;
    let mut table =
        Table::new(["quantity", "within", "gears", "effects", "solver", "error", "× real time", "asked by"]);
    for (i, (quantity, name, want, within)) in ALL.iter().take(count).enumerate() {
        let scene = scene::find(name, &fmu_build::tools::paths::scenes())?;
        // the start settles
        let from = if *name == "study_turning" { 0.1 * scene.stop_time } else { 0.0 };
        let question = Question { wants: vec![(*want).to_owned()], within: *within, from, timed };
        let found = answer(
            &scene,
            &question,
            &mut Watch::new(|done, what| {
                report((i as f64 + done.min(1.0)) / count as f64, &format!("{quantity}: {what}"));
                true
            }),
        )?;
        let Some(chosen) = found.choice() else { continue };
        let p = &chosen.scene.parameters;
        let effects = effects_on(p).join(", ");
        let real_time = found.seconds[0].map(|seconds| scene.stop_time / seconds);
        let texts = [quantity, name, want].map(|text| (*text).to_owned()).into_iter();
        let own = [number(*within), Gears::of(p).text(), effects.replace(", ", " "), solver(p)];
        let numbers = [
            Some(chosen.error()),
            Some(found.reference.stray()),
            real_time,
            Some(chosen.cost),
            Some(found.reference.cost),
        ];
        file.push(texts.chain(own).chain(numbers.map(number_or_nan)))?;
        let from = if from > 0.0 { format!(" --from {from}s") } else { String::new() };
        table.push([
            (*quantity).to_owned(),
            format!("{} %", 100.0 * within),
            Gears::of(p).text(),
            if effects.is_empty() { "–".into() } else { effects },
            solver(p),
            error(&found, chosen.error()),
            real_time.map_or(String::new(), two),
            format!("`--scene {name} --want {want} --within {}%{from}`", 100.0 * within),
        ]);
    }
    let table = table.all_left();
    let title = "The cheapest setting by quantity, each found and proved by `bevel-differential accuracy` with the options of its row";
    Ok((file.text()?, titled(title, &table)))
}

/// The error, and what cannot be told.
fn error(found: &Answer, error: f64) -> String {
    if found.is_uncertain() {
        format!("{}; two runs of the richest model differ by {}", percent(error), percent(found.reference.stray()))
    } else {
        percent(error)
    }
}
