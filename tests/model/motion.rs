//! Motion compared with closed forms and conservation laws.

use bevel_differential::model::{CONTACT_HEAT, GearContact, Inputs, Parameters, PlanetSpin, Simulation};

fn turn() -> (Parameters, Inputs) {
    let mut p = Parameters::default();
    p.scene.planet_spin = PlanetSpin::Imposed;
    let inputs = Inputs { carrier_speed: 954f64.to_radians(), planet_spin: 200f64.to_radians(), ..Inputs::default() };
    (p, inputs)
}

fn ideal() -> Parameters {
    let mut p = Parameters::default();
    p.scene.gear_contact = GearContact::Ideal;
    p
}

#[test]
fn an_ideal_differential_accelerates_by_its_closed_form() {
    let mut inputs = Inputs::default();
    inputs.load_torque[0] += 1.0;
    let mut s = Simulation::start(&ideal(), &inputs, 0.0).unwrap();
    let (j, r) = (*s.inertias(), 0.625);
    let spin = -r / (r * r * 2.0 * j.side[0] + 2.0 * j.planet);
    for k in 1..=100 {
        let t = f64::from(k) * 1e-3;
        s.advance(t).unwrap();
        let m = s.motion();
        assert!((m.spin_speed[0] / (spin * t) - 1.0).abs() < 1e-12);
        assert!((m.spin_angle[0] / (0.5 * spin * t * t) - 1.0).abs() < 1e-9);
        assert!((m.side_speed[0] + m.side_speed[1] - 2.0 * m.carrier_speed).abs() < 1e-12 * m.carrier_speed);
        assert!(m.side_speed[0] < m.side_speed[1], "the lighter side is faster");
    }
    // the gears transmit different torques only to accelerate the planets: T_L − T_R = N I_p (z_s/z_p) ψ̈
    let radius = 0.036;
    let f = *s.forces();
    let difference = (f.side_tangential[0] - f.side_tangential[1]) * radius;
    assert!((difference + 2.0 * j.planet / r * spin).abs() < 1e-9, "{difference}");
    assert!(s.ledger().energy_residual.abs() < 1e-9 * 835.0 * 50.0);
}

#[test]
fn an_ideal_torque_driven_differential_with_unequal_ends_follows_its_mass_matrix() {
    let mut p = ideal();
    p.scene.carrier_drive = bevel_differential::model::CarrierDrive::Torque;
    p.inertia.left_end = 1.0;
    p.inertia.right_end = 3.0;
    let inputs = Inputs { carrier_torque: 500.0, load_torque: [10.0, 30.0], ..Inputs::default() };
    let mut s = Simulation::start(&p, &inputs, 0.0).unwrap();
    let before = s.motion();
    s.advance(0.1).unwrap();
    let (m, j, r) = (s.motion(), *s.inertias(), 0.625);
    // d'Alembert's momentum balances of the carrier with its gears, and of the spin
    let d = |a: f64, b: f64| (b - a) / 0.1;
    let (left, right) = (d(before.side_speed[0], m.side_speed[0]), d(before.side_speed[1], m.side_speed[1]));
    let (carrier, spin) = (d(before.carrier_speed, m.carrier_speed), d(0.0, m.spin_speed[0]));
    let all = j.carrier * carrier + j.side[0] * left + j.side[1] * right - (500.0 - 40.0);
    let roll = r * (j.side[0] * left - j.side[1] * right) + 2.0 * j.planet * spin - r * (30.0 - 10.0);
    assert!(all.abs() < 1e-9 && roll.abs() < 1e-9, "{all} {roll}");
}

#[test]
fn a_jump_of_an_imposed_speed_is_counted_as_work() {
    for contact in [GearContact::Ideal, GearContact::Tooth] {
        let mut p = Parameters::default();
        p.scene.gear_contact = contact;
        let mut inputs = Inputs::default();
        let mut s = Simulation::start(&p, &inputs, 0.0).unwrap();
        s.advance(0.01).unwrap();
        inputs.carrier_speed *= 0.9;
        s.set_inputs(&inputs);
        for k in 1..=100 {
            s.advance(0.01 + f64::from(k) * 1e-3).unwrap();
        }
        let m = s.motion();
        assert!((m.side_speed[0] / inputs.carrier_speed - 1.0).abs() < 1e-4, "{contact:?}: {m:?}");
        let b = s.ledger();
        assert!(b.energy_residual.abs() < 1e-2 * b.heat[CONTACT_HEAT].max(1.0), "{contact:?}: {b:?}");
    }
}

#[test]
fn pairs_that_enter_and_leave_contact_abruptly_keep_the_energy_balanced() {
    let (mut p, inputs) = turn();
    p.effects.teeth.corner_contact = false;
    let mut s = Simulation::start(&p, &inputs, 0.0).unwrap();
    s.advance(0.5).unwrap();
    // there are a dozen jumps of some tenths of a joule
    let residual = s.ledger().energy_residual;
    assert!(residual.abs() < 1e-3, "{residual} J");
}
