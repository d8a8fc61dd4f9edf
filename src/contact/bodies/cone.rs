//! The elastic body of a gear under loads on its root cone: finite elements in the meridian, Fourier series around the
//! axis.
//!
//! u = R (U, V, W) along R, φ and ζ. U and V vary like e^{inζ}, and W = i w. With s = sin φ, c = cot φ and D = R ∂/∂R,
//! the strains are
//!
//! ε_R = U + D U,  ε_φ = ∂V/∂φ + U,  ε_ζ = U + c V − n w/s,
//! γ_Rφ = ∂U/∂φ + D V,  γ_Rζ = n U/s + D w,  γ_φζ = n V/s + ∂w/∂φ − c w   (the last two times i).
//!
//! Source: O. C. Zienkiewicz, R. L. Taylor, axisymmetric bodies under loads that are not axisymmetric. Elements have
//! three nodes along φ. Across the face they have three nodes with free ends, or one node. With one node, U, V and w
//! are the same at all R, as in a face without ends. Work and energy are per ∫R²dR. Elements are eliminated one by one,
//! from the held surface up to the root cone.

use nalgebra::{DMatrix, Matrix3};

use crate::contact::stiffness::Elasticity;
use crate::numeric::{asin, cos, sin, tan};

/// Elements along φ.
const ELEMENTS: usize = 5;
/// Factor by which the element lengths grow from the surface down.
const GROWTH: f64 = 1.5;
/// Depth below the root cone at which harmonic n has decayed, in decay lengths sin φ/n.
const DECAYED: f64 = 9.0;
/// Gauss points and weights.
const GAUSS: [(f64, f64); 3] =
    [(-0.774_596_669_241_483_4, 5.0 / 9.0), (0.0, 8.0 / 9.0), (0.774_596_669_241_483_4, 5.0 / 9.0)];

/// Surface on which a body is held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Held {
    /// Cone with this polar angle [rad].
    Cone(f64),
    /// Cylinder with this radius [m].
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

/// The body of a gear between the root cone and the surface on which it is held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HollowCone {
    /// Polar angle of the loaded surface [rad].
    pub surface: f64,
    /// Surface on which the body is held.
    pub held: Held,
    /// Inner and outer cone distance [m].
    pub face: [f64; 2],
    /// Elastic constants.
    pub elasticity: Elasticity,
}

/// Functions of a node at a point of an element: value, slope along φ, and R times the slope along R.
type Shape = [f64; 3];

impl HollowCone {
    /// Compliance matrix of harmonic `n` [1/Pa]. Column j contains the displacements (U, V, w) of the surface under a
    /// unit load along direction j (R, φ, ζ) per azimuth. If `is_free_to_turn`, the body is not held along ζ, and its
    /// mean rotation is 0. The face has 3 nodes (`nodes_across`), or 1 for a face without ends. Returns `None` if the
    /// stiffness matrix is not positive definite.
    pub fn compliance(&self, n: usize, is_free_to_turn: bool, nodes_across: usize) -> Option<Matrix3<f64>> {
        let total = (1.0 - GROWTH.powi(ELEMENTS as i32)) / (1.0 - GROWTH);
        let (mut below, mut from) = (None, 0.0);
        let free = n == 0 && is_free_to_turn;
        for e in (0..ELEMENTS).rev() {
            let to = if e == 0 { 1.0 } else { from + GROWTH.powi(e as i32) / total };
            below = Some(self.eliminated(n, [from, to], (nodes_across, is_free_to_turn && !free), below)?);
            from = to;
        }
        let mut stiffness = below?;
        if free {
            // torsion is decoupled from the other displacements
            for i in (2..3 * nodes_across).step_by(3) {
                stiffness.fill_row(i, 0.0);
                stiffness.fill_column(i, 0.0);
                stiffness[(i, i)] = 1.0;
            }
        }
        let shares = self.shares(nodes_across);
        let loads =
            DMatrix::from_fn(
                3 * nodes_across,
                3,
                |i, j| if i % 3 == j && !(free && j == 2) { shares[i / 3] } else { 0.0 },
            );
        let moved = stiffness.cholesky()?.solve(&loads);
        Some((loads.transpose() * moved).fixed_view::<3, 3>(0, 0).into_owned())
    }

    /// Compliance matrix of harmonic `n` [1/Pa] for waves that are short compared with the body and its face. It is the
    /// compliance of a half-space under loads p cos kx with k = n/sin φ.
    pub fn half_space(&self, n: usize) -> Matrix3<f64> {
        let Elasticity { young, poisson } = self.elasticity;
        let normal = 2.0 / (self.elasticity.plane_modulus() * n as f64);
        let coupling = -normal * (1.0 - 2.0 * poisson) / (2.0 * (1.0 - poisson));
        let along = 2.0 * (1.0 + poisson) / (young * n as f64);
        Matrix3::new(along, 0.0, 0.0, 0.0, normal, coupling, 0.0, coupling, normal)
    }

    /// Fractions of a load proportional to R² that act on the `nodes_across` nodes across the face.
    fn shares(&self, nodes_across: usize) -> [f64; 3] {
        let mut shares = [0.0; 3];
        self.along_face(nodes_across, |_, weight, values, _| {
            shares.iter_mut().zip(values).for_each(|(share, value)| *share += weight * value);
        });
        shares
    }

    /// Calls `visit` at the Gauss points across the face with R [m], the weight R²dR/∫R²dR, and values and R times the
    /// slopes of the nodes' shape functions.
    fn along_face(&self, nodes_across: usize, mut visit: impl FnMut(f64, f64, [f64; 3], [f64; 3])) {
        let [inner, outer] = self.face;
        let (middle, half) = (0.5 * (inner + outer), 0.5 * (outer - inner));
        let moment = (outer.powi(3) - inner.powi(3)) / 3.0;
        for (x, weight) in GAUSS {
            let r = middle + half * x;
            let (values, slopes) = if nodes_across == 1 { ([1.0, 0.0, 0.0], [0.0; 3]) } else { quadratic(x) };
            visit(r, weight * half * r * r / moment, values, slopes.map(|slope| slope * r / half));
        }
    }

    /// Stiffness matrix of the nodes at the upper end of an element, after elimination of its other nodes. `range`
    /// contains the ends of the element as fractions of the thickness, from the held surface (0) to the root cone (1).
    /// The stiffness `below` acts on its lower end. Without `below`, the lower end is held, but not along ζ if
    /// `is_free_to_turn`. Returns `None` if the stiffness matrix is not positive definite.
    fn eliminated(
        &self,
        n: usize,
        range: [f64; 2],
        (nodes_across, is_free_to_turn): (usize, bool),
        below: Option<DMatrix<f64>>,
    ) -> Option<DMatrix<f64>> {
        let row = 3 * nodes_across;
        let mut k = self.element(n, range, nodes_across);
        let held = below.is_none();
        if let Some(below) = below {
            let mut corner = k.view_mut((2 * row, 2 * row), (row, row));
            corner += below;
        }
        let rest: Vec<usize> =
            (row..3 * row).filter(|i| !held || *i < 2 * row || is_free_to_turn && i % 3 == 2).collect();
        let top = k.view((0, 0), (row, row)).into_owned();
        let side = k.columns(0, row).select_rows(&rest);
        let inner = k.select_rows(&rest).select_columns(&rest);
        Some(top - side.transpose() * inner.cholesky()?.solve(&side))
    }

    /// Stiffness matrix of the element of harmonic `n` that covers the fractions `range` of the thickness. Rows of
    /// nodes are ordered from the upper end down.
    fn element(&self, n: usize, range: [f64; 2], nodes_across: usize) -> DMatrix<f64> {
        let Elasticity { young, poisson } = self.elasticity;
        let shear = 0.5 * young / (1.0 + poisson);
        let lame = 2.0 * shear * poisson / (1.0 - 2.0 * poisson);
        let nodes = 3 * nodes_across;
        let mut k = DMatrix::zeros(3 * nodes, 3 * nodes);
        let (middle, half) = (0.5 * (range[0] + range[1]), 0.5 * (range[1] - range[0]));
        let decayed_angle = self.surface - DECAYED * sin(self.surface) / (n as f64).max(1e-9);
        self.along_face(nodes_across, |r, weight_r, values_r, slopes_r| {
            let [mut bottom, mut bottom_slope] = self.held.at(r);
            if bottom < decayed_angle {
                (bottom, bottom_slope) = (decayed_angle, 0.0);
            }
            let depth = self.surface - bottom;
            for (x, weight) in GAUSS {
                let part = middle + half * x;
                let polar = bottom + part * depth;
                let (s, c) = (sin(polar), cos(polar) / sin(polar));
                let (values, slopes) = quadratic(x);
                let mut strains = [[0.0; 6]; 27];
                for row in 0..3 {
                    for column in 0..nodes_across {
                        // rows from the upper end down
                        let slope = slopes[2 - row] / (half * depth) * values_r[column];
                        let value = values[2 - row] * values_r[column];
                        // along R at the same φ, not at the same fraction of the depth
                        let along = values[2 - row] * slopes_r[column] - (1.0 - part) * bottom_slope * slope;
                        let node = 3 * (row * nodes_across + column);
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

/// Values and slopes at `x` of the three quadratic shape functions with nodes at −1, 0 and 1.
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

/// Adds `weight` times the stiffness of a point with Lamé's constants `lame` and `shear`, on and below the diagonal.
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
#[path = "tests/cone.rs"]
mod tests;
