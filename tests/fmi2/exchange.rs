//! Tests that imposed speeds and speed jumps agree between model exchange and co-simulation, and that trial states of
//! the solver change no result.

use bevel_differential::fmi2::*;
use bevel_differential::variables::table;

use crate::common::Host;
use crate::solver::{Solver, level};

/// Simulates a scene in co-simulation, with a tight tolerance.
pub fn in_co_simulation(set: impl Fn(&Host), h: f64, n: usize) -> Host {
    let host = Host::new();
    set(&host);
    assert_eq!(host.set("solver.relative_tolerance", 1e-10), Status::Ok);
    host.start();
    host.steps(0.0, h, n);
    host
}

#[test]
fn imposed_speeds_follow_their_commands_immediately() {
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
    assert_eq!(solver.states()[speed], 30.0, "the state of an imposed speed has no effect");
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
            // the value shown immediately is the value at the start of the step
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
        assert!((steps.get("left.speed") - steps.get("right.speed")).abs() > 0.5, "the free speed changes");
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
