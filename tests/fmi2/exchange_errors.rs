//! Tests of model exchange at invalid states: a call may be refused or discarded, or end the run, but it never returns
//! a wrong number.

use bevel_differential::fmi2::*;
use bevel_differential::model::STATES;
use bevel_differential::variables::table;

use crate::common::{assert_contains, reference};
use crate::solver::{Solver, level};

#[test]
fn a_tooth_bent_too_far_ends_the_run_with_time_and_location() {
    let mut solver = Solver::new(|host| level(host, 3));
    solver.steps(1e-6, 3);
    let mut x = solver.states();
    x[0] -= 0.2;
    solver.set(solver.time + 1e-6, &x);
    // SAFETY: a live component and memory for the results
    assert_eq!(unsafe { fmi2CompletedIntegratorStep(solver.host.c, 1, &mut 0, &mut 0) }, Status::Error);
    assert_contains(
        &solver.host.last_message(),
        &["fmi2CompletedIntegratorStep", "tooth deflection exceeds", "left", "t = "],
    );
}

#[test]
fn non_finite_numbers_and_wrong_counts_are_refused() {
    let solver = Solver::new(|host| level(host, 3));
    let mut x = solver.states();
    // SAFETY: a live component and arrays of this length
    unsafe {
        assert_eq!(fmi2SetContinuousStates(solver.host.c, x.as_ptr(), STATES - 1), Status::Error);
        let counts = [STATES, STATES - 1].map(|count| count.to_string());
        assert_contains(&solver.host.last_message(), &[&counts[0], &counts[1]]);
        assert_eq!(fmi2GetDerivatives(solver.host.c, x.as_mut_ptr(), 1), Status::Error);
        x[2] = f64::NAN;
        assert_eq!(fmi2SetContinuousStates(solver.host.c, x.as_ptr(), STATES), Status::Discard);
        assert_contains(&solver.host.last_message(), &["carrier.angle", "NaN"]);
        assert_eq!(fmi2SetTime(solver.host.c, f64::INFINITY), Status::Error);
        assert_eq!(fmi2SetReal(solver.host.c, &reference("contact.damping"), 1, &1.0), Status::Error);
        assert_contains(&solver.host.last_message(), &["contact.damping", "event mode"]);
    }
}

#[test]
fn values_that_are_not_finite_at_extreme_states_are_discarded_by_name() {
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
        // SAFETY: a live component and memory for the requested values
        unsafe {
            refused(fmi2GetDerivatives(c, many.as_mut_ptr(), STATES), &many);
            refused(fmi2GetContinuousStates(c, many.as_mut_ptr(), STATES), &many);
            refused(fmi2GetEventIndicators(c, many.as_mut_ptr(), EVENT_INDICATORS), &many[..EVENT_INDICATORS]);
            refused(fmi2GetDirectionalDerivative(c, &speed, 1, &load, 1, &1.0, &mut slope), &[slope]);
        }
        for i in table().real_outputs() {
            let name = table().rows[i as usize].name;
            let (status, value) = solver.host.try_get(name);
            if refused(status, &[value]) {
                assert_contains(&solver.host.last_message(), &["fmi2GetReal", name, "not a finite number"]);
            }
        }
    }
    // trial states change no result
    solver.set(solver.time, &sane);
    assert!(solver.host.outputs().iter().all(|&bits| f64::from_bits(bits).is_finite()));
}

#[test]
fn a_step_to_extreme_states_ends_the_run_and_reset_recovers() {
    for wild in [1e300, -f64::MAX] {
        let solver = Solver::new(|host| level(host, 1));
        let mut x = solver.states();
        x[2] = wild;
        solver.set(solver.time + 1e-6, &x);
        // SAFETY: a live component and memory for the results
        let status = unsafe { fmi2CompletedIntegratorStep(solver.host.c, 1, &mut 0, &mut 0) };
        let mut states = [0.0; STATES];
        // SAFETY: a live component and memory for the requested values
        let read = unsafe { fmi2GetContinuousStates(solver.host.c, states.as_mut_ptr(), STATES) };
        assert!(read != Status::Ok || states.iter().all(|x| x.is_finite()), "{wild}: {status:?}, {states:?}");
        assert_eq!(solver.host.reset(), Status::Ok);
        solver.host.start_exchange();
    }
}
