//! The temperatures of a scene: its network, its start, and where they are read.

use super::network::Network;
use super::{CASE, CLUTCH, GEARS, NODES, Thermal, WASHERS};
use crate::geometry::solid::mass::GearMass;
use crate::model::effect_kinds::{BUILT, Changes};
use crate::model::scene::{Inputs, Start};
use crate::model::setup::effect_outputs::{ALL_HEATS, indices_of};
use crate::model::setup::{HEATS, Parameters};
use crate::problem::Problem;

/// Indices of the temperatures and of the heat stored and given off, among the readings of a step.
const READINGS: std::ops::Range<usize> = indices_of("warm_up", Changes::ByStep);

/// Network of a scene whose planet and side gear have the given `masses`; `None` if temperatures are constant.
pub fn network(p: &Parameters, masses: &[GearMass; 2]) -> Option<Box<Network<HEATS>>> {
    (BUILT && p.effects.warm_up).then(|| Box::new(with_parameters(p, masses)))
}

/// Network with the parameters `p`.
pub fn with_parameters(p: &Parameters, masses: &[GearMass; 2]) -> Network<HEATS> {
    let [planet, side] = masses.map(|gear| gear.mass);
    let gears = f64::from(p.geometry.planet_count) * planet + 2.0 * side;
    p.specs.warm_up.network(gears, p.oil.temperature, ALL_HEATS.map(|heat| heat.warms))
}

/// Temperatures at the start, with the `network` of the scene.
pub fn at_start(p: &Parameters, network: Option<&Network<HEATS>>, inputs: &Inputs) -> Thermal {
    let oil = p.oil.temperature;
    let Some(network) = network else { return Thermal::uniform(oil) };
    let oil = network.around.changed(inputs.changes_outside()).sump.unwrap_or(oil);
    // steady heat begins its search without knowing how warm the other nodes become
    if p.scene.start == Start::SteadyHeat {
        return Thermal::uniform(oil);
    }
    Thermal::at(p.specs.warm_up.temperatures_at_start(oil))
}

/// Name of the parameter of [`cycle`].
pub const CYCLE: &str = "warm_up.cycle";

/// Duration of a cycle whose heat the start in steady heat balances [s].
pub fn cycle(p: &Parameters) -> f64 {
    p.specs.warm_up.cycle
}

/// Problem of a start that needs temperatures which change, if they are constant.
pub fn constant_temperatures(p: &Parameters) -> Option<Problem> {
    let text = "steady_heat needs temperatures that change: set effects.warm_up = true";
    (p.scene.start == Start::SteadyHeat && !p.effects.warm_up).then(|| Problem::new("scene.start", text))
}

/// Name of a thermal node, and the parameter by which its heat leaves.
pub fn node_and_path(node: usize) -> (&'static str, &'static str) {
    match node {
        GEARS => ("gears", "warm_up.gears_to_oil"),
        CLUTCH => ("clutch packs", "warm_up.clutch_to_oil"),
        WASHERS => ("washers", "warm_up.washers_to_oil"),
        CASE => ("case", "warm_up.case_to_ambient"),
        _ => ("oil", "warm_up.oil_to_case"),
    }
}

/// Sets the readings: temperatures [K] or their rates, then the heat stored and given off [J] or their rates.
pub fn set_readings(readings: &mut [f64], temperatures: &[f64; NODES], heat: Option<[f64; 2]>) {
    let readings = &mut readings[READINGS];
    readings[..NODES].copy_from_slice(temperatures);
    if let Some(heat) = heat {
        readings[NODES..].copy_from_slice(&heat);
    }
}

/// Temperatures, or their rates, among the `readings` of a step.
pub fn temperatures(readings: &[f64]) -> [f64; NODES] {
    std::array::from_fn(|node| readings[READINGS][node])
}
