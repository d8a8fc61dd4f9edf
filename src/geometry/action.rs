//! Points and normals of contact as vectors: on the line of action, and at tip corners beyond its ends.
//!
//! Frame of a mesh: apex at the origin, z along the planet's axis from apex to heel, x in the plane of both axes toward
//! the side gear's axis a_s = (sinΣ, 0, cosΣ). With P₀ along the pitch line and Q₀ ⟂ P₀ in that plane toward the planet's
//! tip, on the unit sphere
//!
//!   T₀ = sinα Q₀ ± cosα ŷ,   C(s) = cos s P₀ + sin s T₀,   T(s) = dC/ds = cos s T₀ − sin s P₀
//!
//! are the place of contact and the common normal, pointing from the planet into the side gear: + for the flanks whose
//! contact moves up the path when the planet turns forward about z, − for their mirror images. A tip corner stands on
//! the tip circle of its own gear; the normal there is that of the flank it touches.

use nalgebra::Vector3;

use super::corner::CornerGap;
use super::pair::Pair;
use crate::numeric::{PI, TAU, atan2, cos, sin, sqrt};

/// Largest approach for which corners are tabulated [rad]: beyond that of any tooth that does not break.
const REACH: f64 = 0.1;

/// A place of contact on the unit sphere; multiply by the cone distance for a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Direction C of the point.
    pub point: Vector3<f64>,
    /// Unit normal, from the planet into the side gear, tangent to the sphere.
    pub normal: Vector3<f64>,
    /// Direction along both flanks, toward the planet's root and the side gear's tip.
    pub along: Vector3<f64>,
}

/// Kind of a contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spot {
    /// On the path of contact.
    Path,
    /// The planet's tip corner on the side gear's flank.
    PlanetTip,
    /// The side gear's tip corner on the planet's flank.
    SideTip,
}

/// Contacts of a pair.
#[derive(Clone, Debug)]
pub struct LineOfAction {
    pair: Pair,
    corner: [CornerGap; 2],
}

impl LineOfAction {
    /// Line of action and corners of `pair`.
    pub fn new(pair: &Pair) -> Self {
        Self { pair: *pair, corner: [0, 1].map(|i| CornerGap::new(pair, i, REACH)) }
    }

    /// Axis of gear `i` from apex to heel, and the direction ⟂ to it toward the other gear's axis.
    fn axes(&self, i: usize) -> [Vector3<f64>; 2] {
        let (ss, cs) = (sin(self.pair.shaft_angle), cos(self.pair.shaft_angle));
        if i == 0 { [Vector3::z(), Vector3::x()] } else { [Vector3::new(ss, 0.0, cs), Vector3::new(-cs, 0.0, ss)] }
    }

    /// Contact in the frame of the mesh, at the arc `place` [rad]: s on the path, or Δ of a corner past the path's end;
    /// `turn` = ±1 selects the mirror image.
    pub fn contact(&self, spot: Spot, place: f64, turn: f64) -> Contact {
        let (point, normal) = match spot {
            Spot::Path => self.on_path(place, turn),
            Spot::PlanetTip => self.at_corner(0, place, turn),
            Spot::SideTip => self.at_corner(1, place, turn),
        };
        Contact { point, normal, along: point.cross(&normal) * turn }
    }

    fn on_path(&self, s: f64, turn: f64) -> (Vector3<f64>, Vector3<f64>) {
        let (pitch, alpha) = (self.pair.gears[0].pitch, self.pair.pressure_angle);
        let pitch_line = Vector3::new(sin(pitch), 0.0, cos(pitch));
        let depthwise = Vector3::new(cos(pitch), 0.0, -sin(pitch));
        let tangent = depthwise * sin(alpha) + Vector3::y() * (turn * cos(alpha));
        (pitch_line * cos(s) + tangent * sin(s), tangent * cos(s) - pitch_line * sin(s))
    }

    fn at_corner(&self, i: usize, delta: f64, turn: f64) -> (Vector3<f64>, Vector3<f64>) {
        let corner = self.corner[i].exact(delta);
        // the planet turns its corner toward ±y, the side gear has its own on the other side
        let sign = if i == 0 { turn } else { -turn };
        let [own, toward] = self.axes(i);
        let across = toward * cos(corner.own_azimuth) + Vector3::y() * (sign * sin(corner.own_azimuth));
        let point = own * cos(corner.own_polar) + across * sin(corner.own_polar);
        // the mate's flank: its normal has the base circle as lever arm
        let mate = 1 - i;
        let [axis, _] = self.axes(mate);
        let (polar, lever) = (corner.mate_polar, sin(self.pair.gears[mate].base));
        let around = axis.cross(&point) / sin(polar);
        let outward = (point * cos(polar) - axis) / sin(polar);
        let (share, side) = (lever / sin(polar), if mate == 0 { 1.0 } else { -1.0 });
        let normal = (around * (turn * share) + outward * sqrt((1.0 - share * share).max(0.0))) * side;
        (point, normal)
    }

    /// Turns a contact's vectors from the frame of the mesh into that of gear `i`: z along its axis from apex to heel, x
    /// along the middle of the tooth from which `tooth_azimuth` [rad] counts to the tooth in contact. What lies on the
    /// flank at the same height in the frame of the mesh then lies on the error-free flank of that tooth.
    pub fn in_gear(&self, contact: &Contact, i: usize, tooth_azimuth: f64, turn: f64) -> Contact {
        let angle = self.rotation(contact, i, tooth_azimuth, turn);
        let [axis, toward] = self.axes(i);
        let across = axis.cross(&toward);
        let (c, s) = (cos(angle), sin(angle));
        let turned = |v: &Vector3<f64>| {
            let (x, y) = (v.dot(&toward), v.dot(&across));
            Vector3::new(c * x + s * y, c * y - s * x, v.dot(&axis))
        };
        Contact { point: turned(&contact.point), normal: turned(&contact.normal), along: turned(&contact.along) }
    }

    /// Angle about the axis of gear `i` by which it stands turned in the frame of the mesh [rad], from the flank that touches.
    pub fn rotation(&self, contact: &Contact, i: usize, tooth_azimuth: f64, turn: f64) -> f64 {
        let gear = &self.pair.gears[i];
        let [axis, toward] = self.axes(i);
        let (x, y) = (contact.point.dot(&toward), contact.point.dot(&axis.cross(&toward)));
        let polar = atan2(sqrt(x * x + y * y), contact.point.dot(&axis));
        let angle = atan2(y, x) - tooth_azimuth - turn * gear.half_angle(polar);
        angle - TAU * libm::floor((angle + PI) / TAU)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::GearSpec;

    fn golden() -> Vec<[f64; 11]> {
        include_str!("../../tests/data/golden_contact_path_B.csv")
            .lines()
            .filter(|line| !line.starts_with(['#', 's']))
            .map(|line| {
                let values: Vec<f64> = line.split(',').map(|x| x.parse().expect("a number")).collect();
                values.try_into().expect("eleven columns")
            })
            .collect()
    }

    fn default_pair() -> Pair {
        Pair::new(&GearSpec { backlash: 0.0, ..GearSpec::default() })
    }

    #[test]
    fn points_and_normals_are_the_golden_ones_and_the_mirrored_ones() {
        let pair = default_pair();
        let action = LineOfAction::new(&pair);
        let rows = golden();
        assert!(rows.len() > 10);
        for [s, phi1, phi2, cx, cy, cz, tx, ty, tz, theta1, theta2] in rows {
            for turn in [1.0, -1.0] {
                let contact = action.contact(Spot::Path, s.to_radians(), turn);
                let point = contact.point * pair.outer_cone * 1e3;
                assert!((point - Vector3::new(cx, turn * cy, cz)).amax() < 1e-9, "{s}");
                assert!((contact.normal - Vector3::new(tx, turn * ty, tz)).amax() < 1e-10, "{s}");
                // the flanks are there when the gears have turned as the table says, teeth in mid-gap at the pitch point
                for (i, theta, polar) in [(0, theta1, phi1), (1, theta2, phi2)] {
                    let [axis, _] = action.axes(i);
                    assert!((contact.point.dot(&axis) - polar.to_radians().cos()).abs() < 1e-10);
                    let turned = action.rotation(&contact, i, -turn * pair.gears[i].half_pitch, turn);
                    let wanted = if i == 0 { turn * theta } else { -turn * theta };
                    assert!((turned - wanted.to_radians()).abs() < 1e-9, "{i} {turned} {theta}");
                }
            }
        }
    }

    #[test]
    fn corners_continue_the_path_and_their_normals_have_the_moment_arms_of_the_gap() {
        for (z_p, z_s) in [(10, 16), (9, 14), (14, 14)] {
            let pair = Pair::new(&GearSpec { planet_teeth: z_p, side_teeth: z_s, ..GearSpec::default() });
            let action = LineOfAction::new(&pair);
            for turn in [1.0, -1.0] {
                let ends = [action.corner[0].end, -action.corner[1].end];
                let corners = [Spot::PlanetTip, Spot::SideTip];
                for i in 0..2 {
                    let (end, start) =
                        (action.contact(Spot::Path, ends[i], turn), action.contact(corners[i], 0.0, turn));
                    assert!((end.point - start.point).amax() < 1e-12);
                    assert!((end.normal - start.normal).amax() < 1e-9, "{end:?} {start:?}");
                    for delta in [0.005, 0.02, 0.04] {
                        let contact = action.contact(corners[i], delta, turn);
                        assert!((contact.normal.norm() - 1.0).abs() < 1e-13);
                        assert!(contact.normal.dot(&contact.point).abs() < 1e-13);
                        // virtual work: about its own axis the corner has the lever sinδ_b (1 − g′), about its mate's sinδ_b
                        let slope = action.corner[i].exact(delta).gap.d;
                        for k in 0..2 {
                            let [axis, _] = action.axes(k);
                            let sign = if k == 0 { turn } else { -turn };
                            let lever = contact.point.cross(&contact.normal).dot(&axis) * sign;
                            let wanted = pair.sin_base()[k] * if k == i { 1.0 - slope } else { 1.0 };
                            assert!(
                                (lever - wanted).abs() < 1e-12,
                                "{z_p}/{z_s} corner {i} gear {k}: {lever} {wanted}"
                            );
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn contacts_lie_on_the_flanks_of_the_gears_own_frames() {
        let pair = default_pair();
        let action = LineOfAction::new(&pair);
        for turn in [1.0, -1.0] {
            for s in [-0.1, 0.0, 0.12] {
                let contact = action.contact(Spot::Path, s, turn);
                for (i, outward) in [(0, 1.0), (1, -1.0)] {
                    let gear = &pair.gears[i];
                    let own = action.in_gear(&contact, i, 0.0, turn);
                    let polar = libm::acos(own.point.z);
                    assert!((own.point - gear.flank_point(polar, turn)).amax() < 1e-13);
                    assert!((own.normal * outward - gear.flank_normal(polar, turn)).amax() < 1e-12);
                    // toward the planet's root, and the side gear's tip
                    assert!(own.along.z * outward > 0.0);
                }
            }
        }
    }
}
