//! Gap opened by small rigid displacements of the gears, to first order.
//!
//! A displacement w(x) = δ + φ × x of the planet moves its flank along the normal T by T·w. For the side gear, the sign
//! is opposite: e = −T·w_p + T·w_s at x = R C(s) (T, C and the directions as in `normals`). The result is
//!
//! planet outward along its axis by ε_p e = ε_p (sinα sinδ_p cos s + cosδ_p sin s)
//! side gear outward along its axis by ε_s e = ε_s (sinα sinδ_s cos s − cosδ_s sin s)
//! planet along t by ε_t (hypoid offset) e = ∓ε_t cosα cos s (− drive, + coast)
//! planet turned about the apex, Σ → Σ + δΣ e = R sinα δΣ
//!
//! The factors of ε_p and ε_s are the axial forces per normal force, as virtual work requires. The last gap follows
//! from w = δΣ [(x·Q₀) P₀ − (x·P₀) Q₀], T·w = −R δΣ sinα (sin²s + cos²s). It is the same along the whole path. A
//! rotation about the apex grows with R like the approach itself and leaves the load distribution along the face
//! unchanged; offsets shift it. The point of contact also moves on the flanks, but this effect is of second order in
//! the displacement.

use super::{ContactNormals, MeshId, Normal, ToothErrorSpec};
use crate::numeric::{Jet, TAU, cos, sin};

/// Displacements of all meshes.
#[derive(Clone, Debug)]
pub struct Misalignment {
    /// Displacement of each planet along its axis, outward, and along its t [m].
    planet: Box<[[f64; 2]]>,
    /// Displacement of each side gear along its axis, outward [m].
    side_axial: f64,
    /// sinα δΣ of the left meshes; the right meshes have the opposite sign.
    tilt: f64,
}

impl Misalignment {
    /// Returns the displacements defined by `spec` for `planets` equally spaced planets, or `None` if all are zero.
    pub fn new(spec: &ToothErrorSpec, normals: &ContactNormals, planets: usize) -> Option<Self> {
        let values = [spec.shaft_angle_error, spec.planet_axial_offset, spec.side_axial_offset, spec.axis_offset];
        (values != [0.0; 4]).then(|| {
            let of_planet = |i: usize| {
                let azimuth = TAU * i as f64 / planets as f64;
                // the pins move along t of planet 0, which is sinφ r̂ + cosφ t of the planet at φ
                [spec.planet_axial_offset + spec.axis_offset * sin(azimuth), spec.axis_offset * cos(azimuth)]
            };
            Self {
                planet: (0..planets).map(of_planet).collect(),
                side_axial: spec.side_axial_offset,
                tilt: normals.sin_pressure * spec.shaft_angle_error,
            }
        })
    }

    /// Gap [m] of `mesh` opened by displacements at the normal `n`, the same at every R. The indices must be in range.
    #[inline]
    pub fn offset(&self, mesh: MeshId, n: &Normal) -> Jet {
        let [axial, across] = self.planet[mesh.planet];
        n.axial[1] * self.side_axial - n.axial[0] * axial - n.across * across
    }

    /// Turn of the planet about the apex [rad], which opens a gap that grows with R.
    #[inline]
    pub fn turn(&self, mesh: MeshId) -> f64 {
        if mesh.side == 0 { self.tilt } else { -self.tilt }
    }

    /// Upper bound of the excess material caused by displacements at cone distances up to `outer` [m].
    pub fn max_excess(&self, outer: f64) -> f64 {
        // no component of a normal is longer than 1
        let moved = self.planet.iter().map(|[axial, across]| axial.abs() + across.abs()).fold(0.0, f64::max);
        moved + self.side_axial.abs() + outer * self.tilt.abs()
    }

    /// True if planets are positioned differently in their meshes.
    pub fn is_individual(&self) -> bool {
        self.planet.iter().any(|p| *p != self.planet[0])
    }

    /// True if the gap is proportional to R.
    pub fn is_rotation(&self) -> bool {
        self.side_axial == 0.0 && self.planet.iter().all(|p| *p == [0.0; 2])
    }
}
