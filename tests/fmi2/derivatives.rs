//! Tests that compare derivatives of inputs and outputs with steps and finite differences.

use bevel_differential::fmi2::*;
use bevel_differential::variables::table;
use bevel_differential::variables::units::{NEWTON, NEWTON_METRE, ONE, PASCAL, RAD_PER_S2, WATT};

use crate::common::{Host, assert_contains, reference};

fn set_derivative(host: &Host, name: &str, order: i32, value: f64) {
    // SAFETY: a live component and one value each
    let status = unsafe { fmi2SetRealInputDerivatives(host.c, &reference(name), 1, &order, &value) };
    assert_eq!(status, Status::Ok, "{:?}", host.log());
}

fn rate(host: &Host, name: &str) -> f64 {
    let mut value = f64::NAN;
    // SAFETY: a live component and one value each
    let status = unsafe { fmi2GetRealOutputDerivatives(host.c, &reference(name), 1, &1, &mut value) };
    assert_eq!(status, Status::Ok, "{name}: {:?}", host.log());
    value
}

/// Creates a torque-driven differential with gear contact `level`, whose wheels have inertia.
pub fn driven_by_torque(level: i32) -> Host {
    let host = Host::on_level(level);
    assert_eq!(host.set_integer("scene.carrier_drive", 2), Status::Ok);
    host
}

#[test]
fn torques_with_two_derivatives_give_the_momentum_of_their_integral() {
    for level in [1, 2, 3] {
        let host = driven_by_torque(level);
        host.start();
        let inertia = {
            // everything rotates with the carrier, so an impulse of 1 N·m·s without load gives the inertia
            let trial = driven_by_torque(1);
            assert_eq!(trial.set_many(&["left.load_torque", "right.load_torque"], &[0.0; 2]), Status::Ok);
            assert_eq!(trial.set("carrier.torque_command", 100.0), Status::Ok);
            trial.start();
            let before = trial.get("carrier.speed");
            trial.steps(0.0, 1e-2, 1);
            1.0 / (trial.get("carrier.speed") - before)
        };
        let before = host.get("carrier.speed");
        set_derivative(&host, "carrier.torque_command", 1, 2000.0);
        set_derivative(&host, "carrier.torque_command", 2, -3e4);
        let h = 0.05;
        host.steps(0.0, h, 1);
        let impulse = 2000.0 * h * h / 2.0 - 3e4 * h * h * h / 6.0;
        let gained = (host.get("carrier.speed") - before) * inertia;
        // the teeth vibrate about the mean motion
        let bound = if level == 1 { 1e-9 } else { 2e-2 };
        assert!((gained / impulse - 1.0).abs() < bound, "level {level}: {gained} instead of {impulse} N·m·s");
        assert_eq!(host.get("carrier.torque_command"), 1670.0 + 2000.0 * h - 1.5e4 * h * h);
    }
}

#[test]
fn imposed_speeds_follow_their_derivatives_and_need_the_torque_of_their_acceleration() {
    for level in [1, 2, 3] {
        let host = Host::on_level(level);
        host.start();
        let (speed, angle) = (host.get("carrier.speed"), host.get("carrier.angle"));
        let torque = host.get("carrier.torque");
        set_derivative(&host, "carrier.speed_command", 1, 200.0);
        let h = 0.02;
        host.steps(0.0, h, 1);
        assert!((host.get("carrier.speed") - speed - 200.0 * h).abs() < 1e-9);
        let turned = host.get("carrier.angle") - angle;
        assert!((turned - speed * h - 100.0 * h * h).abs() < 1e-9, "{turned}");
        // without further calls, the speed continues to rise
        host.steps(h, h, 1);
        assert!((host.get("carrier.speed") - speed - 400.0 * h).abs() < 1e-9);
        // at least 1 kg·m² of wheels and 0.02 kg·m² of carrier and gears
        let more = host.get("carrier.torque") - torque;
        // lumped meshes still vibrate
        assert!(level == 2 || (200.0..230.0).contains(&more), "level {level}: {more} N·m");
        // relative to the transmitted energy
        let through = host.get("power.in") * 2.0 * h;
        assert!(host.get("solver.energy_residual").abs() < 1e-6 * through, "{}", host.get("solver.energy_residual"));
    }
}

#[test]
fn accelerated_shaft_ends_need_the_work_of_their_inertia() {
    for level in [1, 3] {
        let host = driven_by_torque(level);
        assert_eq!(host.set_boolean("effects.half_shaft", 1), Status::Ok);
        for side in ["left", "right"] {
            assert_eq!(host.set_integer(&format!("scene.{side}_drive"), 2), Status::Ok);
        }
        host.start();
        for side in ["left", "right"] {
            set_derivative(&host, &format!("{side}.speed_command"), 1, 200.0);
        }
        let h = 0.02;
        host.steps(0.0, h, 1);
        // 0.5 kg·m² at each end, from 50 to 54 rad/s: about 200 J
        let residual = host.get("solver.energy_residual");
        assert!(residual.abs() < 0.01, "level {level}: {residual} J");
    }
}

#[test]
fn one_long_step_with_derivatives_equals_many_short_steps() {
    for level in [1, 3] {
        let run = |h: f64, with_rates: bool| {
            let host = Host::on_level(level);
            assert_eq!(host.set_integer("scene.planet_spin", 2), Status::Ok);
            assert_eq!(host.set("solver.relative_tolerance", 1e-9), Status::Ok);
            host.start();
            let steps = (0.01 / h).round() as usize;
            for i in 0..steps {
                let t = i as f64 * h;
                // short steps hold the value at their middle
                let at = if with_rates { t } else { t + 0.5 * h };
                assert_eq!(host.set("left.load_torque", 835.0 + 3e4 * at), Status::Ok);
                assert_eq!(host.set("spin.command", 200.0 * at), Status::Ok);
                if with_rates {
                    set_derivative(&host, "left.load_torque", 1, 3e4);
                    set_derivative(&host, "spin.command", 1, 200.0);
                }
                assert_eq!(host.step(t, h), Status::Ok, "{:?}", host.log());
            }
            (host.get("left.speed"), host.get("planet[1].spin_angle"))
        };
        let (long, short) = (run(1e-2, true), run(1e-5, false));
        assert!((long.0 - short.0).abs() < 2e-3, "{long:?} {short:?}");
        assert!((long.1 - short.1).abs() < 1e-6, "{long:?} {short:?}");
        assert!((long.1 - 100.0 * 1e-4).abs() < 1e-9);
    }
}

#[test]
fn an_input_set_without_a_derivative_is_held_constant() {
    let host = Host::on_level(1);
    host.start();
    set_derivative(&host, "left.load_torque", 1, 1e4);
    assert_eq!(host.set("left.load_torque", 500.0), Status::Ok, "in either order before a step");
    host.steps(0.0, 1e-3, 1);
    assert_eq!(host.get("left.load_torque"), 510.0);
    assert_eq!(host.set("left.load_torque", 600.0), Status::Ok);
    host.steps(1e-3, 1e-3, 1);
    assert_eq!(host.get("left.load_torque"), 600.0);
    // the range is checked at the end of the step
    set_derivative(&host, "left.load_torque", 1, 1e12);
    assert_eq!(host.step(2e-3, 1e-3), Status::Error);
    assert_contains(&host.last_message(), &["left.load_torque", "N.m", "100000000"]);
    set_derivative(&host, "left.load_torque", 1, 0.0);
    host.steps(2e-3, 1e-3, 1);
}

#[test]
fn input_derivatives_are_part_of_the_state() {
    let host = Host::on_level(3);
    host.start();
    set_derivative(&host, "left.load_torque", 1, 1e4);
    host.steps(0.0, 1e-3, 1);
    let state = host.get_state();
    let bytes = host.serialize(state);
    let on = |host: &Host| {
        host.steps(1e-3, 1e-3, 3);
        host.outputs()
    };
    let expected = on(&host);
    assert_eq!(host.set_state(state), Status::Ok);
    assert!(on(&host) == expected);
    let other = Host::new();
    let (status, copy) = other.deserialize(&bytes);
    assert_eq!((status, other.set_state(copy)), (Status::Ok, Status::Ok));
    assert!(on(&other) == expected);
    other.free_state(copy);
    host.free_state(state);
}

/// Outputs with continuous derivatives: neither the heat of contact, nor statistics of the solver, nor counts.
pub fn smooth_outputs() -> Vec<&'static str> {
    let is_smooth = |name: &&str| {
        let groups = ["heat.contact", "solver.", "held."];
        !groups.iter().any(|group| name.starts_with(group)) && !name.ends_with("_pairs")
    };
    table().real_outputs().map(|i| table().rows[i as usize].name).filter(is_smooth).collect()
}

#[test]
fn output_derivatives_equal_differences_of_outputs() {
    for level in [1, 2, 3] {
        // the gears roll under a rising torque, so that everything moves
        let begin = || {
            let host = driven_by_torque(level);
            assert_eq!(host.set_integer("scene.start", 2), Status::Ok);
            assert_eq!(host.set("solver.relative_tolerance", 1e-10), Status::Ok);
            assert_eq!(host.set("right.load_torque", 700.0), Status::Ok);
            host.start();
            host.steps(0.0, 1e-3, 13);
            set_derivative(&host, "carrier.torque_command", 1, 1e4);
            set_derivative(&host, "left.load_torque", 1, -5e3);
            host
        };
        let (host, h) = (begin(), 2e-7);
        let state = host.get_state();
        let at = |steps: usize, name: &str| {
            assert_eq!(host.set_state(state), Status::Ok);
            host.steps(13e-3, h, steps);
            host.get(name)
        };
        for name in smooth_outputs() {
            assert_eq!(host.set_state(state), Status::Ok);
            let computed = rate(&host, name);
            let [a, b, c] = [0, 1, 2].map(|n| at(n, name));
            let difference = (-3.0 * a + 4.0 * b - c) / (2.0 * h);
            // rounding errors of the values, divided by h
            let unit = table().rows[reference(name) as usize].unit.unwrap();
            // accelerations result from torques of 1 kN·m; efficiencies are ratios of such torques
            let least = if unit == RAD_PER_S2 {
                1e3
            } else if unit == ONE {
                0.1
            } else {
                0.0
            };
            let size = a.abs().max(least);
            let floor = if [WATT, NEWTON, NEWTON_METRE, RAD_PER_S2, PASCAL].contains(&unit) { 1e-3 } else { 1e-8 };
            let noise = 1e-5 * difference.abs() + 2e-11 * size / h + floor;
            assert!(
                (computed - difference).abs() <= noise,
                "level {level}: d({name})/dt = {computed}, differences {difference}"
            );
        }
        // the derivative of heat in the ledger is a power
        assert_eq!(host.set_state(state), Status::Ok);
        let computed = rate(&host, "heat.contact");
        let [a, b] = [0, 5].map(|n| at(n, "heat.contact"));
        let difference = (b - a) / (5.0 * h);
        assert!(
            (computed - difference).abs() <= 1e-3 * difference.abs() + 1e-6,
            "level {level}: {computed} W, {difference} W"
        );
        host.free_state(state);
    }
}

#[test]
fn derivatives_set_before_initialisation_apply_from_the_start() {
    let host = Host::on_level(1);
    set_derivative(&host, "carrier.speed_command", 1, 100.0);
    host.start();
    assert_eq!(rate(&host, "carrier.speed"), 100.0);
    let held = Host::on_level(1);
    held.start();
    assert!(host.get("carrier.torque") > held.get("carrier.torque") + 100.0);
}

#[test]
fn a_parabola_that_leaves_the_range_in_between_is_refused() {
    let host = Host::on_level(1);
    host.start();
    let h = 1e-3;
    set_derivative(&host, "left.load_torque", 1, 4e9 / h);
    set_derivative(&host, "left.load_torque", 2, -8e9 / (h * h));
    assert_eq!(host.step(0.0, h), Status::Error);
    assert_contains(&host.last_message(), &["left.load_torque", "within the step"]);
}
