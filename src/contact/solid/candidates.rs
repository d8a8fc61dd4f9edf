//! Which teeth can touch: their flanks' boxes overlap. Both gears have a tree of boxes, in their own frame and in
//! millimetres, through which pairs are looked for together.

use nalgebra::{Matrix3, Vector3};
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::Vector;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy, BvhNode};

use super::flank::{Flanks, Ray, half_pitch};
use crate::geometry::Pair;
use crate::numeric::{cos, sin};

/// Millimetres per metre: the unit of lengths in the trees.
const MM: f64 = 1e3;

/// Teeth on either side of the middle that are looked at, at most.
const MOST: i32 = 6;

/// Trees of both gears' drive flanks.
#[derive(Clone)]
pub struct Candidates {
    trees: [Bvh; 2],
    /// Number of the first tooth.
    first: i32,
    margin: f64,
}

impl std::fmt::Debug for Candidates {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.debug_struct("Candidates").field("first", &self.first).finish_non_exhaustive()
    }
}

impl Candidates {
    /// Trees of the flanks of `pair`, which count as near within `margin` [m].
    pub fn new(pair: &Pair, flanks: &Flanks, margin: f64) -> Self {
        let span = (pair.path.contact_ratio / 2.0) as i32 + 2;
        let last = span.min(MOST);
        let tree = |i: usize, ahead: f64| {
            let gear = &pair.gears[i];
            let boxes = (-last..=last).map(|k| {
                let azimuth = f64::from(k) * gear.tooth_pitch() + ahead;
                around(&flanks.rays[i], azimuth, [pair.inner_cone, pair.outer_cone])
            });
            let boxes: Vec<Aabb> = boxes.collect();
            Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes)
        };
        Self { trees: [tree(0, 0.0), tree(1, half_pitch(&pair.gears[1]))], first: -last, margin: margin * MM }
    }

    /// Calls `visit` with the number of each pair of flanks that may touch, the planet lying at (turn, offset) in the side
    /// gear's frame. A flank meets the one of the tooth ahead and no other: the tooth itself is in between.
    #[inline]
    pub fn near(&self, (turn, offset): (Matrix3<f64>, Vector3<f64>), mut visit: impl FnMut(i32)) {
        let (size, offset) = (turn.abs(), offset * MM);
        let check = |planet: &BvhNode, side: &BvhNode| {
            let middle = |n: &BvhNode| Vector3::from((n.mins() + n.maxs()).to_array()) * 0.5;
            let half = |n: &BvhNode| Vector3::from((n.maxs() - n.mins()).to_array()) * 0.5;
            let apart = turn * middle(planet) + offset - middle(side);
            let reach = size * half(planet) + half(side);
            (0..3).all(|i| apart[i].abs() <= reach[i] + self.margin)
        };
        for (planet, side) in self.trees[0].leaf_pairs(&self.trees[1], check) {
            if planet == side {
                visit(self.first + planet as i32);
            }
        }
    }
}

/// Box around a flank at `azimuth` between two cone distances.
fn around(rays: &[Ray], azimuth: f64, cones: [f64; 2]) -> Aabb {
    let (s, c) = (sin(azimuth), cos(azimuth));
    let points = rays.iter().flat_map(|r| {
        let r = r.direction;
        let d = Vector::new(c * r.x - s * r.y, s * r.x + c * r.y, r.z);
        cones.map(|cone| d * (cone * MM))
    });
    Aabb::from_points(points)
}
