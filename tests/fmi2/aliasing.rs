//! Tests of hosts that pass one buffer, or overlapping buffers, for several arguments of a call.

use bevel_differential::fmi2::*;
use bevel_differential::model::STATES;

use crate::common::{Host, assert_contains, reference};

/// Writes derivatives of two outputs along a direction of two inputs to `values`.
///
/// # Safety
/// Both pointers are valid for two numbers.
unsafe fn derive(host: &Host, change: *const f64, values: *mut f64) -> Status {
    let unknown = [reference("left.acceleration"), reference("right.acceleration")];
    let known = [reference("left.load_torque"), reference("right.load_torque")];
    // SAFETY: a live component; the arrays are valid for two elements
    unsafe { fmi2GetDirectionalDerivative(host.c, unknown.as_ptr(), 2, known.as_ptr(), 2, change, values) }
}

#[test]
fn one_buffer_may_hold_the_direction_and_receive_the_derivatives() {
    for running in [false, true] {
        let host = Host::on_level(3);
        assert_eq!([host.setup(), host.enter()], [Status::Ok; 2]);
        if running {
            assert_eq!(host.exit(), Status::Ok);
            host.steps(0.0, 1e-3, 3);
        }
        let (change, mut expected) = ([2.0, -3.0], [f64::NAN; 2]);
        // SAFETY: arrays of two
        assert_eq!(unsafe { derive(&host, change.as_ptr(), expected.as_mut_ptr()) }, Status::Ok, "{:?}", host.log());
        assert!(expected[0] != 0.0 && expected[1] != 0.0 && expected[0] != expected[1], "{expected:?}");
        let mut both = change;
        let buffer = both.as_mut_ptr();
        // SAFETY: one array of two
        assert_eq!(unsafe { derive(&host, buffer, buffer) }, Status::Ok);
        assert_eq!(both, expected, "running: {running}");
        // the results start at the second number of the direction
        let mut shifted = [change[0], change[1], f64::NAN];
        let buffer = shifted.as_mut_ptr();
        // SAFETY: within an array of three
        assert_eq!(unsafe { derive(&host, buffer, buffer.add(1)) }, Status::Ok);
        assert_eq!(shifted[1..], expected);
    }
}

#[test]
fn integers_may_replace_their_references() {
    let host = Host::new();
    let names = ["geometry.planet_teeth", "geometry.side_teeth"];
    let expected = names.map(|name| host.get_integer(name));
    let mut both = names.map(reference);
    let buffer = both.as_mut_ptr();
    // SAFETY: a live component and one array of two
    assert_eq!(unsafe { fmi2GetInteger(host.c, buffer, 2, buffer.cast()) }, Status::Ok);
    assert_eq!(both.map(|bits| bits as i32), expected);
}

#[test]
fn references_overwritten_by_results_are_refused() {
    // a result covers two references, so the second one is overwritten before it is read
    let host = Host::new();
    let load = u64::from(reference("left.load_torque"));
    let mut memory = [f64::from_bits(load << 32 | load); 2];
    let buffer = memory.as_mut_ptr();
    // SAFETY: a live component and memory for two numbers
    assert_eq!(unsafe { fmi2GetReal(host.c, buffer.cast(), 2, buffer) }, Status::Error);
    assert_contains(&host.last_message(), &["fmi2GetReal", "does not exist"]);
    assert_eq!(memory[0], 835.0);
}

#[test]
fn one_variable_may_receive_both_results_of_a_completed_step() {
    let host = Host::for_exchange();
    host.start_exchange();
    let mut both = -1;
    let target = &raw mut both;
    // SAFETY: a live component and memory for one value
    assert_eq!(unsafe { fmi2CompletedIntegratorStep(host.c, 1, target, target) }, Status::Ok);
    assert_eq!(both, 0);
    let mut states = [f64::NAN; STATES];
    // SAFETY: a live component and memory for all states
    unsafe {
        assert_eq!(fmi2GetContinuousStates(host.c, states.as_mut_ptr(), STATES), Status::Ok);
        assert_eq!(fmi2SetContinuousStates(host.c, states.as_ptr(), STATES), Status::Ok);
    }
}
