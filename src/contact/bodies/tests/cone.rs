//! The elastic cone against closed forms and rigid motions.

use super::*;

const STEEL: Elasticity = Elasticity { young: 2.07e11, poisson: 0.25 };

fn cone(surface: f64, clamp: f64) -> HollowCone {
    HollowCone { surface, held: Held::Cone(clamp), face: [22e-3, 42e-3], elasticity: STEEL }
}

#[test]
fn torsion_matches_the_closed_form() {
    // T = 2πG sin³φ θ′ ∫R²dR: θ = T/(2πG) [ln tan(φ/2)/2 − cos φ/(2 sin²φ)], with and without ends
    let integral = |x: f64| 0.5 * libm::log(tan(0.5 * x)) - cos(x) / (2.0 * sin(x) * sin(x));
    let shear = 0.5 * STEEL.young / (1.0 + STEEL.poisson);
    for [clamp, surface] in [[0.2, 0.8], [0.15, 0.46], [0.7, 0.86]] {
        let expected = sin(surface) * sin(surface) / shear * (integral(surface) - integral(clamp));
        for across in [1, 3] {
            let found = cone(surface, clamp).compliance(0, false, across).expect("elastic")[(2, 2)];
            assert!((found / expected - 1.0).abs() < 5e-3, "{clamp} {surface}: {found:e} {expected:e}");
            assert_eq!(cone(surface, clamp).compliance(0, true, across).expect("elastic")[(2, 2)], 0.0);
        }
    }
}

#[test]
fn short_waves_behave_as_on_a_half_space() {
    let n = 400;
    let cone = cone(0.8, 0.3);
    let (found, expected) = (cone.compliance(n, false, 1).expect("elastic"), cone.half_space(n));
    assert!((found - expected).norm() < 0.01 * expected.norm(), "{found} {expected}");
}

/// Relative force that resists a displacement of the nodes of an element. `displacement` maps R and φ to U, V and w.
fn resistance(body: &HollowCone, n: usize, displacement: impl Fn(f64, f64) -> [f64; 3]) -> f64 {
    let range = [0.2, 0.5];
    let k = body.element(n, range, 3);
    let [inner, outer] = body.face;
    let moved = nalgebra::DVector::from_fn(27, |i, _| {
        let (row, column) = (i / 9, i / 3 % 3);
        let r = inner + 0.5 * (outer - inner) * column as f64;
        let part = range[1] - 0.5 * (range[1] - range[0]) * row as f64;
        let bottom = body.held.at(r)[0];
        displacement(r, bottom + part * (body.surface - bottom))[i % 3]
    });
    (&k * &moved).norm() / (k.norm() * moved.norm())
}

#[test]
fn rigid_motions_of_the_whole_body_need_no_force() {
    let face = [36e-3, 42e-3];
    let bodies =
        [HollowCone { face, ..cone(0.8, 0.3) }, HollowCone { face, held: Held::Cylinder(6e-3), ..cone(0.8, 0.3) }];
    // quadratics approximate sines and 1/R closely; a wrong sign of any term causes an error of at least one hundredth
    for body in &bodies {
        // rotations about the gear's axis and across it: W = −cos φ sin ζ is w = cos φ with W = i w
        assert!(resistance(body, 0, |_, p| [0.0, 0.0, sin(p)]) < 1e-4);
        assert!(resistance(body, 1, |_, p| [0.0, 1.0, cos(p)]) < 1e-4);
        // translations along the axis and across it
        assert!(resistance(body, 0, |r, p| [cos(p) / r, -sin(p) / r, 0.0]) < 1e-4);
        assert!(resistance(body, 1, |r, p| [sin(p) / r, cos(p) / r, 1.0 / r]) < 1e-4);
        // a motion that is not rigid
        assert!(resistance(body, 1, |r, p| [sin(p) / r, cos(p) / r, -1.0 / r]) > 1e-2);
    }
}

#[test]
fn compliances_are_symmetric_and_positive() {
    for n in [0, 1, 2, 5, 40] {
        let c = cone(0.46, 0.15).compliance(n, false, 3).expect("elastic");
        assert!((c - c.transpose()).norm() < 1e-12 * c.norm());
        assert!(c.cholesky().is_some(), "{n}: {c}");
    }
}

#[test]
fn free_ends_soften() {
    // the motion that is the same at all R is one of the motions that a finite face can have
    for n in [1, 2, 5, 8] {
        let [endless, finite] = [1, 3].map(|across| cone(0.86, 0.3).compliance(n, false, across).expect("elastic"));
        assert!((finite - endless).cholesky().is_some(), "{n}: {endless} {finite}");
    }
}

#[test]
fn elements_are_fine_enough() {
    for across in [1, 3] {
        for n in [0, 1, 2, 6, 30] {
            let cone = cone(0.86, 0.3);
            let coarse = cone.compliance(n, false, across).expect("elastic");
            let mut below = None;
            for e in 0..120 {
                let part = |k: i32| f64::from(k) / 120.0;
                below = cone.eliminated(n, [part(e), part(e + 1)], (across, false), below);
            }
            let shares = cone.shares(across);
            let loads = DMatrix::from_fn(3 * across, 3, |i, j| if i % 3 == j { shares[i / 3] } else { 0.0 });
            let stiffness = below.expect("elements");
            let fine = loads.transpose() * stiffness.cholesky().expect("a stiffness").solve(&loads);
            assert!((coarse - &fine).norm() < 5e-3 * fine.norm(), "{n}: {fine}");
        }
    }
}

/// Compliance of a plane annulus in plane strain: displacements (u_r, u_θ) of the edge at radius `outer` under loads p
/// cos nθ along r and t sin nθ along θ, n ≥ 2. At radius `inner` it is held along r but not along θ. It uses J. H.
/// Michell's stress functions r^n, r^-n, r^(n+2), r^(2-n), times cos nθ (Timoshenko & Goodier, Theory of Elasticity,
/// section 43).
fn annulus(n: f64, [inner, outer]: [f64; 2]) -> nalgebra::Matrix2<f64> {
    let shear = 0.5 * STEEL.young / (1.0 + STEEL.poisson);
    let kappa = 3.0 - 4.0 * STEEL.poisson;
    // σ_r cos, τ_rθ sin, 2G u_r cos, 2G u_θ sin of φ = r^m cos nθ (Barber, Elasticity, table 9.1)
    let of = |k: usize, r: f64| -> [f64; 4] {
        match k {
            0 => [
                -n * (n - 1.0) * r.powf(n - 2.0),
                n * (n - 1.0) * r.powf(n - 2.0),
                -n * r.powf(n - 1.0),
                n * r.powf(n - 1.0),
            ],
            1 => [
                -(n + 1.0) * (n - 2.0) * r.powf(n),
                n * (n + 1.0) * r.powf(n),
                (kappa - n - 1.0) * r.powf(n + 1.0),
                (kappa + n + 1.0) * r.powf(n + 1.0),
            ],
            2 => [
                -n * (n + 1.0) * r.powf(-n - 2.0),
                -n * (n + 1.0) * r.powf(-n - 2.0),
                n * r.powf(-n - 1.0),
                n * r.powf(-n - 1.0),
            ],
            _ => [
                -(n + 2.0) * (n - 1.0) * r.powf(-n),
                -n * (n - 1.0) * r.powf(-n),
                (kappa + n - 1.0) * r.powf(1.0 - n),
                -(kappa - n + 1.0) * r.powf(1.0 - n),
            ],
        }
    };
    let rows = nalgebra::Matrix4::from_fn(|i, k| match i {
        0 => of(k, outer)[0],
        1 => of(k, outer)[1],
        2 => of(k, inner)[2],
        _ => of(k, inner)[1],
    });
    let edge = nalgebra::Matrix2x4::from_fn(|i, k| of(k, outer)[2 + i]);
    let loads = nalgebra::Matrix4x2::from_fn(|i, j| if i == j { 1.0 } else { 0.0 });
    edge * rows.try_inverse().expect("independent functions") * loads / (2.0 * shear)
}

#[test]
fn a_planet_of_small_angles_matches_an_annulus_on_a_pin() {
    // near the axis the sphere is flat: φ is a radius, and U is a displacement out of the plane, which plane strain
    // excludes
    for [inner, outer] in [[0.6e-2, 1e-2], [0.3e-2, 1e-2]] {
        for n in [2, 3, 4, 6] {
            let cone = HollowCone { surface: outer, ..cone(outer, inner) };
            let found = cone.compliance(n, true, 1).expect("elastic");
            let expected = annulus(n as f64, [inner, outer]);
            // a load per length is one per ζ over r; w is the imaginary part, so that W = −w sin nζ
            let found = nalgebra::Matrix2::new(found[(1, 1)], -found[(1, 2)], -found[(2, 1)], found[(2, 2)]) * outer;
            assert!((found - expected).norm() < 0.01 * expected.norm(), "{inner} n {n}: {found} {expected}");
        }
    }
}
