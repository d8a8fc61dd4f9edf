//! Curves of the teeth as texts for a CAD program's "curve through XYZ points": a line per point, x y z in millimetres.
//!
//! Curves are in the gear's own frame: apex at the origin, z along the axis from apex to heel, the tooth centred on the
//! x-z plane. A straight bevel tooth is the loft from its curve at the heel (R_e) to its curve at the toe (R_i), along
//! straight lines through the apex. Both curves have points at the same polar angles.

use std::fmt::Write;

use bevel_differential::geometry::involute::{Gear, direction};
use bevel_differential::geometry::solid::Outline;
use bevel_differential::geometry::{GearSpec, Pair};

/// Default number of points of a flank's curve.
pub const POINTS: usize = 101;

/// Names of the gears of a pair in files.
pub const NAMES: [&str; 2] = ["planet", "side_gear"];

/// A curve in space.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Name of its file without extension, such as `planet_left_flank_heel`.
    pub name: String,
    /// Points [m].
    pub points: Vec<[f64; 3]>,
}

impl Curve {
    /// Text of the curve: three columns in millimetres, no header, twelve decimals.
    pub fn text(&self) -> String {
        let mut text = String::with_capacity(64 * self.points.len());
        for point in &self.points {
            // adding zero makes a negative zero positive
            let [x, y, z] = point.map(|v| (v * 1e3 * 1e12).round() / 1e12 + 0.0);
            let _ = writeln!(text, "{x:.12} {y:.12} {z:.12}");
        }
        text
    }
}

/// Returns all curves of both gears: the two flanks and the outline with its fillets, each at heel and toe. Flanks have
/// `points` ≥ 2 points, equally spaced in the arc by which the great circle rolls. They run from the base circle, or
/// the root if that is larger, to the tip.
pub fn curves(pair: &Pair, spec: &GearSpec, points: usize) -> Vec<Curve> {
    let fillet = spec.root_fillet * pair.module / pair.outer_cone;
    let mut curves = Vec::with_capacity(12);
    for (name, gear) in NAMES.iter().zip(&pair.gears) {
        for (end, cone) in [("heel", pair.outer_cone), ("toe", pair.inner_cone)] {
            for (side, sign) in [("left", 1.0), ("right", -1.0)] {
                let points = flank(gear, sign, points).map(|p| p.map(|v| v * cone)).collect();
                curves.push(Curve { name: format!("{name}_{side}_flank_{end}"), points });
            }
            let nodes = Outline::new(gear, fillet, points.saturating_sub(1).max(1)).nodes;
            let points = nodes.iter().map(|n| unit(n.polar, n.azimuth).map(|v| v * cone)).collect();
            curves.push(Curve { name: format!("{name}_outline_{end}"), points });
        }
    }
    curves
}

/// Points of a flank on the unit sphere. `sign` is +1 for the left flank, at positive azimuth, and −1 for the right
/// one.
fn flank(gear: &Gear, sign: f64, points: usize) -> impl Iterator<Item = [f64; 3]> + '_ {
    let start = gear.action_arc(gear.root.max(gear.base));
    let length = gear.action_arc(gear.tip) - start;
    let intervals = points.max(2) - 1;
    (0..=intervals).map(move |k| {
        let psi = start + length * (k as f64 / intervals as f64);
        unit(gear.polar_at(psi), sign * (gear.half_angle(gear.base) - gear.inv_of_arc(psi)))
    })
}

fn unit(polar: f64, azimuth: f64) -> [f64; 3] {
    direction(polar, azimuth).into()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Vec<[f64; 3]> {
        text.lines()
            .map(|line| {
                let values: Vec<f64> = line.split_whitespace().map(|v| v.parse().expect("a number")).collect();
                values.try_into().expect("three columns")
            })
            .collect()
    }

    #[test]
    fn points_in_files_are_on_the_rolled_great_circle_within_a_nanometre() {
        for (planet_teeth, side_teeth) in [(10, 16), (9, 14), (12, 40)] {
            let spec = GearSpec { planet_teeth, side_teeth, ..GearSpec::default() };
            let pair = Pair::new(&spec);
            let curves = curves(&pair, &spec, POINTS);
            assert_eq!(curves.len(), 12);
            let mut worst = 0.0f64;
            for curve in curves.iter().filter(|c| c.name.contains("flank")) {
                let gear = &pair.gears[usize::from(curve.name.starts_with("side_gear"))];
                let cone = 1e3 * if curve.name.ends_with("heel") { pair.outer_cone } else { pair.inner_cone };
                let sign = if curve.name.contains("left") { 1.0 } else { -1.0 };
                let points = read(&curve.text());
                assert_eq!(points.len(), POINTS);
                let base_azimuth = gear.half_angle(gear.base);
                for [x, y, z] in points {
                    assert!((x.hypot(y).hypot(z) - cone).abs() < 1e-9, "{}", curve.name);
                    // the unwound string: it starts at the tangent point on the base circle, at the rolled azimuth, and
                    // follows the tangent great circle by the rolled arc
                    let (sb, cb) = gear.base.sin_cos();
                    let psi = ((x * x + y * y) / (cone * cone) - sb * sb).max(0.0).sqrt().atan2(z / cone);
                    let rolled = sign * (base_azimuth - psi / sb);
                    let tangent_point = [sb * rolled.cos(), sb * rolled.sin(), cb];
                    let along = [-sign * rolled.sin(), sign * rolled.cos(), 0.0];
                    let exact = [0, 1, 2].map(|i| cone * (psi.cos() * tangent_point[i] + psi.sin() * along[i]));
                    let off = (exact[0] - x).hypot(exact[1] - y).hypot(exact[2] - z);
                    worst = worst.max(off);
                }
                let last = read(&curve.text())[POINTS - 1];
                assert!((last[2] - cone * gear.tip.cos()).abs() < 1e-9);
            }
            assert!(worst < 1e-6, "{worst:e} mm");
            eprintln!("worst deviation {worst:e} mm");
        }
    }

    #[test]
    fn outlines_run_from_gap_to_gap_through_the_flanks() {
        let spec = GearSpec::default();
        let pair = Pair::new(&spec);
        let curves = curves(&pair, &spec, 11);
        let names: Vec<&str> = curves.iter().map(|c| c.name.as_str()).collect();
        assert!(names.contains(&"planet_left_flank_heel") && names.contains(&"side_gear_outline_toe"), "{names:?}");
        for curve in curves.iter().filter(|c| c.name.contains("outline")) {
            let (first, last) = (curve.points[0], curve.points[curve.points.len() - 1]);
            assert!((first[0] - last[0]).abs() + (first[1] + last[1]).abs() + (first[2] - last[2]).abs() < 1e-15);
            assert!(!curve.text().contains("-0.000000000000"), "{}", curve.text());
        }
    }
}
