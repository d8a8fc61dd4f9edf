//! Tests of events in model exchange.

use bevel_differential::fmi2::*;

use crate::common::Host;
use crate::exchange::in_co_simulation;
use crate::solver::{Solver, level};

#[test]
fn a_clutch_that_slips_and_sticks_is_an_event() {
    let set = |host: &Host| {
        level(host, 1);
        assert_eq!(host.set_boolean("effects.limited_slip", 1), Status::Ok);
        assert_eq!(host.set_many(&["left.load_torque", "right.load_torque"], &[835.0; 2]), Status::Ok);
        assert_eq!(
            host.set_many(&["limited_slip.preload", "limited_slip.torque_coefficient"], &[50.0, 0.0]),
            Status::Ok
        );
    };
    // the clutch sticks, slips, and sticks again
    let loads = [(845.0, 0.01), (400.0, 0.02), (1250.0, 0.06)];
    let mut solver = Solver::new(set);
    let steps = in_co_simulation(set, 1e-9, 1);
    let mut time = 1e-9;
    let mut seen = Vec::new();
    for (load, until) in loads {
        assert_eq!(solver.host.set("left.load_torque", load), Status::Ok);
        assert_eq!(steps.set("left.load_torque", load), Status::Ok);
        solver.event();
        solver.events = 0;
        while solver.time < until - 1e-9 {
            solver.step(1e-6);
        }
        assert_eq!(steps.step(time, until - time), Status::Ok);
        time = until;
        seen.push(solver.events);
        let (a, b) = (solver.host.get("left.speed"), steps.get("left.speed"));
        assert!((a - b).abs() < 1e-4, "after {load} N·m: {a} by exchange, {b} by steps");
        let (a, b) = (solver.host.get("heat.clutch"), steps.get("heat.clutch"));
        assert!((a - b).abs() < 1e-3 * b.abs() + 1e-6, "after {load} N·m: heat {a} and {b} J");
    }
    assert_eq!(seen[0], 0, "it holds");
    assert!(seen[1] >= 1 && seen[2] >= 1, "{seen:?}");
}

#[test]
fn a_lock_commanded_between_events_requests_an_event() {
    let mut solver = Solver::new(|host| level(host, 1));
    solver.steps(1e-5, 3);
    assert_eq!(solver.events, 0);
    assert_eq!(solver.host.set("lock.command", 1.0), Status::Ok);
    solver.steps(1e-6, 1);
    assert_eq!(solver.events, 1);
    assert_eq!(solver.host.set("left.load_torque", 500.0), Status::Ok);
    solver.steps(1e-6, 4000);
    assert!((solver.host.get("left.speed") - solver.host.get("right.speed")).abs() < 0.2);
}

#[test]
fn a_speed_jump_at_an_event_changes_states_and_enters_the_energy_balance() {
    for gears in [1, 2, 3] {
        let mut solver = Solver::new(|host| level(host, gears));
        solver.steps(1e-6, 3);
        // SAFETY: a live component
        assert_eq!(unsafe { fmi2EnterEventMode(solver.host.c) }, Status::Ok);
        assert_eq!(solver.host.set("carrier.speed_command", 45.0), Status::Ok);
        let info = solver.host.update();
        assert_eq!(info.states_changed, 1);
        let residual = solver.host.get("solver.energy_residual");
        assert!(residual.abs() < 1e-6, "level {gears}: {residual} J");
        // at a time event, before which no step is completed
        assert_eq!(unsafe { fmi2EnterContinuousTimeMode(solver.host.c) }, Status::Ok);
        let x = solver.states();
        let rates = solver.rates(solver.time, &x);
        solver.set(solver.time + 1e-7, &std::array::from_fn(|i| x[i] + 1e-7 * rates[i]));
        solver.time += 1e-7;
        assert_eq!(solver.event().states_changed, 0);
        let residual = solver.host.get("solver.energy_residual");
        assert!(residual.abs() < 1e-3, "level {gears}: {residual} J");
    }
}

#[test]
fn entering_event_mode_in_event_mode_changes_nothing() {
    for gears in [1, 3] {
        let mut solver = Solver::new(|host| level(host, gears));
        solver.steps(1e-6, 3);
        // SAFETY: a live component
        let enter = || unsafe { fmi2EnterEventMode(solver.host.c) };
        assert_eq!(enter(), Status::Ok);
        let before = solver.host.outputs();
        assert_eq!(enter(), Status::Ok, "{:?}", solver.host.log());
        assert!(solver.host.outputs() == before);
        assert_eq!(solver.host.update().new_discrete_states_needed, 0);
        // also after an update, before continuous-time mode
        assert_eq!(enter(), Status::Ok);
        solver.host.update();
        // SAFETY: a live component
        assert_eq!(unsafe { fmi2EnterContinuousTimeMode(solver.host.c) }, Status::Ok);
        assert!(solver.host.outputs() == before);
        solver.steps(1e-6, 3);
    }
}
