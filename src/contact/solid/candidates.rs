//! Teeth that can touch, found with overlapping boxes around pieces of both gears' flanks.
//!
//! Both gears have a tree of such boxes in their own frame, and both trees are traversed together. Flanks consist of
//! rays through the apex. The boxes therefore enclose directions, on a sphere with a radius of one metre, in
//! millimetres. On this sphere a piece of a flank is short, whereas a box around the piece from toe to heel would
//! contain half a tooth.
//!
//! The mesh repeats with every base pitch. The teeth near each other are therefore searched once for each cell of
//! positions, with boxes enlarged by the motion of the gears within a cell. A cell may contain a tooth too many, whose
//! overlap is then negative, but never one too few.

use nalgebra::Matrix3;
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::Vector;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy, BvhNode};

use super::flank::{Flanks, Ray, half_pitch};
use super::{Displacement, MAX_TEETH, Placement};
use crate::geometry::Pair;
use crate::numeric::{cos, sin};

/// Millimetres per metre: the unit of lengths in the trees.
const MM: f64 = 1e3;

/// Pieces of a flank.
const PIECES: usize = 8;

/// Cells per base pitch.
const CELLS: usize = 128;

/// Largest overlap for which the cells are valid, in base pitches.
const DEEPEST: f64 = 1.0 / 64.0;

/// First and last number of the pairs of teeth that are near each other.
type Near = [i32; 2];

/// No pairs.
const NONE: Near = [0, -1];

/// Drive flanks of both gears.
#[derive(Clone)]
pub struct Candidates {
    trees: [Bvh; 2],
    /// Number of pieces of a flank of each gear.
    pieces: [usize; 2],
    /// Number of the last tooth; the first tooth has the negative number.
    last: i32,
    /// Largest gap of aligned gears at which flanks can touch [rad].
    apart: f64,
    /// Placement of gears without displacement.
    aligned: Placement,
    sin_base: [f64; 2],
    half_backlash: f64,
    /// Cells in order of x from −½ to ½ base pitch.
    cells: Vec<Near>,
    /// Reciprocal of the length of a cell [1/rad].
    per_cell: f64,
    /// Largest overlap for which the cells are valid [rad].
    deepest: f64,
}

impl std::fmt::Debug for Candidates {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.debug_struct("Candidates").field("last", &self.last).field("cells", &self.cells).finish_non_exhaustive()
    }
}

impl Candidates {
    /// Builds the trees of the flanks of `pair`. Flanks can touch up to a gap of `apart` between aligned gears in the
    /// same position [rad].
    pub fn new(pair: &Pair, flanks: &Flanks, apart: f64) -> Self {
        let last = ((pair.path.contact_ratio / 2.0) as i32 + 2).min(MAX_TEETH);
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
        let cell = pair.base_pitch / CELLS as f64;
        let mut new = Self {
            trees: [tree(0, 0.0), tree(1, half_pitch(&pair.gears[1]))],
            pieces: [cuts[0].len() - 1, cuts[1].len() - 1],
            last,
            apart,
            aligned: Placement::new(pair, &Displacement::default()),
            sin_base: pair.sin_base(),
            half_backlash: pair.normal_backlash / 2.0,
            cells: Vec::new(),
            per_cell: 1.0 / cell,
            deepest: DEEPEST * pair.base_pitch,
        };
        // middle and half range of q, from the gap to the largest overlap for which the cells are valid
        let deepest = new.deepest;
        let (q, half) = (0.5 * (apart - deepest) - new.half_backlash, 0.5 * (apart + deepest));
        // motion of the gears within a cell, each by the rotation of its farthest point
        let moved = 0.5 * cell / new.sin_base[0] + (0.5 * cell + half) / new.sin_base[1];
        let middle = |i: usize| cell * (i as f64 + 0.5) - 0.5 * pair.base_pitch;
        new.cells = (0..CELLS).map(|i| new.search(q, middle(i), moved + deepest)).collect();
        new
    }

    /// Numbers of the pairs of flanks that may touch at (q, x), with x within half a base pitch of 0 [rad].
    #[inline]
    pub fn near(&self, q: f64, x: f64) -> std::ops::RangeInclusive<i32> {
        let deep = -q - self.half_backlash;
        let middle = (CELLS / 2) as f64;
        let [first, last] = if deep <= self.deepest {
            let cell = (x * self.per_cell + middle).max(0.0) as usize;
            self.cells[cell.min(CELLS - 1)]
        } else {
            self.search(q, x, deep)
        };
        first..=last
    }

    /// First and last number of the pairs of flanks that may touch at (q, x) [rad], found by traversing the trees.
    /// Flanks overlap or are moved by up to `deep` [rad]. A flank can touch only the tooth ahead, because its own tooth
    /// is between it and the tooth behind.
    fn search(&self, q: f64, x: f64, deep: f64) -> Near {
        let turn: Matrix3<f64> = self.aligned.between([x / self.sin_base[0], (q + x) / self.sin_base[1]]);
        let (size, margin) = (turn.abs(), (self.apart + deep) * MM);
        let check = |planet: &BvhNode, side: &BvhNode| {
            let (p_low, p_high) = (planet.mins().to_array(), planet.maxs().to_array());
            let (s_low, s_high) = (side.mins().to_array(), side.maxs().to_array());
            (0..3).all(|i| {
                // twice the distance of the middles, and twice the reach of both boxes along it
                let (mut apart, mut reach) = (-s_low[i] - s_high[i], s_high[i] - s_low[i]);
                for j in 0..3 {
                    apart += turn[(i, j)] * (p_low[j] + p_high[j]);
                    reach += size[(i, j)] * (p_high[j] - p_low[j]);
                }
                apart.abs() <= reach + 2.0 * margin
            })
        };
        let mut near: Option<Near> = None;
        for (planet, side) in self.trees[0].leaf_pairs(&self.trees[1], check) {
            let tooth = planet as usize / self.pieces[0];
            if tooth == side as usize / self.pieces[1] {
                let k = tooth as i32 - self.last;
                let [first, last] = near.unwrap_or([k, k]);
                near = Some([first.min(k), last.max(k)]);
            }
        }
        near.unwrap_or(NONE)
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::GearSpec;

    #[test]
    fn cells_contain_every_pair_that_the_trees_find_in_any_position() {
        for apart in [1e-5, 5e-3] {
            let pair = Pair::new(&GearSpec::default());
            let near = Candidates::new(&pair, &Flanks::new(&pair, 0.03, 24), apart);
            for i in 0..2_000 {
                // golden ratios spread positions evenly
                let (f, g) = (0.618_033_988_749_895 * f64::from(i), 0.414_213_562_373_095 * f64::from(i));
                let deep = (g - g.floor()) * (near.deepest + apart) - apart;
                let (q, x) = (-near.half_backlash - deep, (f - f.floor() - 0.5) * pair.base_pitch);
                let ([first, last], named) = (near.search(q, x, deep), near.near(q, x));
                assert!(first > last || named.contains(&first) && named.contains(&last), "{q} {x}: {first} {last}");
                assert!(named.count() <= 4, "{q} {x}");
            }
        }
    }
}
