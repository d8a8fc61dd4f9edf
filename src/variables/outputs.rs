//! Rows of the outputs.

use super::access::OutputSource::{self, Reading};
use crate::declaration::units::*;
use crate::declaration::{Row, SIDES, Shown, filled, row};
use crate::model::{ALL_HEATS, Changes, MAX_PLANETS, TOOTH_PAIRS, efficiency, readings};

/// Placeholders with two values each, as written in names and in descriptions.
const EITHER: [(&str, [&str; 2], [&str; 2]); 2] =
    [("{side}", SIDES, SIDES), ("{gear}", ["planet", "side"], ["planet", "side gear"])];
/// Placeholder for a number, counted from 1.
const NUMBER: &str = "{i}";

/// Adds outputs to `$rows`. The doc comment is the description; the unit, the display unit and the source follow. An
/// output whose name contains `{side}` or `{gear}` exists for both of them, and one whose name contains `planet[{i}]`
/// or `pair[{i}]` for each planet or pair. Its source reads the value by an index: the side or gear, the planet, the
/// pair, or twice the planet plus the side.
macro_rules! outputs {
    ($rows:ident: $($(#[doc = $line:literal])+ $name:literal: $unit:expr, $source:ident($of:expr);)+) => {
        $(add(&mut $rows, $name, concat!($($line),+).trim_start(), $unit.into(), |i| OutputSource::$source(i, $of));)+
    };
}

pub(super) use outputs;

/// Adds the rows of the output `name`.
pub fn add(
    rows: &mut Vec<Row<OutputSource>>,
    name: &'static str,
    description: &'static str,
    shown: Shown,
    source: fn(usize) -> OutputSource,
) {
    let either = EITHER.iter().find(|(placeholder, ..)| name.contains(placeholder));
    let two = if either.is_some() { 2 } else { 1 };
    let count = match name {
        _ if !name.contains(NUMBER) => 1,
        _ if name.starts_with("planet") => MAX_PLANETS,
        _ => TOOTH_PAIRS,
    };
    for index in 0..count * two {
        let number = (index / two + 1).to_string();
        let [in_name, in_text] = either.map_or(["", ""], |(_, names, texts)| [names[index % two], texts[index % two]]);
        let name = filled(name, |placeholder| if placeholder == "i" { &number } else { in_name });
        let description = filled(description, |_| in_text);
        rows.push(row(name, description).output(shown, source(index)));
    }
}

/// Rows of all outputs.
pub fn rows() -> Vec<Row<OutputSource>> {
    let mut rows = own();
    for (index, heat) in ALL_HEATS.iter().enumerate() {
        let source = OutputSource::Ledger(index, |ledger, index| ledger.heat[index]);
        rows.push(row(heat.output, heat.description).output(JOULE, source));
    }
    let (mut at_instants, mut by_steps) = (0.., 0..);
    for reading in readings() {
        let indices = match reading.changes {
            Changes::Always => &mut at_instants,
            Changes::ByStep => &mut by_steps,
        };
        let index = indices.next().unwrap_or(0);
        let source = match (reading.changes, reading.choices) {
            (Changes::Always, _) => Reading(index),
            (Changes::ByStep, None) => OutputSource::Ledger(index, |ledger, index| ledger.readings[index]),
            (Changes::ByStep, Some(kind)) => OutputSource::Choice(kind, index),
        };
        rows.push(row(reading.name, reading.description).output(Shown(reading.unit, reading.display), source));
    }
    rows
}

/// Rows of the outputs that belong to no effect.
fn own() -> Vec<Row<OutputSource>> {
    let mut rows = Vec::new();
    outputs! { rows:
        /// Carrier angle since the start
        "carrier.angle": RADIAN | DEG, Motion(|m, _| m.carrier_angle);
        /// Carrier speed
        "carrier.speed": RAD_PER_S | DEG_PER_S, Motion(|m, _| m.carrier_speed);
        /// Carrier acceleration
        "carrier.acceleration": RAD_PER_S2, Forces(|f, _| f.carrier_acceleration);
        /// Torque on the carrier from its drive: of the ring gear with effects.final_drive
        "carrier.torque": NEWTON_METRE, Forces(|f, _| f.carrier_torque);
        /// Pinion angle since the start; without effects.final_drive, the angle of the carrier
        "pinion.angle": RADIAN | DEG, Motion(|m, _| m.drive_angle[0]);
        /// Pinion speed, positive if it drives forward; without effects.final_drive, the speed of the carrier
        "pinion.speed": RAD_PER_S | DEG_PER_S, Motion(|m, _| m.drive_speed[0]);
        /// Torque that the shaft delivers to the pinion; without effects.final_drive, the torque on the carrier
        "pinion.torque": NEWTON_METRE, Forces(|f, _| f.pinion_torque);
        /// Angle of the body that the drive turns: the driven end of the propeller shaft, otherwise the pinion
        "propeller.angle": RADIAN | DEG, Motion(|m, _| m.drive_angle[1]);
        /// Speed of the body that the drive turns: the driven end of the propeller shaft, otherwise the pinion
        "propeller.speed": RAD_PER_S | DEG_PER_S, Motion(|m, _| m.drive_speed[1]);
        /// Torque of the drive on this body
        "propeller.torque": NEWTON_METRE, Forces(|f, _| f.port_torque);
        /// Side gear angle, including lash and deflection; 0 if assembled with teeth in mid-gap; for a wheel behind a
        /// half-shaft read {side}.wheel_angle
        "{side}.angle": RADIAN | DEG, Motion(|m, s| m.side_angle[s]);
        /// Side gear speed; for a wheel behind a half-shaft read {side}.wheel_speed
        "{side}.speed": RAD_PER_S | DEG_PER_S, Motion(|m, s| m.side_speed[s]);
        /// Wheel angle, for brakes and tyres: {side}.angle - {side}.twist if the wheel end of the half-shaft is a
        /// separate body, otherwise {side}.angle
        "{side}.wheel_angle": RADIAN | DEG, Motion(|m, s| m.wheel_angle[s]);
        /// Wheel speed, for brakes and tyres: speed of the wheel end of the half-shaft if it is a separate body
        /// (scene.{side}_drive = speed, or effects.half_shaft with inertia.{side}_end above 0), otherwise {side}.speed
        "{side}.wheel_speed": RAD_PER_S | DEG_PER_S, Motion(|m, s| m.wheel_speed[s]);
        /// Side gear acceleration
        "{side}.acceleration": RAD_PER_S2, Forces(|f, s| f.side_acceleration[s]);
        /// Torque that the half-shaft delivers to the wheel
        "{side}.shaft_torque": NEWTON_METRE, Forces(|f, s| f.shaft_torque[s]);
        /// Torque of all meshes on the side gear, divided by the outer pitch radius
        "{side}.tangential_force": NEWTON, Forces(|f, s| f.side_tangential[s]);
        /// Sum of the normal forces of all meshes of the side gear
        "{side}.normal_force": NEWTON, Forces(|f, s| f.side_normal[s]);
        /// Thrust of all meshes on the side gear, away from the apex
        "{side}.thrust_force": NEWTON, Components(|f, s| f.side_thrust[s]);
        /// Spin angle relative to the carrier since the start
        "planet[{i}].spin_angle": RADIAN | DEG, Motion(|m, i| m.spin_angle[i]);
        /// Spin speed relative to the carrier
        "planet[{i}].spin_speed": RAD_PER_S | DEG_PER_S, Motion(|m, i| m.spin_speed[i]);
        /// Normal force of the mesh with the {side} side gear, summed over its tooth pairs
        "planet[{i}].{side}_normal_force": NEWTON, Forces(|f, k| f.mesh[k / 2][k % 2].normal);
        /// Number of loaded tooth pairs in the mesh with the {side} side gear; each counts by its loaded share of the
        /// face
        "planet[{i}].{side}_pairs": ONE, Forces(|f, k| f.mesh[k / 2][k % 2].pairs);
        /// Resultant mesh force on the planet across the pin
        "planet[{i}].pin_force": NEWTON, Components(|f, i| f.pin_force[i]);
        /// Thrust of both meshes on the planet, away from the apex
        "planet[{i}].thrust_force": NEWTON, Components(|f, i| f.planet_thrust[i]);
        /// Approach of the drive flanks to the {side} side gear at the mean cone distance; 0 at first touch
        "planet[{i}].{side}_transmission_error": METRE | MM, Forces(|f, k| f.mesh[k / 2][k % 2].transmission_error);
        /// Tooth number of a loaded pair of planet 1 with the left side gear, counted from 0 on the planet; -1 = no
        /// such pair; pairs are ordered from the planet's root to its tip
        "mesh.pair[{i}].tooth": ONE, Pair(|pair| pair.tooth);
        /// Normal force of this pair, negative on the coast flank
        "mesh.pair[{i}].force": NEWTON, Pair(|pair| pair.force);
        /// Contact position of this pair on the planet profile: distance from the pitch circle toward the tip, at the
        /// mean cone distance
        "mesh.pair[{i}].height": METRE | MM, Pair(|pair| pair.height);
        /// Hertz pressure of this pair at the toe
        "mesh.pair[{i}].toe_pressure": PASCAL | MPA, Pair(|pair| pair.pressure[0]);
        /// Hertz pressure of this pair at the mean cone distance
        "mesh.pair[{i}].middle_pressure": PASCAL | MPA, Pair(|pair| pair.pressure[1]);
        /// Hertz pressure of this pair at the heel
        "mesh.pair[{i}].heel_pressure": PASCAL | MPA, Pair(|pair| pair.pressure[2]);
        /// Total torque that the spin drive exerts on all planets; 0 if the spin is free
        "spin.torque": NEWTON_METRE, Forces(|f, _| f.spin_torque);
        /// Tooth engagements of one mesh per second
        "mesh.frequency": HERTZ, Motion(|m, _| m.mesh_frequency);
        /// Power delivered by the drive, at its port, and by the spin drive
        "power.in": WATT, Forces(|f, _| f.power_in);
        /// Power delivered to the wheels
        "power.out": WATT, Forces(|f, _| f.power_out);
        /// Power turned into heat within the differential; power of the wheel brakes is part of power.out
        "power.loss": WATT, Forces(|f, _| f.power_loss);
        /// 1 - power.loss / power fed in: sum over the drive, left wheel, right wheel and spin drive if they feed
        /// power; at least 0, and 1 if none feeds power
        "efficiency": ONE, Forces(|f, _| efficiency(f));
        /// Ratio of slow to fast half-shaft torque, averaged over the last whole mesh cycle if shafts twist; fast is
        /// the side ahead in the direction of the torque sum; 1 if the sum is below 1e-3 N.m; 1e6 if the fast shaft
        /// transmits no torque, for example if one wheel stands still and the other spins freely; with imposed spin
        /// and imposed loads it is the ratio of the loads, regardless of friction
        "torque_bias_ratio": ONE, Forces(|f, _| f.torque_bias_ratio);
        /// Difference over sum of half-shaft torques, averaged over the last whole mesh cycle if shafts twist; 0 if
        /// the sum is below 1e-3 N.m; at most 1e6
        "locking_value": ONE, Forces(|f, _| f.locking_value);
        /// Number of side gears that dry friction holds to the carrier
        "held.sides": ONE, Ledger(|l, _| l.held[0]);
        /// Number of planet groups that dry friction holds on their pins
        "held.planets": ONE, Ledger(|l, _| l.held[1]);
        /// Number of wheels that their brakes hold
        "held.wheels": ONE, Ledger(|l, _| l.held[2]);
        /// Number of clutches on command that hold
        "held.clutches": ONE, Ledger(|l, _| l.held[3]);
        /// Number of accepted steps
        "solver.steps": ONE, Ledger(|l, _| l.steps);
        /// Number of rejected steps
        "solver.rejected": ONE, Ledger(|l, _| l.rejected);
        /// Number of tooth force evaluations
        "solver.rhs_calls": ONE, Ledger(|l, _| l.rhs_calls);
        /// Size of the last accepted step
        "solver.step_size": SECOND, Ledger(|l, _| l.step_size);
        /// Stored energy minus work of the inputs plus heat; 0 for an exact solution
        "solver.energy_residual": JOULE, Ledger(|l, _| l.energy_residual);
    }
    rows
}
