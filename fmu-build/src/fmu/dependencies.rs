//! Which inputs each output depends on at an instant: the model structure of the description.

use bevel_differential::variables::{Access, OutputSource, Table, Variable, units};

/// Ending of names of outputs that depend on the torques of their side, and on speeds that a held wheel opposes.
const BY_OWN_LOAD: &str = ".twist";
/// Endings of names of outputs that depend only on positions.
const BY_POSITION: [&str; 1] = ["transmission_error"];
/// Parts of names of outputs that depend on positions and speeds but not on torques: of teeth, and of shafts as well.
const BY_MOTION_OF_TEETH: [&str; 6] =
    ["stress.", "temperature.flash", "temperature.contact", "safety.scuffing", "pv.washers", "pv.clutch"];
const BY_MOTION: [&str; 1] = ["power.loss"];
/// Output that depends on speeds and on the torques of the brakes, and the ending of their names.
const OF_BRAKES: (&str, &str) = ("pv.brake", ".brake_torque");
/// Commands that speeds follow at once, and the endings of their names; sides of unequal inertia couple both.
const COMMANDS: [&str; 2] = ["carrier.speed_command", "spin.command"];
const FOLLOWERS: [&str; 6] =
    ["carrier.speed", "left.speed", "right.speed", "wheel_speed", "spin_speed", "mesh.frequency"];
/// Ends of half-shafts whose speed is commanded: the command's ending and that of the output, both of one side.
const OF_END: (&str, &str) = (".speed_command", ".wheel_speed");

/// Whether speeds follow the input at once.
fn is_followed(input: &Variable) -> bool {
    COMMANDS.contains(&input.name)
}

/// Whether the input is a torque.
pub fn is_torque(input: &Variable) -> bool {
    input.unit == Some(units::NEWTON_METRE)
}

/// Whether the input is a speed.
pub fn is_speed(input: &Variable) -> bool {
    input.unit == Some(units::RAD_PER_S)
}

/// Whether the output changes with accepted steps only.
pub fn is_of_ledger(row: &Variable) -> bool {
    let by_step =
        |source| matches!(source, OutputSource::Ledger(_) | OutputSource::LedgerReading(_) | OutputSource::Heat(_));
    matches!(row.access, Access::Output(source) if by_step(source))
}

/// Inputs that are `wanted`, by their indices.
pub fn inputs_where(table: &Table, wanted: impl Fn(&Variable) -> bool) -> Vec<usize> {
    table.inputs.iter().copied().filter(|&i| wanted(&table.rows[i])).collect()
}

/// Inputs that output `index` depends on at an instant, over all scenes and both kinds of FMU; tests/python checks it.
///
/// Torques act at once on accelerations and, without teeth, on all forces. Imposed speeds act at once in model exchange,
/// on speeds and on all forces, which are damped; in co-simulation they act through the step only. Angles and the ledger
/// follow with time alone.
pub fn dependencies(table: &Table, index: usize) -> Vec<usize> {
    let row = &table.rows[index];
    let named = |parts: &[&str]| parts.iter().any(|part| row.name.contains(part));
    match row.access {
        Access::Output(OutputSource::Motion(_)) => inputs_where(table, |input| {
            let own_side = input.name.strip_suffix(OF_END.0).zip(row.name.strip_suffix(OF_END.1));
            let follows = FOLLOWERS.iter().any(|end| row.name.ends_with(end));
            own_side.is_some_and(|(of, side)| of == side) || follows && is_followed(input)
        }),
        Access::Output(OutputSource::Pair(..)) => inputs_where(table, is_followed),
        Access::Output(OutputSource::Forces(_) | OutputSource::Parts(_) | OutputSource::Reading(_))
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
            if named(&BY_MOTION_OF_TEETH) {
                return inputs_where(table, is_followed);
            }
            inputs_where(table, |input| is_speed(input) || is_torque(input) && !named(&BY_MOTION))
        }
        _ => Vec::new(),
    }
}
