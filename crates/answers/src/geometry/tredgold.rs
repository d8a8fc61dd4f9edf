//! Comparison of the planar approximation with the exact geometry: the errors of a drawing based on virtual spur gears.
//!
//! On the back cones, developed into the plane, the line of action is straight: with r_b = r cos α and legs
//! √(r_a² − r_b²), it has the length a sin α between both base circles. Lengths are at the heel.

use bevel_differential::geometry::Tredgold;
use bevel_differential::numeric::{PI, acos, cos, sin, sqrt, tan};

use super::design::Design;
use super::dimension::QuantityKind;
use super::tooth_rows::land;

/// A quantity with its exact and its approximate value.
#[derive(Clone, Debug, PartialEq)]
pub struct TredgoldComparison {
    /// Term in snake case.
    pub key: &'static str,
    /// Kind of the number.
    pub kind: QuantityKind,
    /// Exact value, on the sphere [SI].
    pub exact: f64,
    /// Value of Tredgold's virtual gears [SI].
    pub planar: f64,
}

impl TredgoldComparison {
    /// Relative error of the approximation; `None` if the exact value is zero.
    pub fn error(&self) -> Option<f64> {
        (self.exact.abs() > f64::EPSILON).then(|| self.planar / self.exact - 1.0)
    }
}

/// Line of action of the virtual gears.
struct Plane {
    /// Pitch radii [m].
    radius: [f64; 2],
    /// Base radii [m].
    base: [f64; 2],
    /// Distances from each tangent point to the gear's own tip [m].
    leg: [f64; 2],
    /// Distances from each tangent point to the pitch point [m].
    pitch: [f64; 2],
}

impl Plane {
    fn new(planar: &Tredgold, alpha: f64) -> Self {
        let (radius, base) = (planar.diameter.map(|d| d / 2.0), planar.base_diameter.map(|d| d / 2.0));
        let tip = planar.tip_diameter.map(|d| d / 2.0);
        let leg = [0, 1].map(|i| sqrt(tip[i] * tip[i] - base[i] * base[i]));
        Self { radius, base, leg, pitch: radius.map(|r| r * sin(alpha)) }
    }

    fn line(&self) -> f64 {
        self.pitch[0] + self.pitch[1]
    }

    /// Distance from the tangent point of gear `i` to the point where the mate's tip touches [m].
    fn start(&self, i: usize) -> f64 {
        self.line() - self.leg[1 - i]
    }

    /// Length of the path between the base circles [m].
    fn path(&self) -> f64 {
        self.leg[0].min(self.line()) + self.leg[1].min(self.line()) - self.line()
    }

    fn limit_addendum(&self, i: usize) -> f64 {
        sqrt(self.base[i] * self.base[i] + self.line() * self.line()) - self.radius[i]
    }

    fn land(&self, design: &Design, i: usize) -> f64 {
        let (alpha, tip) = (design.pair.pressure_angle, design.planar.tip_diameter[i] / 2.0);
        let at_tip = acos(self.base[i] / tip);
        let thickness = design.pair.gears[i].half_pitch * design.pair.outer_pitch_diameter(i);
        let involute = |angle: f64| tan(angle) - angle;
        2.0 * tip * (thickness / (2.0 * self.radius[i]) + involute(alpha) - involute(at_tip))
    }
}

/// Comparisons of all quantities for which the approximation is used.
pub fn comparisons(design: &Design) -> Vec<TredgoldComparison> {
    let (pair, alpha) = (&design.pair, design.pair.pressure_angle);
    let plane = Plane::new(&design.planar, alpha);
    let pitch = PI * pair.module * cos(alpha);
    let start = |i: usize| pair.outer_cone * tan(pair.line_of_action() - pair.tip_arc[1 - i]);
    let length = |key, exact, planar| TredgoldComparison { key, kind: QuantityKind::Length, exact, planar };
    let ratio = |key, exact, planar| TredgoldComparison { key, kind: QuantityKind::Ratio, exact, planar };
    vec![
        ratio("contact_ratio", pair.path.contact_ratio, plane.path() / pitch),
        ratio("contact_ratio_without_limits", pair.path.unclipped_ratio, design.planar.contact_ratio),
        length("outer_base_pitch", pair.base_pitch * pair.outer_cone, pitch),
        length("outer_path_length", (pair.path.high - pair.path.low) * pair.outer_cone, plane.path()),
        length("planet_limit_addendum", pair.limit_addendum(0), plane.limit_addendum(0)),
        length("side_gear_limit_addendum", pair.limit_addendum(1), plane.limit_addendum(1)),
        length("planet_tip_land_at_heel", land(design, 0), plane.land(design, 0)),
        length("side_gear_tip_land_at_heel", land(design, 1), plane.land(design, 1)),
        length("planet_curvature_radius_at_start_of_active_profile", start(0), plane.start(0)),
        length("side_gear_curvature_radius_at_start_of_active_profile", start(1), plane.start(1)),
    ]
}
