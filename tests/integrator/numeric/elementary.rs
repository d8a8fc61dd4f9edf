//! Test that compares sine and cosine with libm.

#[test]
fn sine_and_cosine_by_both_algorithms_agree_with_libm() {
    for k in -20_000..=20_000 {
        let x = f64::from(k) * 5e-5;
        let (sin, cos) = bevel_differential::numeric::sin_cos(x);
        // within one or two roundings
        assert!((sin - libm::sin(x)).abs() <= 3e-16 * x.abs(), "{x}: {sin:e}");
        assert!((cos - libm::cos(x)).abs() <= 3e-16, "{x}: {cos:e}");
    }
}
