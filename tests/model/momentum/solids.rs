//! Mass properties of a closed surface as a sum of tetrahedra from the apex, in closed form.
//!
//! Over the tetrahedron of the origin and a, b, c, with d = a·(b × c) and s = a + b + c:
//!
//!   ∫ dV = d/6,   ∫ x dV = d s/24,   ∫ x xᵀ dV = d (a aᵀ + b bᵀ + c cᵀ + s sᵀ)/120.

use bevel_differential::geometry::solid::GearSolid;
use bevel_differential::geometry::{GearSpec, Pair};
use nalgebra::{Matrix3, Vector3};

/// Number of facets per flank of the solids in the simulation.
const FACETS: usize = 96;

/// Mass properties about the apex, with z along the gear's axis from the apex to the heel.
#[derive(Clone, Copy, Debug)]
pub struct Solid {
    /// Mass [kg].
    pub mass: f64,
    /// Mass times the distance of its centre from the apex [kg·m].
    pub moment: f64,
    /// Moment of inertia about the axis [kg·m²].
    pub axial: f64,
    /// Moment of inertia about an axis through the apex, across the gear's axis [kg·m²].
    pub transverse: f64,
}

impl Solid {
    /// Solid of gear `gear` (0 planet, 1 side gear) of `spec` with the density `density` [kg/m³].
    pub fn new(spec: &GearSpec, gear: usize, density: f64) -> Self {
        let surface = GearSolid::new(&Pair::new(spec), spec, gear, FACETS, 1);
        let (mut volume, mut first, mut second) = (0.0, Vector3::zeros(), Matrix3::zeros());
        for triangle in &surface.triangles {
            let [a, b, c] = triangle.map(|i| surface.vertices[i as usize]);
            let (double, sum) = (a.dot(&b.cross(&c)), a + b + c);
            volume += double / 6.0;
            first += sum * (double / 24.0);
            second +=
                (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose()) * (double / 120.0);
        }
        let [xx, yy, zz] = [0, 1, 2].map(|i| density * second[(i, i)]);
        Self { mass: density * volume, moment: density * first.z, axial: xx + yy, transverse: zz + 0.5 * (xx + yy) }
    }
}
