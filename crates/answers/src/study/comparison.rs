//! Rows and notes of the comparison: the study, theory, this program.

use bevel_differential::model::Parameters;

use crate::study::evaluation::{Results, SETTLED_BAND, defaults};
use crate::study::published;
use crate::study::report::{Cell, ComparisonReport, ComparisonRow};
use crate::study::theory::{self, Theory};

/// N/m^1.5 in N/mm^1.5.
fn per_mm15(stiffness: f64) -> f64 {
    stiffness / 1e3f64.powf(1.5)
}

fn row(quantity: &'static str, study: Cell, theory: Cell, program: Cell) -> ComparisonRow {
    ComparisonRow { quantity, study, theory, program, note: None }
}

/// Notes that rows point to, numbered from 1 in this order.
#[derive(Clone, Copy)]
enum Note {
    Inputs = 1,
    Stiffness,
    Ripple,
    Force,
    Start,
    Frequency,
    Energy,
}

fn noted(note: Note, row: ComparisonRow) -> ComparisonRow {
    ComparisonRow { note: Some(note as usize), ..row }
}

/// The comparison of `results` with theory and the study.
pub fn report(theory: &Theory, results: &Results) -> ComparisonReport {
    ComparisonReport { rows: rows(theory, results), notes: notes(theory, results) }
}

fn rows(theory: &Theory, results: &Results) -> Vec<ComparisonRow> {
    use Cell::{Empty, Number, Power, Text};
    let [speed, load, stiffness] = defaults();
    let (straight, turning) = (&results.straight, &results.turning);
    let carrier = published::VEHICLE_SPEED.map(|v| theory::carrier_speed(v, published::TYRE_RADIUS));
    let [straight_speeds, turning_speeds] = [
        theory.side_speeds(published::CARRIER_SPEED[0], 0.0),
        theory.side_speeds(published::CARRIER_SPEED[1], published::PLANET_SPIN),
    ];
    let sum = |speeds: [f64; 2]| speeds[0] + speeds[1];
    let mean = |values: [f64; 2]| (values[0] + values[1]) / 2.0;
    let frequency = theory.mesh_frequency(published::PLANET_SPIN);
    let normal_force = theory.normal_force(published::LOAD);
    let tangential_force = theory.outer_tangential_force(published::LOAD);
    let ripple = || Text(format!("{} %", 2.0 * published::RIPPLE));
    let percent = |value: f64| Text(format!("{value:.2} %"));
    vec![
        noted(
            Note::Inputs,
            row(
                "input: carrier at 60 km/h, deg/s",
                Number(published::CARRIER_SPEED[0], 2),
                Number(carrier[0], 2),
                Number(speed, 2),
            ),
        ),
        noted(
            Note::Inputs,
            row(
                "input: carrier at 20 km/h, deg/s",
                Number(published::CARRIER_SPEED[1], 2),
                Number(carrier[1], 2),
                Number(turning.carrier_speed, 2),
            ),
        ),
        noted(
            Note::Inputs,
            row(
                "input: load per half-shaft, N.m",
                Number(published::LOAD, 2),
                Number(theory::load_torque(), 2),
                Number(load, 2),
            ),
        ),
        noted(
            Note::Stiffness,
            row(
                "input: stiffness K, N/mm^1.5",
                Power(published::STIFFNESS_PRINTED),
                Power(per_mm15(theory.hertz_stiffness())),
                Power(stiffness),
            ),
        ),
        row(
            "straight: left, deg/s",
            Number(published::STRAIGHT_SPEEDS[0], 0),
            Number(straight_speeds[0], 3),
            Number(straight.side_speeds[0], 3),
        ),
        row(
            "straight: right, deg/s",
            Number(published::STRAIGHT_SPEEDS[1], 0),
            Number(straight_speeds[1], 3),
            Number(straight.side_speeds[1], 3),
        ),
        noted(Note::Ripple, row("straight: ripple, peak to peak", ripple(), percent(0.0), percent(straight.ripple[0]))),
        row(
            "turn: left, deg/s",
            Number(published::TURNING_SPEEDS[0], 0),
            Number(turning_speeds[0], 3),
            Number(turning.side_speeds[0], 3),
        ),
        row(
            "turn: right, deg/s",
            Number(published::TURNING_SPEEDS[1], 0),
            Number(turning_speeds[1], 3),
            Number(turning.side_speeds[1], 3),
        ),
        row(
            "turn: sum, deg/s",
            Number(sum(published::TURNING_SPEEDS), 0),
            Number(sum(turning_speeds), 3),
            Number(sum(turning.side_speeds), 3),
        ),
        noted(Note::Ripple, row("turn: ripple left, peak to peak", ripple(), Empty, percent(turning.ripple[0]))),
        noted(Note::Ripple, row("turn: ripple right, peak to peak", ripple(), Empty, percent(turning.ripple[1]))),
        noted(
            Note::Force,
            row(
                "T/r_p, all planets, outer, N",
                Number(published::FORCE, 0),
                Number(tangential_force, 0),
                Number(straight.tangential_force[0], 0),
            ),
        ),
        noted(
            Note::Force,
            row(
                "turn: T/r_p, N",
                Number(published::FORCE, 0),
                Number(tangential_force, 0),
                Number(turning.tangential_force[0], 0),
            ),
        ),
        noted(
            Note::Force,
            row("normal force per mesh, N", Empty, Number(normal_force, 0), Number(mean(straight.normal_force), 0)),
        ),
        noted(
            Note::Force,
            row(
                "turn: normal force per mesh, N",
                Empty,
                Number(normal_force, 0),
                Number(mean(turning.normal_force), 0),
            ),
        ),
        noted(
            Note::Start,
            row("start: largest T/r_p, N", Text("spikes".into()), Empty, Number(straight.peak_tangential_force, 0)),
        ),
        noted(Note::Start, row("start: settled after, ms", Empty, Empty, Number(straight.settled_after * 1e3, 2))),
        noted(
            Note::Frequency,
            row(
                "straight: mesh frequency, Hz",
                Number(published::MESH_FREQUENCY, 1),
                Number(theory.mesh_frequency(0.0), 3),
                Number(straight.mesh_frequency, 3),
            ),
        ),
        noted(
            Note::Frequency,
            row("straight: first line of force, Hz", Empty, Text("none".into()), line(straight.first_line)),
        ),
        noted(
            Note::Frequency,
            row("turn: mesh frequency, Hz", Empty, Number(frequency, 3), Number(turning.mesh_frequency, 3)),
        ),
        noted(
            Note::Frequency,
            row("turn: first line of force, Hz", Empty, Number(frequency, 3), line(turning.first_line)),
        ),
        noted(
            Note::Energy,
            row("straight: energy residual", Empty, Number(0.0, 0), Power(straight.relative_energy_residual)),
        ),
        noted(
            Note::Energy,
            row("turn: energy residual", Empty, Number(0.0, 0), Power(turning.relative_energy_residual)),
        ),
        row("straight: integrator steps", Empty, Empty, Number(straight.steps, 0)),
        row("turn: integrator steps", Empty, Empty, Number(turning.steps, 0)),
    ]
}

fn line(frequency: Option<f64>) -> Cell {
    frequency.map_or(Cell::Text("none".into()), |f| Cell::Number(f, 3))
}

fn notes(theory: &Theory, results: &Results) -> Vec<String> {
    let [speed, load, stiffness] = defaults();
    let hertz = per_mm15(theory.hertz_stiffness());
    let carrier = published::VEHICLE_SPEED.map(|v| theory::carrier_speed(v, published::TYRE_RADIUS));
    let geometry = Parameters::default().geometry;
    let side = theory.pair().outer_pitch_diameter(1) * 1e3 / 2.0;
    let mut notes = vec![String::new(); Note::Energy as usize];
    notes[Note::Inputs as usize - 1] = format!(
        "The study rounds its inputs: unrounded they are {:.2} and {:.2} deg/s (v / tyre radius) and {:.2} N.m \
         (mass · g · front share · adhesion · tyre radius, half of it on each side). The program runs with the \
         study's {speed:.0} and {:.0} deg/s and {load:.0} N.m, so that results compare.",
        carrier[0],
        carrier[1],
        theory::load_torque(),
        published::CARRIER_SPEED[1]
    );
    notes[Note::Stiffness as usize - 1] = format!(
        "K = 4/3 √R E* is {hertz:.4e} N/mm^1.5. The study prints {:.2e}, a factor ten off, and then uses {:.2e}, \
         {:+.1} %. The program's default is the value used, {stiffness:.2e}; contact.stiffness_from_hertz takes the \
         formula's.",
        published::STIFFNESS_PRINTED,
        published::STIFFNESS_USED,
        (published::STIFFNESS_USED / hertz - 1.0) * 100.0
    );
    notes[Note::Ripple as usize - 1] = format!(
        "The study says ±{} % for all speeds. Settled, straight driving has no ripple, because no tooth rolls. In \
         the turn the exact tooth form gives no more than this with the study's contact law and constants.",
        published::RIPPLE
    );
    let straight = &results.straight;
    notes[Note::Start as usize - 1] = format!(
        "Started in mid-play, the load throws the side gears back until the teeth strike: the force peaks after \
         {:.0} µs at {:.2} times the static one, and speeds are within {:.0} % of theory after {:.2} ms. The study's \
         output every {:.0} ms cannot see this.",
        straight.peak_time * 1e6,
        straight.peak_tangential_force / theory.outer_tangential_force(published::LOAD),
        SETTLED_BAND * 100.0,
        straight.settled_after * 1e3,
        published::INTERVAL * 1e3
    );
    notes[Note::Force as usize - 1] = format!(
        "T/r_p with r_p = {side:.0} mm is the tangential force of all planets on one side gear, referred to its \
         outer pitch circle. Teeth carry it around the mean cone distance: with {} planets each mesh has F_t = \
         {:.0} N and F_n = {:.0} N.",
        geometry.planet_count,
        theory.mean_tangential_force(published::LOAD),
        theory.normal_force(published::LOAD)
    );
    notes[Note::Frequency as usize - 1] = format!(
        "Straight ahead planets and side gears do not roll on each other: the mesh frequency z_p |spin| / 360 is \
         {:.0} Hz, in the turn {:.3} Hz. The study's {} Hz is ten times the carrier's rotation ({:.2} Hz).",
        theory.mesh_frequency(0.0),
        theory.mesh_frequency(published::PLANET_SPIN),
        published::MESH_FREQUENCY,
        f64::from(geometry.planet_teeth) * published::CARRIER_SPEED[0] / 360.0
    );
    notes[Note::Energy as usize - 1] =
        "Stored energy less work of the inputs plus heat, over the energy that went through in the same time; zero \
         for an exact solution."
            .to_owned();
    let [undercut, jams] = theory.standard_addenda_clip();
    let what = match (undercut, jams) {
        (true, true) => "undercut the planet and jam in the side gear",
        (true, false) => "undercut the planet: the side gear's tips reach below its base circle",
        (false, true) => "jam in the side gear",
        (false, false) => "are free of interference",
    };
    let [sphere, planar] = theory.contact_ratios();
    notes.push(format!(
        "Geometry: standard addenda (1.0 m) {what}; the limit is {:.3} m at {:.0} deg. Long and short addenda, the \
         default, cure it. The face width of {:.0} mm is {:.3} R_e, above the usual R_e/3. The contact ratio is {:.4} \
         on the sphere; Tredgold's planar approximation, which the study uses, gives {:.4} ({:+.2} %).",
        theory.addendum_limit(),
        geometry.pressure_angle.to_degrees(),
        geometry.face_width * 1e3,
        theory.relative_face_width(),
        sphere,
        planar,
        100.0 * (planar / sphere - 1.0)
    ));
    notes
}
