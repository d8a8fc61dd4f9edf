//! Model exchange gives the results of co-simulation, and trial states of the solver change no result.

use bevel_differential::fmi2::*;
use bevel_differential::variables::table;

use crate::common::Host;
use crate::solver::{Solver, level};

/// The same scene in co-simulation, at a tight tolerance.
pub fn in_co_simulation(set: impl Fn(&Host), h: f64, n: usize) -> Host {
    let host = Host::new();
    set(&host);
    assert_eq!(host.set("solver.relative_tolerance", 1e-10), Status::Ok);
    host.start();
    host.steps(0.0, h, n);
    host
}

/// Outputs that are compared.
const COMPARED: [&str; 10] = [
    "left.speed",
    "right.speed",
    "left.angle",
    "carrier.angle",
    "carrier.torque",
    "left.normal_force",
    "planet[1].spin_angle",
    "planet[2].right_normal_force",
    "left.shaft_torque",
    "heat.contact",
];

fn agree(exchange: &Host, steps: &Host, bound: f64, what: &str) {
    for name in COMPARED {
        let (a, b) = (exchange.get(name), steps.get(name));
        assert!((a - b).abs() <= bound * b.abs().max(1e-3), "{what}, {name}: {a} by exchange, {b} by steps");
    }
}

#[test]
fn model_exchange_gives_the_results_of_co_simulation() {
    type Set = fn(&Host);
    let scenes: [(&str, f64, usize, Set); 5] = [
        ("ideal", 1e-4, 40, |host| {
            level(host, 1);
            assert_eq!(host.set("left.load_torque", 700.0), Status::Ok);
        }),
        ("lumped", 1e-6, 4000, |host| {
            level(host, 2);
            assert_eq!(host.set("left.load_torque", 830.0), Status::Ok);
        }),
        ("tooth, a turn", 1e-6, 4000, |host| {
            level(host, 3);
            assert_eq!(host.set_integer("scene.planet_spin", 2), Status::Ok);
            assert_eq!(host.set("spin.command", 20.0), Status::Ok);
            assert_eq!(host.set_integer("scene.start", 2), Status::Ok);
        }),
        ("tooth, by torque, four planets", 1e-6, 4000, |host| {
            level(host, 3);
            assert_eq!(host.set_integer("scene.carrier_drive", 2), Status::Ok);
            assert_eq!(host.set_integer("geometry.planet_count", 4), Status::Ok);
        }),
        ("half-shafts and pins", 1e-6, 4000, |host| {
            level(host, 3);
            assert_eq!(host.set_boolean("effects.half_shaft", 1), Status::Ok);
            assert_eq!(host.set_boolean("effects.pin_compliance", 1), Status::Ok);
            assert_eq!(host.set_boolean("effects.bearing_drag", 1), Status::Ok);
            let names = ["carrier_torque", "carrier_viscous", "carrier_churning", "side_torque", "side_viscous"];
            let names = names.map(|name| format!("bearing_drag.{name}"));
            let names = names.each_ref().map(String::as_str);
            assert_eq!(host.set_many(&names, &[0.5, 5e-3, 1e-4, 0.2, 1e-3]), Status::Ok);
        }),
    ];
    for (name, h, n, set) in scenes {
        let mut solver = Solver::new(set);
        solver.steps(h, n);
        let steps = in_co_simulation(set, h * n as f64, 1);
        agree(&solver.host, &steps, 1e-5, name);
        assert_eq!(solver.host.get("solver.steps"), n as f64);
        let residual = solver.host.get("solver.energy_residual");
        assert!(residual.abs() < 1e-4, "{name}: {residual} J");
    }
}

#[test]
fn imposed_speeds_follow_their_commands_at_once() {
    let solver = Solver::new(|host| level(host, 1));
    assert_eq!(solver.host.set("carrier.speed_command", 30.0), Status::Ok);
    assert_eq!(solver.host.get("carrier.speed"), 30.0);
    assert_eq!((solver.host.get("left.speed") + solver.host.get("right.speed")) / 2.0, 30.0);
    assert_eq!(solver.host.get("der(carrier.angle)"), 30.0);
    let speed = table().states.iter().position(|&i| table().rows[i].name == "carrier.speed").unwrap();
    let mut x = solver.states();
    assert_eq!(x[speed], 30.0);
    x[speed] = 77.0;
    solver.set(0.0, &x);
    assert_eq!(solver.states()[speed], 30.0, "the state of an imposed speed takes no part");
}

#[test]
fn speed_jumps_of_gears_without_teeth_give_the_same_speeds_in_both_kinds() {
    for imposed in [false, true] {
        let set = |host: &Host| {
            level(host, 1);
            if imposed {
                assert_eq!(host.set_integer("scene.carrier_drive", 2), Status::Ok);
                assert_eq!(host.set_integer("scene.planet_spin", 2), Status::Ok);
            }
        };
        let command = if imposed { "spin.command" } else { "carrier.speed_command" };
        let mut solver = Solver::new(set);
        let steps = Host::new();
        set(&steps);
        steps.start();
        for k in 0..200 {
            let value = if imposed { 0.0 } else { 50.0 } + 0.05 * f64::from(k);
            assert_eq!(solver.host.set(command, value), Status::Ok);
            assert_eq!(steps.set(command, value), Status::Ok);
            // the value shown at once is the value at the beginning of the step
            let shown = steps.get("left.speed");
            solver.step(1e-5);
            assert_eq!(steps.step(f64::from(k) * 1e-5, 1e-5), Status::Ok);
            assert!((steps.get("left.speed") - shown).abs() < 0.1, "{shown} {}", steps.get("left.speed"));
            for name in ["left.speed", "right.speed", "carrier.speed", "planet[1].spin_speed"] {
                let (a, b) = (solver.host.get(name), steps.get(name));
                assert!((a - b).abs() < 2e-2, "{command}, {name}: {a} by exchange, {b} by steps");
            }
        }
        assert!(solver.events >= 199, "{}", solver.events);
        assert!((steps.get("left.speed") - steps.get("right.speed")).abs() > 0.5, "the free speed takes part");
    }
}

#[test]
fn trial_states_of_the_solver_change_no_result() {
    let mut solver = Solver::new(|host| level(host, 3));
    solver.steps(1e-6, 10);
    let (x, outputs) = (solver.states(), solver.host.outputs());
    for k in 0..20 {
        let tried = std::array::from_fn(|i| x[i] * (1.0 + 1e-4 * f64::from(k)) + 1e-6 * (i as f64));
        solver.rates(solver.time + 1e-5, &tried);
        solver.host.outputs();
    }
    solver.set(solver.time, &x);
    assert!(solver.states() == x);
    assert!(solver.host.outputs() == outputs);
}

#[test]
fn a_state_between_steps_is_restored_bit_by_bit_here_and_in_another_instance() {
    let set = |host: &Host| {
        level(host, 3);
        assert_eq!(host.set_boolean("effects.limited_slip", 1), Status::Ok);
        let names = ["limited_slip.preload", "limited_slip.torque_coefficient"];
        assert_eq!(host.set_many(&names, &[50.0, 0.1]), Status::Ok);
    };
    let mut solver = Solver::new(set);
    solver.steps(1e-6, 50);
    // between two completed steps
    let x = solver.states();
    let tried = solver.rates(solver.time, &x);
    solver.set(solver.time + 5e-7, &std::array::from_fn(|i| x[i] + 5e-7 * tried[i]));
    let (state, time) = (solver.host.get_state(), solver.time);
    let bytes = solver.host.serialize(state);
    let on = |solver: &mut Solver| {
        solver.time = time + 5e-7;
        solver.steps(1e-6, 30);
        (solver.states().map(f64::to_bits), solver.host.outputs())
    };
    let expected = on(&mut solver);
    assert_eq!(solver.host.set_state(state), Status::Ok);
    assert!(on(&mut solver) == expected);
    let mut other = Solver { host: Host::for_exchange(), time, events: 0 };
    let (status, copy) = other.host.deserialize(&bytes);
    assert_eq!((status, other.host.set_state(copy)), (Status::Ok, Status::Ok));
    assert!(on(&mut other) == expected);
    other.host.free_state(copy);
    solver.host.free_state(state);
}
