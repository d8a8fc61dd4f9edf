//! Half-shafts on ideal gears, compared with the damped oscillation of two bodies, while the loads change at every
//! communication step.

use bevel_differential::model::{CarrierDrive, GearContact, Inputs, Method, Parameters, Simulation};

/// Stiffness k of each half-shaft [N·m/rad].
const STIFFNESS: f64 = 9000.0;
/// Damping c of each half-shaft [N·m·s/rad].
const DAMPING: f64 = 5.0;
/// Inertia of each wheel [kg·m²].
const END: f64 = 1.0;
/// Torque on the carrier [N·m].
const TORQUE: f64 = 250.0;
/// Communication step [s].
const H: f64 = 1e-3;

/// Twist [rad] and twist rate [rad/s] `h` [s] after they were `twist` and `rate`, by the closed-form solution of
/// φ̈ = f − a (k φ + c φ̇).
fn twist_after(h: f64, [twist, rate]: [f64; 2], f: f64, a: f64) -> [f64; 2] {
    let rest = f / (a * STIFFNESS);
    let decay = 0.5 * a * DAMPING;
    let frequency = (a * STIFFNESS - decay * decay).sqrt();
    let (sin, cos) = (frequency * h).sin_cos();
    let (x, y) = (twist - rest, (rate + decay * (twist - rest)) / frequency);
    let e = (-decay * h).exp();
    let moved = e * (x * cos + y * sin);
    [rest + moved, e * frequency * (y * cos - x * sin) - decay * moved]
}

#[test]
fn twists_under_loads_that_change_at_every_step_follow_a_damped_oscillation() {
    for (method, tolerance) in [(Method::Adaptive, 1e-6), (Method::Adaptive, 1e-8), (Method::Radau, 1e-8)] {
        let mut p = Parameters::default();
        (p.scene.gear_contact, p.scene.carrier_drive) = (GearContact::Ideal, CarrierDrive::Torque);
        p.effects.half_shaft = true;
        (p.specs.half_shaft.stiffness, p.specs.half_shaft.damping) = ([STIFFNESS; 2], [DAMPING; 2]);
        (p.inertia.left_end, p.inertia.right_end) = (END, END);
        (p.solver.method, p.solver.relative_tolerance) = (method, tolerance);
        let mut inputs = Inputs { carrier_torque: TORQUE, load_torque: [100.0; 2], ..Inputs::default() };
        let mut s = Simulation::start(&p, &inputs, 0.0).unwrap();
        // carrier and side gears turn as one body under equal loads
        let inner = s.inertias().carrier + s.inertias().side.iter().map(|side| side - END).sum::<f64>();
        let twist = |s: &Simulation, side: usize| {
            let m = s.motion();
            [m.side_angle[side] - m.wheel_angle[side], m.side_speed[side] - m.wheel_speed[side]]
        };
        let mut expected = twist(&s, 0);
        let mut largest = 0.0f64;
        for k in 0..500 {
            let load = 100.0 + 100.0 * (4.0 * std::f64::consts::PI * f64::from(k) * H).sin();
            inputs.load_torque = [load; 2];
            s.set_inputs(&inputs);
            s.advance(f64::from(k + 1) * H).unwrap();
            let (f, a) = (TORQUE / inner + load / END, 2.0 / inner + 1.0 / END);
            expected = twist_after(H, expected, f, a);
            largest = largest.max(expected[0].abs());
            // each step may add an error of one tolerance of the twist
            let allowed = f64::from(k + 1) * tolerance * (1e-3 + largest);
            for side in 0..2 {
                let found = twist(&s, side)[0];
                assert!((found - expected[0]).abs() < allowed, "{method:?} {tolerance} {k}: {found} {}", expected[0]);
            }
        }
        assert!(largest > 0.01, "{largest} rad: the shafts twist");
        let ledger = s.ledger();
        assert!(ledger.energy_residual.abs() < 500.0 * tolerance * 100.0, "{} J", ledger.energy_residual);
    }
}
