//! Test that compares Taylor arithmetic with finite differences.

use bevel_differential::numeric::*;

#[test]
fn derivatives_agree_with_central_differences() {
    let f = |x: Jet| ((x.sin() * 2.0 + x * x).sqrt() / (x + 3.0)).atan2(x.cos() + x);
    let (x, h) = (0.7, 1e-4);
    let at = |x: f64| f(Jet::variable(x));
    let (m, c, p) = (at(x - h), at(x), at(x + h));
    assert!((c.d - (p.v - m.v) / (2.0 * h)).abs() < 1e-7);
    assert!((c.dd - (p.d - m.d) / (2.0 * h)).abs() < 1e-6);
}
