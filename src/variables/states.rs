//! Rows of the continuous states and their derivatives, for the host's solvers.
//!
//! Some states are outputs; the other states and all derivatives are local variables. States of bodies that a scene
//! does not have are 0.

use super::{Access, OutputSource, Variable};
use crate::declaration::units::{self, DEG, DEG_PER_S, MM};
use crate::declaration::{Causality, DisplayUnit, SIDES, Unit, row};
use crate::model::{ATTACHED, BODIES, Body, STATES};
use crate::static_memory::store_text;

/// A state and its derivative.
struct State {
    name: String,
    derivative: String,
    description: String,
    /// Nominal value for the error control of the host's solver.
    nominal: f64,
    unit: Unit,
    display: Option<DisplayUnit>,
    rate_unit: Unit,
}

/// Kind of motion of a body: units of position, velocity and acceleration.
struct Kind {
    units: [Unit; 3],
    display: [Option<DisplayUnit>; 2],
}

const TURNS: Kind =
    Kind { units: [units::RADIAN, units::RAD_PER_S, units::RAD_PER_S2], display: [Some(DEG), Some(DEG_PER_S)] };
const SHIFTS: Kind = Kind { units: [units::METRE, units::M_PER_S, units::M_PER_S2], display: [Some(MM), None] };

/// Tooth deflection as the angle of a gear [rad].
const DEFLECTION: f64 = 1e-3;
/// Angle of the carrier [rad].
const ANGLE: f64 = 1.0;
/// Twist of a half-shaft [rad].
const TWIST: f64 = 1e-2;
/// Shift of seats [m].
const AXIAL: f64 = 1e-5;
/// Speed of gears [rad/s].
const SPEED: f64 = 10.0;
/// Speed of seats [m/s].
const AXIAL_SPEED: f64 = 1e-2;

/// Returns the position and velocity states of a body.
fn states(body: Body) -> [State; 2] {
    let of = match body {
        Body::Side(s) | Body::Seat(s) => SIDES[s].into(),
        Body::Carrier => "carrier".into(),
        Body::Planet(i) | Body::Pin(i) => format!("planet[{}]", i + 1),
        Body::Attached(k) => ATTACHED[k].of.into(),
    };
    let (kind, descriptions, names, nominal) = match body {
        Body::Side(_) => (
            &TURNS,
            ["{side} side gear angle relative to the carrier", "{side} side gear speed"],
            ["relative_angle", "speed"],
            [DEFLECTION, SPEED],
        ),
        Body::Carrier => (&TURNS, ["Carrier angle", "Carrier speed"], ["angle", "speed"], [ANGLE, SPEED]),
        Body::Seat(_) => (
            &SHIFTS,
            [
                "{side} side gear position along its axis, away from the apex",
                "{side} side gear speed along its axis, away from the apex",
            ],
            ["seat_position", "seat_speed"],
            [AXIAL, AXIAL_SPEED],
        ),
        Body::Planet(_) => {
            (&TURNS, ["Planet spin angle", "Planet spin speed"], ["spin_angle", "spin_speed"], [DEFLECTION, SPEED])
        }
        Body::Pin(_) => (
            &TURNS,
            ["Pin angle relative to the carrier", "Absolute pin speed"],
            ["pin_angle", "pin_speed"],
            [DEFLECTION, SPEED],
        ),
        Body::Attached(k) => (&TURNS, ATTACHED[k].descriptions, ATTACHED[k].states, [TWIST, SPEED]),
    };
    let side = if let Body::Side(0) | Body::Seat(0) = body { "Left" } else { "Right" };
    [0, 1].map(|i| State {
        name: format!("{of}.{}", names[i]),
        derivative: format!("der({of}.{})", names[i]),
        description: descriptions[i].replace("{side}", side),
        nominal: nominal[i],
        unit: kind.units[i],
        display: kind.display[i],
        rate_unit: kind.units[i + 1],
    })
}

fn local(name: &'static str, unit: Unit, source: OutputSource, description: &'static str) -> Variable {
    let row = row(name, description).output(unit, Access::Output(source));
    Variable { causality: Causality::Local, ..row }
}

/// Adds the missing rows to `rows` and sets the nominal values of all states. Returns the indices of states and
/// derivatives: positions in the order of `BODIES`, then velocities.
pub fn complete(rows: &mut Vec<Variable>) -> ([usize; STATES], [usize; STATES]) {
    let (mut indices, mut derivatives) = ([0; STATES], [0; STATES]);
    let mut numbered = Vec::new();
    for (number, body) in BODIES.into_iter().enumerate() {
        let [position, velocity] = states(body);
        numbered.extend([(number, position), (number + BODIES.len(), velocity)]);
    }
    for &(k, ref state) in &numbered {
        let found = rows.iter().position(|row| row.name == state.name);
        indices[k] = found.unwrap_or_else(|| {
            let [name, description] = [&state.name, &state.description].map(|text| store_text(text));
            let row = local(name, state.unit, OutputSource::State(k), description);
            rows.push(Variable { display: state.display, ..row });
            rows.len() - 1
        });
        rows[indices[k]].nominal = Some(state.nominal);
    }
    for &(k, ref state) in &numbered {
        let row = local(
            store_text(&state.derivative),
            state.rate_unit,
            OutputSource::Rate(k),
            "Time derivative of the state",
        );
        derivatives[k] = rows.len();
        rows.push(Variable { derivative_of: Some(indices[k]), ..row });
    }
    (indices, derivatives)
}
