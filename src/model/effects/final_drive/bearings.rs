//! Forces of the final drive on the ring gear and on the bearings of the carrier.
//!
//! Frame of the housing: x forward, y to the left, z upward; the axle drives forward if it turns about +y. With s = sgn
//! T, the hand h = ±1 (right-hand teeth: +1 on the left of the planets, −1 on their right, where forward drive turns the
//! gear the other way about its own axis), the pressure angle α_n of the loaded flank, the spiral angle β and the pitch
//! angle δ of the ring gear, the force on the ring gear at its mean radius r is
//!
//! ```text
//! F_t = T/r
//! F_a = |F_t|/cos β (tan α_n sin δ − s h sin β cos δ)    along the axle, away from the planets
//! F_r = |F_t|/cos β (tan α_n cos δ + s h sin β sin δ)    toward the axle
//! ```
//!
//! The bearing toward which the axial force points carries all of it. Preload and induced thrust of tapered rollers are
//! left out.

use super::{FinalDriveSpec, Hand, RingSide};
use crate::numeric::{cos, sin};

/// Forces on the ring gear and on the bearings [N].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reaction {
    /// Along the circumference, positive if it drives forward.
    pub tangential: f64,
    /// Along the axle, positive away from the planets.
    pub axial: f64,
    /// Toward the axle.
    pub radial: f64,
    /// On the left and the right bearing, along x, y and z.
    pub bearings: [[f64; 3]; 2],
}

impl FinalDriveSpec {
    /// Forces under the `torque` on the ring gear [N·m].
    pub(super) fn reaction_to(&self, torque: f64) -> Reaction {
        let drives = torque >= 0.0;
        let (sign, pressure_angle) =
            if drives { (1.0, self.drive_pressure_angle) } else { (-1.0, self.coast_pressure_angle) };
        let hand = self.side() * if self.hand == Hand::Right { 1.0 } else { -1.0 };
        let tangential = torque / self.mean_radius;
        let slope = sin(pressure_angle) / cos(pressure_angle);
        let along = sign * hand * sin(self.spiral_angle);
        let (sine, cosine) = (sin(self.pitch_angle), cos(self.pitch_angle));
        let normal = tangential.abs() / cos(self.spiral_angle);
        let axial = normal * (slope * sine - along * cosine);
        let radial = normal * (slope * cosine + along * sine);
        Reaction { tangential, axial, radial, bearings: self.on_bearings([tangential, axial, radial]) }
    }

    /// Side of the ring gear along y.
    fn side(&self) -> f64 {
        if self.ring_side == RingSide::Left { 1.0 } else { -1.0 }
    }

    /// Forces on both bearings under the force on the ring gear: equal resultant, and equal moments across the axle.
    fn on_bearings(&self, [tangential, axial, radial]: [f64; 3]) -> [[f64; 3]; 2] {
        let side = self.side();
        // position of the mesh: r (cos ψ, 0, sin ψ) + y along the axle
        let (forward, upward) = (cos(self.azimuth), sin(self.azimuth));
        let (y, along) = (side * self.ring_offset, side * axial);
        // the direction of the circumference is ŷ × r̂ = (sin ψ, 0, −cos ψ)
        let across = [tangential * upward - radial * forward, -tangential * forward - radial * upward];
        // the axial force at the radius r tilts the carrier in the plane of the axle and the mesh
        let tilt = along * self.mean_radius;
        let tilts = [tilt * forward, tilt * upward];
        let [left, right] = [self.left_bearing, -self.right_bearing];
        let on_left = |k: usize| (across[k] * (y - right) - tilts[k]) / (left - right);
        let [x, z] = [on_left(0), on_left(1)];
        let toward = [along.max(0.0), along.min(0.0)];
        [[x, toward[0], z], [across[0] - x, toward[1], across[1] - z]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    type Vector = [f64; 3];

    fn cross(a: Vector, b: Vector) -> Vector {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    }

    fn sum(vectors: &[Vector]) -> Vector {
        std::array::from_fn(|k| vectors.iter().map(|v| v[k]).sum())
    }

    fn scaled(a: Vector, by: f64) -> Vector {
        a.map(|x| by * x)
    }

    fn drive(hand: Hand, ring_side: RingSide) -> FinalDriveSpec {
        FinalDriveSpec {
            spiral_angle: 0.6,
            drive_pressure_angle: 0.33,
            coast_pressure_angle: 0.41,
            pitch_angle: 1.2,
            azimuth: 0.3,
            ring_offset: 0.031,
            left_bearing: 0.08,
            right_bearing: 0.07,
            hand,
            ring_side,
            ..FinalDriveSpec::default()
        }
    }

    #[test]
    fn the_force_is_normal_to_the_loaded_flank() {
        let (hands, sides) =
            ([(Hand::Right, 1.0), (Hand::Left, -1.0)], [(RingSide::Left, 1.0), (RingSide::Right, -1.0)]);
        for ((hand, h), (side, y), sign) in
            hands.into_iter().flat_map(|h| sides.map(|s| (h, s))).flat_map(|(h, s)| [1.0, -1.0].map(|t| (h, s, t)))
        {
            let spec = FinalDriveSpec { azimuth: 0.0, ..drive(hand, side) };
            let found = spec.reaction_to(sign * 500.0);
            // the mesh is in front of the axle; the gear's own axis points away from the planets
            let (axis, radial) = ([0.0, y, 0.0], [1.0, 0.0, 0.0]);
            let forward = cross([0.0, 1.0, 0.0], radial);
            let (sine, cosine) = (f64::sin(spec.pitch_angle), f64::cos(spec.pitch_angle));
            let generatrix = sum(&[scaled(axis, cosine), scaled(radial, sine)]);
            let out = sum(&[scaled(radial, cosine), scaled(axis, -sine)]);
            // the outer half of a right-hand tooth is inclined clockwise for an observer who looks along the axis
            let clockwise = cross(axis, radial);
            let (sin, cos) = (f64::sin(spec.spiral_angle), f64::cos(spec.spiral_angle));
            let tooth = sum(&[scaled(generatrix, cos), scaled(clockwise, h * sin)]);
            let across = cross(tooth, out);
            let dot = |a: Vector, b: Vector| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
            let across = scaled(across, sign * dot(across, forward).signum());
            let alpha = if sign > 0.0 { spec.drive_pressure_angle } else { spec.coast_pressure_angle };
            // the flank pushes across the tooth and into the gear
            let normal = sum(&[scaled(across, f64::cos(alpha)), scaled(out, -f64::sin(alpha))]);
            let force = scaled(normal, found.tangential / dot(normal, forward));
            for (direction, expected) in [(axis, found.axial), (radial, -found.radial)] {
                let off = dot(force, direction) - expected;
                assert!(off.abs() < 1e-9 * found.tangential.abs(), "{hand:?} {side:?} {sign}: {force:?} {found:?}");
            }
        }
    }

    #[test]
    fn bearings_balance_the_forces_and_the_moments_across_the_axle() {
        for side in [RingSide::Left, RingSide::Right] {
            for torque in [700.0, -700.0] {
                let spec = drive(Hand::Left, side);
                let found = spec.reaction_to(torque);
                let sign = if side == RingSide::Left { 1.0 } else { -1.0 };
                let radial = [f64::cos(spec.azimuth), 0.0, f64::sin(spec.azimuth)];
                let along = cross([0.0, 1.0, 0.0], radial);
                let force = sum(&[
                    scaled(along, found.tangential),
                    scaled(radial, -found.radial),
                    [0.0, sign * found.axial, 0.0],
                ]);
                let at = sum(&[scaled(radial, spec.mean_radius), [0.0, sign * spec.ring_offset, 0.0]]);
                let [left, right] = found.bearings;
                let moments = sum(&[
                    cross(at, force),
                    scaled(cross([0.0, spec.left_bearing, 0.0], left), -1.0),
                    scaled(cross([0.0, -spec.right_bearing, 0.0], right), -1.0),
                ]);
                let rest = sum(&[force, scaled(left, -1.0), scaled(right, -1.0)]);
                for zero in [rest[0], rest[1], rest[2], moments[0], moments[2]] {
                    assert!(zero.abs() < 1e-11 * found.tangential.abs(), "{side:?} {torque}: {rest:?} {moments:?}");
                }
                // the whole moment about the axle is the torque
                assert!((moments[1] - torque).abs() < 1e-9 * torque.abs());
            }
        }
    }

    #[test]
    fn the_other_hand_and_side_are_the_mirror_image() {
        let spec = drive(Hand::Left, RingSide::Left);
        let mirrored = FinalDriveSpec {
            left_bearing: spec.right_bearing,
            right_bearing: spec.left_bearing,
            ring_side: RingSide::Right,
            hand: Hand::Right,
            ..spec
        };
        // the mirror image in the plane of the planets
        let [a, b] = [spec, mirrored].map(|spec| spec.reaction_to(400.0).bearings);
        for s in 0..2 {
            let [x, y, z] = b[1 - s];
            for (found, expected) in [(a[s][0], x), (a[s][1], -y), (a[s][2], z)] {
                assert!((found - expected).abs() < 1e-9, "{a:?} {b:?}");
            }
        }
    }
}
