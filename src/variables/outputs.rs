//! Rows of the outputs.

use super::access::OutputSource::{self, Components, Forces, Heat, Ledger, LedgerReading, Motion, Pair, Reading};
use crate::declaration::units::{self, DEG, DEG_PER_S, MM, MPA};
use crate::declaration::{Row, Shown, row};
use crate::model::{CONTACT_HEAT, Changes, efficiency, heats, readings};

type Output = Row<OutputSource>;

/// Rows of one side: 0 left, 1 right.
macro_rules! side {
    ($name:literal, $s:literal) => {
        [
            row(
                concat!($name, ".angle"),
                concat!(
                    "Side gear angle, including lash and deflection; 0 if assembled with teeth in mid-gap; for a \
                     wheel behind a half-shaft read ",
                    $name,
                    ".wheel_angle"
                ),
            )
            .output((units::RADIAN, DEG), Motion(|m| m.side_angle[$s])),
            row(
                concat!($name, ".speed"),
                concat!("Side gear speed; for a wheel behind a half-shaft read ", $name, ".wheel_speed"),
            )
            .output((units::RAD_PER_S, DEG_PER_S), Motion(|m| m.side_speed[$s])),
            row(
                concat!($name, ".wheel_angle"),
                concat!(
                    "Wheel angle, for brakes and tyres: ",
                    $name,
                    ".angle - ",
                    $name,
                    ".twist if the wheel end of the half-shaft is a separate body, otherwise ",
                    $name,
                    ".angle"
                ),
            )
            .output((units::RADIAN, DEG), Motion(|m| m.wheel_angle[$s])),
            row(
                concat!($name, ".wheel_speed"),
                concat!(
                    "Wheel speed, for brakes and tyres: speed of the wheel end of the half-shaft if it is a \
                     separate body (scene.",
                    $name,
                    "_drive = speed, or effects.half_shaft with inertia.",
                    $name,
                    "_end above 0), otherwise ",
                    $name,
                    ".speed"
                ),
            )
            .output((units::RAD_PER_S, DEG_PER_S), Motion(|m| m.wheel_speed[$s])),
            row(concat!($name, ".acceleration"), "Side gear acceleration")
                .output(units::RAD_PER_S2, Forces(|f| f.side_acceleration[$s])),
            row(concat!($name, ".shaft_torque"), "Torque that the half-shaft delivers to the wheel")
                .output(units::NEWTON_METRE, Forces(|f| f.shaft_torque[$s])),
            row(
                concat!($name, ".tangential_force"),
                "Torque of all meshes on the side gear, divided by the outer pitch radius",
            )
            .output(units::NEWTON, Forces(|f| f.side_tangential[$s])),
            row(concat!($name, ".normal_force"), "Sum of the normal forces of all meshes of the side gear")
                .output(units::NEWTON, Forces(|f| f.side_normal[$s])),
            row(concat!($name, ".thrust_force"), "Thrust of all meshes on the side gear, away from the apex")
                .output(units::NEWTON, Components(|f| f.side_thrust[$s])),
        ]
    };
}

/// Rows of one planet, numbered from 0 in the code and from 1 in names.
macro_rules! planet {
    ($name:literal, $i:literal) => {
        [
            row(concat!($name, ".spin_angle"), "Spin angle relative to the carrier since the start")
                .output((units::RADIAN, DEG), Motion(|m| m.spin_angle[$i])),
            row(concat!($name, ".spin_speed"), "Spin speed relative to the carrier")
                .output((units::RAD_PER_S, DEG_PER_S), Motion(|m| m.spin_speed[$i])),
            row(
                concat!($name, ".left_normal_force"),
                "Normal force of the mesh with the left side gear, summed over its tooth pairs",
            )
            .output(units::NEWTON, Forces(|f| f.mesh[$i][0].normal)),
            row(
                concat!($name, ".right_normal_force"),
                "Normal force of the mesh with the right side gear, summed over its tooth pairs",
            )
            .output(units::NEWTON, Forces(|f| f.mesh[$i][1].normal)),
            row(concat!($name, ".left_pairs"), "Number of loaded tooth pairs in the mesh with the left side gear")
                .output(units::ONE, Forces(|f| f.mesh[$i][0].pairs)),
            row(concat!($name, ".right_pairs"), "Number of loaded tooth pairs in the mesh with the right side gear")
                .output(units::ONE, Forces(|f| f.mesh[$i][1].pairs)),
            row(concat!($name, ".pin_force"), "Resultant mesh force on the planet across the pin")
                .output(units::NEWTON, Components(|f| f.pin_force[$i])),
            row(concat!($name, ".thrust_force"), "Thrust of both meshes on the planet, away from the apex")
                .output(units::NEWTON, Components(|f| f.planet_thrust[$i])),
            row(
                concat!($name, ".left_transmission_error"),
                "Approach of the drive flanks to the left side gear at the mean cone distance; 0 at first touch",
            )
            .output((units::METRE, MM), Forces(|f| f.mesh[$i][0].transmission_error)),
            row(
                concat!($name, ".right_transmission_error"),
                "Approach of the drive flanks to the right side gear at the mean cone distance; 0 at first touch",
            )
            .output((units::METRE, MM), Forces(|f| f.mesh[$i][1].transmission_error)),
        ]
    };
}

/// Rows of a loaded pair in the mesh of planet 1 with the left side gear, numbered from 0 in the code and from 1 in
/// names.
macro_rules! pair {
    ($name:literal, $k:literal) => {
        [
            row(
                concat!($name, ".tooth"),
                "Tooth number of a loaded pair of planet 1 with the left side gear, counted from 0 on the planet; \
                 -1 = no such pair; pairs are ordered from the planet's root to its tip",
            )
            .output(units::ONE, Pair($k, |pair| pair.tooth)),
            row(concat!($name, ".force"), "Normal force of this pair, negative on the coast flank")
                .output(units::NEWTON, Pair($k, |pair| pair.force)),
            row(
                concat!($name, ".height"),
                "Contact position of this pair on the planet profile: distance from the pitch circle toward the \
                 tip, at the mean cone distance",
            )
            .output((units::METRE, MM), Pair($k, |pair| pair.height)),
            row(concat!($name, ".toe_pressure"), "Hertz pressure of this pair at the toe")
                .output((units::PASCAL, MPA), Pair($k, |pair| pair.pressure[0])),
            row(concat!($name, ".middle_pressure"), "Hertz pressure of this pair at the mean cone distance")
                .output((units::PASCAL, MPA), Pair($k, |pair| pair.pressure[1])),
            row(concat!($name, ".heel_pressure"), "Hertz pressure of this pair at the heel")
                .output((units::PASCAL, MPA), Pair($k, |pair| pair.pressure[2])),
        ]
    };
}

/// Rows of all outputs.
pub fn rows() -> Vec<Output> {
    let mut rows = vec![
        row("carrier.angle", "Carrier angle since the start").output((units::RADIAN, DEG), Motion(|m| m.carrier_angle)),
        row("carrier.speed", "Carrier speed").output((units::RAD_PER_S, DEG_PER_S), Motion(|m| m.carrier_speed)),
        row("carrier.acceleration", "Carrier acceleration")
            .output(units::RAD_PER_S2, Forces(|f| f.carrier_acceleration)),
        row("carrier.torque", "Torque that the drive delivers to the carrier")
            .output(units::NEWTON_METRE, Forces(|f| f.carrier_torque)),
    ];
    rows.extend(side!("left", 0));
    rows.extend(side!("right", 1));
    rows.extend(planet!("planet[1]", 0));
    rows.extend(planet!("planet[2]", 1));
    rows.extend(planet!("planet[3]", 2));
    rows.extend(planet!("planet[4]", 3));
    rows.extend(pair!("mesh.pair[1]", 0));
    rows.extend(pair!("mesh.pair[2]", 1));
    rows.extend(pair!("mesh.pair[3]", 2));
    rows.extend([
        row("spin.torque", "Total torque that the spin drive exerts on all planets; 0 if the spin is free")
            .output(units::NEWTON_METRE, Forces(|f| f.spin_torque)),
        row("mesh.frequency", "Tooth engagements of one mesh per second")
            .output(units::HERTZ, Motion(|m| m.mesh_frequency)),
        row("power.in", "Power delivered by carrier drive and spin drive").output(units::WATT, Forces(|f| f.power_in)),
        row("power.out", "Power delivered to the wheels").output(units::WATT, Forces(|f| f.power_out)),
        row(
            "power.loss",
            "Power turned into heat within the differential; power of the wheel brakes is part of \
                           power.out",
        )
        .output(units::WATT, Forces(|f| f.power_loss)),
        row(
            "efficiency",
            "1 - power.loss / power fed in: sum over carrier drive, left wheel, right wheel and spin drive if they \
             feed power; at least 0, and 1 if none feeds power",
        )
        .output(units::ONE, Forces(efficiency)),
        row(
            "torque_bias_ratio",
            "Ratio of slow to fast half-shaft torque, averaged over the last whole mesh cycle if shafts twist; fast \
             is the side ahead in the direction of the torque sum; 1 if the sum is below 1e-3 N.m; 1e6 if the fast \
             shaft transmits no torque, for example if one wheel stands still and the other spins freely; with \
             imposed spin and imposed loads it is the ratio of the loads, regardless of friction",
        )
        .output(units::ONE, Forces(|f| f.torque_bias_ratio)),
        row(
            "locking_value",
            "Difference over sum of half-shaft torques, averaged over the last whole mesh cycle if shafts twist; 0 \
             if the sum is below 1e-3 N.m; at most 1e6",
        )
        .output(units::ONE, Forces(|f| f.locking_value)),
        row("heat.contact", "Heat of contact damping since the start")
            .output(units::JOULE, Ledger(|l| l.heat[CONTACT_HEAT])),
        row("held.sides", "Number of side gears that dry friction holds to the carrier")
            .output(units::ONE, Ledger(|l| l.held[0])),
        row("held.planets", "Number of planet groups that dry friction holds on their pins")
            .output(units::ONE, Ledger(|l| l.held[1])),
        row("held.wheels", "Number of wheels that their brakes hold").output(units::ONE, Ledger(|l| l.held[2])),
        row("solver.steps", "Number of accepted steps").output(units::ONE, Ledger(|l| l.steps)),
        row("solver.rejected", "Number of rejected steps").output(units::ONE, Ledger(|l| l.rejected)),
        row("solver.rhs_calls", "Number of tooth force evaluations").output(units::ONE, Ledger(|l| l.rhs_calls)),
        row("solver.step_size", "Size of the last accepted step").output(units::SECOND, Ledger(|l| l.step_size)),
        row("solver.energy_residual", "Stored energy minus work of the inputs plus heat; 0 for an exact solution")
            .output(units::JOULE, Ledger(|l| l.energy_residual)),
    ]);
    for (place, heat) in heats().enumerate() {
        let source = Heat(CONTACT_HEAT + 1 + place);
        rows.push(row(heat.output, heat.description).output(units::JOULE, source));
    }
    let (mut at_instants, mut by_steps) = (0.., 0..);
    for reading in readings() {
        let source = match reading.changes {
            Changes::Always => Reading(at_instants.next().unwrap_or(0)),
            Changes::ByStep => LedgerReading(by_steps.next().unwrap_or(0)),
        };
        rows.push(row(reading.name, reading.description).output(Shown(reading.unit, reading.display), source));
    }
    rows
}
