//! Cones, tip and root angles and the line of action of a pair, for any shaft angle.
//!
//! δ_p = atan2(sinΣ, z_s/z_p + cosΣ), δ_s = Σ − δ_p, R_e = m z_p / (2 sinδ_p), sinδ_b = sinδ cosα (ISO 23509:2016).
//! On the unit sphere, the line of action is the great circle tangent to both base circles. The position s on it is
//! measured from the pitch point, positive toward the planet's tip. Both gears turn by s = sinδ_b·θ.

use serde::Serialize;

use super::addendum::tooth_heights;
use super::{Gear, GearSpec};
use crate::numeric::{FRAC_PI_2, PI, TAU, asin, atan2, cos, sin, tan};

/// Geometry of a planet (index 0) meshing with a side gear (index 1).
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Pair {
    /// The gears on the unit sphere: planet, side gear.
    pub gears: [Gear; 2],
    /// Shaft angle Σ [rad].
    pub shaft_angle: f64,
    /// Pressure angle α [rad].
    pub pressure_angle: f64,
    /// Outer module m [m].
    pub module: f64,
    /// Outer cone distance R_e [m].
    pub outer_cone: f64,
    /// Mean cone distance R_m [m].
    pub mean_cone: f64,
    /// Inner cone distance R_i [m].
    pub inner_cone: f64,
    /// Base pitch p_b as an arc on the unit sphere [rad], equal on both gears.
    pub base_pitch: f64,
    /// Normal backlash b_n as an arc on the unit sphere [rad].
    pub normal_backlash: f64,
    /// Coefficient of the addendum split x = (h_ap − h_as)/2m.
    pub profile_shift: f64,
    /// Arcs ψ from each gear's tangent point to the pitch point [rad].
    pub pitch_arc: [f64; 2],
    /// Arcs ψ from each gear's tangent point to its own tip cone [rad].
    pub tip_arc: [f64; 2],
    /// The path of contact.
    pub path: Path,
}

/// Path of contact, with ends as arcs from the pitch point, positive toward the planet's tip.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Path {
    /// End at the side gear's tip [rad], clipped at the planet's base circle.
    pub low: f64,
    /// End at the planet's tip [rad], clipped at the side gear's base circle.
    pub high: f64,
    /// True for each clipped end: the end at the planet's base circle, the end at the side gear's base circle.
    pub clipped: [bool; 2],
    /// Contact ratio without clipping.
    pub unclipped_ratio: f64,
    /// Contact ratio ε = length / p_b.
    pub contact_ratio: f64,
}

impl Pair {
    /// Computes the geometry of the pair `spec`. Its values must be within the ranges of the interface, and both pitch
    /// angles must be below 90° (no crown or internal gears).
    pub fn new(spec: &GearSpec) -> Self {
        let (z_p, z_s) = (f64::from(spec.planet_teeth), f64::from(spec.side_teeth));
        let (m, alpha, sigma) = (spec.module, spec.pressure_angle, spec.shaft_angle);
        let pitch_p = atan2(sin(sigma), z_s / z_p + cos(sigma));
        let pitch = [pitch_p, sigma - pitch_p];
        let outer_cone = m * z_p / (2.0 * sin(pitch_p));
        let ratio = z_s * cos(pitch[0]) / (z_p * cos(pitch[1]));
        let heights = tooth_heights(spec, if z_p <= z_s { ratio } else { 1.0 / ratio });
        let x = (heights.addendum[0] - heights.addendum[1]) / (2.0 * m);
        let gear = |i: usize, teeth: i32, shift: f64| {
            let z = f64::from(teeth);
            Gear {
                teeth,
                pitch: pitch[i],
                base: asin(sin(pitch[i]) * cos(alpha)),
                tip: pitch[i] + atan2(heights.addendum[i], outer_cone),
                root: pitch[i] - atan2(heights.dedendum[i], outer_cone),
                // planar thickness at the outer pitch circle with the split x and the shift k, thinned by j_t/2
                half_pitch: (FRAC_PI_2 + 2.0 * shift * tan(alpha) + spec.thickening(i)) / z
                    - spec.backlash / (2.0 * m * z),
                addendum: heights.addendum[i],
                dedendum: heights.dedendum[i],
            }
        };
        let gears = [gear(0, spec.planet_teeth, x), gear(1, spec.side_teeth, -x)];
        let pitch_arc = gears.map(|g| g.action_arc(g.pitch));
        let tip_arc = gears.map(|g| g.action_arc(g.tip));
        let base_pitch = TAU * sin(gears[0].base) / z_p;
        Self {
            gears,
            shaft_angle: sigma,
            pressure_angle: alpha,
            module: m,
            outer_cone,
            mean_cone: outer_cone - spec.face_width / 2.0,
            inner_cone: outer_cone - spec.face_width,
            base_pitch,
            normal_backlash: spec.backlash * cos(alpha) / outer_cone,
            profile_shift: x,
            pitch_arc,
            tip_arc,
            path: path(pitch_arc, tip_arc, base_pitch),
        }
    }

    /// Arc between both tangent points, which is the usable line of action [rad].
    pub fn line_of_action(&self) -> f64 {
        self.pitch_arc[0] + self.pitch_arc[1]
    }

    /// Working depth as an arc on the unit sphere [rad].
    pub fn working_depth(&self) -> f64 {
        (self.gears[0].addendum + self.gears[1].addendum) / self.outer_cone
    }

    /// Outer pitch diameter of gear `i` [m].
    pub fn outer_pitch_diameter(&self, i: usize) -> f64 {
        self.module * f64::from(self.gears[i].teeth)
    }

    /// Tip angle of gear `i` [rad] at which its tip reaches the tangent point on its mate's base circle. Larger angles
    /// cause interference.
    pub fn limit_tip_angle(&self, i: usize) -> f64 {
        self.gears[i].polar_at(self.line_of_action())
    }

    /// Largest addendum of gear `i` without interference [m] at the outer cone distance.
    pub fn limit_addendum(&self, i: usize) -> f64 {
        self.outer_cone * tan(self.limit_tip_angle(i) - self.gears[i].pitch)
    }

    /// Angle through which a side gear turns freely while the other side gear and the carrier are held [rad]. It is the
    /// backlash of both meshes of a planet in series.
    pub fn wheel_lash(&self) -> f64 {
        2.0 * self.normal_backlash / sin(self.gears[1].base)
    }

    /// sinδ_b of planet and side gear: moment arms of the normal force per unit of cone distance.
    pub fn sin_base(&self) -> [f64; 2] {
        self.gears.map(|g| sin(g.base))
    }

    /// Position on the path at which a planet tooth centred on the common plane touches: γ_p,pitch sinδ_bp [rad].
    pub fn centred_position(&self) -> f64 {
        self.gears[0].half_pitch * sin(self.gears[0].base)
    }
}

fn path(pitch_arc: [f64; 2], tip_arc: [f64; 2], base_pitch: f64) -> Path {
    let (low, high) = (pitch_arc[1] - tip_arc[1], tip_arc[0] - pitch_arc[0]);
    let clipped = [low < -pitch_arc[0], high > pitch_arc[1]];
    let (l, h) = (low.max(-pitch_arc[0]), high.min(pitch_arc[1]));
    Path { low: l, high: h, clipped, unclipped_ratio: (high - low) / base_pitch, contact_ratio: (h - l) / base_pitch }
}

/// Planar approximation on the back cones (Tredgold), as used by the study.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tredgold {
    /// Numbers of teeth of the virtual gears z_v = z / cosδ.
    pub teeth: [f64; 2],
    /// Reference diameters of the virtual gears [m].
    pub diameter: [f64; 2],
    /// Base diameters of the virtual gears [m].
    pub base_diameter: [f64; 2],
    /// Tip diameters of the virtual gears [m].
    pub tip_diameter: [f64; 2],
    /// Contact ratio of the virtual gears, unclipped.
    pub contact_ratio: f64,
}

impl Tredgold {
    /// Returns the virtual spur gears of the pair at the outer cone distance.
    pub fn new(pair: &Pair) -> Self {
        let g = &pair.gears;
        let teeth = g.map(|g| f64::from(g.teeth) / cos(g.pitch));
        let diameter = teeth.map(|z| z * pair.module);
        let base_diameter = diameter.map(|d| d * cos(pair.pressure_angle));
        let tip_diameter = [diameter[0] + 2.0 * g[0].addendum, diameter[1] + 2.0 * g[1].addendum];
        let leg = |i: usize| crate::numeric::sqrt((tip_diameter[i] / 2.0).powi(2) - (base_diameter[i] / 2.0).powi(2));
        let length = leg(0) + leg(1) - (diameter[0] + diameter[1]) / 2.0 * sin(pair.pressure_angle);
        let base_pitch = PI * pair.module * cos(pair.pressure_angle);
        Self { teeth, diameter, base_diameter, tip_diameter, contact_ratio: length / base_pitch }
    }
}
