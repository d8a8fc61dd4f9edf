//! Tooth errors for tests.

use bevel_differential::contact::errors::ToothErrorSpec;

/// Returns tooth errors of every kind at the same time.
pub fn every_kind() -> ToothErrorSpec {
    ToothErrorSpec {
        accuracy_grade: 7,
        seed: 11,
        runout_by_grade: true,
        planet_tip_relief: 15e-6,
        side_tip_relief: 10e-6,
        crowning: 6e-6,
        shaft_angle_error: 2e-4,
        planet_axial_offset: 20e-6,
        side_axial_offset: -30e-6,
        axis_offset: 15e-6,
        ..ToothErrorSpec::default()
    }
}
