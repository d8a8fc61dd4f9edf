//! Gap that small rigid displacements of the gears open, to first order.
//!
//! A displacement w(x) = δ + φ × x of the planet moves its flank along the normal T by T·w, of the side gear likewise
//! with the opposite sense: e = −T·w_p + T·w_s at x = R C(s) (T, C and the directions as in `normals`). That gives
//!
//!   planet outward along its axis by ε_p        e = ε_p (sinα sinδ_p cos s + cosδ_p sin s)
//!   side gear outward along its axis by ε_s     e = ε_s (sinα sinδ_s cos s − cosδ_s sin s)
//!   planet along t by ε_t (hypoid offset)       e = ∓ε_t cosα cos s  (− drive, + coast)
//!   planet turned about the apex, Σ → Σ + δΣ    e = R sinα δΣ
//!
//! the factors of ε_p and ε_s being the axial forces per normal force, as they must by virtual work. The last one comes
//! from w = δΣ [(x·Q₀) P₀ − (x·P₀) Q₀], T·w = −R δΣ sinα (sin²s + cos²s): the same all along the path. A rotation about
//! the apex grows with R like the approach itself and leaves the load's distribution along the face unchanged;
//! offsets shift it. Contact itself moves on the flanks, but that is of second order in the displacement.

use super::{ContactNormals, MeshId, Normal, ToothErrorSpec};
use crate::numeric::{Jet, TAU, cos, sin};

/// Displacements of all meshes.
#[derive(Clone, Debug)]
pub struct Misalignment {
    /// Each planet's displacement along its axis, outward, and along its t [m].
    planet: Box<[[f64; 2]]>,
    /// Each side gear's displacement along its axis, outward [m].
    side_axial: f64,
    /// sinα δΣ of the left meshes; the right ones have its negative.
    tilt: f64,
}

impl Misalignment {
    /// Displacements after `spec` of `planets` equally spaced planets, if there are any.
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

    /// Gap [m] of `mesh`, its indices in range, that displacements open where the normal is `n`: the same at every R.
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

    /// Most excess material that displacements bring at cone distances up to `outer` [m].
    pub fn most_excess(&self, outer: f64) -> f64 {
        // no part of a normal is longer than 1
        let moved = self.planet.iter().map(|[axial, across]| axial.abs() + across.abs()).fold(0.0, f64::max);
        moved + self.side_axial.abs() + outer * self.tilt.abs()
    }

    /// Whether planets stand differently in their meshes.
    pub fn is_individual(&self) -> bool {
        self.planet.iter().any(|p| *p != self.planet[0])
    }

    /// Whether the gap is proportional to R.
    pub fn is_rotation(&self) -> bool {
        self.side_axial == 0.0 && self.planet.iter().all(|p| *p == [0.0; 2])
    }
}
