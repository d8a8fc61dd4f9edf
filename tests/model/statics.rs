//! Statics: preload, load sharing, the cogging well of free planets, and its threshold.

use bevel_differential::contact::mesh::{Mesh, MeshState};
use bevel_differential::contact::spring::{ImpactSpring, Resultant};
use bevel_differential::contact::{AnySpring, ContactLaw, Damping, Impact};
use bevel_differential::geometry::{GearSpec, Pair};
use bevel_differential::model::{
    CarrierDrive, Forces, GearContact, Inputs, Parameters, PlanetSpin, SideDrive, Simulation, Start, readings,
};

const LOAD: f64 = 835.0;

fn started(parameters: &Parameters, inputs: &Inputs) -> Simulation {
    Simulation::start(parameters, inputs, 0.0).unwrap()
}

fn teeth(planet: i32, side: i32, count: i32) -> Parameters {
    let mut p = Parameters::default();
    p.geometry.planet_teeth = planet;
    p.geometry.side_teeth = side;
    p.geometry.planet_count = count;
    p
}

#[test]
fn equilibrium_starts_with_balanced_torques_and_no_acceleration() {
    for (z_p, z_s, n) in [(10, 16, 2), (10, 16, 4), (9, 14, 4), (11, 15, 2), (11, 15, 3), (10, 18, 3), (10, 18, 4)] {
        let mut s = started(&teeth(z_p, z_s, n), &Inputs::default());
        let inertia = s.inertias().side[0];
        let f = *s.forces();
        for side in 0..2 {
            let torque = f.side_tangential[side] * 0.5 * 4.5e-3 * f64::from(z_s);
            assert!((torque - LOAD).abs() < 1e-6, "{z_p}/{z_s}, {n} planets: {torque}");
            assert!((f.side_acceleration[side] * inertia).abs() < 1e-6);
        }
        assert!((f.carrier_torque - 2.0 * LOAD).abs() < 1e-6);
    }
}

#[test]
fn brakes_start_with_the_torque_of_their_temperature_and_sliding_speed() {
    for (direction, torque, slope) in
        [(1.0, 400.0, 0.0), (-1.0, 400.0, 0.0), (1.0, 0.0, 0.0), (1.0, 400.0, -0.05), (-1.0, 400.0, 0.1)]
    {
        let mut p = Parameters::default();
        p.effects.wheel_brake = true;
        let brakes = &mut p.specs.wheel_brake;
        (brakes.temperature, brakes.sliding.hot_temperature, brakes.sliding.hot_factor) = (473.15, 473.15, 0.25);
        (brakes.sliding.slip_slope, brakes.mean_radius) = (slope, 0.12);
        let speed = direction * Inputs::default().carrier_speed;
        let inputs =
            Inputs { carrier_speed: speed, load_torque: [0.0; 2], brake_torque: [torque; 2], ..Inputs::default() };
        let f = *started(&p, &inputs).forces();
        for side in 0..2 {
            let at_start = f.side_tangential[side] * 0.5 * 4.5e-3 * 16.0;
            let expected = direction * 0.25 * torque * (1.0 + slope * 0.12 * speed.abs());
            assert!((at_start - expected).abs() < 1e-6, "{direction} {torque} {slope}: {at_start} for {expected}");
        }
    }
}

#[test]
fn three_planets_that_differ_stay_in_the_equilibrium_they_start_in() {
    for (planet, pins) in [(10, false), (11, false), (10, true), (11, true)] {
        let mut p = teeth(planet, 15, 3);
        (p.effects.tooth_errors, p.effects.pin_compliance) = (true, pins);
        p.contact.law = ContactLaw::Line;
        let errors = &mut p.specs.tooth_errors;
        (errors.accuracy_grade, errors.axis_offset) = (5, -50e-6);
        (errors.planet_tip_relief, errors.side_tip_relief) = (35e-6, 25e-6);
        let inputs = Inputs { load_torque: [-300.0, -303.0], ..Inputs::default() };
        let mut s = started(&p, &inputs);
        let normals =
            |s: &mut Simulation| s.forces().mesh[..3].iter().flatten().map(|m| m.normal).collect::<Vec<f64>>();
        let begin = normals(&mut s);
        for k in 1..=20 {
            s.advance(f64::from(k) * 1e-5).unwrap();
            let off =
                normals(&mut s).iter().zip(&begin).map(|(now, then)| (now / then - 1.0).abs()).fold(0.0, f64::max);
            // the gears turn by 0.5 degrees
            assert!(off < 0.02, "{planet} teeth, pins {pins}: {off} after {k} steps");
        }
    }
}

/// Mesh of the default differential under the law of the study, for an independent computation of statics.
struct Statics {
    mesh: Mesh,
    sin_base: [f64; 2],
}

impl Statics {
    fn new() -> Self {
        let pair = Pair::new(&GearSpec::default());
        let law = Impact { stiffness: 5.77e5 * 1e3f64.powf(1.5), exponent: 1.5, damping: 0.0, per_full_depth: 1e4 };
        let spring = AnySpring::Impact(ImpactSpring { law, cone: pair.mean_cone });
        let whole = Resultant::new(pair.mean_cone, 1.0);
        Self { mesh: Mesh::new(&pair, (spring, Damping::NONE), whole, true, 0.1), sin_base: pair.sin_base() }
    }

    /// Energy of the loaded mesh of two identical planets, and torque on one planet, for side σ, spin angle ψ and load
    /// `torque`. The side gear is turned until it carries the load.
    fn side(&self, sigma: f64, psi: f64, torque: f64) -> (f64, f64) {
        let x = sigma * self.sin_base[0] * psi;
        let load = |q: f64| self.mesh.force(&MeshState { position: [q, x], rate: [0.0; 2], ..MeshState::default() });
        let (mut lo, mut hi) = (-0.1, 0.0);
        for _ in 0..100 {
            let q = 0.5 * (lo + hi);
            if 2.0 * self.sin_base[1] * load(q).force[0] > torque { lo = q } else { hi = q }
        }
        let alpha = (lo + x) / self.sin_base[1];
        let [f_q, f_x] = load(lo).force;
        (
            2.0 * self.mesh.energy(&MeshState { position: [lo, x], ..MeshState::default() }) + torque * alpha,
            sigma * self.sin_base[0] * (f_x - f_q),
        )
    }

    /// Torque on both planets at spin angle ψ with `extra` load on the left side [N·m].
    fn spin_torque(&self, psi: f64, extra: f64) -> f64 {
        2.0 * (self.side(1.0, psi, LOAD + extra).1 + self.side(-1.0, psi, LOAD).1)
    }

    /// True if the planets can rest somewhere in a tooth cycle with `extra` load on the left side [N·m].
    fn rests(&self, extra: f64) -> bool {
        let signs: Vec<bool> = (0..=400)
            .map(|k| self.spin_torque(f64::from(k - 200) * std::f64::consts::PI / 2000.0, extra) > 0.0)
            .collect();
        signs.windows(2).any(|w| w[0] != w[1])
    }

    /// Steepest slope of the balanced well over the angle of the side gears, max |dΠ/dα| with α = ψ z_p/z_s [N·m].
    fn steepest(&self) -> f64 {
        let ratio = self.sin_base[0] / self.sin_base[1];
        (0..=400)
            .map(|k| (self.spin_torque(f64::from(k - 200) * std::f64::consts::PI / 2000.0, 0.0) / ratio).abs())
            .fold(0.0, f64::max)
    }

    fn threshold(&self) -> f64 {
        let (mut lo, mut hi) = (0.0, 100.0);
        while hi - lo > 0.01 {
            let middle = 0.5 * (lo + hi);
            if self.rests(middle) { lo = middle } else { hi = middle }
        }
        lo
    }
}

#[test]
fn the_cogging_well_has_the_depth_of_its_potential() {
    let statics = Statics::new();
    let energy = |psi: f64| statics.side(1.0, psi, LOAD).0 + statics.side(-1.0, psi, LOAD).0;
    let levels: Vec<f64> = (0..=200).map(|k| energy(f64::from(k) * std::f64::consts::PI / 1000.0)).collect();
    let highest = levels.iter().copied().fold(f64::MIN, f64::max);
    assert!((highest - levels[0] - 1.32).abs() < 0.02, "depth {} J", highest - levels[0]);
    assert!(levels.iter().all(|&e| e >= levels[0] - 1e-9), "ψ = 0 is the minimum");
}

#[test]
fn free_planets_hold_small_imbalance_and_roll_beyond_the_threshold_of_statics() {
    let statics = Statics::new();
    // 27.35 N·m is the result of an independent computation of the same potential (tests/python/test_cogging.py)
    assert!((statics.steepest() - 27.35).abs() < 0.02, "steepest slope {} N·m", statics.steepest());
    let threshold = statics.threshold();
    assert!((threshold / statics.steepest() - 1.0).abs() < 0.01, "threshold {threshold} N·m");
    let run = |extra: f64, start: Start, time: f64| {
        let mut p = Parameters::default();
        p.scene.start = start;
        let mut inputs = Inputs::default();
        inputs.load_torque[0] += extra;
        let mut s = started(&p, &inputs);
        for k in 1..=(time / 1e-3) as u32 {
            s.advance(f64::from(k) * 1e-3).unwrap();
        }
        s.motion()
    };
    let carrier = Inputs::default().carrier_speed;
    // after the transient of a rolling start, both sides settle at carrier speed under small imbalances
    for extra in [1.0, 20.0] {
        let m = run(extra, Start::Rolling, 0.5);
        for speed in m.side_speed {
            assert!((speed / carrier - 1.0).abs() < 1e-5, "+{extra} N·m: {speed}");
        }
        assert!(m.spin_angle[0].abs() < 0.1, "+{extra} N·m rolled {} rad", m.spin_angle[0]);
    }
    // from an equilibrium, the planets of the program start to roll at the threshold computed from the potential
    assert!(run(0.97 * threshold, Start::Equilibrium, 0.2).spin_speed[0].abs() < 1e-3);
    for extra in [1.03 * threshold, 60.0] {
        let m = run(extra, Start::Equilibrium, 0.1);
        assert!(
            m.side_speed[1] > carrier + 10.0 && m.side_speed[0] < carrier - 10.0,
            "the lighter side is faster: {m:?}"
        );
        assert!(m.spin_speed[0] < -10.0);
    }
}

#[test]
fn a_load_no_tooth_can_carry_is_an_error_with_a_hint() {
    let mut inputs = Inputs::default();
    inputs.load_torque[1] = 1e7;
    let problems = Simulation::start(&Parameters::default(), &inputs, 0.0).unwrap_err();
    assert_eq!(problems[0].variable, "right.load_torque");
    assert!(problems[0].message.contains("tooth deflection exceeds half the base pitch"), "{}", problems[0]);
    // during a run, it is a step failure with time and cause, and the state stays valid
    let mut s = started(&Parameters::default(), &Inputs::default());
    s.advance(0.01).unwrap();
    let before = s.clone();
    s.set_inputs(&inputs);
    let failure = s.advance(0.02).unwrap_err();
    assert!(failure.message.contains("tooth deflection exceeds half the base pitch"), "{failure}");
    assert!(failure.time >= 0.01 && failure.time < 0.02 && s.state().is_valid());
    // the run continues from the state before the load
    let mut s = before;
    s.advance(0.03).unwrap();
}

#[test]
fn an_imposed_spin_starts_quasi_statically() {
    let mut p = Parameters::default();
    p.scene.planet_spin = PlanetSpin::Imposed;
    let inputs = Inputs { carrier_speed: 954f64.to_radians(), planet_spin: 200f64.to_radians(), ..Inputs::default() };
    let m = started(&p, &inputs).motion();
    let (expected_left, expected_right) = (1079f64.to_radians(), 829f64.to_radians());
    assert!(
        (m.side_speed[0] / expected_left - 1.0).abs() < 1e-9 && (m.side_speed[1] / expected_right - 1.0).abs() < 1e-9
    );
}

#[test]
fn half_shafts_start_wound_on_every_level_and_rest() {
    for level in [GearContact::Ideal, GearContact::Lumped, GearContact::Tooth] {
        let mut p = Parameters::default();
        p.scene.gear_contact = level;
        p.effects.half_shaft = true;
        (p.inertia.left_end, p.inertia.right_end) = (0.5, 0.5);
        let mut s = started(&p, &Inputs::default());
        let stiffness = p.specs.half_shaft.stiffness;
        for k in 0..20 {
            let f = *s.forces();
            for side in 0..2 {
                let twist = reading(&f, ["left.twist", "right.twist"][side]);
                assert!((twist * stiffness[side] / LOAD - 1.0).abs() < 1e-6, "{level:?}: {twist}");
            }
            s.advance(1e-3 * f64::from(k + 1)).unwrap();
        }
    }
}

/// Reading `name` of an effect.
fn reading(forces: &Forces, name: &str) -> f64 {
    readings().zip(forces.readings).find(|(reading, _)| reading.name == name).expect("the reading exists").1
}

#[test]
fn an_equilibrium_beyond_the_largest_deflection_is_refused_at_the_start() {
    let mut p = teeth(17, 9, 2);
    p.contact.law = ContactLaw::LineWeber;
    p.effects.body_compliance = true;
    let (mut carried, mut refused) = (0, 0);
    for k in 0..30 {
        let load = 30e3 + 1e3 * f64::from(k);
        let inputs = Inputs { load_torque: [-load, -load], ..Inputs::default() };
        match Simulation::start(&p, &inputs, 0.0) {
            // a start in equilibrium can continue
            Ok(mut s) => {
                if !s.warnings().iter().any(|warning| warning.message.contains("no equilibrium")) {
                    carried += 1;
                    assert_eq!(s.advance(1e-5), Ok(()), "{load} N.m");
                }
            }
            Err(problems) => {
                refused += 1;
                assert!(problems[0].variable.ends_with("load_torque"), "{}", problems[0]);
                assert!(problems[0].message.contains("cannot be carried at the start"), "{}", problems[0]);
            }
        }
    }
    assert!(carried > 0 && refused > 0, "{carried} carried, {refused} refused");
}

#[test]
fn a_start_under_too_large_a_torque_names_the_input_that_causes_it() {
    let said = |p: &Parameters, inputs: Inputs| {
        let Err(problems) = Simulation::start(p, &inputs, 0.0) else { panic!("teeth carry {inputs:?}") };
        problems[0].to_string()
    };
    let mut p = Parameters::default();
    (p.scene.left_drive, p.scene.right_drive) = (SideDrive::Speed, SideDrive::Speed);
    p.scene.carrier_drive = CarrierDrive::Torque;
    let inputs = Inputs { carrier_torque: 2e6, pinion_torque: -5e5, load_torque: [700.0; 2], ..Inputs::default() };
    let by_carrier = said(&p, inputs);
    assert!(by_carrier.starts_with("carrier.torque_command: 2000000"), "{by_carrier}");
    assert!(by_carrier.contains("1000000.000000 N.m on the left side gear"), "{by_carrier}");
    p.effects.final_drive = true;
    let by_pinion = said(&p, inputs);
    assert!(by_pinion.starts_with("pinion.torque_command: -500000"), "{by_pinion}");
    assert!(by_pinion.contains("-1025000.000000 N.m on the left side gear"), "{by_pinion}");
    // the load of the right side is also on the left side gear
    p.effects.final_drive = false;
    (p.scene.carrier_drive, p.scene.right_drive) = (CarrierDrive::Speed, SideDrive::Torque);
    let by_load = said(&p, Inputs { load_torque: [700.0, 1e6], ..inputs });
    assert!(by_load.starts_with("right.load_torque: 1000000"), "{by_load}");
}
