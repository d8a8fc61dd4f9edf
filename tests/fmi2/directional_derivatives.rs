//! Tests that compare directional derivatives with finite differences.

use bevel_differential::fmi2::*;
use bevel_differential::model::STATES;
use bevel_differential::variables::table;

use crate::common::{Host, reference};
use crate::derivatives::{driven_by_torque, smooth_outputs};
use crate::solver::{Solver, level};

fn along(host: &Host, unknown: &str, known: &[(&str, f64)]) -> f64 {
    let references: Vec<u32> = known.iter().map(|(name, _)| reference(name)).collect();
    let change: Vec<f64> = known.iter().map(|(_, change)| *change).collect();
    let mut value = f64::NAN;
    // SAFETY: a live component and arrays of these lengths
    let status = unsafe {
        let (known, count) = (references.as_ptr(), references.len());
        fmi2GetDirectionalDerivative(host.c, &reference(unknown), 1, known, count, change.as_ptr(), &mut value)
    };
    assert_eq!(status, Status::Ok, "{unknown}: {:?}", host.log());
    value
}

#[test]
fn derivatives_with_respect_to_inputs_equal_differences_of_outputs() {
    for level in [1, 2, 3] {
        let host = driven_by_torque(level);
        host.start();
        host.steps(0.0, 1e-3, 5);
        for input in ["carrier.torque_command", "left.load_torque", "right.load_torque", "carrier.speed_command"] {
            let value = host.get(input);
            let d = 1e-3 * value;
            for name in smooth_outputs() {
                let computed = along(&host, name, &[(input, 2.0)]);
                let [high, low] = [d, -d].map(|d| {
                    assert_eq!(host.set(input, value + d), Status::Ok);
                    host.get(name)
                });
                assert_eq!(host.set(input, value), Status::Ok);
                let difference = (high - low) / d;
                let bound = 1e-7 * difference.abs() + 1e-9 * (1.0 + high.abs() / d.abs());
                assert!(
                    (computed - difference).abs() < bound,
                    "{level}: d({name})/d({input}): {computed}, {difference}"
                );
            }
        }
        // an exact formula: the shaft transmits the load and accelerates the inertia of the wheel
        let by_load = along(&host, "left.shaft_torque", &[("left.load_torque", 1.0)]);
        let acceleration = along(&host, "left.acceleration", &[("left.load_torque", 1.0)]);
        assert!((by_load - 1.0 - 0.5 * acceleration).abs() < 1e-9, "{by_load} {acceleration}");
    }
}

#[test]
fn the_torque_of_a_half_shaft_follows_the_speed_of_its_wheel_immediately() {
    for level in [1, 3] {
        let host = Host::on_level(level);
        assert_eq!(host.set_integer("scene.carrier_drive", 2), Status::Ok);
        assert_eq!(host.set_boolean("effects.half_shaft", 1), Status::Ok);
        for side in ["left", "right"] {
            assert_eq!(host.set_integer(&format!("scene.{side}_drive"), 2), Status::Ok);
        }
        host.start();
        host.steps(0.0, 1e-3, 2);
        let (torque, speed) = (host.get("left.shaft_torque"), host.get("left.speed_command"));
        let by_speed = along(&host, "left.shaft_torque", &[("left.speed_command", 1.0)]);
        let damping = host.get("half_shaft.left_damping");
        assert!(damping > 0.0 && (by_speed + damping).abs() < 1e-6 * damping, "{by_speed} {damping}");
        let before = host.get("solver.energy_residual");
        assert_eq!(host.set("left.speed_command", speed + 2.0), Status::Ok);
        assert!((host.get("left.shaft_torque") - torque + 2.0 * damping).abs() < 1e-6 * torque.abs());
        assert_eq!(host.get("solver.energy_residual"), before, "no step, no work");
        // the old speed restores the old torque
        assert_eq!(host.set("left.speed_command", speed), Status::Ok);
        assert_eq!(host.get("left.shaft_torque"), torque);
    }
}

#[test]
fn initial_outputs_have_derivatives_with_respect_to_inputs_and_parameters() {
    let host = driven_by_torque(3);
    assert_eq!(host.setup(), Status::Ok);
    assert_eq!(host.enter(), Status::Ok);
    // the deflection under equal loads decreases with stiffness as K^(-2/3)
    let stiffness = host.get("contact.stiffness");
    let bent = host.get("planet[1].left_transmission_error");
    let by_stiffness = along(&host, "planet[1].left_transmission_error", &[("contact.stiffness", stiffness)]);
    assert!((by_stiffness / (-2.0 / 3.0 * bent) - 1.0).abs() < 1e-6, "{by_stiffness} {bent}");
    // the derivative is one-sided at a limit of a range
    let other = Host::new();
    assert_eq!((other.setup(), other.enter()), (Status::Ok, Status::Ok));
    assert!(along(&other, "left.acceleration", &[("inertia.left_end", 1.0)]).is_finite());
    let by_speed = along(&host, "carrier.speed", &[("carrier.speed_command", 3.0)]);
    assert!((by_speed - 3.0).abs() < 1e-9);
}
#[test]
fn derivatives_of_rates_equal_differences_of_rates() {
    for (gears, extra) in [(1, false), (2, false), (3, false), (3, true), (4, false)] {
        let mut solver = Solver::new(|host| {
            level(host, gears);
            assert_eq!(host.set_integer("scene.carrier_drive", if extra { 1 } else { 2 }), Status::Ok);
            if extra {
                assert_eq!(host.set_boolean("effects.half_shaft", 1), Status::Ok);
                assert_eq!(host.set_boolean("effects.pin_compliance", 1), Status::Ok);
                assert_eq!(host.set_boolean("effects.final_drive", 1), Status::Ok);
            }
        });
        solver.steps(1e-6, 20);
        let (x, time) = (solver.states(), solver.time);
        let unknown = table().derivatives.map(|i| i as u32);
        let inputs = ["left.load_torque", "carrier.torque_command", "carrier.speed_command"];
        for k in 0..STATES + inputs.len() {
            let known = if k < STATES { table().states[k] as u32 } else { reference(inputs[k - STATES]) };
            let mut computed = [f64::NAN; STATES];
            // SAFETY: a live component and arrays of these lengths
            let status = unsafe {
                let (unknown, values) = (unknown.as_ptr(), computed.as_mut_ptr());
                fmi2GetDirectionalDerivative(solver.host.c, unknown, STATES, &known, 1, &1.0, values)
            };
            assert_eq!(status, Status::Ok, "{:?}", solver.host.log());
            let d = if k < STATES { 1e-6 * table().rows[table().states[k]].nominal.unwrap() } else { 1e-2 };
            let at = |position: f64| {
                if k < STATES {
                    let mut y = x;
                    y[k] += position * d;
                    return solver.rates(time, &y);
                }
                let value = solver.host.get(inputs[k - STATES]);
                assert_eq!(solver.host.set(inputs[k - STATES], value + position * d), Status::Ok);
                let rates = solver.rates(time, &x);
                assert_eq!(solver.host.set(inputs[k - STATES], value), Status::Ok);
                rates
            };
            let (high, low) = (at(1.0), at(-1.0));
            for i in 0..STATES {
                // rates of positions and of velocities, each compared with the largest of their kind
                let kind = if i < STATES / 2 { &computed[..STATES / 2] } else { &computed[STATES / 2..] };
                let steepest = kind.iter().fold(1e-3, |m: f64, x| m.max(x.abs()));
                let difference = (high[i] - low[i]) / (2.0 * d);
                let noise = 1e-5 * difference.abs() + 1e-6 * steepest;
                assert!(
                    (computed[i] - difference).abs() < noise,
                    "{gears} {extra}: rate {i} by {k}: {} {difference}",
                    computed[i]
                );
            }
        }
    }
}
