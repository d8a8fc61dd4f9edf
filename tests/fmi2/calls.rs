//! Tests of the states in which each call is legal: the tables of FMI 2.0.4, typed independently of the source.

use std::ptr;

use bevel_differential::fmi2::*;
use bevel_differential::model::STATES;

use crate::common::{Host, assert_contains, reference};

const KINDS: [&str; 2] = ["co-simulation", "model exchange"];

const PHASES: [[&str; 6]; 2] = [
    ["instantiated", "initialization mode", "step complete", "step failed", "terminated", "error"],
    ["instantiated", "initialization mode", "event mode", "continuous-time mode", "terminated", "error"],
];

/// Creates an instance of `KINDS[kind]` in `PHASES[kind][phase]`.
fn host_in(kind: usize, phase: usize) -> Host {
    let host = if kind == 0 { Host::new() } else { Host::for_exchange() };
    match (kind, phase) {
        (_, 0) => {}
        (_, 1) => assert_eq!(host.enter(), Status::Ok),
        (_, 2) => host.start(),
        (0, 3) => {
            host.start();
            assert_eq!(host.set("left.load_torque", 1e7), Status::Ok);
            assert_eq!(host.step(0.0, 1e-2), Status::Discard, "a load of 1e7 N·m must break the step");
        }
        (_, 3) => host.start_exchange(),
        (_, 4) => {
            host.start();
            assert_eq!(host.terminate(), Status::Ok);
        }
        _ => {
            assert_eq!(host.set("geometry.module", 4.5), Status::Ok);
            assert_eq!(host.enter(), Status::Ok);
            assert_eq!(host.exit(), Status::Error);
        }
    }
    host.clear_log();
    host
}

type Call = (&'static str, &'static str, &'static str, fn(ComponentPointer) -> Status);

/// Table of calls: name, legal phases for co-simulation and for model exchange, and the call with valid arguments.
/// Marks: x, legal; -, illegal in the state; o, legal in the state but not for this kind of instance; e, no values after
/// a failed initialisation; ?, not specified.
#[rustfmt::skip] // a table
fn calls() -> Vec<Call> {
    const N: usize = EVENT_INDICATORS;
    // SAFETY, for all: a live component and arguments that are valid during the call
    vec![
        ("fmi2SetDebugLogging",               "xxxxxx", "xxxxxx", |c| unsafe { fmi2SetDebugLogging(c, 1, 0, ptr::null()) }),
        ("fmi2SetupExperiment",               "x-----", "x-----", |c| unsafe { fmi2SetupExperiment(c, 0, 0.0, 0.0, 0, 0.0) }),
        ("fmi2EnterInitializationMode",       "x-----", "x-----", |c| unsafe { fmi2EnterInitializationMode(c) }),
        ("fmi2ExitInitializationMode",        "-x----", "-x----", |c| unsafe { fmi2ExitInitializationMode(c) }),
        ("fmi2Terminate",                     "--xx--", "--xx--", |c| unsafe { fmi2Terminate(c) }),
        ("fmi2Reset",                         "xxxxxx", "xxxxxx", |c| unsafe { fmi2Reset(c) }),
        ("fmi2SetReal",                       "xxx---", "xxxx--", |c| unsafe { fmi2SetReal(c, &reference("left.load_torque"), 1, &835.0) }),
        ("fmi2SetInteger",                    "xxx---", "xxx---", |c| unsafe { fmi2SetInteger(c, ptr::null(), 0, ptr::null()) }),
        ("fmi2SetBoolean",                    "xxx---", "xxx---", |c| unsafe { fmi2SetBoolean(c, ptr::null(), 0, ptr::null()) }),
        ("fmi2SetString",                     "xxx---", "xxx---", |c| unsafe { fmi2SetString(c, ptr::null(), 0, ptr::null()) }),
        ("fmi2GetReal",                       "xxxxxx", "xxxxxx", |c| unsafe { fmi2GetReal(c, &reference("left.load_torque"), 1, &mut 0.0) }),
        ("fmi2GetInteger",                    "xxxxxx", "xxxxxx", |c| unsafe { fmi2GetInteger(c, ptr::null(), 0, ptr::null_mut()) }),
        ("fmi2GetBoolean",                    "xxxxxx", "xxxxxx", |c| unsafe { fmi2GetBoolean(c, ptr::null(), 0, ptr::null_mut()) }),
        ("fmi2GetString",                     "xxxxxx", "xxxxxx", |c| unsafe { fmi2GetString(c, ptr::null(), 0, ptr::null_mut()) }),
        ("fmi2GetFMUstate",                   "xxxxx-", "xxxxx-", |c| unsafe {
            let mut state = ptr::null_mut();
            let status = fmi2GetFMUstate(c, &mut state);
            fmi2FreeFMUstate(c, &mut state);
            status
        }),
        ("fmi2FreeFMUstate",                  "xxxxxx", "xxxxxx", |c| unsafe { fmi2FreeFMUstate(c, ptr::null_mut()) }),
        ("fmi2GetDirectionalDerivative",      "-xxxxx", "-xxxxx", |c| unsafe {
            fmi2GetDirectionalDerivative(c, ptr::null(), 0, ptr::null(), 0, ptr::null(), ptr::null_mut())
        }),
        ("fmi2SetRealInputDerivatives",       "xxx---", "oo----", |c| unsafe { fmi2SetRealInputDerivatives(c, &reference("left.load_torque"), 1, &1, &0.0) }),
        ("fmi2GetRealOutputDerivatives",      "--xxxe", "----x-", |c| unsafe { fmi2GetRealOutputDerivatives(c, &reference("left.speed"), 1, &1, &mut 0.0) }),
        ("fmi2EnterEventMode",                "------", "--xx--", |c| unsafe { fmi2EnterEventMode(c) }),
        ("fmi2NewDiscreteStates",             "------", "--x---", |c| unsafe { fmi2NewDiscreteStates(c, &mut EventInfo::default()) }),
        ("fmi2EnterContinuousTimeMode",       "------", "--x---", |c| unsafe { fmi2EnterContinuousTimeMode(c) }),
        ("fmi2CompletedIntegratorStep",       "------", "---x--", |c| unsafe { fmi2CompletedIntegratorStep(c, 1, &mut 0, &mut 0) }),
        ("fmi2SetTime",                       "------", "--xx--", |c| unsafe { fmi2SetTime(c, 0.0) }),
        ("fmi2SetContinuousStates",           "------", "---x--", |c| unsafe { fmi2SetContinuousStates(c, [0.0; STATES].as_ptr(), STATES) }),
        ("fmi2GetDerivatives",                "-o--oo", "-xxxxe", |c| unsafe { fmi2GetDerivatives(c, [0.0; STATES].as_mut_ptr(), STATES) }),
        ("fmi2GetEventIndicators",            "-o--oo", "-xxxxe", |c| unsafe { fmi2GetEventIndicators(c, [0.0; N].as_mut_ptr(), N) }),
        ("fmi2GetContinuousStates",           "-o--oo", "-xxxxe", |c| unsafe { fmi2GetContinuousStates(c, [0.0; STATES].as_mut_ptr(), STATES) }),
        ("fmi2GetNominalsOfContinuousStates", "oooooo", "xxxxxx", |c| unsafe { fmi2GetNominalsOfContinuousStates(c, [0.0; STATES].as_mut_ptr(), STATES) }),
        ("fmi2DoStep",                        "--x---", "------", |c| unsafe { fmi2DoStep(c, 0.0, 1e-4, 0) }),
        ("fmi2CancelStep",                    "------", "------", |c| unsafe { fmi2CancelStep(c) }),
        ("fmi2GetStatus",                     "--xxx-", "----?-", |c| unsafe { fmi2GetStatus(c, DO_STEP_STATUS, &mut Status::Ok) }),
        ("fmi2GetRealStatus",                 "--xxx-", "----?-", |c| unsafe { fmi2GetRealStatus(c, LAST_SUCCESSFUL_TIME, &mut 0.0) }),
        ("fmi2GetBooleanStatus",              "--xxx-", "----?-", |c| unsafe { fmi2GetBooleanStatus(c, TERMINATED, &mut 0) }),
        ("fmi2GetStringStatus",               "--xxx-", "----?-", |c| unsafe { fmi2GetStringStatus(c, PENDING_STATUS, &mut ptr::null()) }),
    ]
}

#[test]
fn every_call_is_legal_exactly_in_the_states_of_the_standard_and_errors_name_call_and_state() {
    for (name, steps, exchange, call) in calls() {
        for (kind, legal) in [steps, exchange].into_iter().enumerate() {
            for (phase, legal) in legal.chars().enumerate().filter(|&(_, legal)| legal != '?') {
                let (host, state) = (host_in(kind, phase), PHASES[kind][phase]);
                let status = call(host.c);
                let what = format!("{name}, {}, {state}: {:?}", KINDS[kind], host.log());
                assert_eq!(status, if legal == 'x' { Status::Ok } else { Status::Error }, "{what}");
                match legal {
                    'x' => {}
                    'o' => assert_contains(&host.last_message(), &[name, KINDS[kind]]),
                    'e' => assert_contains(&host.last_message(), &[name]),
                    _ => assert_contains(&host.last_message(), &[name, state]),
                }
            }
        }
    }
}

#[test]
fn a_state_of_the_other_kind_is_refused() {
    let (steps, exchange) = (host_in(0, 2), host_in(1, 2));
    let state = exchange.get_state();
    assert_eq!(steps.set_state(state), Status::Error);
    assert_contains(&steps.last_message(), &["fmi2SetFMUstate", "ModelExchange", "CoSimulation"]);
    exchange.free_state(state);
}

#[test]
fn a_refused_call_leaves_the_simulation_as_it_was() {
    let reference_host = Host::on_level(3);
    reference_host.start();
    let expected = reference_host.record_steps(0, 5);
    let host = Host::on_level(3);
    host.start();
    let mut seen = host.record_steps(0, 2);
    let refused: [fn(ComponentPointer) -> Status; 4] = [
        // SAFETY: a live component
        |c| unsafe { fmi2EnterInitializationMode(c) },
        // SAFETY: as above
        |c| unsafe { fmi2ExitInitializationMode(c) },
        // SAFETY: as above
        |c| unsafe { fmi2CancelStep(c) },
        // SAFETY: as above
        |c| unsafe { fmi2SetupExperiment(c, 0, 0.0, 5.0, 0, 0.0) },
    ];
    assert!(refused.iter().all(|call| call(host.c) == Status::Error));
    seen.extend(host.record_steps(2, 3));
    assert!(seen == expected);
}

#[test]
fn a_null_component_is_an_error() {
    for (name, _, _, call) in calls() {
        assert_eq!(call(ptr::null_mut()), Status::Error, "{name}");
    }
    // SAFETY: NULL is legal
    unsafe { fmi2FreeInstance(ptr::null_mut()) };
}

#[test]
fn outputs_cannot_be_read_before_initialisation() {
    let host = Host::new();
    assert_eq!(host.try_get("left.speed").0, Status::Error);
    assert_contains(&host.last_message(), &["fmi2GetReal", "left.speed", "instantiated"]);
    assert_eq!(host.try_get("left.load_torque"), (Status::Ok, 835.0));
}

#[test]
fn a_derivative_that_does_not_exist_is_refused_by_name() {
    let host = host_in(0, 2);
    let (load, speed, module) = (reference("left.load_torque"), reference("left.speed"), reference("geometry.module"));
    let logged = |words: &[&str]| assert_contains(&host.last_message(), words);
    // SAFETY: a live component and arguments valid during the call
    unsafe {
        assert_eq!(fmi2SetRealInputDerivatives(host.c, &speed, 1, &1, &0.0), Status::Error);
        logged(&["left.speed", "not an input"]);
        for order in [0, 3, -1] {
            assert_eq!(fmi2SetRealInputDerivatives(host.c, &load, 1, &order, &0.0), Status::Error);
            logged(&["left.load_torque", &order.to_string(), "1 to 2"]);
        }
        assert_eq!(fmi2SetRealInputDerivatives(host.c, &load, 1, &1, &f64::NAN), Status::Discard);
        logged(&["left.load_torque", "NaN"]);
        assert_eq!(fmi2GetRealOutputDerivatives(host.c, &speed, 1, &2, &mut 0.0), Status::Error);
        logged(&["left.speed", "order 2"]);
        assert_eq!(fmi2GetRealOutputDerivatives(host.c, &load, 1, &1, &mut 0.0), Status::Error);
        logged(&["left.load_torque", "set by the host"]);
        assert_eq!(fmi2GetDirectionalDerivative(host.c, &load, 1, &load, 1, &1.0, &mut 0.0), Status::Error);
        logged(&["left.load_torque", "no derivative"]);
        assert_eq!(fmi2GetDirectionalDerivative(host.c, &speed, 1, &module, 1, &1.0, &mut 0.0), Status::Error);
        logged(&["geometry.module", "neither"]);
        assert_eq!(
            fmi2GetDirectionalDerivative(host.c, &speed, 1, &load, 1, &f64::INFINITY, &mut 0.0),
            Status::Discard
        );
        logged(&["inf", "finite"]);
        assert_eq!(fmi2GetIntegerStatus(host.c, 0, &mut 0), Status::Discard);
        assert_eq!(fmi2GetRealStatus(host.c, DO_STEP_STATUS, &mut 0.0), Status::Discard);
    }
    host.steps(0.0, 1e-4, 1);
}
