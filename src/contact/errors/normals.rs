//! Contact normal and point of contact in the directions of a mesh. Displacements of the gears are projected onto them.
//!
//! Directions of a mesh: a_p, a_s along the axes of planet and side gear from apex to heel; u ⟂ a_p and v ⟂ a_s in the
//! plane of both axes, each toward the other axis; t = x̂ × r̂ across this plane, the direction in which a planet is
//! carried if the carrier turns forward. P₀ is along the pitch line, and Q₀ ⟂ P₀ is in the plane of the axes, toward
//! the planet's tip. With
//!
//!   T₀ = sinα Q₀ ± cosα t  (+ drive, − coast),   C(s) = cos s P₀ + sin s T₀,   T(s) = dC/ds = cos s T₀ − sin s P₀
//!
//! C is the point of contact on the unit sphere and T the normal at this point, pointing from the planet into the side
//! gear. Left and right mesh are mirror images, so the components below are valid for both.

use crate::contact::Flank;
use crate::geometry::Pair;
use crate::numeric::{Jet, cos, sin, sin_cos};

/// Sines and cosines of the pressure angle and of both pitch angles.
#[derive(Clone, Copy, Debug)]
pub struct ContactNormals {
    /// sinα.
    pub sin_pressure: f64,
    cos_pressure: f64,
    sin_pitch: [f64; 2],
    cos_pitch: [f64; 2],
}

/// Components of the contact normal T(s) with their slopes with respect to s.
#[derive(Clone, Copy, Debug)]
pub struct Normal {
    /// Along the axes of planet and side gear: T·a_p, T·a_s.
    pub axial: [Jet; 2],
    /// Away from the axes of planet and side gear, in their plane: T·u, T·v.
    pub radial: [Jet; 2],
    /// Across the plane of the axes: T·t.
    pub across: Jet,
}

/// +1 for the drive flank, −1 for the coast flank.
pub fn push(flank: Flank) -> f64 {
    match flank {
        Flank::Drive => 1.0,
        Flank::Coast => -1.0,
    }
}

impl ContactNormals {
    /// Normals of `pair`.
    pub fn new(pair: &Pair) -> Self {
        Self {
            sin_pressure: sin(pair.pressure_angle),
            cos_pressure: cos(pair.pressure_angle),
            sin_pitch: pair.gears.map(|g| sin(g.pitch)),
            cos_pitch: pair.gears.map(|g| cos(g.pitch)),
        }
    }

    /// Normal at `s` [rad] on `flank`.
    #[inline]
    pub fn normal(&self, flank: Flank, s: f64) -> Normal {
        let (sin, cos) = sin_cos(s);
        let (along_pitch, along) = (Jet { v: -sin, d: -cos, dd: sin }, Jet { v: cos, d: -sin, dd: -cos });
        let depthwise = along * self.sin_pressure;
        let [sp, ss] = self.sin_pitch;
        let [cp, cs] = self.cos_pitch;
        Normal {
            axial: [along_pitch * cp - depthwise * sp, along_pitch * cs + depthwise * ss],
            radial: [along_pitch * sp + depthwise * cp, along_pitch * ss - depthwise * cs],
            across: along * (push(flank) * self.cos_pressure),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::GearSpec;

    #[test]
    fn the_normal_has_unit_length_and_the_moment_arms_of_the_base_circles() {
        let pair = Pair::new(&GearSpec { shaft_angle: 1.3, ..GearSpec::default() });
        let normals = ContactNormals::new(&pair);
        for flank in [Flank::Drive, Flank::Coast] {
            for s in [-0.2, 0.0, 0.15] {
                let n = normals.normal(flank, s);
                // C is T at s minus a quarter turn
                let c = normals.normal(flank, s - std::f64::consts::FRAC_PI_2);
                for i in 0..2 {
                    let length = n.axial[i].v.powi(2) + n.radial[i].v.powi(2) + n.across.v.powi(2);
                    assert!((length - 1.0).abs() < 1e-14);
                    // (C × T)·a of each gear must be the lever arm sinδ_b
                    let lever = c.radial[i].v * n.across.v - c.across.v * n.radial[i].v;
                    assert!((lever - push(flank) * pair.sin_base()[i]).abs() < 1e-14, "{i} {lever}");
                }
            }
        }
    }
}
