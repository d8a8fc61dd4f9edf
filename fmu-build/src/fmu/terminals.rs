//! terminalsAndIcons.xml: groups of variables that belong to one physical connection. FMI 2.0.4 uses the file of FMI
//! 3.0.
//!
//! A shaft has two terminals, because a parameter of the scene determines which of its variables is the input. A host
//! connects the terminal that fits the drive of the scene.

use anyhow::{Context, Result, ensure};
use bevel_differential::declaration::SIDES;
use bevel_differential::variables::{Causality, named};

use answers::text::xml::Element;

/// Path in the archive.
pub const FILE: &str = "terminalsAndIcons/terminalsAndIcons.xml";
/// Version of FMI whose schema the file follows.
const VERSION: &str = "3.0";
/// Members with equal names are connected.
const MATCHING_RULE: &str = "plug";
/// Kinds of terminals. FMI leaves these names to the project.
const TORQUE_DRIVEN: &str = "org.bevel-differential.rotational-flange.torque-driven";
const SPEED_DRIVEN: &str = "org.bevel-differential.rotational-flange.speed-driven";
const BRAKE: &str = "org.bevel-differential.wheel-brake";
/// Side of a terminal in its texts.
const SIDE: &str = "{side}";
const COMMAND: &str = "org.bevel-differential.command";

/// FMI's kind of a variable in a connection.
#[derive(Clone, Copy)]
enum Kind {
    /// Connected variables are equal.
    Signal,
    /// Connected flows add up to zero; positive into the differential.
    Inflow,
    /// Connected flows add up to zero; positive out of the differential.
    Outflow,
}

/// A variable of a terminal: name of the member, variable, kind.
type Member = (&'static str, &'static str, Kind);

/// A terminal. If its texts contain `{side}` or `{Side}`, there is one for each side.
struct Terminal {
    name: &'static str,
    kind: &'static str,
    description: &'static str,
    members: &'static [Member],
}

use Kind::{Inflow, Outflow, Signal};

const TERMINALS: [Terminal; 14] = [
    Terminal {
        name: "carrier_torque_driven",
        kind: TORQUE_DRIVEN,
        description: "Carrier with scene.carrier_drive = torque: the torque is the input. Speed, angle and torque are positive \
                      forward; a positive torque drives the differential forward",
        members: &[
            ("tau", "carrier.torque_command", Inflow),
            ("w", "carrier.speed", Signal),
            ("phi", "carrier.angle", Signal),
        ],
    },
    Terminal {
        name: "carrier_speed_driven",
        kind: SPEED_DRIVEN,
        description: "Carrier with scene.carrier_drive = speed: the speed is the input. The speed is positive forward; a positive \
                      torque of the drive drives the differential forward",
        members: &[("tau", "carrier.torque", Inflow), ("w", "carrier.speed_command", Signal)],
    },
    Terminal {
        name: "port_torque_driven",
        kind: TORQUE_DRIVEN,
        description: "Pinion, or its propeller shaft, with effects.final_drive and scene.carrier_drive = torque: the torque is \
                      the input. Speed, angle and torque are positive forward",
        members: &[
            ("tau", "pinion.torque_command", Inflow),
            ("w", "propeller.speed", Signal),
            ("phi", "propeller.angle", Signal),
        ],
    },
    Terminal {
        name: "port_speed_driven",
        kind: SPEED_DRIVEN,
        description: "Pinion, or its propeller shaft, with effects.final_drive and scene.carrier_drive = speed: the speed is the \
                      input. The speed is positive forward; a positive torque of the drive drives forward",
        members: &[("tau", "propeller.torque", Inflow), ("w", "pinion.speed_command", Signal)],
    },
    Terminal {
        name: "{side}_torque_driven",
        kind: TORQUE_DRIVEN,
        description: "{Side} half-shaft with scene.{side}_drive = torque: the load is the input. Speed and angle are positive forward; \
                      a positive load resists forward rotation, and drives a standing wheel backward",
        members: &[
            ("tau", "{side}.load_torque", Outflow),
            ("w", "{side}.wheel_speed", Signal),
            ("phi", "{side}.wheel_angle", Signal),
        ],
    },
    Terminal {
        name: "{side}_speed_driven",
        kind: SPEED_DRIVEN,
        description: "{Side} half-shaft with scene.{side}_drive = speed: the speed is the input. The speed is positive forward; a \
                      positive shaft torque drives the wheel forward",
        members: &[("tau", "{side}.shaft_torque", Outflow), ("w", "{side}.speed_command", Signal)],
    },
    Terminal {
        name: "planet_spin",
        kind: SPEED_DRIVEN,
        description: "Spin of all planets on their pins, relative to the carrier, with scene.planet_spin = imposed: \
                      the speed is the input. A positive spin makes the left side faster; the torque is the total \
                      torque of the spin drive on all planets",
        members: &[("tau", "spin.torque", Inflow), ("w", "spin.command", Signal)],
    },
    Terminal {
        name: "{side}_brake",
        kind: BRAKE,
        description: "Brake of the {side} wheel with effects.wheel_brake. The torque has no direction: it opposes rotation and holds \
                      a standing wheel; the speed is positive forward",
        members: &[("brake_torque", "{side}.brake_torque", Signal), ("w", "{side}.wheel_speed", Signal)],
    },
    Terminal {
        name: "lock",
        kind: COMMAND,
        description: "Differential lock: 0 opens it, 1 closes it; the output counts side gears that dry friction holds to the carrier",
        members: &[("command", "lock.command", Signal), ("held", "held.sides", Signal)],
    },
    Terminal {
        name: "{side}_clutch",
        kind: COMMAND,
        description: "{Side} clutch with effects.clutches: 0 opens it, 1 presses it with its full torque",
        members: &[
            ("command", "{side}.clutch_command", Signal),
            ("tau", "{side}.clutch_torque", Signal),
            ("slip", "{side}.clutch_slip", Signal),
        ],
    },
    Terminal {
        name: "{side}_dog",
        kind: COMMAND,
        description: "{Side} dog clutch with effects.disconnect: above 0.5 it closes, otherwise it opens; the output is its phase",
        members: &[("command", "{side}.dog_command", Signal), ("phase", "{side}.dog_phase", Signal)],
    },
    Terminal {
        name: "fault",
        kind: COMMAND,
        description: "Tooth fault with effects.tooth_fault: the tooth breaks when the command rises above 0.5",
        members: &[("command", "fault.trigger", Signal)],
    },
    Terminal {
        name: "ambient",
        kind: COMMAND,
        description: "Surroundings of the case with effects.warm_up: the command changes their temperature; the temperature is that of the case",
        members: &[("command", "warm_up.ambient_change", Signal), ("temperature", "temperature.case", Signal)],
    },
    Terminal {
        name: "sump",
        kind: COMMAND,
        description: "Oil with effects.warm_up and warm_up.sump_given, as from a cooler: the command changes its temperature",
        members: &[("command", "warm_up.sump_change", Signal), ("temperature", "temperature.oil", Signal)],
    },
];

/// Text of the file. Fails if a terminal names a variable that is neither input nor output.
pub fn text() -> Result<String> {
    let terminals = instances().map(|(of, side)| terminal(of, side)).collect::<Result<Vec<_>>>()?;
    let root = Element::new("fmiTerminalsAndIcons")
        .with("fmiVersion", VERSION)
        .child(Element::new("Terminals").children(terminals));
    root.document().context("the terminals cannot be written")
}

/// Terminals with the side of each. The side of a terminal without one does not count.
fn instances() -> impl Iterator<Item = (&'static Terminal, usize)> {
    TERMINALS.iter().flat_map(|of| (0..if of.name.contains(SIDE) { 2 } else { 1 }).map(move |s| (of, s)))
}

/// Text of side `s`.
fn on_side(text: &str, s: usize) -> String {
    text.replace(SIDE, SIDES[s]).replace("{Side}", ["Left", "Right"][s])
}

fn terminal(terminal: &Terminal, s: usize) -> Result<Element> {
    let name = on_side(terminal.name, s);
    let member = |&(member, variable, kind): &Member| self::variable(&name, (member, &on_side(variable, s), kind));
    let members = terminal.members.iter().map(member).collect::<Result<Vec<_>>>()?;
    Ok(Element::new("Terminal")
        .with("name", &name)
        .with("matchingRule", MATCHING_RULE)
        .with("terminalKind", terminal.kind)
        .with("description", on_side(terminal.description, s))
        .children(members))
}

fn variable(terminal: &str, (member, name, kind): (&str, &str, Kind)) -> Result<Element> {
    let row =
        named(name).with_context(|| format!("terminal {terminal}, member {member}: there is no variable {name}"))?;
    ensure!(
        matches!(row.causality, Causality::Input | Causality::Output),
        "terminal {terminal}, member {member}: {name} is neither input nor output"
    );
    let kind = match kind {
        Signal => "signal",
        Inflow => "inflow",
        Outflow => "outflow",
    };
    Ok(Element::new("TerminalMemberVariable")
        .with("variableName", name)
        .with("memberName", member)
        .with("variableKind", kind))
}

#[cfg(test)]
mod tests {
    use super::{Kind, variable};

    #[test]
    fn a_variable_that_cannot_be_connected_is_refused() {
        for (name, said) in [("left.wheel_sped", "no variable"), ("geometry.module", "neither input nor output")] {
            let refused = variable("left", ("w", name, Kind::Signal)).err().map(|error| error.to_string());
            assert!(refused.as_deref().is_some_and(|text| text.contains(said) && text.contains(name)), "{refused:?}");
        }
    }
}
