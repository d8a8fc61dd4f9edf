//! Tooth forces in space: reported components and moments, and loads on washers and pins, compared with points and
//! normals of the contacts.

use bevel_differential::contact::ContactLaw;
use bevel_differential::geometry::Pair;
use bevel_differential::geometry::action::LineOfAction;
use bevel_differential::model::{BODIES, Body, Inputs, Parameters, PlanetSpin, Simulation};

use super::solids::Solid;
use super::space::UnitForce;

/// Relative error of the forces from rounding and from the tables of tip corners (1e-11 of a gap).
const ROUNDING: f64 = 1e-9;

/// Turns with each kind of contact, plain and detailed.
fn turns() -> Vec<(&'static str, Parameters, Inputs)> {
    let mut all = Vec::new();
    type Change = fn(&mut Parameters);
    let changes: [(&str, Change); 6] = [
        ("plain", |_| {}),
        ("friction of the flanks", |p| p.effects.tooth_friction = true),
        ("washers", |p| p.effects.thrust_friction = true),
        ("line, washers", |p| {
            (p.effects.thrust_friction, p.contact.law) = (true, ContactLaw::Line);
        }),
        ("line, pins", |p| {
            (p.effects.pin_compliance, p.contact.law) = (true, ContactLaw::Line);
        }),
        ("line, errors, four planets", |p| {
            (p.effects.tooth_errors, p.contact.law, p.geometry.planet_count) = (true, ContactLaw::LineWeber, 4);
        }),
    ];
    for (name, change) in changes {
        for load in [835.0, -400.0] {
            let mut p = Parameters::default();
            p.scene.planet_spin = PlanetSpin::Imposed;
            change(&mut p);
            let inputs = Inputs { planet_spin: 3.5, load_torque: [load; 2], ..Inputs::default() };
            all.push((name, p, inputs));
        }
    }
    all
}

#[test]
fn points_normals_thrusts_and_pin_forces_equal_those_computed_in_space() {
    let mut spots = [0; 3];
    for (name, p, inputs) in turns() {
        let mut simulation = Simulation::start(&p, &inputs, 0.0).expect("a scene");
        let pair = Pair::new(&p.gears());
        let action = LineOfAction::new(&pair);
        for k in 1..=100 {
            simulation.advance(f64::from(k) * 2e-3).expect("a step");
            let mut loads = Vec::new();
            simulation.tooth_loads(|load| loads.push(*load));
            let forces = *simulation.forces();
            for i in simulation.plan().groups().iter().map(|group| group.planet) {
                let mut mesh = [[0.0; 3]; 2];
                for load in loads.iter().filter(|load| load.planet == i) {
                    spots[load.spot as usize] += 1;
                    let force = UnitForce::of(&pair, load);
                    let (components, contact) = (force.components(load.side), load.contact(&action));
                    let off = [force.point - contact.point, force.normal - contact.normal].map(|off| off.amax());
                    let components_off = (0..3).map(|i| (components[i] - load.components[i]).abs()).fold(0.0, f64::max);
                    assert!(off[0].max(off[1]).max(components_off) < ROUNDING, "{name}: {load:?}");
                    for (sum, component) in mesh[load.side].iter_mut().zip(components) {
                        *sum += load.normal * component;
                    }
                }
                let [left, right] = mesh;
                let pin = (left[2] + right[2]).hypot(left[1] - right[1]);
                let scale = forces.mesh[i][0].normal + forces.mesh[i][1].normal;
                let mut compared = vec![(forces.planet_thrust[i], left[0] + right[0]), (forces.pin_force[i], pin)];
                for s in 0..2 {
                    let found = &forces.mesh[i][s];
                    let found = [found.planet_thrust, found.side_thrust, found.tangential];
                    compared.extend(found.into_iter().zip(mesh[s]));
                }
                for (found, wanted) in compared {
                    let off = (found - wanted).abs() / scale;
                    assert!(off < ROUNDING, "{name}, planet {i}: {found} N for {wanted} N");
                }
            }
        }
    }
    println!("loads on the path and at both tip corners: {spots:?}");
    assert!(spots.iter().all(|&n| n > 100), "{spots:?}");
}

#[test]
fn washers_and_pins_rub_with_the_forces_of_the_teeth_in_space_and_of_the_orbit() {
    for (law, pins) in [(ContactLaw::Impact, false), (ContactLaw::Line, false), (ContactLaw::Line, true)] {
        let mut p = Parameters::default();
        (p.scene.planet_spin, p.contact.law) = (PlanetSpin::Imposed, law);
        (p.effects.thrust_friction, p.effects.pin_compliance) = (true, pins);
        // only dry friction produces heat
        (p.contact.damping, p.specs.pin_compliance.damping_time) = (0.0, 0.0);
        let with = &mut p.specs.thrust_friction;
        (with.coefficient, with.pin_coefficient) = (0.07, 0.04);
        let inputs = Inputs { carrier_speed: 20.0, planet_spin: 3.5, ..Inputs::default() };
        let mut simulation = Simulation::start(&p, &inputs, 0.0).expect("a scene");
        let (pair, planet) = (Pair::new(&p.gears()), Solid::new(&p.gears(), 0, p.material.density));
        let of = |body: Body| BODIES.len() + BODIES.iter().position(|&b| b == body).expect("a body");
        for k in 1..=100 {
            simulation.advance(f64::from(k) * 2e-3).expect("a step");
            let (mut thrust, mut across, mut along, mut sides) = (0.0, 0.0, 0.0, [0.0; 2]);
            simulation.tooth_loads(|load| {
                let components =
                    UnitForce::of(&pair, load).components(load.side).map(|component| load.normal * component);
                thrust += components[0];
                across += components[2];
                along += if load.side == 0 { components[1] } else { -components[1] };
                // both planets are identical
                sides[load.side] += 2.0 * components[1];
            });
            let states = simulation.states();
            let orbit = states[of(if pins { Body::Pin(0) } else { Body::Carrier })];
            thrust += planet.moment * orbit * orbit;
            let with = &p.specs.thrust_friction;
            let on_planet = with.coefficient * with.planet_washer_radius * thrust
                + with.pin_coefficient * with.pin_radius * across.hypot(along);
            let mut wanted = 2.0 * on_planet * inputs.planet_spin;
            for s in 0..2 {
                let slip = states[of(Body::Side(s))] - states[of(Body::Carrier)];
                wanted += with.coefficient * with.side_washer_radius * sides[s] * slip.abs();
            }
            let found = simulation.forces().power_loss;
            assert!((found / wanted - 1.0).abs() < ROUNDING, "{law:?}, pins {pins}: {found} W for {wanted} W");
        }
    }
}
