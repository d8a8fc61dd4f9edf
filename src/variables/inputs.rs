//! Rows of the inputs.

use super::row::{Access, Causality, Range, Variability, Variable};
use super::units::{self, DEG_PER_S, DisplayUnit, Unit};
use crate::model::Inputs;

/// Far beyond any differential, near enough that no intermediate result overflows.
const MAX_SPEED: f64 = 1e5;
const MAX_TORQUE: f64 = 1e8;

fn input(
    name: &'static str,
    unit: Unit,
    display: Option<DisplayUnit>,
    limit: f64,
    at: fn(&mut Inputs) -> &mut f64,
    description: &'static str,
) -> Variable {
    Variable {
        name,
        description,
        causality: Causality::Input,
        variability: Variability::Continuous,
        unit: Some(unit),
        display,
        range: Some(Range { min: -limit, max: limit }),
        nominal: None,
        derivative_of: None,
        access: Access::Input(at),
    }
}

/// A command between 0 and 1.
fn command(name: &'static str, at: fn(&mut Inputs) -> &mut f64, description: &'static str) -> Variable {
    Variable { range: Some(Range { min: 0.0, max: 1.0 }), ..input(name, units::ONE, None, 1.0, at, description) }
}

/// Rows of all inputs.
pub fn rows() -> Vec<Variable> {
    vec![
        input(
            "carrier.speed_command",
            units::RAD_PER_S,
            Some(DEG_PER_S),
            MAX_SPEED,
            |i| &mut i.carrier_speed,
            "Imposed carrier speed; initial speed when the carrier is torque-driven",
        ),
        input(
            "carrier.torque_command",
            units::NEWTON_METRE,
            None,
            MAX_TORQUE,
            |i| &mut i.carrier_torque,
            "Carrier torque when the carrier is torque-driven",
        ),
        input(
            "left.load_torque",
            units::NEWTON_METRE,
            None,
            MAX_TORQUE,
            |i| &mut i.load_torque[0],
            "Load on the left half-shaft; positive resists positive rotation",
        ),
        input(
            "right.load_torque",
            units::NEWTON_METRE,
            None,
            MAX_TORQUE,
            |i| &mut i.load_torque[1],
            "Load on the right half-shaft; positive resists positive rotation",
        ),
        input(
            "planet.spin_command",
            units::RAD_PER_S,
            Some(DEG_PER_S),
            MAX_SPEED,
            |i| &mut i.planet_spin,
            "Imposed planet spin relative to the carrier; positive speeds the left side up",
        ),
        input(
            "left.speed_command",
            units::RAD_PER_S,
            Some(DEG_PER_S),
            MAX_SPEED,
            |i| &mut i.side_speed[0],
            "Imposed speed of the wheel side of the left half-shaft when it is speed-driven",
        ),
        input(
            "right.speed_command",
            units::RAD_PER_S,
            Some(DEG_PER_S),
            MAX_SPEED,
            |i| &mut i.side_speed[1],
            "Imposed speed of the wheel side of the right half-shaft when it is speed-driven",
        ),
        // a build without a lock takes no command for it
        Variable {
            range: Some(Range { min: 0.0, max: if cfg!(feature = "lock") { 1.0 } else { 0.0 } }),
            ..command("lock.command", |i| &mut i.lock, "Command of the differential lock: 0 open, 1 locked")
        },
        command("fault.trigger", |i| &mut i.fault, "Breaks the tooth of effects.tooth_fault when it rises above 0.5"),
    ]
}
