//! The elastic body of a gear under loads on its root cone, by finite elements in the meridian and Fourier series around.
//!
//! u = R (U, V, W) along R, φ and ζ, U and V like e^{inζ}, W = i w. With s = sin φ, c = cot φ and D = R ∂/∂R the strains are
//!
//! ε_R = U + D U,  ε_φ = ∂V/∂φ + U,  ε_ζ = U + c V − n w/s,
//! γ_Rφ = ∂U/∂φ + D V,  γ_Rζ = n U/s + D w,  γ_φζ = n V/s + ∂w/∂φ − c w   (the last two times i);
//!
//! O. C. Zienkiewicz, R. L. Taylor: axisymmetric bodies under loads that are not. Elements have three nodes along φ; across
//! the face they have three as well, with free ends, or one: then the motion is the same at all R, as in a face without ends.
//! Work and energy are per ∫R²dR. Elements are eliminated one by one, from where the body is held up to the root cone.

use nalgebra::{DMatrix, Matrix3};

use crate::contact::stiffness::Elasticity;
use crate::numeric::{asin, cos, sin, tan};

/// Elements along φ.
const ELEMENTS: usize = 5;
/// Their lengths grow by this factor from the surface down.
const GROWTH: f64 = 1.5;
/// Below this many decay lengths sin φ/n nothing is felt of harmonic n.
const DECAYED: f64 = 9.0;
/// Gauss points and weights.
const GAUSS: [(f64, f64); 3] =
    [(-0.774_596_669_241_483_4, 5.0 / 9.0), (0.0, 8.0 / 9.0), (0.774_596_669_241_483_4, 5.0 / 9.0)];

/// Where a body is held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Held {
    /// On the cone of a polar angle [rad].
    Cone(f64),
    /// On the cylinder of a radius [m].
    Cylinder(f64),
}

impl Held {
    /// Polar angle of the surface at the cone distance `r` [m], and R times its slope.
    fn at(self, r: f64) -> [f64; 2] {
        match self {
            Self::Cone(polar) => [polar, 0.0],
            Self::Cylinder(radius) => {
                let polar = asin(radius / r);
                [polar, -tan(polar)]
            }
        }
    }
}

/// The body of a gear between the root cone and where it is held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HollowCone {
    /// Polar angle of the loaded surface [rad].
    pub surface: f64,
    /// Where it is held.
    pub held: Held,
    /// Inner and outer cone distance [m].
    pub face: [f64; 2],
    /// Elastic constants.
    pub elasticity: Elasticity,
}

/// Functions of a node at a point of an element: value, slope along φ, and R times the slope along R.
type Shape = [f64; 3];

impl HollowCone {
    /// Displacements (U, V, w) of the surface under unit loads (U, V, w) per ζ of harmonic `n` [1/Pa]. If the body `turns`, it
    /// is not held along ζ; its mean rotation is 0. `across` nodes across the face: 3, or 1 for a face without ends. None for a
    /// material that is not elastic.
    pub fn compliance(&self, n: usize, turns: bool, across: usize) -> Option<Matrix3<f64>> {
        let total = (1.0 - GROWTH.powi(ELEMENTS as i32)) / (1.0 - GROWTH);
        let (mut below, mut from) = (None, 0.0);
        let free = n == 0 && turns;
        for e in (0..ELEMENTS).rev() {
            let to = if e == 0 { 1.0 } else { from + GROWTH.powi(e as i32) / total };
            below = Some(self.eliminated(n, [from, to], (across, turns && !free), below)?);
            from = to;
        }
        let mut stiffness = below?;
        if free {
            // torsion stands alone
            for i in (2..3 * across).step_by(3) {
                stiffness.fill_row(i, 0.0);
                stiffness.fill_column(i, 0.0);
                stiffness[(i, i)] = 1.0;
            }
        }
        let shares = self.shares(across);
        let loads =
            DMatrix::from_fn(3 * across, 3, |i, j| if i % 3 == j && !(free && j == 2) { shares[i / 3] } else { 0.0 });
        let moved = stiffness.cholesky()?.solve(&loads);
        Some((loads.transpose() * moved).fixed_view::<3, 3>(0, 0).into_owned())
    }

    /// The same for waves that are short against the body and its face: of a half-space under loads p cos kx, k = n/sin φ.
    pub fn half_space(&self, n: usize) -> Matrix3<f64> {
        let Elasticity { young, poisson } = self.elasticity;
        let normal = 2.0 / (self.elasticity.plane_modulus() * n as f64);
        let across = -normal * (1.0 - 2.0 * poisson) / (2.0 * (1.0 - poisson));
        let along = 2.0 * (1.0 + poisson) / (young * n as f64);
        Matrix3::new(along, 0.0, 0.0, 0.0, normal, across, 0.0, across, normal)
    }

    /// Parts of a load like R² that act on the nodes across the face.
    fn shares(&self, across: usize) -> [f64; 3] {
        let mut shares = [0.0; 3];
        self.along_face(across, |_, weight, values, _| {
            shares.iter_mut().zip(values).for_each(|(share, value)| *share += weight * value);
        });
        shares
    }

    /// Calls `visit` with R, weight R²dR/∫R²dR, values and slopes (times R) of the nodes across the face at its Gauss points.
    fn along_face(&self, across: usize, mut visit: impl FnMut(f64, f64, [f64; 3], [f64; 3])) {
        let [inner, outer] = self.face;
        let (middle, half) = (0.5 * (inner + outer), 0.5 * (outer - inner));
        let moment = (outer.powi(3) - inner.powi(3)) / 3.0;
        for (x, weight) in GAUSS {
            let r = middle + half * x;
            let (values, slopes) = if across == 1 { ([1.0, 0.0, 0.0], [0.0; 3]) } else { quadratic(x) };
            visit(r, weight * half * r * r / moment, values, slopes.map(|slope| slope * r / half));
        }
    }

    /// Stiffness seen at the upper end of an element between the parts `range` of the depth, whose lower end stands on the
    /// stiffness `below`, or is held; if it `turns`, not along ζ.
    fn eliminated(
        &self,
        n: usize,
        range: [f64; 2],
        (across, turns): (usize, bool),
        below: Option<DMatrix<f64>>,
    ) -> Option<DMatrix<f64>> {
        let row = 3 * across;
        let mut k = self.element(n, range, across);
        let held = below.is_none();
        if let Some(below) = below {
            let mut corner = k.view_mut((2 * row, 2 * row), (row, row));
            corner += below;
        }
        let rest: Vec<usize> = (row..3 * row).filter(|i| !held || *i < 2 * row || turns && i % 3 == 2).collect();
        let top = k.view((0, 0), (row, row)).into_owned();
        let side = k.columns(0, row).select_rows(&rest);
        let inner = k.select_rows(&rest).select_columns(&rest);
        Some(top - side.transpose() * inner.cholesky()?.solve(&side))
    }

    /// Stiffness of an element; its rows of nodes from the upper end down.
    fn element(&self, n: usize, range: [f64; 2], across: usize) -> DMatrix<f64> {
        let Elasticity { young, poisson } = self.elasticity;
        let shear = 0.5 * young / (1.0 + poisson);
        let lame = 2.0 * shear * poisson / (1.0 - 2.0 * poisson);
        let nodes = 3 * across;
        let mut k = DMatrix::zeros(3 * nodes, 3 * nodes);
        let (middle, half) = (0.5 * (range[0] + range[1]), 0.5 * (range[1] - range[0]));
        let deepest = self.surface - DECAYED * sin(self.surface) / (n as f64).max(1e-9);
        self.along_face(across, |r, weight_r, values_r, slopes_r| {
            let [mut bottom, mut bottom_slope] = self.held.at(r);
            if bottom < deepest {
                (bottom, bottom_slope) = (deepest, 0.0);
            }
            let depth = self.surface - bottom;
            for (x, weight) in GAUSS {
                let part = middle + half * x;
                let polar = bottom + part * depth;
                let (s, c) = (sin(polar), cos(polar) / sin(polar));
                let (values, slopes) = quadratic(x);
                let mut strains = [[0.0; 6]; 27];
                for row in 0..3 {
                    for column in 0..across {
                        // rows from the upper end down
                        let slope = slopes[2 - row] / (half * depth) * values_r[column];
                        let value = values[2 - row] * values_r[column];
                        // along R at the same φ, not at the same part of the depth
                        let along = values[2 - row] * slopes_r[column] - (1.0 - part) * bottom_slope * slope;
                        let node = 3 * (row * across + column);
                        strains[node..node + 3].copy_from_slice(&strains_of([value, slope, along], n as f64 / s, c));
                    }
                }
                add(&mut k, &strains[..3 * nodes], weight_r * weight * half * depth * s, [lame, shear]);
            }
        });
        k.fill_upper_triangle_with_lower_triangle();
        k
    }
}

/// Values and slopes at `x` of the quadratics that are 1 at −1, 0 and 1.
fn quadratic(x: f64) -> ([f64; 3], [f64; 3]) {
    ([0.5 * x * (x - 1.0), 1.0 - x * x, 0.5 * x * (x + 1.0)], [x - 0.5, -2.0 * x, x + 0.5])
}

/// Strains R, φ, ζ, Rφ, Rζ, φζ of displacements U, V and w of a node.
fn strains_of([value, slope, along]: Shape, around: f64, cot: f64) -> [[f64; 6]; 3] {
    [
        [value + along, value, value, slope, around * value, 0.0],
        [0.0, slope, cot * value, along, 0.0, around * value],
        [0.0, 0.0, -around * value, 0.0, along, slope - cot * value],
    ]
}

/// Adds `weight` times the stiffness of a point with Lamé's constants `lame` and `shear`, at and below the diagonal.
fn add(k: &mut DMatrix<f64>, strains: &[[f64; 6]], weight: f64, [lame, shear]: [f64; 2]) {
    let size = strains.len();
    for (b, strain) in strains.iter().enumerate() {
        let volume = lame * (strain[0] + strain[1] + strain[2]);
        let mut stress = [0.0; 6];
        for i in 0..3 {
            stress[i] = weight * (2.0 * shear * strain[i] + volume);
            stress[3 + i] = weight * shear * strain[3 + i];
        }
        let column = &mut k.as_mut_slice()[b * size..(b + 1) * size];
        for (entry, strain) in column.iter_mut().zip(strains).skip(b) {
            let [x, y, z, p, q, r] = *strain;
            *entry += (x * stress[0] + y * stress[1] + z * stress[2]) + (p * stress[3] + q * stress[4] + r * stress[5]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEEL: Elasticity = Elasticity { young: 2.07e11, poisson: 0.25 };

    fn cone(surface: f64, clamp: f64) -> HollowCone {
        HollowCone { surface, held: Held::Cone(clamp), face: [22e-3, 42e-3], elasticity: STEEL }
    }

    #[test]
    fn torsion_is_that_of_the_closed_form() {
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
    fn short_waves_see_a_half_space() {
        let n = 400;
        let cone = cone(0.8, 0.3);
        let (found, expected) = (cone.compliance(n, false, 1).expect("elastic"), cone.half_space(n));
        assert!((found - expected).norm() < 0.01 * expected.norm(), "{found} {expected}");
    }

    /// Part of the stiffness that a displacement of the nodes of an element meets, from R and φ to U, V and w.
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
    fn rigid_motions_of_the_whole_body_cost_nothing() {
        let face = [36e-3, 42e-3];
        let bodies =
            [HollowCone { face, ..cone(0.8, 0.3) }, HollowCone { face, held: Held::Cylinder(6e-3), ..cone(0.8, 0.3) }];
        // quadratics meet sines and 1/R nearly; a wrong sign of any term is a hundredth and more
        for body in &bodies {
            // rotations about the gear's axis and across it: W = −cos φ sin ζ is w = cos φ with W = i w
            assert!(resistance(body, 0, |_, p| [0.0, 0.0, sin(p)]) < 1e-4);
            assert!(resistance(body, 1, |_, p| [0.0, 1.0, cos(p)]) < 1e-4);
            // translations along the axis and across it
            assert!(resistance(body, 0, |r, p| [cos(p) / r, -sin(p) / r, 0.0]) < 1e-4);
            assert!(resistance(body, 1, |r, p| [sin(p) / r, cos(p) / r, 1.0 / r]) < 1e-4);
            // and what is none
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
        // the motion that is the same at all R is one of those that a finite face can have
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

    /// A plane annulus in plane strain between the radii `inner`, held along r but not along θ, and `outer`: displacements
    /// (u_r, u_θ) of the outer edge under loads p cos nθ along r and t sin nθ along θ, n ≥ 2. J. H. Michell's stress functions
    /// r^n, r^-n, r^(n+2), r^(2-n), times cos nθ (Timoshenko & Goodier, Theory of Elasticity, section 43).
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
    fn a_planet_of_small_angles_is_an_annulus_on_a_pin() {
        // near the axis the sphere is flat: φ is a radius, and U a displacement out of the plane, which plane strain has not
        for [inner, outer] in [[0.6e-2, 1e-2], [0.3e-2, 1e-2]] {
            for n in [2, 3, 4, 6] {
                let cone = HollowCone { surface: outer, ..cone(outer, inner) };
                let found = cone.compliance(n, true, 1).expect("elastic");
                let expected = annulus(n as f64, [inner, outer]);
                // a load per length is one per ζ over r; w is the imaginary part, so that W = −w sin nζ
                let found =
                    nalgebra::Matrix2::new(found[(1, 1)], -found[(1, 2)], -found[(2, 1)], found[(2, 2)]) * outer;
                assert!((found - expected).norm() < 0.01 * expected.norm(), "{inner} n {n}: {found} {expected}");
            }
        }
    }
}
