//! Model structure of the description: inputs and states on which each unknown depends at an instant.

use bevel_differential::variables::{Access, Causality, OutputSource, Table, Variable, units};

/// Suffix of outputs that depend on the torques of their side, and on speeds that a held wheel opposes.
const BY_OWN_LOAD: &str = ".twist";
/// Suffixes of outputs that depend only on positions.
const BY_POSITION: [&str; 1] = ["transmission_error"];
/// Parts of the names of outputs that depend on the motion of teeth, washers or clutches, but not on torques.
const BY_MOTION_OF_TEETH: [&str; 7] = [
    "stress.",
    "temperature.flash",
    "temperature.contact",
    "safety.scuffing",
    "pv.washers",
    "pv.clutch",
    ".clutch_slip",
];
/// Parts of the names of outputs that depend on the motion of all bodies, including the wheels, but not on torques.
const BY_MOTION: [&str; 1] = ["power.loss"];
/// Output that depends on speeds and on brake torques, and the suffix of these torques.
const OF_BRAKES: (&str, &str) = ("pv.brake", ".brake_torque");
/// Suffix of the commands of clutches.
const CLUTCH_COMMAND: &str = ".clutch_command";
/// Suffix of outputs of one clutch, and outputs of both, that depend on their commands and on speeds.
const OF_CLUTCH: &str = ".clutch_torque";
const OF_CLUTCHES: [&str; 2] = ["clutches.housing_torque", "pv.clutch_command"];
/// Commands that speeds follow immediately, and the suffixes of these speeds. Sides of unequal inertia couple both.
const COMMANDS: [&str; 3] = ["carrier.speed_command", "pinion.speed_command", "spin.command"];
const FOLLOWERS: [&str; 8] = [
    "carrier.speed",
    "pinion.speed",
    "propeller.speed",
    "left.speed",
    "right.speed",
    "wheel_speed",
    "spin_speed",
    "mesh.frequency",
];
/// Beginnings of the names of outputs that only a final drive has.
const IN_FRONT: [&str; 3] = ["ring_gear.", "left_bearing.", "right_bearing."];
/// Suffixes of the speed command of a half-shaft's end, and of the output on the same side that follows it immediately.
const OF_END: (&str, &str) = (".speed_command", ".wheel_speed");

/// True if speeds follow the input immediately.
fn is_followed(input: &Variable) -> bool {
    COMMANDS.contains(&input.name)
}

/// True if the input commands a clutch.
fn is_clutch(input: &Variable) -> bool {
    input.name.ends_with(CLUTCH_COMMAND)
}

/// True if the input is a torque.
fn is_torque(input: &Variable) -> bool {
    input.unit == Some(units::NEWTON_METRE)
}

/// True if the input is a speed.
fn is_speed(input: &Variable) -> bool {
    input.unit == Some(units::RAD_PER_S)
}

/// True if the output changes only with accepted steps.
fn is_of_ledger(row: &Variable) -> bool {
    matches!(row.access, Access::Output(OutputSource::Ledger(..) | OutputSource::Choice(..)))
}

/// Indices of the inputs that are `wanted`.
fn inputs_where(table: &Table, wanted: impl Fn(&Variable) -> bool) -> Vec<usize> {
    table.inputs.iter().copied().filter(|&i| wanted(&table.rows[i])).collect()
}

/// Inputs on which output `index` depends at an instant, over all scenes and both kinds of FMU. A test in tests/python
/// checks them.
///
/// Torques act immediately on accelerations and, without teeth, on all forces. In model exchange, imposed speeds act
/// immediately on speeds and on all forces, because forces are damped. In co-simulation, imposed speeds act only
/// through the step. Angles and the ledger change only over time.
fn dependencies(table: &Table, index: usize) -> Vec<usize> {
    let row = &table.rows[index];
    let named = |parts: &[&str]| parts.iter().any(|part| row.name.contains(part));
    match row.access {
        Access::Output(OutputSource::Motion(..)) => inputs_where(table, |input| {
            let own_side = input.name.strip_suffix(OF_END.0).zip(row.name.strip_suffix(OF_END.1));
            let follows = FOLLOWERS.iter().any(|end| row.name.ends_with(end));
            own_side.is_some_and(|(of, side)| of == side) || follows && is_followed(input)
        }),
        Access::Output(OutputSource::Pair(..)) => inputs_where(table, is_followed),
        Access::Output(OutputSource::Forces(..) | OutputSource::Components(..) | OutputSource::Reading(_))
            if !named(&BY_POSITION) =>
        {
            if let Some(side) = row.name.strip_suffix(BY_OWN_LOAD) {
                return inputs_where(table, |input| {
                    is_torque(input) && input.name.starts_with(side) || is_followed(input)
                });
            }
            if row.name == OF_BRAKES.0 {
                return inputs_where(table, |input| is_speed(input) || input.name.ends_with(OF_BRAKES.1));
            }
            if let Some(side) = row.name.strip_suffix(OF_CLUTCH) {
                return inputs_where(table, |input| {
                    is_clutch(input) && input.name.starts_with(side) || is_followed(input)
                });
            }
            if OF_CLUTCHES.contains(&row.name) {
                return inputs_where(table, |input| is_clutch(input) || is_followed(input));
            }
            if named(&BY_MOTION_OF_TEETH) {
                return inputs_where(table, is_followed);
            }
            // behind a final drive, the commands of the carrier do not act
            let is_in_front = IN_FRONT.iter().any(|part| row.name.starts_with(part));
            inputs_where(table, |input| {
                // the acceleration of a carrier with imposed speed is the rate of its command
                let is_own = row.name == "carrier.acceleration" && input.name == "carrier.speed_command";
                let acts = !(is_in_front && input.name.starts_with("carrier.") || is_own);
                acts && (is_speed(input) || is_clutch(input) || is_torque(input) && !named(&BY_MOTION))
            })
        }
        _ => Vec::new(),
    }
}

/// Inputs and states on which output `index` depends at an instant.
pub fn of_output(table: &Table, index: usize) -> Vec<usize> {
    let states: &[usize] = if is_of_ledger(&table.rows[index]) { &[] } else { &table.states };
    [&dependencies(table, index), states].concat()
}

/// Inputs and states on which the derivative of state `k` depends at an instant.
pub fn of_derivative(table: &Table, k: usize) -> Vec<usize> {
    let is_position = k < table.states.len() / 2;
    let inputs = inputs_where(table, |input| is_speed(input) || (is_torque(input) || is_clutch(input)) && !is_position);
    [&inputs[..], &table.states].concat()
}

/// Indices of the initial unknowns, in order. Without a list of dependencies, they depend on all knowns (FMI 2.0.4, 2.2.8).
pub fn initial_unknowns(table: &Table) -> Vec<usize> {
    let calculated = (0..table.rows.len()).filter(|&i| table.rows[i].causality == Causality::CalculatedParameter);
    let others = table.outputs.iter().chain(&table.states).chain(&table.derivatives).copied();
    let mut found: Vec<usize> = calculated.chain(others).collect();
    found.sort_unstable();
    found.dedup();
    found
}
