//! Which call is legal in which state: the tables of FMI 2.0.4, typed independently of the source.

use std::ptr;

use bevel_differential::fmi2::*;
use bevel_differential::model::STATES;

use crate::common::{Host, assert_contains, reference};

const PHASES: [&str; 6] =
    ["instantiated", "initialization mode", "step complete", "step failed", "terminated", "error"];

const EXCHANGE_PHASES: [&str; 6] =
    ["instantiated", "initialization mode", "event mode", "continuous-time mode", "terminated", "error"];

/// Brings `host` into the state `error`.
fn fail_to_start(host: &Host) {
    assert_eq!(host.set("geometry.module", 4.5), Status::Ok);
    assert_eq!(host.enter(), Status::Ok);
    assert_eq!(host.exit(), Status::Error);
}

/// An instance for model exchange in `EXCHANGE_PHASES[phase]`.
fn exchange_host_in(phase: usize) -> Host {
    let host = Host::for_exchange();
    match phase {
        0 => {}
        1 => assert_eq!(host.enter(), Status::Ok),
        2 => host.start(),
        3 => host.start_exchange(),
        4 => {
            host.start();
            assert_eq!(host.terminate(), Status::Ok);
        }
        _ => fail_to_start(&host),
    }
    host.clear_log();
    host
}

/// An instance for co-simulation in `PHASES[phase]`.
fn host_in(phase: usize) -> Host {
    let host = Host::new();
    match phase {
        0 => {}
        1 => assert_eq!(host.enter(), Status::Ok),
        2 => host.start(),
        3 => {
            host.start();
            assert_eq!(host.set("left.load_torque", 1e7), Status::Ok);
            assert_eq!(host.step(0.0, 1e-2), Status::Discard, "a load of 1e7 N·m must break the step");
        }
        4 => {
            host.start();
            assert_eq!(host.terminate(), Status::Ok);
        }
        _ => fail_to_start(&host),
    }
    host.clear_log();
    host
}

type Call = (&'static str, &'static str, fn(ComponentPointer) -> Status);

/// Name, legal phases marked by x, and the call with valid arguments.
#[rustfmt::skip] // a table
fn calls() -> Vec<Call> {
    // SAFETY, for all: a live component and arguments that are valid during the call
    vec![
        ("fmi2SetDebugLogging",          "xxxxxx", |c| unsafe { fmi2SetDebugLogging(c, 1, 0, ptr::null()) }),
        ("fmi2SetupExperiment",          "x-----", |c| unsafe { fmi2SetupExperiment(c, 0, 0.0, 0.0, 0, 0.0) }),
        ("fmi2EnterInitializationMode",  "x-----", |c| unsafe { fmi2EnterInitializationMode(c) }),
        ("fmi2ExitInitializationMode",   "-x----", |c| unsafe { fmi2ExitInitializationMode(c) }),
        ("fmi2Terminate",                "--xx--", |c| unsafe { fmi2Terminate(c) }),
        ("fmi2Reset",                    "xxxxxx", |c| unsafe { fmi2Reset(c) }),
        ("fmi2SetReal",                  "xxx---", |c| unsafe { fmi2SetReal(c, &reference("left.load_torque"), 1, &835.0) }),
        ("fmi2SetInteger",               "xxx---", |c| unsafe { fmi2SetInteger(c, ptr::null(), 0, ptr::null()) }),
        ("fmi2SetBoolean",               "xxx---", |c| unsafe { fmi2SetBoolean(c, ptr::null(), 0, ptr::null()) }),
        ("fmi2SetString",                "xxx---", |c| unsafe { fmi2SetString(c, ptr::null(), 0, ptr::null()) }),
        ("fmi2GetReal",                  "xxxxxx", |c| unsafe { fmi2GetReal(c, &reference("left.load_torque"), 1, &mut 0.0) }),
        ("fmi2GetInteger",               "xxxxxx", |c| unsafe { fmi2GetInteger(c, ptr::null(), 0, ptr::null_mut()) }),
        ("fmi2GetBoolean",               "xxxxxx", |c| unsafe { fmi2GetBoolean(c, ptr::null(), 0, ptr::null_mut()) }),
        ("fmi2GetString",                "xxxxxx", |c| unsafe { fmi2GetString(c, ptr::null(), 0, ptr::null_mut()) }),
        ("fmi2GetFMUstate",              "xxxxx-", |c| unsafe {
            let mut state = ptr::null_mut();
            let status = fmi2GetFMUstate(c, &mut state);
            fmi2FreeFMUstate(c, &mut state);
            status
        }),
        ("fmi2FreeFMUstate",             "xxxxxx", |c| unsafe { fmi2FreeFMUstate(c, ptr::null_mut()) }),
        ("fmi2GetDirectionalDerivative", "-xxxxx", |c| unsafe {
            fmi2GetDirectionalDerivative(c, ptr::null(), 0, ptr::null(), 0, ptr::null(), ptr::null_mut())
        }),
        ("fmi2SetRealInputDerivatives",  "xxx---", |c| unsafe { fmi2SetRealInputDerivatives(c, ptr::null(), 0, ptr::null(), ptr::null()) }),
        ("fmi2GetRealOutputDerivatives", "--xxxx", |c| unsafe { fmi2GetRealOutputDerivatives(c, ptr::null(), 0, ptr::null(), ptr::null_mut()) }),
        ("fmi2DoStep",                   "--x---", |c| unsafe { fmi2DoStep(c, 0.0, 1e-4, 0) }),
        ("fmi2CancelStep",               "------", |c| unsafe { fmi2CancelStep(c) }),
        ("fmi2GetStatus",                "--xxx-", |c| unsafe { fmi2GetStatus(c, DO_STEP_STATUS, &mut Status::Ok) }),
        ("fmi2GetRealStatus",            "--xxx-", |c| unsafe { fmi2GetRealStatus(c, LAST_SUCCESSFUL_TIME, &mut 0.0) }),
        ("fmi2GetBooleanStatus",         "--xxx-", |c| unsafe { fmi2GetBooleanStatus(c, TERMINATED, &mut 0) }),
        ("fmi2GetStringStatus",          "--xxx-", |c| unsafe { fmi2GetStringStatus(c, PENDING_STATUS, &mut ptr::null()) }),
    ]
}

/// The same for model exchange. Marks: e, no values after a failed initialisation; o, not for this kind of instance.
#[rustfmt::skip] // a table
fn exchange_calls() -> Vec<Call> {
    const N: usize = EVENT_INDICATORS;
    // SAFETY, for all: a live component and arguments that are valid during the call
    vec![
        ("fmi2SetupExperiment",          "x-----", |c| unsafe { fmi2SetupExperiment(c, 0, 0.0, 0.0, 0, 0.0) }),
        ("fmi2EnterInitializationMode",  "x-----", |c| unsafe { fmi2EnterInitializationMode(c) }),
        ("fmi2ExitInitializationMode",   "-x----", |c| unsafe { fmi2ExitInitializationMode(c) }),
        ("fmi2Terminate",                "--xx--", |c| unsafe { fmi2Terminate(c) }),
        ("fmi2Reset",                    "xxxxxx", |c| unsafe { fmi2Reset(c) }),
        ("fmi2SetReal",                  "xxxx--", |c| unsafe { fmi2SetReal(c, &reference("left.load_torque"), 1, &835.0) }),
        ("fmi2SetInteger",               "xxx---", |c| unsafe { fmi2SetInteger(c, ptr::null(), 0, ptr::null()) }),
        ("fmi2SetBoolean",               "xxx---", |c| unsafe { fmi2SetBoolean(c, ptr::null(), 0, ptr::null()) }),
        ("fmi2SetString",                "xxx---", |c| unsafe { fmi2SetString(c, ptr::null(), 0, ptr::null()) }),
        ("fmi2GetReal",                  "xxxxxx", |c| unsafe { fmi2GetReal(c, &reference("left.load_torque"), 1, &mut 0.0) }),
        ("fmi2GetFMUstate",              "xxxxx-", |c| unsafe {
            let mut state = ptr::null_mut();
            let status = fmi2GetFMUstate(c, &mut state);
            fmi2FreeFMUstate(c, &mut state);
            status
        }),
        ("fmi2GetDirectionalDerivative", "-xxxxx", |c| unsafe {
            fmi2GetDirectionalDerivative(c, ptr::null(), 0, ptr::null(), 0, ptr::null(), ptr::null_mut())
        }),
        ("fmi2EnterEventMode",           "--xx--", |c| unsafe { fmi2EnterEventMode(c) }),
        ("fmi2NewDiscreteStates",        "--x---", |c| unsafe { fmi2NewDiscreteStates(c, &mut EventInfo::default()) }),
        ("fmi2EnterContinuousTimeMode",  "--x---", |c| unsafe { fmi2EnterContinuousTimeMode(c) }),
        ("fmi2CompletedIntegratorStep",  "---x--", |c| unsafe { fmi2CompletedIntegratorStep(c, 1, &mut 0, &mut 0) }),
        ("fmi2SetTime",                  "--xx--", |c| unsafe { fmi2SetTime(c, 0.0) }),
        ("fmi2SetContinuousStates",      "---x--", |c| unsafe { fmi2SetContinuousStates(c, [0.0; STATES].as_ptr(), STATES) }),
        ("fmi2GetDerivatives",           "-xxxxe", |c| unsafe { fmi2GetDerivatives(c, [0.0; STATES].as_mut_ptr(), STATES) }),
        ("fmi2GetEventIndicators",       "-xxxxe", |c| unsafe { fmi2GetEventIndicators(c, [0.0; N].as_mut_ptr(), N) }),
        ("fmi2GetContinuousStates",      "-xxxxe", |c| unsafe { fmi2GetContinuousStates(c, [0.0; STATES].as_mut_ptr(), STATES) }),
        ("fmi2GetNominalsOfContinuousStates", "xxxxxx", |c| unsafe { fmi2GetNominalsOfContinuousStates(c, [0.0; STATES].as_mut_ptr(), STATES) }),
        ("fmi2DoStep",                   "------", |c| unsafe { fmi2DoStep(c, 0.0, 1e-4, 0) }),
        ("fmi2SetRealInputDerivatives",  "oo----", |c| unsafe { fmi2SetRealInputDerivatives(c, &reference("left.load_torque"), 1, &1, &0.0) }),
        ("fmi2GetRealOutputDerivatives", "----x-", |c| unsafe { fmi2GetRealOutputDerivatives(c, &reference("left.speed"), 1, &1, &mut 0.0) }),
    ]
}

#[test]
fn in_model_exchange_every_call_is_legal_exactly_where_the_standard_says() {
    for (name, legal, call) in exchange_calls() {
        for (phase, legal) in legal.chars().enumerate() {
            let host = exchange_host_in(phase);
            let status = call(host.c);
            match legal {
                'x' => assert_eq!(status, Status::Ok, "{name} in {}: {:?}", EXCHANGE_PHASES[phase], host.log()),
                // legal in the state, but not for this kind of instance or after this error
                'e' | 'o' => {
                    assert_eq!(status, Status::Error, "{name} in {}", EXCHANGE_PHASES[phase]);
                    assert_contains(&host.last_message(), &[name]);
                }
                _ => {
                    assert_eq!(status, Status::Error, "{name} in {}", EXCHANGE_PHASES[phase]);
                    assert_contains(&host.last_message(), &[name, EXCHANGE_PHASES[phase]]);
                }
            }
        }
    }
}

#[test]
fn calls_of_the_other_kind_are_refused_in_states_where_they_are_legal() {
    for (name, legal, call) in exchange_calls().into_iter().filter(|(name, ..)| {
        ["fmi2GetDerivatives", "fmi2GetEventIndicators", "fmi2GetContinuousStates", "fmi2GetNominals"]
            .iter()
            .any(|known| name.starts_with(known))
    }) {
        let host = host_in(1);
        assert_eq!((call(host.c), &legal[1..2]), (Status::Error, "x"), "{name}");
        assert_contains(&host.last_message(), &[name, "co-simulation"]);
    }
    let (steps, exchange) = (host_in(2), exchange_host_in(2));
    let state = exchange.get_state();
    assert_eq!(steps.set_state(state), Status::Error);
    assert_contains(&steps.last_message(), &["fmi2SetFMUstate", "ModelExchange", "CoSimulation"]);
    exchange.free_state(state);
}

#[test]
fn every_call_is_legal_exactly_where_the_standard_says_and_errors_name_call_and_state() {
    for (name, legal, call) in calls() {
        for (phase, legal) in legal.chars().enumerate() {
            let host = host_in(phase);
            let status = call(host.c);
            if legal == 'x' {
                assert_eq!(status, Status::Ok, "{name} in {}: {:?}", PHASES[phase], host.log());
            } else {
                assert_eq!(status, Status::Error, "{name} in {}", PHASES[phase]);
                assert_contains(&host.last_message(), &[name, PHASES[phase]]);
            }
        }
    }
}

#[test]
fn a_refused_call_leaves_the_simulation_as_it_was() {
    let reference_host = Host::on_level(3);
    reference_host.start();
    let expected = reference_host.record_steps(0, 5);
    let host = Host::on_level(3);
    host.start();
    let mut seen = host.record_steps(0, 2);
    let stop_free: [fn(ComponentPointer) -> Status; 4] = [
        // SAFETY: a live component
        |c| unsafe { fmi2EnterInitializationMode(c) },
        // SAFETY: as above
        |c| unsafe { fmi2ExitInitializationMode(c) },
        // SAFETY: as above
        |c| unsafe { fmi2CancelStep(c) },
        // SAFETY: as above
        |c| unsafe { fmi2SetupExperiment(c, 0, 0.0, 5.0, 0, 0.0) },
    ];
    assert!(stop_free.iter().all(|call| call(host.c) == Status::Error));
    seen.extend(host.record_steps(2, 3));
    assert!(seen == expected);
}

#[test]
fn a_null_component_is_an_error() {
    for (name, _, call) in calls() {
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
    let host = host_in(2);
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
