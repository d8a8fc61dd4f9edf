//! Foot of a tooth: the fillet between root circle and flank, on the unit sphere.
//!
//! A fillet of angular radius ρ is a small circle about a centre at polar angle c = δ_f + ρ, so that it touches the
//! root circle from above. A parallel of a spherical involute is the same involute turned by ρ/sinδ_b. The centre is
//! therefore on this involute, at the arc ψ_c with cos c = cosδ_b cosψ_c, and the circle touches the flank at ψ = ψ_c −
//! ρ. If ψ is negative, the circle touches the meridian below the base circle. The centre then has the azimuth A from
//! the meridian, sinA = sinρ / sin c, and the circle touches at the polar angle tanφ = tan c cosA.

use crate::geometry::Gear;
use crate::numeric::{asin, atan2, cos, sin, sqrt};

/// Fraction of half a pitch, and angle [rad], below which a piece of the outline is omitted.
const SLIVER: f64 = 1e-7;
/// Number of bisections in the search for the largest fillet, equal to the number of bits of a double.
const HALVINGS: usize = 53;

/// Foot of a tooth on the side of positive azimuth, from the floor of the gap to the start of the involute.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Foot {
    /// Half the angular pitch [rad]: azimuth of the gap's middle.
    pub middle: f64,
    /// Polar angle of the gap's floor [rad]: the root circle, or a higher point at which both flanks meet.
    pub floor: f64,
    /// Angular radius ρ of the fillet [rad]; 0 = a sharp corner.
    pub radius: f64,
    /// Azimuth of the fillet's centre [rad], at which the root land ends. Its polar angle is floor + radius.
    pub centre: f64,
    /// Polar angle and azimuth of the fillet's upper end [rad].
    pub end: [f64; 2],
    /// Angle that the fillet sweeps about its centre [rad].
    pub sweep: f64,
    /// Arc ψ at which the involute starts [rad].
    pub start_arc: f64,
}

impl Foot {
    /// Returns the foot of a tooth of `gear` with a fillet of the angular radius `wanted` [rad], or with the largest
    /// fillet that fits the gap and ends below the pitch circle.
    pub fn new(gear: &Gear, wanted: f64) -> Self {
        let middle = gear.tooth_pitch() / 2.0;
        let start = gear.root.max(gear.base);
        if gear.half_angle(start) >= middle * (1.0 - SLIVER) {
            return Self::closed(gear, middle, gear.action_arc(start));
        }
        let touch = |radius: f64| Touch::new(gear, radius);
        let pitch_arc = gear.action_arc(gear.pitch);
        let fits = |radius: f64| touch(radius).centre <= middle && touch(radius).arc <= pitch_arc;
        let mut radius = wanted.max(0.0);
        if !fits(radius) {
            let (mut low, mut high) = (0.0, radius);
            for _ in 0..HALVINGS {
                let half = 0.5 * (low + high);
                if fits(half) { low = half } else { high = half }
            }
            radius = low;
        }
        if radius < SLIVER {
            radius = 0.0;
        }
        let Touch { mut centre, end: [polar, azimuth], arc } = touch(radius);
        if middle - centre < SLIVER * middle {
            // fully rounded: both fillets of a gap meet in its middle
            centre = middle;
        }
        let (c, apart) = (gear.root + radius, centre - azimuth);
        // angle at the centre between the direction of the pole and the end of the fillet
        let toward = cos(polar) * sin(c) - sin(polar) * cos(c) * cos(apart);
        let sweep = if radius > 0.0 { atan2(sin(polar) * sin(apart), toward) } else { 0.0 };
        Self { middle, floor: gear.root, radius, centre, end: [polar, azimuth], sweep, start_arc: arc.max(0.0) }
    }

    /// Foot of a tooth whose flanks meet those of its neighbours above the root circle, at an arc beyond `low`.
    fn closed(gear: &Gear, middle: f64, low: f64) -> Self {
        let (mut low, mut high) = (low, gear.action_arc(gear.pitch));
        for _ in 0..HALVINGS {
            let half = 0.5 * (low + high);
            if gear.half_angle(gear.polar_at(half)) > middle { low = half } else { high = half }
        }
        let floor = gear.polar_at(low);
        Self { middle, floor, radius: 0.0, centre: middle, end: [floor, middle], sweep: 0.0, start_arc: low }
    }

    /// Polar angle and azimuth of the fillet at the fraction `u` of its sweep [rad]: 0 on the root circle, 1 at its
    /// end.
    pub fn fillet_at(&self, u: f64) -> [f64; 2] {
        let (c, beta) = (self.floor + self.radius, self.sweep * u);
        let (sr, cr) = (sin(self.radius), cos(self.radius));
        let across = sr * sin(beta);
        let outward = cr * sin(c) - sr * cos(c) * cos(beta);
        let polar = atan2(sqrt(across * across + outward * outward), cr * cos(c) + sr * sin(c) * cos(beta));
        [polar, self.centre - atan2(across, outward)]
    }

    /// True if a piece of the meridian remains between the fillet, or the floor, and the base circle of `gear`.
    pub fn has_meridian(&self, gear: &Gear) -> bool {
        self.start_arc <= 0.0 && gear.base - self.end[0] > SLIVER
    }
}

/// Point at which a fillet touches the flank or the meridian.
struct Touch {
    /// Azimuth of the fillet's centre [rad].
    centre: f64,
    /// Polar angle and azimuth of the point [rad].
    end: [f64; 2],
    /// Arc ψ of the point on the involute [rad]; 0 or less on the meridian.
    arc: f64,
}

impl Touch {
    fn new(gear: &Gear, radius: f64) -> Self {
        let c = gear.root + radius;
        let arc = gear.action_arc(c) - radius;
        let foot = gear.half_angle(gear.base);
        if arc > 0.0 {
            let centre = foot - gear.inv_of_arc(arc + radius) + radius / sin(gear.base);
            return Self { centre, end: [gear.polar_at(arc), foot - gear.inv_of_arc(arc)], arc };
        }
        let apart = asin((sin(radius) / sin(c)).min(1.0));
        let polar = atan2(sin(c) * cos(apart), cos(c)).min(gear.base);
        Self { centre: foot + apart, end: [polar, foot], arc }
    }
}
