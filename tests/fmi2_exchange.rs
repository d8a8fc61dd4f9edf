//! Model exchange: a solver of the host's own, here the classical Runge–Kutta method, moves the state.

mod common;

use bevel_differential::fmi2::*;
use bevel_differential::model::STATES;
use bevel_differential::variables::table;
use common::{Host, assert_tells, reference};

/// A host that integrates by itself.
struct Solver {
    host: Host,
    time: f64,
    /// Events that the last steps led to.
    events: usize,
}

impl Solver {
    /// Begins, with the scene that `set` makes.
    fn new(set: impl Fn(&Host)) -> Self {
        let host = Host::for_exchange();
        set(&host);
        host.start_exchange();
        Self { host, time: 0.0, events: 0 }
    }

    fn states(&self) -> [f64; STATES] {
        let mut x = [f64::NAN; STATES];
        // SAFETY: a live component and room for all states
        assert_eq!(unsafe { fmi2GetContinuousStates(self.host.c, x.as_mut_ptr(), STATES) }, Status::Ok);
        x
    }

    fn set(&self, time: f64, x: &[f64; STATES]) {
        // SAFETY: a live component and all states
        unsafe {
            assert_eq!(fmi2SetTime(self.host.c, time), Status::Ok);
            assert_eq!(fmi2SetContinuousStates(self.host.c, x.as_ptr(), STATES), Status::Ok);
        }
    }

    fn rates(&self, time: f64, x: &[f64; STATES]) -> [f64; STATES] {
        let mut rates = [f64::NAN; STATES];
        self.set(time, x);
        // SAFETY: a live component and room for all derivatives
        let status = unsafe { fmi2GetDerivatives(self.host.c, rates.as_mut_ptr(), STATES) };
        assert_eq!(status, Status::Ok, "{:?}", self.host.log());
        rates
    }

    fn indicators(&self) -> [f64; EVENT_INDICATORS] {
        let mut z = [f64::NAN; EVENT_INDICATORS];
        // SAFETY: a live component and room for all indicators
        assert_eq!(unsafe { fmi2GetEventIndicators(self.host.c, z.as_mut_ptr(), EVENT_INDICATORS) }, Status::Ok);
        z
    }

    /// One step; an event where it ends if an indicator changed its sign on the way or the instance asks for it.
    fn step(&mut self, h: f64) {
        let before = self.indicators();
        let x = self.states();
        let moved = |by: f64, k: &[f64; STATES]| std::array::from_fn(|i| x[i] + by * k[i]);
        let k1 = self.rates(self.time, &x);
        let k2 = self.rates(self.time + 0.5 * h, &moved(0.5 * h, &k1));
        let k3 = self.rates(self.time + 0.5 * h, &moved(0.5 * h, &k2));
        let k4 = self.rates(self.time + h, &moved(h, &k3));
        let mean: [f64; STATES] = std::array::from_fn(|i| (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]) / 6.0);
        self.time += h;
        self.set(self.time, &moved(h, &mean));
        let (mut event, mut end) = (-1, -1);
        // SAFETY: a live component and places for the answers
        let status = unsafe { fmi2CompletedIntegratorStep(self.host.c, 1, &mut event, &mut end) };
        assert_eq!((status, end), (Status::Ok, 0), "{:?}", self.host.log());
        let crossed = before.iter().zip(self.indicators()).any(|(a, b)| a.signum() != b.signum());
        if crossed || event == 1 {
            self.event();
        }
    }

    fn event(&mut self) -> EventInfo {
        self.events += 1;
        // SAFETY: a live component
        assert_eq!(unsafe { fmi2EnterEventMode(self.host.c) }, Status::Ok);
        let info = self.host.update();
        assert_eq!(info.new_discrete_states_needed, 0);
        // SAFETY: as above
        assert_eq!(unsafe { fmi2EnterContinuousTimeMode(self.host.c) }, Status::Ok);
        info
    }

    fn steps(&mut self, h: f64, n: usize) {
        (0..n).for_each(|_| self.step(h));
    }
}

fn level(host: &Host, level: i32) {
    assert_eq!(host.set_integer("scene.gear_contact", level), Status::Ok);
    assert_eq!(host.set_many(&["inertia.left_end", "inertia.right_end"], &[0.3, 0.5]), Status::Ok);
}

/// The same scene in co-simulation, at a tight tolerance.
fn in_steps(set: impl Fn(&Host), h: f64, n: usize) -> Host {
    let host = Host::new();
    set(&host);
    assert_eq!(host.set("solver.relative_tolerance", 1e-10), Status::Ok);
    host.start();
    host.steps(0.0, h, n);
    host
}

/// Outputs that both kinds must agree in.
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
fn a_solver_of_the_hosts_finds_what_the_own_one_finds() {
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
            assert_eq!(host.set("planet.spin_command", 20.0), Status::Ok);
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
        }),
    ];
    for (name, h, n, set) in scenes {
        let mut solver = Solver::new(set);
        solver.steps(h, n);
        let steps = in_steps(set, h * n as f64, 1);
        agree(&solver.host, &steps, 1e-5, name);
        assert_eq!(solver.host.get("solver.steps"), n as f64);
        let residual = solver.host.get("solver.energy_residual");
        assert!(residual.abs() < 1e-4, "{name}: {residual} J");
    }
}

#[test]
fn a_clutch_that_lets_go_and_catches_is_an_event() {
    let set = |host: &Host| {
        level(host, 1);
        assert_eq!(host.set_boolean("effects.limited_slip", 1), Status::Ok);
        assert_eq!(host.set_many(&["left.load_torque", "right.load_torque"], &[835.0; 2]), Status::Ok);
        assert_eq!(
            host.set_many(&["limited_slip.preload", "limited_slip.torque_coefficient"], &[50.0, 0.0]),
            Status::Ok
        );
    };
    // 80 N·m on each side hold, 800 N·m slide, equal ones catch again
    let loads = [(845.0, 0.01), (400.0, 0.02), (1250.0, 0.06)];
    let mut solver = Solver::new(set);
    let steps = in_steps(set, 1e-9, 1);
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
fn a_tooth_that_breaks_is_an_event_whose_time_is_known() {
    let onset = 3e-5;
    let mut felt = Vec::new();
    for tooth in 0..10 {
        let mut solver = Solver::new(|host| {
            level(host, 3);
            assert_eq!(host.set_boolean("effects.tooth_fault", 1), Status::Ok);
            assert_eq!(host.set_integer("tooth_fault.gear", 2), Status::Ok);
            assert_eq!(host.set_integer("tooth_fault.tooth", tooth), Status::Ok);
            assert_eq!(host.set("tooth_fault.onset", onset), Status::Ok);
        });
        let info = solver.event();
        assert_eq!((info.next_event_defined, info.next_event), (1, onset));
        solver.steps(1e-6, 29);
        solver.set(onset, &solver.states());
        let before = solver.host.get("der(left.speed)");
        let info = solver.event();
        assert_eq!((info.next_event_defined, info.states_changed), (0, 0));
        if solver.host.get("der(left.speed)") != before {
            felt.push(tooth);
        }
    }
    assert!(!felt.is_empty() && felt.len() < 6, "teeth in mesh are felt at once, others are not: {felt:?}");
}

#[test]
fn a_lock_commanded_between_events_asks_for_one() {
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
fn a_speed_that_jumps_at_an_event_is_a_changed_state_and_is_booked() {
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
        // at a time event, for which no step is completed before
        // SAFETY: as above
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
fn gears_without_teeth_and_unequal_sides_follow_jumps_of_imposed_speeds_alike_in_both_kinds() {
    for imposed in [false, true] {
        let set = |host: &Host| {
            level(host, 1);
            if imposed {
                assert_eq!(host.set_integer("scene.carrier_drive", 2), Status::Ok);
                assert_eq!(host.set_integer("scene.planet_spin", 2), Status::Ok);
            }
        };
        let command = if imposed { "planet.spin_command" } else { "carrier.speed_command" };
        let mut solver = Solver::new(set);
        let steps = Host::new();
        set(&steps);
        steps.start();
        for k in 0..200 {
            let value = if imposed { 0.0 } else { 50.0 } + 0.05 * f64::from(k);
            assert_eq!(solver.host.set(command, value), Status::Ok);
            assert_eq!(steps.set(command, value), Status::Ok);
            // what is shown at once is what the step begins with
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
fn what_the_solver_tries_leaves_no_trace() {
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
fn a_state_in_between_is_restored_to_the_bit_here_and_elsewhere() {
    let set = |host: &Host| {
        level(host, 3);
        assert_eq!(host.set_boolean("effects.limited_slip", 1), Status::Ok);
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

#[test]
fn a_tooth_that_would_jump_ends_the_run_with_time_and_place() {
    let mut solver = Solver::new(|host| level(host, 3));
    solver.steps(1e-6, 3);
    let mut x = solver.states();
    x[0] -= 0.2;
    solver.set(solver.time + 1e-6, &x);
    // SAFETY: a live component and places for the answers
    assert_eq!(unsafe { fmi2CompletedIntegratorStep(solver.host.c, 1, &mut 0, &mut 0) }, Status::Error);
    assert_tells(&solver.host.last(), &["fmi2CompletedIntegratorStep", "would jump", "left", "t = "]);
}

#[test]
fn numbers_that_are_none_and_wrong_counts_are_refused() {
    let solver = Solver::new(|host| level(host, 3));
    let mut x = solver.states();
    // SAFETY: a live component and arrays of the length told
    unsafe {
        assert_eq!(fmi2SetContinuousStates(solver.host.c, x.as_ptr(), STATES - 1), Status::Error);
        assert_tells(&solver.host.last(), &["30", "29"]);
        assert_eq!(fmi2GetDerivatives(solver.host.c, x.as_mut_ptr(), 1), Status::Error);
        x[2] = f64::NAN;
        assert_eq!(fmi2SetContinuousStates(solver.host.c, x.as_ptr(), STATES), Status::Discard);
        assert_tells(&solver.host.last(), &["carrier.angle", "NaN"]);
        assert_eq!(fmi2SetTime(solver.host.c, f64::INFINITY), Status::Error);
        assert_eq!(fmi2SetReal(solver.host.c, &reference("contact.damping"), 1, &1.0), Status::Error);
        assert_tells(&solver.host.last(), &["contact.damping", "event mode"]);
    }
}

#[test]
fn what_has_no_finite_answer_at_wild_states_is_discarded_by_name() {
    let solver = Solver::new(|host| level(host, 3));
    let c = solver.host.c;
    let sane = solver.states();
    for k in 0..STATES {
        let mut x = sane;
        x[k] = 1e300;
        solver.set(solver.time, &x);
        let (mut many, mut slope) = ([0.0; STATES], 0.0);
        let refused = |status, numbers: &[f64]| {
            assert!(status == Status::Ok || status == Status::Discard, "state {k}: {status:?}");
            assert!(status == Status::Discard || numbers.iter().all(|x| x.is_finite()), "state {k}: {numbers:?}");
            status == Status::Discard
        };
        let (speed, load) = (reference("left.speed"), reference("left.load_torque"));
        // SAFETY: a live component and room for what is asked for
        unsafe {
            refused(fmi2GetDerivatives(c, many.as_mut_ptr(), STATES), &many);
            refused(fmi2GetContinuousStates(c, many.as_mut_ptr(), STATES), &many);
            refused(fmi2GetEventIndicators(c, many.as_mut_ptr(), EVENT_INDICATORS), &many[..EVENT_INDICATORS]);
            refused(fmi2GetDirectionalDerivative(c, &speed, 1, &load, 1, &1.0, &mut slope), &[slope]);
        }
        for &i in &table().outputs {
            let name = table().rows[i].name;
            let (status, value) = solver.host.try_get(name);
            if refused(status, &[value]) {
                assert_tells(&solver.host.last(), &["fmi2GetReal", name, "not a finite number"]);
            }
        }
    }
    // what a solver tries leaves no trace
    solver.set(solver.time, &sane);
    assert!(solver.host.outputs().iter().all(|&bits| f64::from_bits(bits).is_finite()));
}

#[test]
fn a_step_to_states_that_cannot_be_counted_ends_the_run_and_a_reset_helps() {
    for wild in [1e300, -f64::MAX] {
        let solver = Solver::new(|host| level(host, 1));
        let mut x = solver.states();
        x[2] = wild;
        solver.set(solver.time + 1e-6, &x);
        // SAFETY: a live component and places for the answers
        let status = unsafe { fmi2CompletedIntegratorStep(solver.host.c, 1, &mut 0, &mut 0) };
        let mut states = [0.0; STATES];
        // SAFETY: a live component and room for what is asked for
        let read = unsafe { fmi2GetContinuousStates(solver.host.c, states.as_mut_ptr(), STATES) };
        assert!(read != Status::Ok || states.iter().all(|x| x.is_finite()), "{wild}: {status:?}, {states:?}");
        assert_eq!(solver.host.reset(), Status::Ok);
        solver.host.start_exchange();
    }
}

#[test]
fn directional_derivatives_are_those_of_the_rates() {
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
            let mut told = [f64::NAN; STATES];
            // SAFETY: a live component and arrays of the lengths told
            let status = unsafe {
                let (unknown, room) = (unknown.as_ptr(), told.as_mut_ptr());
                fmi2GetDirectionalDerivative(solver.host.c, unknown, STATES, &known, 1, &1.0, room)
            };
            assert_eq!(status, Status::Ok, "{:?}", solver.host.log());
            let d = if k < STATES { 1e-6 * table().rows[table().states[k]].nominal.unwrap() } else { 1e-2 };
            let at = |place: f64| {
                if k < STATES {
                    let mut y = x;
                    y[k] += place * d;
                    return solver.rates(time, &y);
                }
                let value = solver.host.get(inputs[k - STATES]);
                assert_eq!(solver.host.set(inputs[k - STATES], value + place * d), Status::Ok);
                let rates = solver.rates(time, &x);
                assert_eq!(solver.host.set(inputs[k - STATES], value), Status::Ok);
                rates
            };
            let (high, low) = (at(1.0), at(-1.0));
            for i in 0..STATES {
                // rates of positions and of velocities, each by the largest of their kind
                let kind = if i < STATES / 2 { &told[..STATES / 2] } else { &told[STATES / 2..] };
                let steepest = kind.iter().fold(1e-3, |m: f64, x| m.max(x.abs()));
                let differs = (high[i] - low[i]) / (2.0 * d);
                let noise = 1e-5 * differs.abs() + 1e-6 * steepest;
                assert!((told[i] - differs).abs() < noise, "{gears} {extra}: rate {i} by {k}: {} {differs}", told[i]);
            }
        }
    }
}
