//! Rows of the continuous states and their derivatives, for solvers of the host's.
//!
//! Some states are outputs; the others, and all derivatives, are local. What a scene does not have is 0.

use super::access::{Access, OutputSource, Variable};
use crate::declaration::units::{self, DEG, DEG_PER_S, DisplayUnit, MM, Unit};
use crate::declaration::{Causality, row};
use crate::model::{ATTACHED, Attached, BODIES, Body, STATES};

/// A state and its derivative.
struct State {
    name: &'static str,
    derivative: &'static str,
    description: &'static str,
    /// Magnitude that errors are to be measured by.
    nominal: f64,
    unit: Unit,
    display: Option<DisplayUnit>,
    rate_unit: Unit,
}

/// How a body moves: units of position, velocity and acceleration.
struct Kind {
    units: [Unit; 3],
    display: [Option<DisplayUnit>; 2],
}

const TURNS: Kind =
    Kind { units: [units::RADIAN, units::RAD_PER_S, units::RAD_PER_S2], display: [Some(DEG), Some(DEG_PER_S)] };
const SHIFTS: Kind = Kind { units: [units::METRE, units::M_PER_S, units::M_PER_S2], display: [Some(MM), None] };

/// Deflection of teeth as the angle of a gear [rad].
const DEFLECTION: f64 = 1e-3;
/// A turn of the carrier [rad].
const TURN: f64 = 1.0;
/// Twist of a half-shaft [rad].
const TWIST: f64 = 1e-2;
/// Axial play [m].
const PLAY: f64 = 1e-5;
/// Speed of gears [rad/s].
const SPEED: f64 = 10.0;
/// Speed of seats [m/s].
const AXIAL_SPEED: f64 = 1e-2;

fn states(kind: &Kind, what: &str, names: [&'static str; 2], nominal: [f64; 2]) -> [State; 2] {
    [(0, "position"), (1, "velocity")].map(|(i, part)| State {
        name: names[i],
        derivative: format!("der({})", names[i]).leak(),
        description: format!("{what}: {part}").leak(),
        nominal: nominal[i],
        unit: kind.units[i],
        display: kind.display[i],
        rate_unit: kind.units[i + 1],
    })
}

/// Position and velocity of each body.
fn bodies() -> Vec<(Body, [State; 2])> {
    type Named = (Body, &'static Kind, &'static str, [&'static str; 2], [f64; 2]);
    let gears: [Named; 13] = [
        (
            Body::Side(0),
            &TURNS,
            "Left side gear, its angle counted from the carrier",
            ["left.relative_angle", "left.speed"],
            [DEFLECTION, SPEED],
        ),
        (
            Body::Side(1),
            &TURNS,
            "Right side gear, its angle counted from the carrier",
            ["right.relative_angle", "right.speed"],
            [DEFLECTION, SPEED],
        ),
        (Body::Carrier, &TURNS, "Carrier", ["carrier.angle", "carrier.speed"], [TURN, SPEED]),
        (
            Body::Seat(0),
            &SHIFTS,
            "Left side gear along its axis, away from the apex",
            ["left.seat_position", "left.seat_speed"],
            [PLAY, AXIAL_SPEED],
        ),
        (
            Body::Seat(1),
            &SHIFTS,
            "Right side gear along its axis, away from the apex",
            ["right.seat_position", "right.seat_speed"],
            [PLAY, AXIAL_SPEED],
        ),
        (
            Body::Planet(0),
            &TURNS,
            "Planet on its pin",
            ["planet[1].spin_angle", "planet[1].spin_speed"],
            [DEFLECTION, SPEED],
        ),
        (
            Body::Planet(1),
            &TURNS,
            "Planet on its pin",
            ["planet[2].spin_angle", "planet[2].spin_speed"],
            [DEFLECTION, SPEED],
        ),
        (
            Body::Planet(2),
            &TURNS,
            "Planet on its pin",
            ["planet[3].spin_angle", "planet[3].spin_speed"],
            [DEFLECTION, SPEED],
        ),
        (
            Body::Planet(3),
            &TURNS,
            "Planet on its pin",
            ["planet[4].spin_angle", "planet[4].spin_speed"],
            [DEFLECTION, SPEED],
        ),
        (
            Body::Pin(0),
            &TURNS,
            "Pin, its angle counted from the carrier",
            ["planet[1].pin_angle", "planet[1].pin_speed"],
            [DEFLECTION, SPEED],
        ),
        (
            Body::Pin(1),
            &TURNS,
            "Pin, its angle counted from the carrier",
            ["planet[2].pin_angle", "planet[2].pin_speed"],
            [DEFLECTION, SPEED],
        ),
        (
            Body::Pin(2),
            &TURNS,
            "Pin, its angle counted from the carrier",
            ["planet[3].pin_angle", "planet[3].pin_speed"],
            [DEFLECTION, SPEED],
        ),
        (
            Body::Pin(3),
            &TURNS,
            "Pin, its angle counted from the carrier",
            ["planet[4].pin_angle", "planet[4].pin_speed"],
            [DEFLECTION, SPEED],
        ),
    ];
    let attached = |(k, body): (usize, &Attached)| (Body::Attached(k), &TURNS, body.what, body.states, [TWIST, SPEED]);
    let all = gears.into_iter().chain(ATTACHED.iter().enumerate().map(attached));
    all.map(|(body, kind, what, names, nominal)| (body, states(kind, what, names, nominal))).collect()
}

fn local(name: &'static str, unit: Unit, source: OutputSource, description: &'static str) -> Variable {
    let row = row(name, description).output(unit, Access::Output(source));
    Variable { causality: Causality::Local, ..row }
}

/// Adds the rows that are missing to `rows`, sets the states' magnitudes there, and returns the indices of states and
/// derivatives in the order of the states: positions of `BODIES`, then velocities.
pub fn complete(rows: &mut Vec<Variable>) -> ([usize; STATES], [usize; STATES]) {
    let (mut indices, mut derivatives) = ([0; STATES], [0; STATES]);
    let mut numbered = Vec::new();
    for (body, [position, velocity]) in bodies() {
        let number = BODIES.iter().position(|&b| b == body).unwrap_or(0);
        numbered.push((number, position));
        numbered.push((number + BODIES.len(), velocity));
    }
    for &(k, ref state) in &numbered {
        let found = rows.iter().position(|row| row.name == state.name);
        indices[k] = found.unwrap_or_else(|| {
            let row = local(state.name, state.unit, OutputSource::State(k), state.description);
            rows.push(Variable { display: state.display, ..row });
            rows.len() - 1
        });
        rows[indices[k]].nominal = Some(state.nominal);
    }
    for &(k, ref state) in &numbered {
        let row = local(state.derivative, state.rate_unit, OutputSource::Rate(k), "Time derivative of the state");
        derivatives[k] = rows.len();
        rows.push(Variable { derivative_of: Some(indices[k]), ..row });
    }
    (indices, derivatives)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_body_has_its_states_and_no_other() {
        let named: Vec<Body> = bodies().into_iter().map(|(body, _)| body).collect();
        assert_eq!(named, BODIES);
    }
}
