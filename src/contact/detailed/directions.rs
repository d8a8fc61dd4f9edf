//! Directions of the normal of a tooth pair, and the arms of its flanks' sliding.

use crate::contact::{Engagement, Spot};
use crate::geometry::Pair;
use crate::numeric::{cos, sin, sin_cos, sqrt};

/// Constants of the line of action, from which the directions of the normal are computed.
#[derive(Clone, Copy, Debug)]
pub struct Directions {
    /// sin and cos of the arcs ψ from the tangent points of planet and side gear to the pitch point.
    pitch_arc: [[f64; 2]; 2],
    /// sinδ_b.
    sin_base: [f64; 2],
    /// cosδ_b.
    cos_base: [f64; 2],
}

/// Direction of a unit normal: components along the axes of planet and side gear, away from the apex, and along the
/// rotation.
#[derive(Clone, Copy, Debug)]
pub struct NormalComponents {
    /// Components.
    pub components: [f64; 3],
    /// Their slopes with respect to the position on the path, or to the arc Δ past its end.
    pub slopes: [f64; 3],
}

/// sin and cos of the arcs ψ from both tangent points to the point of contact.
#[derive(Clone, Copy, Debug)]
pub struct Arcs([[f64; 2]; 2]);

impl Arcs {
    /// Placeholder for callers that need no arcs.
    pub const NONE: Self = Self([[0.0; 2]; 2]);
}

/// Geometry of sliding: arms cotδ_b sinψ of both gears, and ρ = 1/(cotψ_p + cotψ_s), with their slopes with respect to
/// s.
#[derive(Clone, Copy, Debug)]
pub struct SlidingGeometry {
    /// Arms.
    pub arm: [f64; 2],
    /// Slopes of the arms.
    pub arm_slope: [f64; 2],
    /// Relative radius of curvature over the cone distance.
    pub radius: f64,
    /// Slope of the relative radius.
    pub radius_slope: f64,
}

/// Smallest tanψ in the curvature of a flank. At its base circle the radius would vanish.
const MIN_TANGENT: f64 = 1e-6;

/// √x and half its reciprocal, or zeros if x is not safely positive.
fn root(x: f64) -> [f64; 2] {
    if x > 1e-30 {
        let root = sqrt(x);
        [root, 0.5 / root]
    } else {
        [0.0; 2]
    }
}

impl Directions {
    /// Constants of `pair`.
    pub fn new(pair: &Pair) -> Self {
        let [sin_base, cos_base] = [pair.sin_base(), pair.gears.map(|g| cos(g.base))];
        Self { pitch_arc: pair.pitch_arc.map(|psi| [sin(psi), cos(psi)]), sin_base, cos_base }
    }

    /// Arcs at position `s` [rad].
    #[inline(always)]
    pub fn arcs(&self, s: f64) -> Arcs {
        let (sin, cos) = sin_cos(s);
        let [[sp, cp], [ss, cs]] = self.pitch_arc;
        Arcs([[cos * sp + sin * cp, cos * cp - sin * sp], [cos * ss - sin * cs, cos * cs + sin * ss]])
    }

    /// Component ν of the normal along the side gear's axis, for the gear's axial displacement, with its slope with
    /// respect to s; ν″ = −ν.
    #[inline(always)]
    pub fn axial(&self, arcs: &Arcs) -> [f64; 2] {
        let [_, [sin, cos]] = arcs.0;
        [sin * self.cos_base[1], -cos * self.cos_base[1]]
    }

    /// Geometry of sliding.
    #[inline(always)]
    pub fn sliding_geometry(&self, arcs: &Arcs) -> SlidingGeometry {
        let mut geometry = SlidingGeometry { arm: [0.0; 2], arm_slope: [0.0; 2], radius: 0.0, radius_slope: 0.0 };
        let (mut cot, mut cot_slope) = (0.0, 0.0);
        for (i, way) in [1.0, -1.0].into_iter().enumerate() {
            let [sin, cos] = arcs.0[i];
            let ratio = self.cos_base[i] / self.sin_base[i];
            (geometry.arm[i], geometry.arm_slope[i]) = (sin * ratio, way * cos * ratio);
            if sin > MIN_TANGENT * cos {
                cot += cos / sin;
                cot_slope -= way / (sin * sin);
            } else {
                cot += 1.0 / MIN_TANGENT;
            }
        }
        geometry.radius = 1.0 / cot;
        geometry.radius_slope = -geometry.radius * geometry.radius * cot_slope;
        geometry
    }

    /// Direction of the normal of a pair at `spot`. At a corner, `delta` is the arc past the end of the path.
    #[inline(always)]
    pub fn normal(&self, engagement: &Engagement, spot: Spot, arcs: &Arcs, delta: f64) -> NormalComponents {
        let (components, slopes) = match spot {
            Spot::Path => {
                let [[sp, cp], [ss, cs]] = arcs.0;
                let [bp, bs] = self.cos_base;
                ([sp * bp, ss * bs], [cp * bp, -cs * bs])
            }
            Spot::PlanetTip => self.at_corner(engagement, 0, delta),
            Spot::SideTip => self.at_corner(engagement, 1, delta),
        };
        // the axes of a differential are perpendicular; the remaining component is along the rotation
        let [forward, half] = root(1.0 - components[0] * components[0] - components[1] * components[1]);
        let forward_slope = -2.0 * half * (components[0] * slopes[0] + components[1] * slopes[1]);
        NormalComponents {
            components: [components[0], components[1], forward],
            slopes: [slopes[0], slopes[1], forward_slope],
        }
    }

    /// Components of the normal along both axes at the tip corner of gear `i`, with their slopes with respect to Δ.
    ///
    /// At the polar angle φ, a force with the lever arm ℓ about an axis has the component √(sin²φ − ℓ²) along this
    /// axis.
    fn at_corner(&self, engagement: &Engagement, i: usize, delta: f64) -> ([f64; 2], [f64; 2]) {
        let corner = &engagement.corner[i];
        let g = corner.at(delta);
        let (own, [mate, mate_slope]) = corner.sines_squared(delta);
        let lever = (1.0 - g.d) * self.sin_base[i];
        let lever_slope = -g.dd * self.sin_base[i];
        let other = self.sin_base[1 - i];
        let [own, half] = root(own - lever * lever);
        let own_slope = -2.0 * half * lever * lever_slope;
        let [mate, half] = root(mate - other * other);
        let (mut components, mut slopes) = ([own, mate], [own_slope, half * mate_slope]);
        if i == 1 {
            components.swap(0, 1);
            slopes.swap(0, 1);
        }
        (components, slopes)
    }
}
