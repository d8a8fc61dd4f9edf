//! Values of tooth errors that are refused.

use bevel_differential::contact::errors::*;

#[test]
fn defaults_pass() {
    assert_eq!(ToothErrorSpec::default().check(), Ok(()));
    assert_eq!(ToothFaultSpec::default().check([10, 16], 2), Ok(()));
}

#[test]
fn values_out_of_range_are_named() {
    let perfect = ToothErrorSpec::default();
    for (spec, name) in [
        (ToothErrorSpec { accuracy_grade: 1, ..perfect }, "tooth_errors.accuracy_grade"),
        (ToothErrorSpec { accuracy_grade: 12, ..perfect }, "tooth_errors.accuracy_grade"),
        (ToothErrorSpec { runout_by_grade: true, ..perfect }, "tooth_errors.runout_by_grade"),
        (ToothErrorSpec { side_runout: -1e-6, ..perfect }, "tooth_errors.side_runout"),
        (ToothErrorSpec { crowning: f64::NAN, ..perfect }, "tooth_errors.crowning"),
        (ToothErrorSpec { relief_length: 0.0, ..perfect }, "tooth_errors.relief_length"),
        (ToothErrorSpec { shaft_angle_error: 1.0, ..perfect }, "tooth_errors.shaft_angle_error"),
    ] {
        assert_eq!(spec.check().unwrap_err().variable, name);
    }
    let chip = ToothFaultSpec { gear: FaultyGear::Planet, ..ToothFaultSpec::default() };
    for (fault, name) in [
        (ToothFaultSpec { index: 2, ..chip }, "tooth_fault.index"),
        (ToothFaultSpec { index: -1, ..chip }, "tooth_fault.index"),
        (ToothFaultSpec { tooth: 10, ..chip }, "tooth_fault.tooth"),
        (ToothFaultSpec { missing_fraction: 1.5, ..chip }, "tooth_fault.missing_fraction"),
        (ToothFaultSpec { onset: f64::INFINITY, ..chip }, "tooth_fault.onset"),
    ] {
        assert_eq!(fault.check([10, 16], 2).unwrap_err().variable, name);
    }
}
