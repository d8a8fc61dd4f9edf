//! Test that compares numbers with derivatives with finite differences.

use bevel_differential::numeric::*;

fn formula<T: Scalar>(x: T, y: T) -> T {
    let root = (x * x + y * y + 1.0).sqrt();
    (x.sin() * y.cos() - x / root) * (-y).exp() + root.ln() * x.abs().powf(1.7) - y * 3.0
}

#[test]
fn derivatives_agree_with_central_differences() {
    for (x, y) in [(0.7, -0.3), (-1.2, 0.4)] {
        let dual = formula(Dual::<2>::variable(x, 0), Dual::variable(y, 1));
        assert_eq!(dual.v, formula(x, y));
        let h = 1e-6;
        assert!((dual.d[0] - (formula(x + h, y) - formula(x - h, y)) / (2.0 * h)).abs() < 1e-8);
        assert!((dual.d[1] - (formula(x, y + h) - formula(x, y - h)) / (2.0 * h)).abs() < 1e-8);
    }
}
