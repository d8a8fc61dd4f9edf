//! Rows of the outputs.

use super::access::OutputSource;
use crate::declaration::units::{self, DEG, DEG_PER_S, DisplayUnit, MM, MPA, Unit};
use crate::declaration::{Row, output};
use crate::model::{CONTACT_HEAT, Changes, Forces, LedgerReadings, Motion, efficiency, heats, readings};

type Output = Row<OutputSource>;

fn motion(
    name: &'static str,
    unit: Unit,
    display: Option<DisplayUnit>,
    of: fn(&Motion) -> f64,
    text: &'static str,
) -> Output {
    output(name, unit, display, OutputSource::Motion(of), text)
}

fn forces(name: &'static str, unit: Unit, of: fn(&Forces) -> f64, text: &'static str) -> Output {
    output(name, unit, None, OutputSource::Forces(of), text)
}

fn parts(name: &'static str, unit: Unit, of: fn(&Forces) -> f64, text: &'static str) -> Output {
    output(name, unit, None, OutputSource::Parts(of), text)
}

fn ledger(name: &'static str, unit: Unit, of: fn(&LedgerReadings) -> f64, text: &'static str) -> Output {
    output(name, unit, None, OutputSource::Ledger(of), text)
}

/// Rows of one side: 0 left, 1 right.
macro_rules! side {
    ($name:literal, $s:literal) => {
        [
            motion(
                concat!($name, ".angle"),
                units::RADIAN,
                Some(DEG),
                |m| m.side_angle[$s],
                concat!(
                    "Side gear angle, not that of a wheel behind a half-shaft (", $name,
                    ".wheel_angle); 0 as assembled with teeth in mid-gap, lash and deflection included"
                ),
            ),
            motion(
                concat!($name, ".speed"),
                units::RAD_PER_S,
                Some(DEG_PER_S),
                |m| m.side_speed[$s],
                concat!("Side gear speed, not that of a wheel behind a half-shaft (", $name, ".wheel_speed)"),
            ),
            motion(
                concat!($name, ".wheel_angle"),
                units::RADIAN,
                Some(DEG),
                |m| m.wheel_angle[$s],
                concat!(
                    "Wheel angle, for brakes and tyres: of the end of the half-shaft, ", $name, ".angle - ", $name,
                    ".twist, where the end moves by itself; of the side gear otherwise"
                ),
            ),
            motion(
                concat!($name, ".wheel_speed"),
                units::RAD_PER_S,
                Some(DEG_PER_S),
                |m| m.wheel_speed[$s],
                concat!(
                    "Wheel speed, for brakes and tyres: of the end of the half-shaft where that moves by itself (scene.", $name,
                    "_drive = speed, or effects.half_shaft with inertia.", $name, "_end above 0), of the side gear otherwise"
                ),
            ),
            forces(
                concat!($name, ".acceleration"),
                units::RAD_PER_S2,
                |f| f.side_acceleration[$s],
                "Side gear acceleration",
            ),
            forces(
                concat!($name, ".shaft_torque"),
                units::NEWTON_METRE,
                |f| f.shaft_torque[$s],
                "Torque the half-shaft delivers to the wheel",
            ),
            forces(
                concat!($name, ".tangential_force"),
                units::NEWTON,
                |f| f.side_tangential[$s],
                "Torque of all meshes on the side gear, referred to its outer pitch circle",
            ),
            forces(
                concat!($name, ".normal_force"),
                units::NEWTON,
                |f| f.side_normal[$s],
                "Normal forces of all meshes of the side gear, summed",
            ),
            parts(
                concat!($name, ".thrust_force"),
                units::NEWTON,
                |f| f.side_thrust[$s],
                "Thrust of all meshes on the side gear, away from the apex",
            ),
        ]
    };
}

/// Rows of one planet, numbered from 0 inside and from 1 in names.
macro_rules! planet {
    ($name:literal, $i:literal) => {
        [
            motion(
                concat!($name, ".spin_angle"),
                units::RADIAN,
                Some(DEG),
                |m| m.spin_angle[$i],
                "Spin angle relative to the carrier since the start",
            ),
            motion(
                concat!($name, ".spin_speed"),
                units::RAD_PER_S,
                Some(DEG_PER_S),
                |m| m.spin_speed[$i],
                "Spin speed relative to the carrier",
            ),
            forces(
                concat!($name, ".left_normal_force"),
                units::NEWTON,
                |f| f.mesh[$i][0].normal,
                "Normal force of the mesh with the left side gear, its tooth pairs summed",
            ),
            forces(
                concat!($name, ".right_normal_force"),
                units::NEWTON,
                |f| f.mesh[$i][1].normal,
                "Normal force of the mesh with the right side gear, its tooth pairs summed",
            ),
            forces(
                concat!($name, ".left_pairs"),
                units::ONE,
                |f| f.mesh[$i][0].pairs,
                "Tooth pairs under load in the mesh with the left side gear",
            ),
            forces(
                concat!($name, ".right_pairs"),
                units::ONE,
                |f| f.mesh[$i][1].pairs,
                "Tooth pairs under load in the mesh with the right side gear",
            ),
            parts(
                concat!($name, ".pin_force"),
                units::NEWTON,
                |f| f.pin_force[$i],
                "Resultant of the mesh forces across the pin",
            ),
            parts(
                concat!($name, ".thrust_force"),
                units::NEWTON,
                |f| f.planet_thrust[$i],
                "Thrust of both meshes on the planet, away from the apex",
            ),
            output(
                concat!($name, ".left_transmission_error"),
                units::METRE,
                Some(MM),
                OutputSource::Forces(|f| f.mesh[$i][0].transmission_error),
                "Approach of the drive flanks to the left side gear at the mean cone distance; 0 at first touch",
            ),
            output(
                concat!($name, ".right_transmission_error"),
                units::METRE,
                Some(MM),
                OutputSource::Forces(|f| f.mesh[$i][1].transmission_error),
                "Approach of the drive flanks to the right side gear at the mean cone distance; 0 at first touch",
            ),
        ]
    };
}

/// Rows of a loaded pair in the mesh of planet 1 with the left side gear, numbered from 0 inside and from 1 in names.
macro_rules! pair {
    ($name:literal, $k:literal) => {
        [
            output(
                concat!($name, ".tooth"),
                units::ONE,
                None,
                OutputSource::Pair($k, |pair| pair.tooth),
                "Loaded pair in the mesh of planet 1 with the left side gear, from the planet's root to its tip: number of the planet's tooth, from 0; -1 where there is no such pair",
            ),
            output(
                concat!($name, ".force"),
                units::NEWTON,
                None,
                OutputSource::Pair($k, |pair| pair.force),
                "Normal force of this pair, negative on the coast flank",
            ),
            output(
                concat!($name, ".height"),
                units::METRE,
                Some(MM),
                OutputSource::Pair($k, |pair| pair.height),
                "Where this pair touches along the planet's profile, from the pitch circle toward the tip at the mean cone distance",
            ),
            output(
                concat!($name, ".toe_pressure"),
                units::PASCAL,
                Some(MPA),
                OutputSource::Pair($k, |pair| pair.pressure[0]),
                "Hertz pressure of this pair at the toe",
            ),
            output(
                concat!($name, ".middle_pressure"),
                units::PASCAL,
                Some(MPA),
                OutputSource::Pair($k, |pair| pair.pressure[1]),
                "Hertz pressure of this pair at the mean cone distance",
            ),
            output(
                concat!($name, ".heel_pressure"),
                units::PASCAL,
                Some(MPA),
                OutputSource::Pair($k, |pair| pair.pressure[2]),
                "Hertz pressure of this pair at the heel",
            ),
        ]
    };
}

/// Rows of all outputs.
pub fn rows() -> Vec<Output> {
    let mut rows = vec![
        motion("carrier.angle", units::RADIAN, Some(DEG), |m| m.carrier_angle, "Carrier angle since the start"),
        motion("carrier.speed", units::RAD_PER_S, Some(DEG_PER_S), |m| m.carrier_speed, "Carrier speed"),
        forces("carrier.acceleration", units::RAD_PER_S2, |f| f.carrier_acceleration, "Carrier acceleration"),
        forces("carrier.torque", units::NEWTON_METRE, |f| f.carrier_torque, "Torque the drive delivers to the carrier"),
    ];
    rows.extend(side!("left", 0));
    rows.extend(side!("right", 1));
    rows.extend(planet!("planet[1]", 0));
    rows.extend(planet!("planet[2]", 1));
    rows.extend(planet!("planet[3]", 2));
    rows.extend(planet!("planet[4]", 3));
    rows.extend(pair!("planet[1].left_pair[1]", 0));
    rows.extend(pair!("planet[1].left_pair[2]", 1));
    rows.extend(pair!("planet[1].left_pair[3]", 2));
    rows.extend([
        forces(
            "planet.spin_torque",
            units::NEWTON_METRE,
            |f| f.spin_torque,
            "Torque that imposes the spin, all planets together; 0 when the spin is free",
        ),
        motion("mesh.frequency", units::HERTZ, None, |m| m.mesh_frequency, "Tooth engagements per second of one mesh"),
        forces("power.in", units::WATT, |f| f.power_in, "Power delivered by carrier drive and spin drive"),
        forces("power.out", units::WATT, |f| f.power_out, "Power delivered to the wheels"),
        forces("power.loss", units::WATT, |f| f.power_loss, "Power turned into heat within the differential; that of wheel brakes is part of power.out"),
        forces("efficiency", units::ONE, efficiency, "1 - power.loss per power fed in at either end; 1 at zero power"),
        forces(
            "torque_bias_ratio",
            units::ONE,
            |f| f.torque_bias_ratio,
            "Torque of the slow over the fast half-shaft, in the sense of the torques, over the last whole mesh cycle where shafts twist; 1 at zero torque, 1e6 where the fast one carries none, as with one wheel that stands and one that spins freely; with imposed spin and imposed loads it is the ratio of the loads, whatever rubs",
        ),
        forces(
            "locking_value",
            units::ONE,
            |f| f.locking_value,
            "Difference over sum of the half-shaft torques, over the last whole mesh cycle where shafts twist",
        ),
        ledger("heat.contact", units::JOULE, |l| l.heat[CONTACT_HEAT], "Heat of contact damping since the start"),
        ledger("held.sides", units::ONE, |l| l.held[0], "Side gears that dry friction holds to the carrier"),
        ledger("held.planets", units::ONE, |l| l.held[1], "Groups of planets that dry friction holds on their pins"),
        ledger("held.wheels", units::ONE, |l| l.held[2], "Wheels that their brakes hold"),
        ledger("solver.steps", units::ONE, |l| l.steps, "Accepted steps"),
        ledger("solver.rejected", units::ONE, |l| l.rejected, "Rejected steps"),
        ledger("solver.rhs_calls", units::ONE, |l| l.rhs_calls, "Evaluations of the tooth forces"),
        ledger("solver.step_size", units::SECOND, |l| l.step_size, "Size of the last accepted step"),
        ledger(
            "solver.energy_residual",
            units::JOULE,
            |l| l.energy_residual,
            "Stored energy less work of the inputs plus heat; 0 for an exact solution",
        ),
    ]);
    for (place, heat) in heats().enumerate() {
        let source = OutputSource::Heat(CONTACT_HEAT + 1 + place);
        rows.push(output(heat.output, units::JOULE, None, source, heat.description));
    }
    let (mut at_instants, mut by_steps) = (0.., 0..);
    for reading in readings() {
        let source = match reading.changes {
            Changes::Always => OutputSource::Reading(at_instants.next().unwrap_or(0)),
            Changes::ByStep => OutputSource::LedgerReading(by_steps.next().unwrap_or(0)),
        };
        rows.push(output(reading.name, reading.unit, reading.display, source, reading.description));
    }
    rows
}
