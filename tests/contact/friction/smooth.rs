//! Smooth steps and signs.

use bevel_differential::friction::smooth::*;
use bevel_differential::numeric::Dual;

#[test]
fn a_bound_joins_both_sides_with_continuous_slope_and_curvature() {
    let at = |x: f64| floor(Dual::<1>::variable(x, 0), 2.0, 0.5);
    let h = 1e-6;
    for x in [0.0, 1.5 - h, 1.5 + h, 1.7, 2.0, 2.3, 2.5 - h, 2.5 + h, 9.0] {
        let slope = (at(x + h).v - at(x - h).v) / (2.0 * h);
        assert!((slope - at(x).d[0]).abs() < 1e-8, "{x}");
        let curvature = (at(x + h).d[0] - at(x - h).d[0]) / (2.0 * h);
        assert!(curvature > -1e-9 && curvature < 2.0 && at(x).v >= 2.0);
    }
    for x in [1.5, 2.5] {
        assert!(((at(x + h).d[0] - at(x - h).d[0]) / (2.0 * h)).abs() < 1e-4, "curvature jumps at {x}");
    }
    assert_eq!((at(2.5).v, at(3.0).v, at(1.5).v, at(-1e300).v), (2.5, 3.0, 2.0, 2.0));
    assert_eq!((ceiling(0.19, 0.3, 0.1), ceiling(5.0, 0.3, 0.1)), (0.19, 0.3));
    assert_eq!((hold(0.0, [1.0, 10.0]), hold(4.0, [1.0, 10.0]), hold(99.0, [1.0, 10.0])), (1.0, 4.0, 10.0));
}
