//! Motion against closed forms and conservation laws.

use bevel_differential::model::{CONTACT_HEAT, GearContact, Inputs, Parameters, PlanetSpin, Simulation, Start};

use crate::angular_momentum::Differential;

/// Error of the momentum's balance, of all its terms: rounding.
const ROUNDING: f64 = 1e-9;

fn turn() -> (Parameters, Inputs) {
    let mut p = Parameters::default();
    p.scene.planet_spin = PlanetSpin::Imposed;
    let inputs = Inputs { carrier_speed: 954f64.to_radians(), planet_spin: 200f64.to_radians(), ..Inputs::default() };
    (p, inputs)
}

/// Energy residual over ∫Σ|P_in| dt after 0.5 s of undamped turning.
fn undamped_residual(start: Start, tolerance: f64) -> f64 {
    let (mut p, inputs) = turn();
    p.contact.damping = 0.0;
    p.scene.start = start;
    p.solver.relative_tolerance = tolerance;
    let mut s = Simulation::start(&p, &inputs, 0.0).unwrap();
    let (mut turnover, steps) = (0.0, 5000);
    let differential = Differential::of(&s);
    for k in 1..=steps {
        s.advance(0.5 * f64::from(k) / f64::from(steps)).unwrap();
        let balance = differential.at(&s);
        assert!(balance.error() < ROUNDING, "{start:?}, t = {}: {balance:?}", s.time());
        let f = s.forces();
        turnover += (f.power_in.abs() + f.power_out.abs()) * 0.5 / f64::from(steps);
    }
    assert_eq!(s.ledger().heat[CONTACT_HEAT], 0.0);
    (s.ledger().energy_residual / turnover).abs()
}

#[test]
fn an_undamped_turn_conserves_energy_and_better_at_tighter_tolerance() {
    for start in [Start::Equilibrium, Start::Rolling] {
        let (loose, default, tight) =
            (undamped_residual(start, 1e-4), undamped_residual(start, 1e-6), undamped_residual(start, 1e-8));
        assert!(default < 1e-6, "{start:?}: {default:e}");
        // a loose tolerance damps the little that swings after a start in equilibrium, so that less is left to lose
        assert!(tight < default && default < loose, "{start:?}: {loose:e} {default:e} {tight:e}");
        assert!(tight < 0.1 * loose, "{start:?}: {loose:e} {default:e} {tight:e}");
    }
}

#[test]
fn no_tooth_slips_in_the_turn() {
    let (mut p, inputs) = turn();
    p.scene.start = Start::Rolling;
    let mut s = Simulation::start(&p, &inputs, 0.0).unwrap();
    let r = 10.0 / 16.0;
    // elastic deflection under (835 N·m) is below 0.1 mm, and half the lash 0.036 mm, along the line of action
    let bound = 0.15e-3 / (s.pair().mean_cone * s.pair().sin_base()[1]);
    for k in 1..=2000 {
        s.advance(f64::from(k) * 1e-3).unwrap();
        let m = s.motion();
        let left = m.side_angle[0] - m.carrier_angle - r * m.spin_angle[0];
        let right = m.side_angle[1] - m.carrier_angle + r * m.spin_angle[0];
        assert!(left.abs() < bound && right.abs() < bound, "t = {}: {left} {right}", s.time());
        assert!((m.spin_angle[0] - inputs.planet_spin * s.time()).abs() < 1e-9);
    }
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
    // momentum balances of carrier with gears, and of the spin, by d'Alembert
    let d = |a: f64, b: f64| (b - a) / 0.1;
    let (left, right) = (d(before.side_speed[0], m.side_speed[0]), d(before.side_speed[1], m.side_speed[1]));
    let (carrier, spin) = (d(before.carrier_speed, m.carrier_speed), d(0.0, m.spin_speed[0]));
    let all = j.carrier * carrier + j.side[0] * left + j.side[1] * right - (500.0 - 40.0);
    let roll = r * (j.side[0] * left - j.side[1] * right) + 2.0 * j.planet * spin - r * (30.0 - 10.0);
    assert!(all.abs() < 1e-9 && roll.abs() < 1e-9, "{all} {roll}");
    assert!(Differential::of(&s).at(&s).error() < ROUNDING);
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
        if contact == GearContact::Tooth {
            assert!(Differential::of(&s).at(&s).error() < ROUNDING);
        }
        let b = s.ledger();
        assert!(b.energy_residual.abs() < 1e-2 * b.heat[CONTACT_HEAT].max(1.0), "{contact:?}: {b:?}");
    }
}

#[test]
fn one_long_step_equals_many_short_ones() {
    let (mut p, inputs) = turn();
    p.scene.start = Start::Rolling;
    let at = |steps: u32| {
        let mut s = Simulation::start(&p, &inputs, 0.0).unwrap();
        for k in 1..=steps {
            s.advance(0.4 * f64::from(k) / f64::from(steps)).unwrap();
        }
        s.motion().side_speed
    };
    let reference = at(40_000);
    for steps in [1, 4, 40, 400, 4000] {
        let speed = at(steps);
        for side in 0..2 {
            assert!((speed[side] / reference[side] - 1.0).abs() < 2e-6, "{steps} steps: {speed:?} {reference:?}");
        }
    }
}

#[test]
fn pairs_that_enter_and_leave_contact_abruptly_keep_the_energy_balanced() {
    let (mut p, inputs) = turn();
    p.effects.corner_contact = false;
    let mut s = Simulation::start(&p, &inputs, 0.0).unwrap();
    s.advance(0.5).unwrap();
    assert!(Differential::of(&s).at(&s).error() < ROUNDING);
    // each jump is of some tenths of a joule, and there are a dozen of them
    let residual = s.ledger().energy_residual;
    assert!(residual.abs() < 1e-3, "{residual} J");
}
