//! Tests of minima of landscapes with wells, valleys and slopes.

use bevel_differential::numeric::*;
use nalgebra::{DMatrix, DVector};

/// Two wells at x = ±1 and a stiff valley y = kx: f = x⁴/4 − x²/2 + K(y − kx)²/2 + tx.
struct Wells {
    valley: f64,
    tilt: f64,
}

const STIFF: f64 = 1e5;

impl Landscape for Wells {
    fn value(&self, p: &DVector<f64>) -> f64 {
        let (x, d) = (p[0], p[1] - self.valley * p[0]);
        0.25 * x.powi(4) - 0.5 * x * x + 0.5 * STIFF * d * d + self.tilt * x
    }

    fn slopes(&self, p: &DVector<f64>) -> (DVector<f64>, DMatrix<f64>) {
        let (x, k, d) = (p[0], self.valley, p[1] - self.valley * p[0]);
        let gradient = DVector::from_vec(vec![x * x * x - x - STIFF * k * d + self.tilt, STIFF * d]);
        let curvature = [3.0 * x * x - 1.0 + STIFF * k * k, -STIFF * k, -STIFF * k, STIFF];
        (gradient, DMatrix::from_row_slice(2, 2, &curvature))
    }
}

fn search(lean: f64) -> Search {
    Search { longest: 0.1, balance: 1e-11, rough: 1e-8, lean: DVector::from_vec(vec![lean, 0.0]), valley: None }
}

#[test]
fn the_top_between_two_equal_wells_is_left_to_the_side_of_the_lean() {
    for valley in [0.0, 0.5, -3.0] {
        for lean in [1.0, -1.0] {
            let wells = Wells { valley, tilt: 0.0 };
            let found = search(lean).minimum(&wells, DVector::zeros(2)).expect("a minimum");
            assert!((found[0] - lean).abs() < 1e-9 && (found[1] - valley * lean).abs() < 1e-9, "{found}");
        }
    }
}

#[test]
fn a_tilt_decides_before_the_lean() {
    for tilt in [0.2, -0.2] {
        let found = search(tilt).minimum(&Wells { valley: 1.0, tilt }, DVector::zeros(2)).expect("a minimum");
        assert!(found[0] * tilt < 0.0, "{found}");
    }
}

/// f = x² + 0·y: a flat valley.
struct Valley;

impl Landscape for Valley {
    fn value(&self, p: &DVector<f64>) -> f64 {
        p[0] * p[0]
    }

    fn slopes(&self, p: &DVector<f64>) -> (DVector<f64>, DMatrix<f64>) {
        let curvature = DMatrix::from_row_slice(2, 2, &[2.0, 0.0, 0.0, 0.0]);
        (DVector::from_vec(vec![2.0 * p[0], 0.0]), curvature)
    }
}

#[test]
fn a_flat_valley_is_a_minimum() {
    let found = search(1.0).minimum(&Valley, DVector::from_vec(vec![0.05, 0.3])).expect("a minimum");
    assert!(found[0].abs() < 1e-10 && (found[1] - 0.3).abs() < 1e-12, "{found}");
}

#[test]
fn a_slope_without_end_has_no_minimum() {
    struct Slope;
    impl Landscape for Slope {
        fn value(&self, p: &DVector<f64>) -> f64 {
            p[0]
        }
        fn slopes(&self, _: &DVector<f64>) -> (DVector<f64>, DMatrix<f64>) {
            (DVector::from_vec(vec![1.0]), DMatrix::zeros(1, 1))
        }
    }
    let search = Search { lean: DVector::from_vec(vec![1.0]), ..search(1.0) };
    assert!(search.minimum(&Slope, DVector::zeros(1)).is_none());
}
