//! Centrifugal force of the planets on their washers: m r ω², with mass and centre of mass of their solids.
//!
//! Teeth in the middle of the tooth spaces are unloaded, so that the torque that imposes the spin only overcomes the
//! friction of the washers.

use bevel_differential::geometry::GearSpec;
use bevel_differential::model::{
    BODIES, Body, CarrierDrive, GearContact, Inputs, Parameters, PlanetSpin, STATES, SideDrive, Simulation, Start,
};

use super::solids::Solid;

/// Scene with planets that roll at `spin` on a carrier that turns at `carrier` [rad/s], without load.
fn rolling(carrier: f64, spin: f64) -> (Parameters, Inputs) {
    let mut p = Parameters::default();
    (p.scene.planet_spin, p.scene.start, p.effects.thrust_friction) = (PlanetSpin::Imposed, Start::Rolling, true);
    let inputs = Inputs { carrier_speed: carrier, planet_spin: spin, load_torque: [0.0; 2], ..Inputs::default() };
    (p, inputs)
}

/// Torque that imposes the spin, per planet [N·m].
fn spin_torque(p: &Parameters, inputs: &Inputs) -> f64 {
    let mut simulation = Simulation::start(p, inputs, 0.0).expect("a scene");
    let forces = simulation.forces();
    assert!(forces.mesh.iter().flatten().all(|mesh| mesh.normal == 0.0), "teeth in contact");
    forces.spin_torque / f64::from(p.geometry.planet_count)
}

#[test]
fn washers_of_unloaded_planets_bear_the_centrifugal_force() {
    type Change = fn(&mut Parameters);
    let changes: [(&str, Change); 6] = [
        ("the study's", |_| {}),
        ("four, with bores, light", |p| {
            p.geometry = GearSpec { planet_count: 4, planet_bore: 16e-3, ..p.geometry };
            p.material.density = 4500.0;
        }),
        ("other teeth", |p| {
            (p.geometry.planet_teeth, p.geometry.side_teeth, p.geometry.module) = (11, 15, 3e-3);
            p.geometry.face_width = 12e-3;
        }),
        ("a given inertia leaves the mass", |p| {
            (p.inertia.from_geometry, p.inertia.planet) = (false, 1e-3);
        }),
        ("lumped", |p| p.scene.gear_contact = GearContact::Lumped),
        ("compliant pins", |p| p.effects.pin_compliance = true),
    ];
    for (name, change) in changes {
        for (carrier, spin) in [(50.0, 5.0), (-80.0, 5.0), (20.0, -40.0), (0.0, 5.0)] {
            let (mut p, inputs) = rolling(carrier, spin);
            change(&mut p);
            let planet = Solid::new(&p.gears(), 0, p.material.density);
            let with = &p.specs.thrust_friction;
            let arm = with.coefficient * with.planet_washer_radius;
            let (found, wanted) = (spin_torque(&p, &inputs) / arm, planet.moment * carrier * carrier * spin.signum());
            assert!((found - wanted).abs() <= 1e-12 * wanted.abs(), "{name}, {carrier}: {found} N for {wanted} N");
        }
    }
}

#[test]
fn the_study_s_planets_at_60_km_h_press_with_ten_newtons() {
    // 0.16 kg near the mean cone distance, at 2861 deg/s
    let (p, inputs) = rolling(2861f64.to_radians(), 1.0);
    let force = spin_torque(&p, &inputs) / (0.05 * 14e-3);
    assert!((8.0..12.0).contains(&force), "{force} N");
}

#[test]
fn without_washer_friction_the_centrifugal_force_has_no_effect() {
    let (mut p, inputs) = rolling(2861f64.to_radians(), 1.0);
    p.effects.thrust_friction = false;
    assert_eq!(spin_torque(&p, &inputs), 0.0);
    // tooth friction uses detailed loads, but no washer friction
    p.effects.tooth_friction = true;
    assert_eq!(spin_torque(&p, &inputs), 0.0);
}

#[test]
fn masses_of_solids_are_those_of_the_program() {
    for spec in [GearSpec::default(), GearSpec { planet_bore: 14e-3, side_bore: 30e-3, ..GearSpec::default() }] {
        let p = Parameters { geometry: spec, ..Parameters::default() };
        let simulation = Simulation::start(&p, &Inputs::default(), 0.0).expect("a scene");
        let found = *simulation.inertias();
        let [planet, side] = [0, 1].map(|i| Solid::new(&p.gears(), i, p.material.density));
        for (found, wanted) in [
            (found.planet_mass_moment, planet.moment),
            (found.planet, planet.axial),
            (found.planet_transverse, planet.transverse),
            (found.side[0], side.axial),
            (found.side_mass, side.mass),
        ] {
            assert!((found / wanted - 1.0).abs() < 1e-12, "{found} {wanted}");
        }
    }
}

#[test]
fn start_values_of_given_inertias_are_those_of_the_study_s_solids_to_three_digits() {
    let p = Parameters::default();
    let [planet, side] = [0, 1].map(|i| Solid::new(&p.gears(), i, p.material.density).axial);
    println!("solids: planet {planet:e}, side gear {side:e} kg.m2");
    for (start, solid) in [(p.inertia.planet, planet), (p.inertia.side_gear, side)] {
        let digit = 10f64.powf(solid.log10().floor() - 2.0);
        assert!((start - solid).abs() < 0.5 * digit, "{start} for {solid}");
    }
}

#[test]
fn the_deceleration_of_planets_has_the_exact_derivative_with_respect_to_their_orbital_speed() {
    for pins in [false, true] {
        let (mut p, mut inputs) = rolling(50.0, 0.0);
        // wheels with different imposed speeds leave carrier and planets free and without torque
        (p.scene.planet_spin, p.scene.carrier_drive) = (PlanetSpin::Free, CarrierDrive::Torque);
        (p.scene.left_drive, p.scene.right_drive) = (SideDrive::Speed, SideDrive::Speed);
        p.effects.pin_compliance = pins;
        (inputs.carrier_torque, inputs.side_speed) = (0.0, [52.0, 48.0]);
        let simulation = Simulation::start(&p, &inputs, 0.0).expect("a scene");
        let place = |body: Body| BODIES.iter().position(|&b| b == body).expect("a body");
        let speed = |body: Body| BODIES.len() + place(body);
        let orbit = if pins { Body::Pin(0) } else { Body::Carrier };
        let states = simulation.states();
        assert!(states[speed(Body::Planet(0))] > 1.0, "{states:?}");
        let mut change = [0.0; STATES];
        change[speed(orbit)] = 1.0;
        let slopes = simulation.rate_slopes(&simulation.direction(&change, &Inputs::ZERO));
        let slopes = simulation.states_of(|i| slopes[0][i], &slopes[1]);
        let planet = Solid::new(&p.gears(), 0, p.material.density);
        let arm = p.specs.thrust_friction.coefficient * p.specs.thrust_friction.planet_washer_radius;
        let (found, wanted) =
            (slopes[speed(Body::Planet(0))], -arm * 2.0 * planet.moment * states[speed(orbit)] / planet.axial);
        assert!((found / wanted - 1.0).abs() < 1e-12, "pins {pins}: {found} for {wanted}");
        if pins {
            // the centrifugal force depends on the speed of the pin, not of the carrier
            let mut change = [0.0; STATES];
            change[speed(Body::Carrier)] = 1.0;
            let slopes = simulation.rate_slopes(&simulation.direction(&change, &Inputs::ZERO));
            assert_eq!(simulation.states_of(|i| slopes[0][i], &slopes[1])[speed(Body::Planet(0))], 0.0);
        }
    }
}
