//! Coulomb friction with a Stribeck peak.

use bevel_differential::friction::ToothFrictionSpec;
use bevel_differential::friction::coulomb::*;

#[test]
fn peak_falls_from_static_to_kinetic() {
    let spec = ToothFrictionSpec {
        coefficient: 0.06,
        static_ratio: 1.5,
        stribeck_speed: 0.02,
        ..ToothFrictionSpec::default()
    };
    let at = |v: f64| coefficient(&spec, v);
    assert!((at(0.0) - 0.09).abs() < 1e-15);
    // at v_S, 1/e of the peak of 0.03 is left: 0.03/2.718281828459045 = 0.01103638323514327
    assert!((at(0.02) - 0.07103638323514327).abs() < 1e-15);
    assert_eq!(at(-0.02), at(0.02));
    assert!((at(1.0) - 0.06).abs() < 1e-15);
}
