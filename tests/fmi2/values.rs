//! Tests of setting and reading values: refused calls return the right message and change nothing.

use std::ptr;

use bevel_differential::fmi2::*;
use bevel_differential::variables::table;

use crate::common::{Host, assert_contains, reference};

#[test]
fn a_parameter_that_is_not_finite_is_discarded_immediately() {
    let host = Host::new();
    assert_eq!(host.set("geometry.module", f64::NAN), Status::Discard);
    assert_contains(&host.last_message(), &["geometry.module", "NaN", "0.0002", "0.1", " m"]);
    assert_eq!(host.get("geometry.module"), 0.0045);
}

#[test]
fn a_module_of_four_and_a_half_metres_fails_initialisation_with_a_hint_and_works_after_reset() {
    let plain = Host::new();
    plain.start();
    let expected = plain.outputs();
    let host = Host::new();
    assert_eq!(host.set("geometry.module", 4.5), Status::Ok, "initialisation checks all ranges together");
    assert_eq!(host.set_integer("geometry.planet_teeth", -3), Status::Ok);
    assert_eq!(host.enter(), Status::Ok);
    assert_eq!(host.exit(), Status::Error);
    assert_contains(
        &host.last_message(),
        &["geometry.module", "did you mean 4.5 mm", "0.0045", "geometry.planet_teeth", "-3"],
    );
    assert_eq!(host.step(0.0, 1e-3), Status::Error);
    assert_eq!(host.try_get("left.speed").0, Status::Error);
    assert_eq!(host.get("geometry.module"), 4.5, "values that were set can be read");
    assert_eq!(host.reset(), Status::Ok);
    assert_eq!(host.get("geometry.module"), 0.0045);
    host.start();
    assert!(host.outputs() == expected);
}

#[test]
fn parameters_can_be_corrected_in_initialisation_mode() {
    let host = Host::new();
    assert_eq!(host.set("geometry.module", 4.5), Status::Ok);
    assert_eq!(host.enter(), Status::Ok);
    assert_eq!(host.try_get("left.speed").0, Status::Error);
    assert_contains(&host.last_message(), &["did you mean"]);
    assert_eq!(host.set("geometry.module", 0.0045), Status::Ok);
    assert_eq!(host.exit(), Status::Ok);
}

#[test]
fn an_input_that_grows_out_of_its_range_is_called_unstable_and_a_wrong_unit_is_not() {
    for sign in [1.0, -1.0] {
        let host = Host::new();
        host.start();
        assert_eq!(host.set("carrier.speed_command", sign * 114_748.0), Status::Discard);
        assert_contains(&host.last_message(), &["carrier.speed_command", "did you mean"]);
        assert_eq!(host.set("carrier.speed_command", sign * 40_000.0), Status::Ok);
        assert_eq!(host.set("carrier.speed_command", sign * 114_748.0), Status::Discard);
        let said = host.last_message();
        assert_contains(&said, &["114748 rad/s is outside", "40000 before", "unstable"]);
        assert!(!said.contains("did you mean"), "{said}");
    }
}

#[test]
fn outputs_and_fixed_parameters_are_not_set_in_a_running_simulation() {
    let host = Host::new();
    assert_eq!(host.set("left.speed", 1.0), Status::Error);
    assert_contains(&host.last_message(), &["left.speed", "output"]);
    host.start();
    assert_eq!(host.set("geometry.module", 0.005), Status::Error);
    assert_contains(&host.last_message(), &["geometry.module", "fixed"]);
    assert_eq!(host.set_integer("geometry.side_teeth", 17), Status::Error);
    assert_contains(&host.last_message(), &["geometry.side_teeth", "fixed"]);
    assert_eq!(host.set_boolean("effects.backlash", 0), Status::Error);
    assert_contains(&host.last_message(), &["effects.backlash", "fixed"]);
    assert_eq!(host.get("geometry.module"), 0.0045);
    host.steps(0.0, 1e-4, 1);
}

#[test]
fn a_tunable_parameter_takes_effect_in_a_running_simulation() {
    // the damping is doubled between two steps; the runs differ from then on
    let (plain, tuned) = (Host::on_level(3), Host::on_level(3));
    plain.start();
    tuned.start();
    assert!(plain.record_steps(0, 2) == tuned.record_steps(0, 2));
    let damping = tuned.get("contact.damping");
    assert_eq!(tuned.set("contact.damping", 2.0 * damping), Status::Ok);
    assert_eq!(tuned.get("contact.damping"), 2.0 * damping);
    assert!(plain.record_steps(2, 2) != tuned.record_steps(2, 2));
    assert_eq!(tuned.set("contact.damping", -1.0), Status::Discard);
    assert_contains(&tuned.last_message(), &["contact.damping", "-1"]);
    assert_eq!(tuned.get("contact.damping"), 2.0 * damping);
}

#[test]
fn the_number_of_an_unknown_choice_is_refused_with_the_choices() {
    let host = Host::new();
    assert_eq!(host.set_integer("solver.method", 4), Status::Error);
    assert_contains(&host.last_message(), &["solver.method: 4 is not one of 1 = adaptive, 2 = fixed_step, 3 = radau"]);
}

#[test]
fn an_output_with_choices_is_read_as_an_integer_and_cannot_be_set() {
    let host = Host::new();
    assert_eq!(host.set_boolean("effects.coupling_advice", 1), Status::Ok);
    assert_eq!(host.set("carrier.speed_command", 0.0), Status::Ok);
    host.start();
    host.steps(0.0, 1e-3, 50);
    let state = reference("coupling.advice_state");
    let mut value = -1;
    // SAFETY: a live component and arguments valid during the call
    unsafe {
        assert_eq!(fmi2GetInteger(host.c, &state, 1, &mut value), Status::Ok);
        assert_eq!(fmi2GetReal(host.c, &state, 1, &mut 0.0), Status::Error);
        assert_contains(&host.last_message(), &["coupling.advice_state is of type Enumeration"]);
        assert_eq!(fmi2SetInteger(host.c, &state, 1, &1), Status::Error);
        assert_contains(&host.last_message(), &["coupling.advice_state is an output and cannot be set"]);
    }
    // no value of the host has changed
    assert_eq!(value, 3);
}

#[test]
fn wrong_types_and_unknown_references_are_named() {
    let host = Host::new();
    let unknown = table().rows.len() as u32;
    // SAFETY: a live component and arguments valid during the call
    unsafe {
        assert_eq!(fmi2GetReal(host.c, &reference("geometry.planet_teeth"), 1, &mut 0.0), Status::Error);
        assert_contains(&host.last_message(), &["fmi2GetReal", "geometry.planet_teeth", "Integer"]);
        assert_eq!(fmi2SetInteger(host.c, &reference("geometry.module"), 1, &1), Status::Error);
        assert_contains(&host.last_message(), &["fmi2SetInteger", "geometry.module", "Real"]);
        assert_eq!(fmi2GetBoolean(host.c, &reference("left.speed"), 1, &mut 0), Status::Error);
        assert_eq!(fmi2SetBoolean(host.c, &reference("left.speed"), 1, &0), Status::Error);
        assert_eq!(fmi2GetString(host.c, &reference("left.speed"), 1, &mut ptr::null()), Status::Error);
        assert_contains(&host.last_message(), &["fmi2GetString", "left.speed", "Real"]);
        assert_eq!(fmi2SetString(host.c, &unknown, 1, &c"x".as_ptr()), Status::Error);
        for unknown in [unknown, u32::MAX] {
            assert_eq!(fmi2GetReal(host.c, &unknown, 1, &mut 0.0), Status::Error);
            assert_contains(&host.last_message(), &[&unknown.to_string(), "does not exist"]);
            assert_eq!(fmi2SetReal(host.c, &unknown, 1, &0.0), Status::Error);
        }
    }
}

#[test]
fn null_arrays_are_refused_unless_the_count_is_zero() {
    let host = Host::new();
    let module = reference("geometry.module");
    // SAFETY: a live component; NULL arrays are the object of the test
    unsafe {
        assert_eq!(fmi2GetReal(host.c, ptr::null(), 0, ptr::null_mut()), Status::Ok);
        assert_eq!(fmi2SetReal(host.c, ptr::null(), 0, ptr::null()), Status::Ok);
        assert_eq!(fmi2GetReal(host.c, ptr::null(), 1, &mut 0.0), Status::Error);
        assert_contains(&host.last_message(), &["fmi2GetReal", "vr", "NULL"]);
        assert_eq!(fmi2GetReal(host.c, &module, 1, ptr::null_mut()), Status::Error);
        assert_contains(&host.last_message(), &["fmi2GetReal", "value", "NULL"]);
        assert_eq!(fmi2SetReal(host.c, &module, usize::MAX, &0.0), Status::Error);
        assert_eq!(fmi2GetStatus(host.c, 0, ptr::null_mut()), Status::Error);
    }
}

#[test]
fn every_real_parameter_reads_back_its_start_value() {
    let host = Host::new();
    for row in table().rows.iter().filter(|row| crate::common::is_real_parameter(&row.access)) {
        let value = host.get(row.name);
        assert_eq!(host.set(row.name, value), Status::Ok);
        assert_eq!(host.get(row.name), value, "{}", row.name);
    }
}
