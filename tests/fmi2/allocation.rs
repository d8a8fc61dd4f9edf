//! Once initialised, setting inputs, stepping and reading outputs allocate nothing.

use bevel_differential::fmi2::*;
use bevel_differential::model::STATES;
use bevel_differential::variables::table;

use crate::common::counting_allocator::allocations;
use crate::common::{Host, reference};

#[test]
fn setting_stepping_and_reading_allocate_nothing_on_both_levels() {
    for level in [1, 3] {
        let host = Host::on_level(level);
        host.start();
        // the log says once that ideal gears do not feel it
        assert_eq!(host.set("contact.damping", 6e4), Status::Ok);
        let outputs: Vec<u32> = table().outputs.iter().map(|&i| i as u32).collect();
        let (mut values, mut slope) = (vec![f64::NAN; outputs.len()], f64::NAN);
        let inputs = [reference("left.load_torque"), reference("right.load_torque"), reference("contact.damping")];
        let mut counts = [0; 5];
        let mut ok = true;
        for i in 0..50 {
            let t = f64::from(i) * 1e-3;
            let loads = [800.0 + 50.0 * (300.0 * t).sin(), 800.0, 5e4 + t];
            // SAFETY, for all: a live component and arrays of these lengths
            let mut calls: [&mut dyn FnMut() -> Status; 5] = [
                &mut || unsafe { fmi2SetReal(host.c, inputs.as_ptr(), 3, loads.as_ptr()) },
                &mut || unsafe { fmi2SetRealInputDerivatives(host.c, inputs.as_ptr(), 1, &1, &2e4) },
                &mut || unsafe { fmi2DoStep(host.c, t, 1e-3, 1) },
                &mut || unsafe { fmi2GetRealOutputDerivatives(host.c, outputs.as_ptr(), 1, &1, &mut slope) },
                &mut || unsafe { fmi2GetReal(host.c, outputs.as_ptr(), outputs.len(), values.as_mut_ptr()) },
            ];
            for (call, count) in calls.iter_mut().zip(&mut counts) {
                let before = allocations();
                ok &= call() == Status::Ok;
                *count += allocations() - before;
            }
        }
        assert!(ok && values.iter().all(|v| v.is_finite()), "{:?}", host.log());
        assert_eq!(counts, [0; 5], "level {level}: set, set derivatives, step, get derivatives, get");
    }
}

#[test]
fn going_on_under_inputs_that_hold_allocates_nothing() {
    let host = Host::on_level(3);
    host.start();
    let before = allocations();
    let mut ok = true;
    for i in 0..500 {
        // SAFETY: a live component
        ok &= unsafe { fmi2DoStep(host.c, f64::from(i) * 1e-4, 1e-4, 1) } == Status::Ok;
    }
    assert_eq!((ok, allocations() - before), (true, 0), "{:?}", host.log());
}

#[test]
fn model_exchange_allocates_nothing() {
    let host = Host::for_exchange();
    host.start_exchange();
    let (mut states, mut rates) = ([0.0; STATES], [0.0; STATES]);
    let (mut indicators, mut event, mut end) = ([0.0; EVENT_INDICATORS], 0, 0);
    let before = allocations();
    let mut ok = true;
    for i in 1..50 {
        // SAFETY: a live component and arrays of these lengths
        unsafe {
            ok &= fmi2GetContinuousStates(host.c, states.as_mut_ptr(), STATES) == Status::Ok;
            ok &= fmi2GetDerivatives(host.c, rates.as_mut_ptr(), STATES) == Status::Ok;
            states.iter_mut().zip(&rates).for_each(|(x, rate)| *x += 1e-8 * rate);
            ok &= fmi2SetTime(host.c, 1e-8 * f64::from(i)) == Status::Ok;
            ok &= fmi2SetContinuousStates(host.c, states.as_ptr(), STATES) == Status::Ok;
            ok &= fmi2GetEventIndicators(host.c, indicators.as_mut_ptr(), EVENT_INDICATORS) == Status::Ok;
            ok &= fmi2CompletedIntegratorStep(host.c, 1, &mut event, &mut end) == Status::Ok;
        }
    }
    assert!(ok, "{:?}", host.log());
    assert_eq!(allocations() - before, 0);
}

#[test]
fn overwriting_a_state_allocates_nothing() {
    let host = Host::on_level(3);
    host.start();
    let mut state = host.get_state();
    let before = allocations();
    // SAFETY: a live component and a live state
    let statuses = unsafe { [fmi2GetFMUstate(host.c, &mut state), fmi2SetFMUstate(host.c, state)] };
    assert_eq!((statuses, allocations() - before), ([Status::Ok; 2], 0));
    host.free_state(state);
}
