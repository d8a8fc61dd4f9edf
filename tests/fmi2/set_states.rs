//! Tests of states that are set as variables. They give the same result as setting all states in one call, and can be
//! set only in continuous-time mode. A call sets all its values or none.

use bevel_differential::fmi2::*;
use bevel_differential::model::STATES;
use bevel_differential::variables::table;

use crate::common::{Host, assert_contains, reference};
use crate::solver::{Solver, level};

type Set = fn(&Host);

/// Scenes with free, imposed, constrained and unused states.
const SCENES: [(&str, Set); 4] = [
    ("teeth, speed of the carrier imposed", |host| level(host, 3)),
    ("teeth, spin imposed, four planets, half-shafts and pins", |host| {
        level(host, 3);
        assert_eq!(host.set_integer("geometry.planet_count", 4), Status::Ok);
        assert_eq!(host.set_integer("scene.planet_spin", 2), Status::Ok);
        assert_eq!(host.set("spin.command", 3.0), Status::Ok);
        assert_eq!(host.set_boolean("effects.half_shaft", 1), Status::Ok);
        assert_eq!(host.set_boolean("effects.pin_compliance", 1), Status::Ok);
    }),
    ("teeth, carrier driven by torque, dry friction", |host| {
        level(host, 3);
        assert_eq!(host.set_integer("scene.carrier_drive", 2), Status::Ok);
        assert_eq!(host.set_boolean("effects.thrust_friction", 1), Status::Ok);
    }),
    ("without teeth", |host| {
        level(host, 1);
        assert_eq!(host.set("left.load_torque", 700.0), Status::Ok);
    }),
];

/// Creates a solver some steps after the start, after whole turns of the carrier.
fn turned(set: Set) -> Solver {
    let mut solver = Solver::new(set);
    solver.steps(1e-6, 5);
    let mut x = solver.states();
    x[2] += 1000.0;
    solver.set(solver.time + 1e-6, &x);
    solver.time += 1e-6;
    // SAFETY: a live component and memory for the results
    assert_eq!(unsafe { fmi2CompletedIntegratorStep(solver.host.c, 1, &mut 0, &mut 0) }, Status::Ok);
    solver
}

fn state_references() -> [u32; STATES] {
    table().states.map(|index| index as u32)
}

fn set_real(host: &Host, references: &[u32], values: &[f64]) -> Status {
    assert_eq!(references.len(), values.len());
    // SAFETY: a live component and arrays of this length
    unsafe { fmi2SetReal(host.c, references.as_ptr(), references.len(), values.as_ptr()) }
}

/// Returns the present state as bytes.
fn bytes(host: &Host) -> Vec<u8> {
    let state = host.get_state();
    let bytes = host.serialize(state);
    host.free_state(state);
    bytes
}

/// Returns the bits of derivatives, states and event indicators, and of a column of derivatives of the derivatives.
fn seen(solver: &Solver) -> Vec<u64> {
    let (mut rates, mut column, mut indicators) = ([0.0; STATES], [0.0; STATES], [0.0; EVENT_INDICATORS]);
    let c = solver.host.c;
    let (unknown, known) = (table().derivatives.map(|index| index as u32), reference("left.relative_angle"));
    // SAFETY: a live component and memory for the results
    unsafe {
        assert_eq!(fmi2GetDerivatives(c, rates.as_mut_ptr(), STATES), Status::Ok, "{:?}", solver.host.log());
        assert_eq!(fmi2GetEventIndicators(c, indicators.as_mut_ptr(), EVENT_INDICATORS), Status::Ok);
        let place = column.as_mut_ptr();
        assert_eq!(fmi2GetDirectionalDerivative(c, unknown.as_ptr(), STATES, &known, 1, &1.0, place), Status::Ok);
    }
    rates.into_iter().chain(solver.states()).chain(indicators).chain(column).map(f64::to_bits).collect()
}

/// Returns states at which teeth are loaded and bodies turn differently.
fn moved(x: &[f64; STATES]) -> [f64; STATES] {
    std::array::from_fn(|k| {
        let nominal = table().rows[table().states[k]].nominal.unwrap();
        x[k] + 0.01 * nominal * (1.0 + k as f64 / 7.0) * if k % 3 == 0 { -1.0 } else { 1.0 }
    })
}

#[test]
fn states_set_as_variables_equal_states_set_in_one_call_to_the_last_bit() {
    for (name, set) in SCENES {
        let [together, one_by_one, in_one_call] = [(); 3].map(|()| turned(set));
        let x = moved(&together.states());
        together.set(together.time, &x);
        let references = state_references();
        for k in (0..STATES).rev() {
            assert_eq!(set_real(&one_by_one.host, &references[k..=k], &x[k..=k]), Status::Ok, "{name}");
        }
        assert_eq!(set_real(&in_one_call.host, &references, &x), Status::Ok, "{name}");
        for other in [one_by_one, in_one_call] {
            assert!(bytes(&other.host) == bytes(&together.host), "{name}: another state");
            assert!(seen(&other) == seen(&together), "{name}: other derivatives");
        }
    }
}

#[test]
fn a_single_state_leaves_the_others_as_they_are() {
    for (name, set) in SCENES {
        let [together, single] = [(); 2].map(|()| turned(set));
        let start = together.states();
        let wanted = moved(&start);
        for k in 0..STATES {
            let mut x = start;
            x[k] = wanted[k];
            together.set(together.time, &x);
            assert_eq!(set_real(&single.host, &state_references()[k..=k], &x[k..=k]), Status::Ok);
            assert!(seen(&single) == seen(&together), "{name}: state {k}");
            assert_eq!(set_real(&single.host, &state_references()[k..=k], &start[k..=k]), Status::Ok);
        }
    }
}

#[test]
fn inputs_and_states_are_set_in_one_call() {
    for (name, set) in SCENES {
        let [apart, mixed] = [(); 2].map(|()| turned(set));
        let x = moved(&apart.states());
        let inputs = ["carrier.speed_command", "left.load_torque", "spin.command"];
        let values = [17.0, 640.0, 2.5];
        assert_eq!(apart.host.set_many(&inputs, &values), Status::Ok);
        apart.set(apart.time, &x);
        let mut references = state_references().to_vec();
        let mut numbers = x.to_vec();
        for (name, value) in inputs.iter().zip(values) {
            references.insert(7, reference(name));
            numbers.insert(7, value);
        }
        assert_eq!(set_real(&mixed.host, &references, &numbers), Status::Ok);
        assert!(bytes(&mixed.host) == bytes(&apart.host), "{name}");
        assert!(seen(&mixed) == seen(&apart), "{name}");
    }
}

#[test]
fn a_refused_call_sets_none_of_its_values() {
    let solver = turned(|host| level(host, 3));
    let (before, host) = (bytes(&solver.host), &solver.host);
    let [angle, speed] = ["left.relative_angle", "left.speed"].map(reference);
    for (bad, value, status, words) in [
        ("right.speed", f64::NAN, Status::Discard, ["right.speed", "NaN"]),
        ("left.load_torque", 1e30, Status::Discard, ["left.load_torque", "outside"]),
        ("left.normal_force", 1.0, Status::Error, ["left.normal_force", "is an output"]),
        ("contact.damping", 1.0, Status::Error, ["contact.damping", "enter event mode first"]),
        ("der(left.speed)", 1.0, Status::Error, ["der(left.speed)", "cannot be set"]),
    ] {
        let references = [angle, speed, reference("right.load_torque"), reference(bad)];
        assert_eq!(set_real(host, &references, &[1e-4, 12.0, 500.0, value]), status, "{bad}");
        assert_contains(&host.last_message(), &["fmi2SetReal", words[0], words[1]]);
        assert!(bytes(host) == before, "{bad}");
    }
}

#[test]
fn states_are_refused_in_every_other_mode_with_the_reason() {
    let refused = |host: &Host, mode: &str| {
        for name in ["left.relative_angle", "left.speed", "carrier.angle"] {
            assert_eq!(host.set(name, 0.1), Status::Error, "{name} in {mode}");
            assert_contains(&host.last_message(), &["fmi2SetReal", name, "continuous-time mode"]);
        }
    };
    for host in [Host::new(), Host::for_exchange()] {
        refused(&host, "the state instantiated");
        assert_eq!([host.setup(), host.enter()], [Status::Ok; 2]);
        refused(&host, "initialisation mode");
        assert_eq!(host.exit(), Status::Ok);
        refused(&host, "step mode and event mode");
    }
}

#[test]
fn a_saved_state_contains_the_states_that_were_set() {
    for (name, set) in SCENES {
        let [solver, other] = [(); 2].map(|()| turned(set));
        let x = moved(&solver.states());
        assert_eq!(set_real(&solver.host, &state_references(), &x), Status::Ok);
        let (status, state) = other.host.deserialize(&bytes(&solver.host));
        assert_eq!([status, other.host.set_state(state)], [Status::Ok; 2]);
        other.host.free_state(state);
        assert!(seen(&other) == seen(&solver), "{name}");
    }
}
