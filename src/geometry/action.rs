//! Points and normals of contact as vectors: on the line of action, and at tip corners beyond its ends.
//!
//! Frame of a mesh: apex at the origin, z along the planet's axis from apex to heel, x in the plane of both axes toward
//! the side gear's axis a_s = (sinΣ, 0, cosΣ). P₀ is along the pitch line, and Q₀ ⟂ P₀ is in this plane, toward the
//! planet's tip. On the unit sphere,
//!
//!   T₀ = sinα Q₀ ± cosα ŷ,   C(s) = cos s P₀ + sin s T₀,   T(s) = dC/ds = cos s T₀ − sin s P₀
//!
//! are the point of contact and the common normal, pointing from the planet into the side gear. The sign is + for the
//! flanks whose contact moves up the path when the planet turns forward about z, and − for their mirror images. A tip
//! corner is on the tip circle of its own gear. The normal at a corner is that of the flank that it touches.

use nalgebra::Vector3;

use super::{CornerGap, Pair};
use crate::numeric::{PI, TAU, atan2, cos, sin, sqrt};

/// Largest approach for which corners are tabulated [rad], beyond the approach of any unbroken tooth.
const REACH: f64 = 0.1;

/// A contact on the unit sphere. Multiply by the cone distance to obtain a point.
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

/// Points and normals of all contacts of a pair of gears.
#[derive(Clone, Debug)]
pub struct LineOfAction {
    pair: Pair,
    corner: [CornerGap; 2],
}

impl LineOfAction {
    /// Returns the line of action and the corners of `pair`.
    pub fn new(pair: &Pair) -> Self {
        Self { pair: *pair, corner: [0, 1].map(|i| CornerGap::new(pair, i, REACH)) }
    }

    /// Axis of gear `i` from apex to heel, and the direction ⟂ to it toward the other gear's axis.
    fn axes(&self, i: usize) -> [Vector3<f64>; 2] {
        let (ss, cs) = (sin(self.pair.shaft_angle), cos(self.pair.shaft_angle));
        if i == 0 { [Vector3::z(), Vector3::x()] } else { [Vector3::new(ss, 0.0, cs), Vector3::new(-cs, 0.0, ss)] }
    }

    /// Contact in the frame of the mesh at the arc `spot_arc` [rad]: s on the path, or Δ of a corner past the end of
    /// the path. `turn` = ±1 selects the mirror image.
    pub fn contact(&self, spot: Spot, spot_arc: f64, turn: f64) -> Contact {
        let (point, normal) = match spot {
            Spot::Path => self.on_path(spot_arc, turn),
            Spot::PlanetTip => self.at_corner(0, spot_arc, turn),
            Spot::SideTip => self.at_corner(1, spot_arc, turn),
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
        // the planet's corner is turned toward ±y, the side gear's corner is on the other side
        let sign = if i == 0 { turn } else { -turn };
        let [own, toward] = self.axes(i);
        let across = toward * cos(corner.own_azimuth) + Vector3::y() * (sign * sin(corner.own_azimuth));
        let point = own * cos(corner.own_polar) + across * sin(corner.own_polar);
        // normal of the mate's flank: its moment arm about the mate's axis is sinδ_b, the radius of the base circle
        let mate = 1 - i;
        let [axis, _] = self.axes(mate);
        let (polar, lever) = (corner.mate_polar, sin(self.pair.gears[mate].base));
        let around = axis.cross(&point) / sin(polar);
        let outward = (point * cos(polar) - axis) / sin(polar);
        let (share, side) = (lever / sin(polar), if mate == 0 { 1.0 } else { -1.0 });
        let normal = (around * (turn * share) + outward * sqrt((1.0 - share * share).max(0.0))) * side;
        (point, normal)
    }

    /// Converts a contact's vectors from the frame of the mesh to the frame of gear `i`: z along its axis from apex to
    /// heel, x along the middle of tooth 0. `tooth_azimuth` [rad] is the azimuth of the tooth in contact from tooth 0.
    /// In this frame, the contact is on the error-free flank of that tooth.
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

    /// Rotation angle of gear `i` about its axis in the frame of the mesh [rad], computed from the touching flank.
    pub fn rotation(&self, contact: &Contact, i: usize, tooth_azimuth: f64, turn: f64) -> f64 {
        let gear = &self.pair.gears[i];
        let [axis, toward] = self.axes(i);
        let (x, y) = (contact.point.dot(&toward), contact.point.dot(&axis.cross(&toward)));
        let polar = atan2(sqrt(x * x + y * y), contact.point.dot(&axis));
        let angle = atan2(y, x) - tooth_azimuth - turn * gear.half_angle(polar);
        angle - TAU * libm::floor((angle + PI) / TAU)
    }
}
