//! Differentials that do not roll, with errors, and functions to read their results.

#![allow(dead_code)] // each test binary uses its own part

use bevel_differential::contact::ContactLaw;
use bevel_differential::contact::errors::ToothErrorSpec;
use bevel_differential::contact::pairs::Flank;
use bevel_differential::geometry::Pair;
use bevel_differential::model::{Changes, Inputs, Parameters, Simulation, ToothLoad, readings};

pub const TORQUE: f64 = 835.0;

pub fn close(program: f64, expected: f64, relative: f64) {
    assert!((program / expected - 1.0).abs() <= relative, "program {program}, expected {expected}");
}

pub fn reading(simulation: &mut Simulation, name: &str) -> f64 {
    let mut instant = readings().filter(|reading| reading.changes != Changes::ByStep);
    let at = instant.position(|r| r.name == name).expect("a reading");
    simulation.forces().readings[at]
}

/// Middles and width of `n` equal slices of the face [m].
pub fn middles(pair: &Pair, n: usize) -> (impl Iterator<Item = f64> + Clone, f64) {
    let width = (pair.outer_cone - pair.inner_cone) / n as f64;
    let inner = pair.inner_cone;
    ((0..n).map(move |j| inner + (j as f64 + 0.5) * width), width)
}

/// Loaded pairs by mesh: planet, side, flank, position.
pub fn pairs_of(loads: &[ToothLoad]) -> Vec<(usize, usize, Flank, f64)> {
    let mut pairs: Vec<(usize, usize, Flank, f64)> = Vec::new();
    for load in loads {
        let pair = (load.planet, load.side, load.flank, load.s);
        if pairs.last() != Some(&pair) {
            pairs.push(pair);
        }
    }
    pairs
}

/// A differential with errors that does not roll.
pub fn standing(law: ContactLaw, errors: &ToothErrorSpec) -> Simulation {
    let mut p = Parameters::default();
    (p.effects.strength, p.effects.tooth_errors) = (true, true);
    p.specs.tooth_errors = *errors;
    p.contact.law = law;
    let inputs = Inputs { load_torque: [TORQUE; 2], ..Inputs::default() };
    let mut simulation = Simulation::start(&p, &inputs, 0.0).expect("a scene");
    simulation.advance(0.02).expect("a step");
    simulation
}

pub fn loads(simulation: &Simulation) -> Vec<ToothLoad> {
    let mut all = Vec::new();
    simulation.tooth_loads(|load| all.push(*load));
    all
}
