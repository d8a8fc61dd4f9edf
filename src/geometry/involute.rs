//! Spherical involute of one gear: a great circle rolls on the base circle of the unit sphere.
//!
//! ψ is the arc from the tangent point on the base circle. The polar angle φ follows from cosφ = cosδ_b cosψ. inv(φ) =
//! ψ/sinδ_b − atan2(tanψ, sinδ_b) is the azimuth of the flank relative to its base point.

use nalgebra::Vector3;
use serde::Serialize;

use crate::numeric::{atan2, cos, sin, sqrt, tan};

/// One gear of the pair on the unit sphere, with the axis +z from apex to heel and a tooth centred on azimuth 0.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Gear {
    /// Number of teeth z.
    pub teeth: i32,
    /// Pitch angle δ [rad].
    pub pitch: f64,
    /// Base angle δ_b [rad].
    pub base: f64,
    /// Tip angle δ_a [rad].
    pub tip: f64,
    /// Root angle δ_f [rad].
    pub root: f64,
    /// Half tooth angle at the pitch circle γ_pitch [rad], including backlash.
    pub half_pitch: f64,
    /// Addendum at the outer cone distance h_ae [m].
    pub addendum: f64,
    /// Dedendum at the outer cone distance h_fe [m].
    pub dedendum: f64,
}

/// Arc ψ along the line of action from a base circle of angle `base` to polar angle `polar` [rad]; 0 at or below the
/// base circle.
pub fn action_arc(base: f64, polar: f64) -> f64 {
    // sin²ψ cos²δ_b = sin²φ − sin²δ_b = sin(φ−δ_b) sin(φ+δ_b): no cancellation near the base circle
    let s2 = sin(polar - base) * sin(polar + base);
    if s2 <= 0.0 { 0.0 } else { atan2(sqrt(s2), cos(polar)) }
}

impl Gear {
    /// Arc ψ of the flank point at polar angle `polar` [rad].
    pub fn action_arc(&self, polar: f64) -> f64 {
        action_arc(self.base, polar)
    }

    /// Polar angle of the flank point at arc `psi` [rad].
    pub fn polar_at(&self, psi: f64) -> f64 {
        let (sb, cb) = (sin(self.base), cos(self.base));
        // atan2 keeps full accuracy near both ends: sin²φ = sin²δ_b + cos²δ_b sin²ψ
        let s = cb * sin(psi);
        atan2(sqrt(sb * sb + s * s), cb * cos(psi))
    }

    /// Spherical involute function at arc `psi` [rad].
    pub fn inv_of_arc(&self, psi: f64) -> f64 {
        let sb = sin(self.base);
        psi / sb - atan2(tan(psi), sb)
    }

    /// Spherical involute function at polar angle `polar` [rad].
    pub fn inv(&self, polar: f64) -> f64 {
        self.inv_of_arc(self.action_arc(polar))
    }

    /// Half tooth angle γ at polar angle `polar` [rad]. Below the base circle, the flank is a meridian.
    pub fn half_angle(&self, polar: f64) -> f64 {
        self.half_pitch + self.inv(self.pitch) - self.inv(polar)
    }

    /// Point of the left (`+1`) or right (`−1`) flank at polar angle `polar` on the unit sphere.
    pub fn flank_point(&self, polar: f64, side: f64) -> Vector3<f64> {
        direction(polar, side * self.half_angle(polar))
    }

    /// Outward unit normal of the left (`+1`) or right (`−1`) flank at polar angle `polar`, tangent to the sphere.
    pub fn flank_normal(&self, polar: f64, side: f64) -> Vector3<f64> {
        // the moment arm of the normal about the axis is sinδ_b everywhere, so its azimuthal component is sinδ_b / sinφ
        let azimuth = side * self.half_angle(polar);
        let e_polar = Vector3::new(cos(polar) * cos(azimuth), cos(polar) * sin(azimuth), -sin(polar));
        let e_azimuth = Vector3::new(-sin(azimuth), cos(azimuth), 0.0);
        let along = sin(self.base) / sin(polar);
        let inward = sqrt((1.0 - along * along).max(0.0));
        e_azimuth * (side * along) + e_polar * inward
    }

    /// Angular pitch 2π/z [rad].
    pub fn tooth_pitch(&self) -> f64 {
        crate::numeric::TAU / f64::from(self.teeth)
    }
}

/// Unit vector at polar angle and azimuth.
pub fn direction(polar: f64, azimuth: f64) -> Vector3<f64> {
    Vector3::new(sin(polar) * cos(azimuth), sin(polar) * sin(azimuth), cos(polar))
}
