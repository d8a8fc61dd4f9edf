//! Mass properties of a gear: mass and moments of inertia of its solid, computed with parry3d.
//!
//! The solid is the exported one (`manifold`). A gear consists of z sectors of one tooth. Its mass and axial moment of
//! inertia are z times those of the sector. Its transverse moment is z times the mean of the sector's moments about any
//! two perpendicular axes.

use parry3d_f64::mass_properties::MassProperties;
use parry3d_f64::math::Vector;

use super::GearSolid;
use crate::geometry::{GearSpec, Pair};

/// Length units per metre: millimetres for parry3d, whose tolerances are absolute. Gears smaller than about a
/// centimetre need a smaller unit, see [`MIN_MOMENT`].
const MM: f64 = 1e3;
/// Smallest estimated moment of inertia, in kilograms times the square of the length unit. A smaller unit is chosen if
/// the moment would be below it.
const MIN_MOMENT: f64 = 0.5;
/// Facets per flank. With this number, masses and moments of inertia are within 2e-5 of the limit of many facets.
const FACETS: usize = 96;

/// Mass properties about the gear's axis and apex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GearMass {
    /// Mass [kg].
    pub mass: f64,
    /// Distance of the centre of mass from the apex [m].
    pub centre: f64,
    /// Moment of inertia about the gear's axis [kg·m²].
    pub axial: f64,
    /// Moment of inertia about any axis through the apex perpendicular to the gear's axis [kg·m²].
    pub transverse_at_apex: f64,
}

/// Mass properties of gear `gear` (0 planet, 1 side gear) of `pair`, built from `spec`, at the density `density`
/// [kg/m³].
pub fn gear_mass(pair: &Pair, spec: &GearSpec, gear: usize, density: f64) -> GearMass {
    let sector = GearSolid::sector(pair, spec, gear, FACETS).mass(density);
    let z = f64::from(pair.gears[gear].teeth);
    GearMass {
        mass: z * sector.mass,
        centre: sector.centre,
        axial: z * sector.axial,
        transverse_at_apex: z * sector.transverse_at_apex,
    }
}

impl GearSolid {
    /// Mass properties about the gear's axis and apex at the density `density` [kg/m³]. A sector has its share of the
    /// gear's values.
    pub fn mass(&self, density: f64) -> GearMass {
        let reach = self.vertices.iter().map(|v| v.norm()).fold(0.0, f64::max);
        let moment = density * reach.powi(5);
        let mut unit = MM;
        while moment > 0.0 && moment * unit * unit < MIN_MOMENT {
            unit *= 10.0;
        }
        let vertices: Vec<Vector> =
            self.vertices.iter().map(|v| Vector::new(v.x * unit, v.y * unit, v.z * unit)).collect();
        let p = MassProperties::from_trimesh(density / (unit * unit * unit), &vertices, &self.triangles);
        let (com, inertia) = (p.local_com / unit, p.reconstruct_inertia_matrix() * (1.0 / (unit * unit)));
        // about the apex, by Steiner's theorem; by symmetry, the mean of x and y is valid for the whole gear
        let (xx, yy, zz) = (com.x * com.x, com.y * com.y, com.z * com.z);
        GearMass {
            mass: p.mass(),
            centre: com.z,
            axial: inertia.z_axis.z + p.mass() * (xx + yy),
            transverse_at_apex: 0.5 * (inertia.x_axis.x + inertia.y_axis.y + p.mass() * (xx + yy + 2.0 * zz)),
        }
    }
}
