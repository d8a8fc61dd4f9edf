//! Ideal gears without effects under inputs that are linear or quadratic in time. Their steps have a closed form.
//!
//! Expected values are momenta and energies of all bodies, and integrals of the torques.

use bevel_differential::model::{
    CarrierDrive, GearContact, InputDerivatives, Inputs, Parameters, PlanetSpin, Simulation,
};

/// Length of the steps [s].
const H: f64 = 0.07;
/// z_p/z_s of the default gears.
const RATIO: f64 = 0.625;

/// Scenes with half-shaft ends of unequal inertia, for imposed and free carriers and spins.
fn scenes() -> Vec<Parameters> {
    let mut scenes = Vec::new();
    for drive in [CarrierDrive::Speed, CarrierDrive::Torque] {
        for spin in [PlanetSpin::Free, PlanetSpin::Imposed] {
            let mut p = Parameters::default();
            p.scene.gear_contact = GearContact::Ideal;
            (p.scene.carrier_drive, p.scene.planet_spin) = (drive, spin);
            (p.inertia.left_end, p.inertia.right_end) = (1.0, 3.0);
            scenes.push(p);
        }
    }
    scenes
}

/// Inputs and their derivatives. The `sign` −1 gives the mirror image.
fn course(sign: f64) -> (Inputs, InputDerivatives) {
    let of = |carrier_speed, carrier_torque, load_torque: [f64; 2], planet_spin| Inputs {
        carrier_speed: sign * carrier_speed,
        carrier_torque: sign * carrier_torque,
        load_torque: load_torque.map(|torque| sign * torque),
        planet_spin: sign * planet_spin,
        ..Inputs::ZERO
    };
    let first = of(30.0, 4e3, [-7e3, 2e3], 11.0);
    let second = of(-400.0, 9e4, [5e4, -3e4], 250.0);
    (of(20.0, 500.0, [300.0, 250.0], 3.0), InputDerivatives { rates: [first, second] })
}

fn start(p: &Parameters, sign: f64) -> Simulation {
    let (inputs, derivatives) = course(sign);
    let mut s = Simulation::start(p, &inputs, 0.0).unwrap();
    s.set_input_derivatives(Some(derivatives));
    s
}

/// Value of a `sum` of inputs after `t` [s], with its first and second integral.
fn along(sum: impl Fn(&Inputs) -> f64, t: f64) -> [f64; 3] {
    let (inputs, InputDerivatives { rates: [first, second] }) = course(1.0);
    let [a, b, c] = [inputs, first, second].map(|inputs| sum(&inputs));
    [
        a + b * t + c * t.powi(2) / 2.0,
        a * t + b * t.powi(2) / 2.0 + c * t.powi(3) / 6.0,
        a * t.powi(2) / 2.0 + b * t.powi(3) / 6.0 + c * t.powi(4) / 24.0,
    ]
}

/// Speeds of carrier, side gears and planets [rad/s], and the angles that they have turned [rad].
fn motion(s: &Simulation) -> [[f64; 4]; 2] {
    let m = s.motion();
    [
        [m.carrier_speed, m.side_speed[0], m.side_speed[1], m.spin_speed[0]],
        [m.carrier_angle, m.side_angle[0], m.side_angle[1], m.spin_angle[0]],
    ]
}

/// Inertias of carrier, side gears and all planets [kg·m²].
fn inertias(s: &Simulation) -> [f64; 4] {
    let j = s.inertias();
    [j.carrier, j.side[0], j.side[1], j.planets * j.planet]
}

fn kinetic_energy(s: &Simulation) -> f64 {
    let ([speeds, _], inertias) = (motion(s), inertias(s));
    (0..4).map(|i| 0.5 * inertias[i] * speeds[i] * speeds[i]).sum()
}

#[track_caller]
fn assert_near(found: f64, expected: f64, size: f64) {
    assert!((found - expected).abs() <= 1e-12 * size, "{found} is not {expected} within 1e-12 of {size}");
}

#[test]
fn imposed_speeds_follow_their_inputs_and_free_ones_the_sums_of_torques() {
    for p in scenes() {
        let mut s = start(&p, 1.0);
        let ([speeds, angles], j) = (motion(&s), inertias(&s));
        s.advance(H).unwrap();
        let after = motion(&s);
        let gained: [f64; 4] = std::array::from_fn(|i| after[0][i] - speeds[i]);
        let turned: [f64; 4] = std::array::from_fn(|i| after[1][i] - angles[i]);
        // angles that result from the accelerations
        let beyond: [f64; 4] = std::array::from_fn(|i| turned[i] - H * speeds[i]);
        if p.scene.carrier_drive == CarrierDrive::Speed {
            let [speed, angle, _] = along(|u| u.carrier_speed, H);
            assert_near(after[0][0], speed, 50.0);
            assert_near(turned[0], angle, 50.0);
        } else {
            let [_, momentum, of_angle] = along(|u| u.carrier_torque - u.load_torque[0] - u.load_torque[1], H);
            let all = |x: &[f64; 4]| j[0] * x[0] + j[1] * x[1] + j[2] * x[2];
            assert_near(all(&gained), momentum, 100.0);
            assert_near(all(&beyond), of_angle, 100.0);
        }
        if p.scene.planet_spin == PlanetSpin::Imposed {
            let [speed, angle, _] = along(|u| u.planet_spin, H);
            assert_near(after[0][3], speed, 50.0);
            assert_near(turned[3], angle, 50.0);
        } else {
            let [_, momentum, of_angle] = along(|u| RATIO * (u.load_torque[1] - u.load_torque[0]), H);
            let roll = |x: &[f64; 4]| RATIO * (j[1] * x[1] - j[2] * x[2]) + j[3] * x[3];
            assert_near(roll(&gained), momentum, 100.0);
            assert_near(roll(&beyond), of_angle, 100.0);
        }
        // Willis' equation
        for x in [gained, turned] {
            assert_near(x[1], x[0] + RATIO * x[3], 50.0);
            assert_near(x[2], x[0] - RATIO * x[3], 50.0);
        }
        assert_eq!(s.ledger().steps, 1.0, "a step is computed in one piece");
    }
}

#[test]
fn the_work_of_all_inputs_is_the_gain_of_kinetic_energy() {
    for p in scenes() {
        let mut s = start(&p, 1.0);
        let before = kinetic_energy(&s);
        for k in 1..=3 {
            s.advance(f64::from(k) * H).unwrap();
        }
        let gained = kinetic_energy(&s) - before;
        assert!(gained.abs() > 100.0, "{gained} J: the scene moves");
        assert_near(s.state().sums.work, gained, kinetic_energy(&s));
    }
}

/// Work of imposed speeds follows from the torques that impose them. The work of a scene without such torques is
/// therefore compared with the integral of its power.
#[test]
fn the_work_of_torques_is_the_integral_of_their_power() {
    let p = scenes().remove(2);
    let power = |t: f64| {
        let mut s = start(&p, 1.0);
        s.advance(t).unwrap();
        let [carrier, left, right] =
            [along(|u| u.carrier_torque, t)[0], along(|u| u.load_torque[0], t)[0], along(|u| u.load_torque[1], t)[0]];
        let m = s.motion();
        carrier * m.carrier_speed - left * m.side_speed[0] - right * m.side_speed[1]
    };
    let mut s = start(&p, 1.0);
    s.advance(H).unwrap();
    // Simpson's rule on intervals so short that it is exact except for rounding
    let n = 400;
    let sum: f64 = (0..=n)
        .map(|k| {
            let weight = if k == 0 || k == n { 1.0 } else { f64::from(2 + 2 * (k % 2)) };
            weight * power(H * f64::from(k) / f64::from(n))
        })
        .sum();
    assert_near(s.state().sums.work, sum * H / f64::from(3 * n), 1e4);
}

#[test]
fn one_long_step_is_as_exact_as_many_short_ones() {
    for p in scenes() {
        let [mut one, mut many] = [start(&p, 1.0), start(&p, 1.0)];
        one.advance(H).unwrap();
        for k in 1..=64 {
            many.advance(H * f64::from(k) / 64.0).unwrap();
        }
        let (one, many) = (motion(&one), motion(&many));
        for i in 0..4 {
            assert_near(one[0][i], many[0][i], 1e2);
            assert_near(one[1][i], many[1][i], 1e2);
        }
    }
}

#[test]
fn the_mirror_image_has_the_same_bits_with_opposite_signs() {
    for p in scenes() {
        let [mut s, mut mirrored] = [start(&p, 1.0), start(&p, -1.0)];
        for k in 1..=5 {
            let t = f64::from(k) * H;
            s.advance(t).unwrap();
            mirrored.advance(t).unwrap();
            assert_eq!(motion(&s), motion(&mirrored).map(|x| x.map(|x| -x)));
            assert_eq!(s.state().sums.work, mirrored.state().sums.work);
        }
    }
}
