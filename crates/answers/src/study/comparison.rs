//! Rows and notes of the comparison: the study, theory, this program.

use bevel_differential::model::Parameters;

use super::evaluation::{Results, SETTLED_BAND, defaults};
use super::report::{Cell, ComparisonReport, ComparisonRow};
use super::stated::{self, CARRIER_SPEED, FORCE, LOAD, PLANET_SPIN, RIPPLE, STRAIGHT_SPEEDS, TURNING_SPEEDS};
use super::theory::{self, Theory};

/// Converts a stiffness from N/m^1.5 to N/mm^1.5.
fn per_mm15(stiffness: f64) -> f64 {
    stiffness / 1e3f64.powf(1.5)
}

/// Notes that rows point to, numbered from 1 in this order.
#[derive(Clone, Copy, PartialEq)]
enum Note {
    Nothing,
    Inputs,
    Stiffness,
    Ripple,
    Force,
    Start,
    Frequency,
    Energy,
}

/// A row with the cells of study, theory and this program.
fn row(note: Note, quantity: &'static str, cells: [Cell; 3]) -> ComparisonRow {
    ComparisonRow { quantity, cells, note: (note != Note::Nothing).then_some(note as usize) }
}

/// The comparison of `results` with theory and the study.
pub fn report(theory: &Theory, results: &Results) -> ComparisonReport {
    ComparisonReport { rows: rows(theory, results), notes: notes(theory, results) }
}

fn rows(theory: &Theory, results: &Results) -> Vec<ComparisonRow> {
    use Cell::{Empty, Number, Scientific, Text};
    use Note::{Energy, Force, Frequency, Inputs, Nothing, Ripple, Start, Stiffness};
    let [speed, load, stiffness] = defaults();
    let (straight, turning) = (&results.straight, &results.turning);
    let carrier = stated::VEHICLE_SPEED.map(|v| theory::carrier_speed(v, stated::TYRE_RADIUS));
    let [ahead, turn] =
        [(CARRIER_SPEED[0], 0.0), (CARRIER_SPEED[1], PLANET_SPIN)].map(|(c, p)| theory.side_speeds(c, p));
    let sum = |speeds: [f64; 2]| speeds[0] + speeds[1];
    let mean = |values: [f64; 2]| (values[0] + values[1]) / 2.0;
    let frequency = theory.mesh_frequency(PLANET_SPIN);
    let input = |study, theory, program| [study, theory, program].map(|value| Number(value, 2));
    let speeds = |study, theory, program| [Number(study, 0), Number(theory, 3), Number(program, 3)];
    let ripple = |theory, program| [Text(format!("{} %", 2.0 * RIPPLE)), theory, Text(format!("{program:.2} %"))];
    let tangential = |program| [FORCE, theory.outer_tangential_force(LOAD), program].map(|force| Number(force, 0));
    let normal = |program| [Empty, Number(theory.normal_force(LOAD), 0), Number(mean(program), 0)];
    let line = |frequency: Option<f64>| frequency.map_or(Text("none".into()), |f| Number(f, 3));
    let energy = |program| [Empty, Number(0.0, 0), Scientific(program)];
    let alone = |program, decimals| [Empty, Empty, Number(program, decimals)];
    let stiffnesses = [stated::STIFFNESS_PRINTED, per_mm15(theory.hertz_stiffness()), stiffness].map(Scientific);
    let start = [Text("spikes".into()), Empty, Number(straight.peak_tangential_force, 0)];
    let mesh =
        [Number(stated::MESH_FREQUENCY, 1), Number(theory.mesh_frequency(0.0), 3), Number(straight.mesh_frequency, 3)];
    vec![
        row(Inputs, "input: carrier at 60 km/h, deg/s", input(CARRIER_SPEED[0], carrier[0], speed)),
        row(Inputs, "input: carrier at 20 km/h, deg/s", input(CARRIER_SPEED[1], carrier[1], turning.carrier_speed)),
        row(Inputs, "input: load per half-shaft, N.m", input(LOAD, theory::load_torque(), load)),
        row(Stiffness, "input: stiffness K, N/mm^1.5", stiffnesses),
        row(Nothing, "straight: left, deg/s", speeds(STRAIGHT_SPEEDS[0], ahead[0], straight.side_speeds[0])),
        row(Nothing, "straight: right, deg/s", speeds(STRAIGHT_SPEEDS[1], ahead[1], straight.side_speeds[1])),
        row(Ripple, "straight: ripple, peak to peak", ripple(Text("0.00 %".into()), straight.ripple[0])),
        row(Nothing, "turn: left, deg/s", speeds(TURNING_SPEEDS[0], turn[0], turning.side_speeds[0])),
        row(Nothing, "turn: right, deg/s", speeds(TURNING_SPEEDS[1], turn[1], turning.side_speeds[1])),
        row(Nothing, "turn: sum, deg/s", speeds(sum(TURNING_SPEEDS), sum(turn), sum(turning.side_speeds))),
        row(Ripple, "turn: ripple left, peak to peak", ripple(Empty, turning.ripple[0])),
        row(Ripple, "turn: ripple right, peak to peak", ripple(Empty, turning.ripple[1])),
        row(Force, "T/r_p, all planets, outer, N", tangential(straight.tangential_force[0])),
        row(Force, "turn: T/r_p, N", tangential(turning.tangential_force[0])),
        row(Force, "normal force per mesh, N", normal(straight.normal_force)),
        row(Force, "turn: normal force per mesh, N", normal(turning.normal_force)),
        row(Start, "start: largest T/r_p, N", start),
        row(Start, "start: settled after, ms", alone(straight.settled_after * 1e3, 2)),
        row(Frequency, "straight: mesh frequency, Hz", mesh),
        row(Frequency, "straight: first line of force, Hz", [Empty, Text("none".into()), line(straight.first_line)]),
        row(Frequency, "turn: mesh frequency, Hz", [Empty, Number(frequency, 3), Number(turning.mesh_frequency, 3)]),
        row(Frequency, "turn: first line of force, Hz", [Empty, Number(frequency, 3), line(turning.first_line)]),
        row(Energy, "straight: energy residual", energy(straight.relative_energy_residual)),
        row(Energy, "turn: energy residual", energy(turning.relative_energy_residual)),
        row(Nothing, "straight: integrator steps", alone(straight.steps, 0)),
        row(Nothing, "turn: integrator steps", alone(turning.steps, 0)),
    ]
}

/// Texts of the notes in the order of `Note`, then one that belongs to no row.
fn notes(theory: &Theory, results: &Results) -> Vec<String> {
    let [speed, load, stiffness] = defaults();
    let hertz = per_mm15(theory.hertz_stiffness());
    let carrier = stated::VEHICLE_SPEED.map(|v| theory::carrier_speed(v, stated::TYRE_RADIUS));
    let geometry = Parameters::default().geometry;
    let side = theory.pair().outer_pitch_diameter(1) * 1e3 / 2.0;
    let straight = &results.straight;
    let [undercut, jams] = theory.standard_addenda_interfere();
    let consequence = match (undercut, jams) {
        (true, true) => "undercut the planet and jam in the side gear",
        (true, false) => "undercut the planet: the side gear's tips reach below its base circle",
        (false, true) => "jam in the side gear",
        (false, false) => "are free of interference",
    };
    let [sphere, planar] = theory.contact_ratios();
    vec![
        format!(
            "The study rounds its inputs: unrounded they are {:.2} and {:.2} deg/s (v / tyre radius) and {:.2} N.m \
             (mass · g · front share · adhesion · tyre radius, half of it on each side). The program runs with the \
             study's {speed:.0} and {:.0} deg/s and {load:.0} N.m, so that results compare.",
            carrier[0],
            carrier[1],
            theory::load_torque(),
            stated::CARRIER_SPEED[1]
        ),
        format!(
            "K = 4/3 √R E* is {hertz:.4e} N/mm^1.5. The study prints {:.2e}, a factor ten off, and then uses {:.2e}, \
             {:+.1} %. The program's default is the value used, {stiffness:.2e}; contact.stiffness_from_hertz takes the \
             formula's.",
            stated::STIFFNESS_PRINTED,
            stated::STIFFNESS_USED,
            (stated::STIFFNESS_USED / hertz - 1.0) * 100.0
        ),
        format!(
            "The study says ±{} % for all speeds. Settled, straight driving has no ripple, because no tooth rolls. In \
             the turn the exact tooth form gives no more than this with the study's contact law and constants.",
            stated::RIPPLE
        ),
        format!(
            "T/r_p with r_p = {side:.0} mm is the tangential force of all planets on one side gear, referred to its \
             outer pitch circle. Teeth carry it around the mean cone distance: with {} planets each mesh has F_t = \
             {:.0} N and F_n = {:.0} N.",
            geometry.planet_count,
            theory.mean_tangential_force(stated::LOAD),
            theory.normal_force(stated::LOAD)
        ),
        format!(
            "Started in mid-play, the load throws the side gears back until the teeth strike: the force peaks after \
             {:.0} µs at {:.2} times the static one, and speeds are within {:.0} % of theory after {:.2} ms. The study's \
             output every {:.0} ms cannot see this.",
            straight.peak_time * 1e6,
            straight.peak_tangential_force / theory.outer_tangential_force(stated::LOAD),
            SETTLED_BAND * 100.0,
            straight.settled_after * 1e3,
            stated::INTERVAL * 1e3
        ),
        format!(
            "Straight ahead planets and side gears do not roll on each other: the mesh frequency z_p |spin| / 360 is \
             {:.0} Hz, in the turn {:.3} Hz. The study's {} Hz is ten times the carrier's rotation ({:.2} Hz).",
            theory.mesh_frequency(0.0),
            theory.mesh_frequency(stated::PLANET_SPIN),
            stated::MESH_FREQUENCY,
            f64::from(geometry.planet_teeth) * stated::CARRIER_SPEED[0] / 360.0
        ),
        "Stored energy less work of the inputs plus heat, over the energy that went through in the same time; zero \
         for an exact solution."
            .to_owned(),
        format!(
            "Geometry: standard addenda (1.0 modules) {consequence}; the limit is {:.3} modules at {:.0} deg. Long and short \
             addenda, the default, cure it. The face width of {:.0} mm is {:.3} R_e, above the usual R_e/3. The contact ratio is {:.4} \
             on the sphere; Tredgold's planar approximation, which the study uses, gives {:.4} ({:+.2} %).",
            theory.addendum_limit(),
            geometry.pressure_angle.to_degrees(),
            geometry.face_width * 1e3,
            theory.relative_face_width(),
            sphere,
            planar,
            100.0 * (planar / sphere - 1.0)
        ),
    ]
}
