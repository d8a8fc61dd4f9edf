//! Pressure between flanks.

use bevel_differential::geometry::{GearSpec, Pair};
use bevel_differential::strength::hertz::*;

fn contact() -> LineContact {
    LineContact::new(&Pair::new(&GearSpec::default()), 2.07e11, 0.25)
}

#[test]
fn the_closed_form_of_the_relative_curvature_equals_the_sum_of_both_curvatures() {
    let c = contact();
    for s in [-0.15, 0.0, 0.2] {
        let [p, g] = [c.pitch_arc[0] + s, c.pitch_arc[1] - s].map(|psi| 30e-3 * psi.tan());
        let tau = c.relative_radius(s).unwrap();
        assert!((30e-3 * tau * (1.0 / p + 1.0 / g) - 1.0).abs() < 1e-14);
    }
}

#[test]
fn a_line_law_has_a_uniform_pressure_over_the_face_equal_to_that_of_impact() {
    let c = contact();
    for cone in [c.cone_range[0], 30e-3, c.cone_range[1]] {
        let p = c.pressure_at(c.line_load(5e3, cone), cone, 0.1).unwrap();
        let b = c.cone_range[1] - c.cone_range[0];
        let impact = c.pressure_at(5e3 / b, c.mean_cone, 0.1).unwrap();
        assert!((p / impact - 1.0).abs() < 1e-14);
    }
}
