//! The ladder of fidelities: the error of each rung against the richest, and what it costs.

use anyhow::Result;
use bevel_differential::contact::ContactLaw;
use bevel_differential::model::{GearContact, Inputs, Parameters, Simulation};
use bevel_differential::problem;

use super::cases::{CaseMotion, CostCase, Fidelity};
use super::measure::{self, TimedJob, cells};
use super::{CostPlan, measured_here};
use answers::text::csv_file::number;
use answers::text::numbers::Spread;

/// The columns.
pub const COLUMNS: &str =
    "scene,rung,adds,status,message,quantity,unit,value,richest,error,runs,cpu_s,cpu_s_low,cpu_s_high,cost";

/// A rung.
#[derive(Clone, Copy)]
struct Rung {
    name: &'static str,
    adds: &'static str,
    /// How it follows from the rung before.
    add: fn(&mut Parameters),
    /// Whether the short form has it too.
    quick: bool,
}

const fn rung(name: &'static str, adds: &'static str, add: fn(&mut Parameters)) -> Rung {
    Rung { name, adds, add, quick: true }
}

/// Solid teeth, of which the short form has two.
const fn solid(name: &'static str, adds: &'static str, add: fn(&mut Parameters), quick: bool) -> Rung {
    Rung { name, adds, add, quick }
}

fn faceted(p: &mut Parameters, facets: i32) {
    p.scene.gear_contact = GearContact::Solid;
    p.solid.facets = facets;
}

/// All rungs, the plainest first; solids are as exact teeth with the same law become if they are cut into facets.
const RUNGS: [Rung; 14] = [
    rung("ideal", "no teeth: Willis' equation", |p| p.scene.gear_contact = GearContact::Ideal),
    rung("lumped", "a spring with play per mesh", |p| p.scene.gear_contact = GearContact::Lumped),
    solid("solid, 4 facets", "IMPACT on facets: no hand-over left", |p| faceted(p, 4), false),
    solid("solid, 8 facets", "hand-over washed out", |p| faceted(p, 8), true),
    solid("solid, 16 facets", "hand-over late", |p| faceted(p, 16), false),
    solid("solid, 32 facets", "deflection of exact teeth to 3 %", |p| faceted(p, 32), true),
    solid("solid, 64 facets", "to 1 %", |p| faceted(p, 64), false),
    solid("solid, 128 facets", "to 0.3 %", |p| faceted(p, 128), false),
    rung("tooth, impact", "tooth pairs, Adams' IMPACT", |p| p.scene.gear_contact = GearContact::Tooth),
    rung("tooth, line", "stiffness from the teeth's shape", |p| p.contact.law = ContactLaw::Line),
    rung("tooth, line_weber", "Hertz part by load", |p| p.contact.law = ContactLaw::LineWeber),
    rung("+ friction", "flanks, washers and pins rub", |p| {
        p.effects.tooth_friction = true;
        p.effects.thrust_friction = true;
    }),
    rung("+ pins and case", "give way; slices over the face", |p| p.effects.pin_compliance = true),
    rung("+ gear bodies", "turn, tilt and couple their teeth", |p| p.effects.body_compliance = true),
];

/// What is looked at: names and units.
const TURN: [(&str, &str); 7] = [
    ("mean speed, left", "rad/s"),
    ("mean mesh force", "N"),
    ("peak mesh force", "N"),
    ("speed ripple, left", "1"),
    ("mean deflection", "m"),
    ("deflection, peak to peak", "m"),
    ("heat of one tooth", "J"),
];
const CLUNK: [(&str, &str); 6] = [
    ("speed of the carrier at the end", "rad/s"),
    ("peak shaft torque", "N.m"),
    ("time of the peak", "s"),
    ("speed of the left gear, rms", "rad/s"),
    ("peak mesh force", "N"),
    ("heat", "J"),
];

/// A scene: how it begins, how long it settles, when it ends and how closely it is recorded [s].
struct LadderScene {
    name: &'static str,
    motion: CaseMotion,
    settled: f64,
    end: f64,
    every: f64,
    quantities: &'static [(&'static str, &'static str)],
}

const SCENES: [LadderScene; 2] = [
    LadderScene { name: "turn", motion: CaseMotion::Turn, settled: 0.18, end: 0.36, every: 5e-4, quantities: &TURN },
    LadderScene { name: "clunk", motion: CaseMotion::Clunk, settled: 0.0, end: 0.02, every: 1e-5, quantities: &CLUNK },
];
/// Communication step while times are measured [s].
const STEP: f64 = 1e-3;

/// A line of a record.
struct LadderPoint {
    time: f64,
    speed: f64,
    carrier: f64,
    force: f64,
    torque: f64,
    deflection: f64,
    heat: f64,
}

/// Measures, and returns the CSV file. `report` receives the fraction done and the current job.
pub fn measure(form: &CostPlan, report: &mut dyn FnMut(f64, &str)) -> Result<String> {
    let rungs: Vec<Rung> = RUNGS.into_iter().filter(|rung| rung.quick || !form.short).collect();
    let mut found = Vec::new();
    let mut jobs = Vec::new();
    for (i, scene) in SCENES.iter().enumerate() {
        let case = CostCase::new(scene.motion, Fidelity::Ideal)?;
        let mut parameters = case.parameters;
        for (j, rung) in rungs.iter().enumerate() {
            let done = (i * rungs.len() + j) as f64 / (SCENES.len() * rungs.len()) as f64;
            report(0.2 * done, &format!("ladder: {}, {}", scene.name, rung.name));
            (rung.add)(&mut parameters);
            let started = start(&parameters, &case.inputs, &case.then);
            let values =
                started.clone().and_then(|simulation| record(scene, simulation)).map(|r| quantities(scene, &r));
            if let (Ok(simulation), Ok(_)) = (started, &values) {
                let run = Box::new(move || {
                    let mut simulation = simulation.clone();
                    for k in 1..=(scene.end / STEP).round() as u32 {
                        // it has run to its end before
                        let _ = simulation.advance(f64::from(k) * STEP);
                    }
                });
                jobs.push(TimedJob { run, first: 0.0 });
            }
            found.push(values);
        }
    }
    let mut times =
        measure::time(&mut jobs, form.runs, &mut |done| report(0.2 + 0.8 * done, "ladder: times")).into_iter();
    let spreads: Vec<Option<Spread>> =
        found.iter().map(|values| if values.is_ok() { times.next() } else { None }).collect();
    text(&rungs, &found, &spreads)
}

fn start(parameters: &Parameters, inputs: &Inputs, then: &Inputs) -> Result<Simulation, String> {
    let mut simulation = Simulation::start(parameters, inputs, 0.0).map_err(|found| problem::list(&found))?;
    simulation.set_inputs(then);
    Ok(simulation)
}

fn record(scene: &LadderScene, mut simulation: Simulation) -> Result<Vec<LadderPoint>, String> {
    let mut points = Vec::new();
    for k in 1..=(scene.end / scene.every).round() as u32 {
        let time = f64::from(k) * scene.every;
        simulation.advance(time).map_err(|failure| failure.to_string())?;
        if time < scene.settled - 0.5 * scene.every {
            continue;
        }
        let (motion, heat) = (simulation.motion(), simulation.ledger().heat.iter().sum());
        let forces = simulation.forces();
        points.push(LadderPoint {
            time,
            speed: motion.side_speed[0],
            carrier: motion.carrier_speed,
            force: forces.mesh[0][0].normal,
            torque: forces.shaft_torque[0],
            deflection: forces.mesh[0][0].transmission_error,
            heat,
        });
    }
    Ok(points)
}

/// Values of the quantities of `scene`.
fn quantities(scene: &LadderScene, points: &[LadderPoint]) -> Vec<f64> {
    let mean = |of: fn(&LadderPoint) -> f64| points.iter().map(of).sum::<f64>() / points.len() as f64;
    let most = |of: fn(&LadderPoint) -> f64| points.iter().map(of).fold(f64::NEG_INFINITY, f64::max);
    let range = |of: fn(&LadderPoint) -> f64| most(of) - points.iter().map(of).fold(f64::INFINITY, f64::min);
    let (Some(first), Some(last)) = (points.first(), points.last()) else { return Vec::new() };
    let heat = last.heat - first.heat;
    match scene.motion {
        CaseMotion::Turn | CaseMotion::Blow => vec![
            mean(|p| p.speed),
            mean(|p| p.force),
            most(|p| p.force),
            range(|p| p.speed) / mean(|p| p.speed),
            mean(|p| p.deflection),
            range(|p| p.deflection),
            heat,
        ],
        CaseMotion::Clunk => {
            let peak = most(|p| p.torque);
            let when = points.iter().find(|p| p.torque == peak).map_or(f64::NAN, |p| p.time);
            let speed = mean(|p| p.speed * p.speed).sqrt();
            vec![last.carrier, peak, when, speed, most(|p| p.force), heat]
        }
    }
}

fn text(rungs: &[Rung], found: &[Result<Vec<f64>, String>], spreads: &[Option<Spread>]) -> Result<String> {
    let mut out = measured_here(
        COLUMNS,
        &[
            "error: difference from the richest rung over its value; cost: cpu_s over that of the ideal rung",
            "turn: the study's, one tooth after one to settle; clunk: the scene with the study's gears and restitution",
        ],
    )?;
    for (i, scene) in SCENES.iter().enumerate() {
        let first = i * rungs.len();
        let richest = found[first + rungs.len() - 1].as_ref().ok();
        let unit = spreads[first].map_or(f64::NAN, |s| s.median);
        for (j, Rung { name: rung, adds, .. }) in rungs.iter().enumerate() {
            let (values, spread) = (&found[first + j], spreads[first + j].unwrap_or(Spread::of(&[])));
            let [median, low, high, count] = cells(&spread);
            for (k, (quantity, unit_of)) in scene.quantities.iter().enumerate() {
                let best = richest.map_or(f64::NAN, |values| values[k]);
                let (status, message, value) = match values {
                    Ok(values) => ("ok", "", values[k]),
                    Err(why) => ("failed", why.as_str(), f64::NAN),
                };
                let texts = [scene.name, rung, adds, status, message, quantity, unit_of].map(str::to_owned);
                let values = [value, best, (value / best - 1.0).abs()].map(number);
                let times = [&count, &median, &low, &high].map(String::clone);
                out.push(texts.into_iter().chain(values).chain(times).chain([number(spread.median / unit)]))?;
            }
        }
    }
    out.text()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantities_of_a_record_are_means_ranges_and_peaks() {
        let point = |time: f64, speed: f64| LadderPoint {
            time,
            speed,
            carrier: 7.0,
            force: 100.0 * speed,
            torque: -speed,
            deflection: 1e-6 * speed,
            heat: time,
        };
        let points = [point(0.0, 1.0), point(1.0, 3.0), point(2.0, 2.0)];
        let turn = quantities(&SCENES[0], &points);
        assert_eq!(turn[..4], [2.0, 200.0, 300.0, 1.0]);
        assert_eq!(turn[6], 2.0);
        let clunk = quantities(&SCENES[1], &points);
        assert_eq!(clunk[..3], [7.0, -1.0, 0.0]);
    }

    #[test]
    fn every_rung_of_the_ladder_is_richer_than_the_one_before() {
        let mut parameters = Parameters::default();
        let mut before = parameters;
        for (i, rung) in RUNGS.iter().enumerate() {
            (rung.add)(&mut parameters);
            assert!(i == 0 || parameters != before, "{}", rung.name);
            before = parameters;
        }
    }
}
