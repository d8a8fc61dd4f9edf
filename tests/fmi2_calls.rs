//! Which call is legal in which state: the co-simulation table of FMI 2.0.4, typed a second time.

mod common;

use std::ptr;

use bevel_differential::fmi2::*;
use common::{Host, assert_tells, reference};

const PHASES: [&str; 6] =
    ["instantiated", "initialization mode", "step complete", "step failed", "terminated", "error"];

/// An instance in the phase of that number.
fn host_in(phase: usize) -> Host {
    let host = Host::new();
    match phase {
        0 => {}
        1 => assert_eq!(host.enter(), Status::Ok),
        2 => host.start(),
        3 => {
            host.start();
            assert_eq!(host.set("left.load_torque", 1e7), Status::Ok);
            assert_eq!(host.step(0.0, 1e-2), Status::Discard, "ten tons per tooth must break the step");
        }
        4 => {
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

type Call = (&'static str, &'static str, fn(ComponentPointer) -> Status);

/// Name, legal phases as a string of x and -, and the call with arguments that are right.
#[rustfmt::skip] // a table
fn calls() -> Vec<Call> {
    // SAFETY, for all: a live component and arguments that are valid through the call
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

#[test]
fn every_call_is_legal_exactly_where_the_standard_says_and_refusals_name_call_and_state() {
    for (name, legal, call) in calls() {
        for (phase, legal) in legal.chars().enumerate() {
            let host = host_in(phase);
            let status = call(host.c);
            if legal == 'x' {
                assert_eq!(status, Status::Ok, "{name} in {}: {:?}", PHASES[phase], host.log());
            } else {
                assert_eq!(status, Status::Error, "{name} in {}", PHASES[phase]);
                assert_tells(&host.last(), &[name, PHASES[phase]]);
            }
        }
    }
}

#[test]
fn a_refused_call_leaves_the_simulation_as_it_was() {
    let reference_host = Host::on_level(3);
    reference_host.start();
    let expected = reference_host.journey(0, 5);
    let host = Host::on_level(3);
    host.start();
    let mut seen = host.journey(0, 2);
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
    seen.extend(host.journey(2, 3));
    assert!(seen == expected);
}

#[test]
fn a_null_component_is_an_error_and_never_a_crash() {
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
    assert_tells(&host.last(), &["fmi2GetReal", "left.speed", "instantiated"]);
    assert_eq!(host.try_get("left.load_torque"), (Status::Ok, 835.0));
}

#[test]
fn what_is_not_claimed_is_refused_with_the_flag_named() {
    let host = host_in(2);
    let load = reference("left.load_torque");
    // SAFETY: a live component and arguments valid through the call
    unsafe {
        assert_eq!(fmi2SetRealInputDerivatives(host.c, &load, 1, &1, &0.0), Status::Error);
        assert_tells(&host.last(), &["canInterpolateInputs"]);
        assert_eq!(fmi2GetRealOutputDerivatives(host.c, &load, 1, &1, &mut 0.0), Status::Error);
        assert_tells(&host.last(), &["maxOutputDerivativeOrder"]);
        assert_eq!(fmi2GetDirectionalDerivative(host.c, &load, 1, &load, 1, &1.0, &mut 0.0), Status::Error);
        assert_tells(&host.last(), &["providesDirectionalDerivative"]);
        assert_eq!(fmi2GetIntegerStatus(host.c, 0, &mut 0), Status::Discard);
        assert_eq!(fmi2GetRealStatus(host.c, DO_STEP_STATUS, &mut 0.0), Status::Discard);
    }
    host.steps(0.0, 1e-4, 1);
}
