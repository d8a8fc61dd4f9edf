//! Stiffness of the study by Hertz.

#[test]
fn stiffness_equals_that_of_the_study_without_its_arithmetic_error() {
    let k = bevel_differential::contact::hertz::stiffness(22.5e-3, 36e-3, 2.07e11, 0.25);
    assert!((k / 1.7321e10 - 1.0).abs() < 1e-5, "{k}");
    // in N/mm^1.5, as the study prints it
    assert!((k / 1e3f64.powf(1.5) / 5.4774e5 - 1.0).abs() < 1e-4);
}
