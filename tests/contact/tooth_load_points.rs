//! Loads of single tooth pairs as forces at points, which are the rows of a load history for FEA.

use std::f64::consts::{PI, TAU};

use bevel_differential::contact::pairs::Spot;
use bevel_differential::geometry::action::LineOfAction;
use bevel_differential::geometry::assembly;
use bevel_differential::model::{Inputs, Parameters, PlanetSpin, Simulation, Start, ToothLoad};

/// A turn with a flank of each kind in contact, fast enough to pass several mesh cycles.
fn turning(planet_teeth: i32, side_teeth: i32, planets: i32, load: f64) -> (Parameters, Inputs) {
    let mut p = Parameters::default();
    p.geometry.planet_teeth = planet_teeth;
    p.geometry.side_teeth = side_teeth;
    p.geometry.planet_count = planets;
    p.scene.planet_spin = PlanetSpin::Imposed;
    p.scene.start = Start::Equilibrium;
    p.solver.merge_planets = false;
    let inputs = Inputs { planet_spin: 200f64.to_radians(), load_torque: [load; 2], ..Inputs::default() };
    (p, inputs)
}

fn loads(simulation: &Simulation) -> Vec<ToothLoad> {
    let mut all = Vec::new();
    simulation.tooth_loads(|load| all.push(*load));
    all
}

/// Runs a turn and calls `look` at each instant.
fn instants(p: &Parameters, inputs: &Inputs, mut look: impl FnMut(&mut Simulation)) {
    let mut simulation = Simulation::start(p, inputs, 0.0).expect("a scene");
    for k in 1..=60 {
        simulation.advance(f64::from(k) * 5e-3).expect("a step");
        look(&mut simulation);
    }
}

#[test]
fn moments_of_the_forces_at_their_points_equal_the_tooth_torques() {
    for (load, friction) in [(835.0, 0.0), (-835.0, 0.0), (835.0, 0.08)] {
        let (mut p, inputs) = turning(10, 16, 2, load);
        if friction > 0.0 {
            p.effects.tooth_friction = true;
            p.specs.tooth_friction.coefficient = friction;
        }
        let mut corners = 0;
        let (mut worst_side, mut worst_planet) = (0.0f64, 0.0f64);
        instants(&p, &inputs, |simulation| {
            let pair = *simulation.pair();
            let action = LineOfAction::new(&pair);
            let (mut side, mut planet) = ([0.0; 2], 0.0);
            let mut beyond = false;
            for load in loads(simulation) {
                beyond |= load.spot_arc != load.s;
                let contact = load.contact(&action);
                let turn = load.turn();
                for i in 0..2 {
                    let own = action.in_gear(&contact, i, load.tooth_azimuth(&pair, i), turn);
                    // the planet pushes the side gear along the normal; friction on the planet is positive along the
                    // flank
                    let sign = if i == 0 { -1.0 } else { 1.0 };
                    let force = own.normal * (sign * load.normal) - own.along * (sign * load.friction);
                    let moment = (own.point * load.cone).cross(&force).z;
                    if i == 0 {
                        planet += moment;
                    } else {
                        // about +x, which is along the left side gear's axis and against the right one's
                        side[load.side] += if load.side == 0 { moment } else { -moment };
                    }
                }
            }
            let forces = *simulation.forces();
            let radius = pair.outer_pitch_diameter(1) / 2.0;
            // friction of corners uses the moment arms of the extended path
            let tolerance = if friction > 0.0 && beyond { 5e-3 } else { 1e-9 };
            corners += usize::from(beyond);
            for s in 0..2 {
                let error = side[s] / (forces.side_tangential[s] * radius) - 1.0;
                worst_side = worst_side.max(error.abs());
                assert!(error.abs() < tolerance, "side {s}: {error:e}");
            }
            // spin is imposed and steady, so its drive balances the teeth; positive spin is about the axis toward the
            // apex
            let error = (planet - forces.spin_torque).abs() / load.abs();
            worst_planet = worst_planet.max(error);
            assert!(error < tolerance, "planets: {planet} {}", forces.spin_torque);
        });
        println!("load {load}, friction {friction}: {worst_side:e} {worst_planet:e}, {corners} instants with corners");
        assert!(corners > 0, "no corner touched");
    }
}

#[test]
fn contacts_turn_with_the_gears_and_stay_on_their_teeth() {
    let wrap = |angle: f64| angle - TAU * ((angle + PI) / TAU).floor();
    for (z_p, z_s, planets) in [(10, 16, 2), (10, 16, 4), (9, 14, 2), (11, 15, 2), (10, 18, 3), (9, 14, 4)] {
        for load in [835.0, -835.0] {
            let (p, inputs) = turning(z_p, z_s, planets, load);
            let phases = assembly::phases(&p.geometry).expect("planets that fit");
            instants(&p, &inputs, |simulation| {
                let pair = *simulation.pair();
                let action = LineOfAction::new(&pair);
                let motion = simulation.motion();
                for load in loads(simulation) {
                    let contact = load.contact(&action);
                    let (turn, i) = (load.turn(), load.planet);
                    let what = || format!("{z_p}/{z_s} x {planets}: {load:?}");
                    let [pitch_p, pitch_s] = pair.gears.map(|g| g.tooth_pitch());
                    // tooth 0 of a planet started its phase ahead of the left side gear's axis
                    let spin = -(motion.spin_angle[i] + phases[i][0] * pitch_p);
                    let spin = if load.side == 0 { spin } else { spin + PI };
                    let turned = action.rotation(&contact, 0, load.tooth_azimuth(&pair, 0), turn);
                    let off = wrap(turned - spin) * pair.sin_base()[0] * load.cone;
                    // if the side gear's corner leads, the planet's flank is behind it by the deflection
                    let slack = if load.spot == Spot::SideTip { 1.001 * load.depth } else { 1e-9 };
                    assert!(off.abs() < slack, "planet: {} pitches; {}", wrap(turned - spin) / pitch_p, what());
                    // tooth 0 of a side gear started ahead of tooth 0 of planet 1, or of the gap at that position
                    let side = load.side;
                    let forward = motion.side_angle[side] - motion.carrier_angle + (0.5 + phases[0][side]) * pitch_s
                        - assembly::azimuth(i, planets);
                    let wanted = if side == 0 { forward } else { -forward };
                    let turned = action.rotation(&contact, 1, load.tooth_azimuth(&pair, 1), turn);
                    // the side gear's flank is at the planet's flank, less the deflection
                    let off = wrap(turned - wanted) * pair.sin_base()[1] * load.cone;
                    let slack = if load.spot == Spot::SideTip { 1e-9 } else { 1.001 * load.depth + 1e-9 };
                    assert!(off.abs() < slack, "side: {} pitches; {}", wrap(turned - wanted) / pitch_s, what());
                }
            });
        }
    }
}
