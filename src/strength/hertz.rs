//! Contact pressure of two cylinders (Hertz, 1881): p_H = √(w E*/(π ρ)), 1/ρ = 1/ρ_p + 1/ρ_s, E* = E/(2(1−ν²)).
//!
//! A spherical involute at arc ψ from its tangent point has the radius ρ = R tanψ at cone distance R. Contact at s on
//! the path has ψ_p = ψ_p0 + s and ψ_s = ψ_s0 − s. Therefore ρ = R τ(s) with τ = sinψ_p sinψ_s / sin(ψ_p + ψ_s).
//!
//! The `impact` law acts at R_m, with w = F/b. Under the line laws w = 2FR/(R_e² − R_i²) grows with R in the same way
//! as ρ, so the pressure is uniform over the face. Because R_e² − R_i² = 2 b R_m, it equals the pressure at R_m under
//! `impact`. One formula therefore serves both: p_H = √(F E* / (π b R_m τ(s))). F acts at the cone distance of the
//! law's resultant: R_m under `impact`, R_F > R_m under line laws. For the same moment, F is therefore smaller under
//! line laws.

use serde::{Deserialize, Serialize};

use crate::geometry::Pair;
use crate::numeric::{PI, sin, sqrt};

/// Smallest radius of curvature for the formula, relative to that at the pitch point. Toward a base circle the radius
/// tends to zero, and the flank is not a cylinder over the contact width.
const MIN_RADIUS: f64 = 1e-3;

/// Line contact of a planet with a side gear.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LineContact {
    /// Modulus of the contact E* [Pa].
    pub modulus: f64,
    /// Mean cone distance R_m [m].
    pub mean_cone: f64,
    /// Inner and outer cone distance R_i, R_e [m].
    pub cone_range: [f64; 2],
    /// Arcs ψ from the tangent points of planet and side gear to the pitch point [rad].
    pub pitch_arc: [f64; 2],
    /// Ends of the path of contact [rad].
    pub path: [f64; 2],
    /// Ends of the part of the path on which a single pair transmits the load [rad]: the inner points of single contact
    /// of planet and side gear.
    pub single: [f64; 2],
    /// The smaller of the relative radii of curvature at these ends, per unit of cone distance; `None` at a base
    /// circle.
    pub rated_radius: Option<f64>,
}

impl LineContact {
    /// Returns the contact of `pair`, with the same Young's modulus [Pa] and Poisson's ratio for both gears.
    pub fn new(pair: &Pair, young_modulus: f64, poisson_ratio: f64) -> Self {
        let mut contact = Self {
            modulus: young_modulus / (2.0 * (1.0 - poisson_ratio * poisson_ratio)),
            mean_cone: pair.mean_cone,
            cone_range: [pair.inner_cone, pair.outer_cone],
            pitch_arc: pair.pitch_arc,
            path: [pair.path.low, pair.path.high],
            single: [pair.path.high - pair.base_pitch, pair.path.low + pair.base_pitch],
            rated_radius: None,
        };
        let [planet, side] = contact.single.map(|s| contact.relative_radius(s));
        contact.rated_radius = planet.zip(side).map(|(a, b)| a.min(b));
        contact
    }

    /// Relative radius of curvature per unit of cone distance τ at position `s` on the path [rad].
    ///
    /// Corner contact beyond an end of the path uses the flanks' radii at that end. Returns `None` if the radius
    /// vanishes, at a base circle.
    pub fn relative_radius(&self, s: f64) -> Option<f64> {
        if s.is_nan() {
            return None;
        }
        let s = s.max(self.path[0]).min(self.path[1]);
        let line = sin(self.pitch_arc[0] + self.pitch_arc[1]);
        let at = |s: f64| sin(self.pitch_arc[0] + s) * sin(self.pitch_arc[1] - s) / line;
        let radius = at(s);
        // written so that NaN fails
        (radius > MIN_RADIUS * at(0.0)).then_some(radius)
    }

    /// Load per width of a line law w [N/m] at cone distance `cone` [m] under the pair's normal force [N].
    pub fn line_load(&self, force: f64, cone: f64) -> f64 {
        2.0 * force * cone / (self.cone_range[1] * self.cone_range[1] - self.cone_range[0] * self.cone_range[0])
    }

    /// Pressure [Pa] of a load per width [N/m] at cone distance `cone` [m] and position `s` [rad].
    ///
    /// The pressure is 0 without load. Returns `None` if a radius vanishes or a value is not finite.
    pub fn pressure_at(&self, line_load: f64, cone: f64, s: f64) -> Option<f64> {
        self.pressure_on(line_load, cone * self.relative_radius(s)?)
    }

    /// Pressure [Pa] of a load per width [N/m] on flanks of the relative radius of curvature `radius` > 0 [m].
    pub fn pressure_on(&self, line_load: f64, radius: f64) -> Option<f64> {
        if line_load.is_nan() || line_load <= 0.0 {
            return Some(0.0);
        }
        let pressure = sqrt(line_load * self.modulus / (PI * radius));
        pressure.is_finite().then_some(pressure)
    }

    /// Contact half-width b = 2w/(π p_H) [m] under a load per width w [N/m] with the pressure p_H [Pa].
    pub fn half_width(line_load: f64, pressure: f64) -> f64 {
        if pressure > 0.0 { 2.0 * line_load / (PI * pressure) } else { 0.0 }
    }

    /// Pressure [Pa] of one tooth pair under the normal force `force` [N] at position `s` [rad], for any law.
    pub fn pressure(&self, force: f64, s: f64) -> Option<f64> {
        self.pressure_at(self.line_load(force, self.mean_cone), self.mean_cone, s)
    }

    /// Position on the path of the point whose pressure is rated [rad]: the end of single contact with the smaller
    /// radius of curvature.
    pub fn rated_position(&self) -> f64 {
        let radius = |end: usize| self.relative_radius(self.single[end]).unwrap_or(0.0);
        self.single[usize::from(radius(1) < radius(0))]
    }

    /// Pressure [Pa] used in a rating: one pair transmits the whole normal force `force` [N] of the mesh at the worse
    /// inner point of single contact (ISO 10300-2:2001, Z_M-B of teeth without overlap).
    ///
    /// S–N curves for pitting refer to this pressure. Near the end of the path the pressure is higher, because the
    /// radius vanishes toward the base circle. At that end, however, the sliding flanks wear and relief reduces the
    /// load.
    pub fn rated_pressure(&self, force: f64) -> Option<f64> {
        self.pressure_on(self.line_load(force, self.mean_cone), self.mean_cone * self.rated_radius?)
    }
}
