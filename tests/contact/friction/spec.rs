//! Values that no law of friction could use.

use bevel_differential::friction::*;

#[test]
fn values_that_no_law_could_use_are_named() {
    let good = ToothFrictionSpec::default();
    assert_eq!(good.problem(), None);
    for (bad, name) in [
        (ToothFrictionSpec { coefficient: 0.5, ..good }, "tooth_friction.coefficient"),
        (ToothFrictionSpec { coefficient: f64::NAN, ..good }, "tooth_friction.coefficient"),
        (ToothFrictionSpec { static_ratio: 0.9, ..good }, "tooth_friction.static_ratio"),
        (ToothFrictionSpec { static_ratio: 7.0, ..good }, "tooth_friction.static_ratio"),
        (ToothFrictionSpec { regularisation_speed: 0.0, ..good }, "tooth_friction.regularisation_speed"),
        (ToothFrictionSpec { roughness: f64::INFINITY, ..good }, "tooth_friction.roughness"),
    ] {
        assert_eq!(bad.problem().map(|p| p.variable), Some(name));
    }
}
