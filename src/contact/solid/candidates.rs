//! Teeth that can touch, and where on their flanks, found by overlapping boxes around pieces of both gears' flanks.
//!
//! Both gears have a tree of such boxes in their own frame; both trees are traversed together. As flanks consist of rays
//! through the apex, boxes enclose directions, on a sphere of one metre in millimetres: there a
//! piece of a flank is short, whereas a box around it from toe to heel would hold half a tooth.

use std::ops::RangeInclusive;

use nalgebra::Matrix3;
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::Vector;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy, BvhNode};

use super::flank::{Flanks, Ray, half_pitch};
use crate::geometry::Pair;
use crate::numeric::{cos, sin};

/// Millimetres per metre: the unit of lengths in the trees.
const MM: f64 = 1e3;

/// Largest number of teeth examined on either side of the middle.
const MOST: i32 = 6;
const MOST_TEETH: usize = 2 * MOST as usize + 1;

/// Pieces of a flank.
const PIECES: usize = 8;

/// Trees of both gears' drive flanks.
#[derive(Clone)]
pub struct Candidates {
    trees: [Bvh; 2],
    /// Rays at the ends of the pieces.
    cuts: [Vec<usize>; 2],
    /// Number of the last tooth; the first one has its negative.
    last: i32,
    margin: f64,
}

/// Pieces of both flanks that are near each other, first and last.
type Pieces = [[usize; 2]; 2];

impl std::fmt::Debug for Candidates {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.debug_struct("Candidates").field("last", &self.last).field("cuts", &self.cuts).finish_non_exhaustive()
    }
}

impl Candidates {
    /// Trees of the flanks of `pair`, whose pieces are near each other within `margin` [rad].
    pub fn new(pair: &Pair, flanks: &Flanks, margin: f64) -> Self {
        let last = ((pair.path.contact_ratio / 2.0) as i32 + 2).min(MOST);
        let cuts = [0, 1].map(|i| cuts(flanks.rays[i].len()));
        let tree = |i: usize, ahead: f64| {
            let gear = &pair.gears[i];
            let mut boxes = Vec::new();
            for k in -last..=last {
                let azimuth = f64::from(k) * gear.tooth_pitch() + ahead;
                boxes.extend(cuts[i].windows(2).map(|cut| around(&flanks.rays[i][cut[0]..=cut[1]], azimuth)));
            }
            Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes)
        };
        Self { trees: [tree(0, 0.0), tree(1, half_pitch(&pair.gears[1]))], cuts, last, margin: margin * MM }
    }

    /// Calls `visit` with the number of each pair of flanks that may touch and the rays of both that may, the planet being
    /// turned by `turn` in the side gear's frame and its flanks up to `deep` [rad] inside those of the side gear. A flank
    /// meets only that of the tooth ahead: the tooth itself is in between.
    #[inline]
    pub fn near(&self, turn: Matrix3<f64>, deep: f64, mut visit: impl FnMut(i32, [RangeInclusive<usize>; 2])) {
        let (size, margin) = (turn.abs(), self.margin + deep * MM);
        let check = |planet: &BvhNode, side: &BvhNode| {
            let (p_low, p_high) = (planet.mins().to_array(), planet.maxs().to_array());
            let (s_low, s_high) = (side.mins().to_array(), side.maxs().to_array());
            (0..3).all(|i| {
                // twice the distance of the middles, and of what reaches across it
                let (mut apart, mut reach) = (-s_low[i] - s_high[i], s_high[i] - s_low[i]);
                for j in 0..3 {
                    apart += turn[(i, j)] * (p_low[j] + p_high[j]);
                    reach += size[(i, j)] * (p_high[j] - p_low[j]);
                }
                apart.abs() <= reach + 2.0 * margin
            })
        };
        let pieces = [self.cuts[0].len() - 1, self.cuts[1].len() - 1];
        let mut found: [Option<Pieces>; MOST_TEETH] = [None; MOST_TEETH];
        for (planet, side) in self.trees[0].leaf_pairs(&self.trees[1], check) {
            let (planet, side) = (planet as usize, side as usize);
            let (tooth, here) = (planet / pieces[0], [planet % pieces[0], side % pieces[1]]);
            if tooth == side / pieces[1] {
                let known = found[tooth].get_or_insert(here.map(|p| [p, p]));
                for (range, p) in known.iter_mut().zip(here) {
                    *range = [range[0].min(p), range[1].max(p)];
                }
            }
        }
        for (tooth, pieces) in found.iter().enumerate() {
            if let Some(pieces) = pieces {
                let rays = [0, 1].map(|i| self.cuts[i][pieces[i][0]]..=self.cuts[i][pieces[i][1] + 1]);
                visit(tooth as i32 - self.last, rays);
            }
        }
    }
}

/// Cuts a flank of `rays` rays into pieces.
fn cuts(rays: usize) -> Vec<usize> {
    let facets = rays - 1;
    let pieces = facets.min(PIECES);
    (0..=pieces).map(|i| i * facets / pieces).collect()
}

/// Box around a piece of a flank at `azimuth`.
fn around(rays: &[Ray], azimuth: f64) -> Aabb {
    let (s, c) = (sin(azimuth), cos(azimuth));
    let points = rays.iter().map(|r| {
        let r = r.direction;
        Vector::new(c * r.x - s * r.y, s * r.x + c * r.y, r.z) * MM
    });
    Aabb::from_points(points)
}
