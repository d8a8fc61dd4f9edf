//! What a gear's surface encloses: volume, mass and moments of inertia, by parry3d.

use parry3d_f64::mass_properties::MassProperties;
use parry3d_f64::math::Vector;

use super::manifold::GearSolid;
use crate::geometry::mass::GearMass;

/// Millimetres per metre: parry3d's tolerances suit bodies of some units.
const MM: f64 = 1e3;

impl GearSolid {
    /// Enclosed volume [m³]: the sum of the tetrahedra that the triangles make with the apex.
    pub fn volume(&self) -> f64 {
        let corner = |i: u32| self.vertices[i as usize];
        self.triangles.iter().map(|&[a, b, c]| corner(a).dot(&corner(b).cross(&corner(c))) / 6.0).sum()
    }

    /// Mass properties about the gear's axis and apex at the density `density` [kg/m³].
    pub fn mass(&self, density: f64) -> GearMass {
        let vertices: Vec<Vector> = self.vertices.iter().map(|v| Vector::new(v.x * MM, v.y * MM, v.z * MM)).collect();
        let p = MassProperties::from_trimesh(density / (MM * MM * MM), &vertices, &self.triangles);
        let (com, inertia) = (p.local_com / MM, p.reconstruct_inertia_matrix() * (1.0 / (MM * MM)));
        // about the apex, by Steiner; the mean of x and y holds for the whole gear by symmetry
        let (xx, yy, zz) = (com.x * com.x, com.y * com.y, com.z * com.z);
        GearMass {
            mass: p.mass(),
            centre: com.z,
            axial: inertia.z_axis.z + p.mass() * (xx + yy),
            transverse_at_apex: 0.5 * (inertia.x_axis.x + inertia.y_axis.y + p.mass() * (xx + yy + 2.0 * zz)),
        }
    }
}
