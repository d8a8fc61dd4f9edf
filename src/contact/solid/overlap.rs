//! Overlap of two faceted flanks in one section.
//!
//! Both sections are polygons in the plane of projection of [`super::pose`]: the planet's surface h_p(u), the side gear's
//! h_s(u), material of the planet below, of the side gear above. Their overlap at u is the distance of one surface inside
//! the other, as an arc
//!
//!   δ = (h_p − h_s) c / (1 + u² + h_p h_s),   c = n_h √(1 + u² + h²), n_h the part along h of the normal,
//!
//! negative where the flanks stand apart, at the corners of both polygons and linear between them. On the path of contact
//! both normals are the same; a tip corner is measured along that of the flank it meets: c passes from the side gear's at
//! the planet's tip to the planet's at the side gear's tip. The depth of a section is its greatest overlap,
//! taken softly over the patch around it:
//!
//!   p = ε ln( ∫ exp(δ(u)/ε) du / √(2π ρ ε) ),   ∂p = ∫ w ∂δ du with the weights w ∝ exp(δ/ε), ∫ w du = 1
//!
//! Every facet under the patch carries its share w du of the load along its own normal, so that force and torque are
//! continuous where the deepest corner changes; the deepest point alone would make them jump at each facet. The patch
//! has the half-width √(ρ ε) between flanks of relative radius of curvature ρ (Laplace's method: for δ = p − u²/2ρ the
//! formula returns p exactly); ε follows the heights of the arcs over their facets and vanishes with them, as the square
//! of the facets' length. For ε → 0 the depth is the greatest overlap, which on involutes is exactly the approach less
//! the gap of the tip corners, a − g.

use super::exponential::mean_exponential;
use super::flank::Ray;
use super::polygon::{ProjectedRay, TipSpan, project};
use super::pose::Pose;
use crate::numeric::{Smooth, TAU, sqrt};

/// Weights below e to this power vanish in double precision.
const NEGLIGIBLE: f64 = -36.0;

/// Least ratio of the flanks' distance to their height difference where they touch.
const LEAST_METRIC: f64 = 0.8;
/// Largest variation of that ratio over a patch.
const SLOPING: f64 = 0.05;
/// Largest exponent before the sum is rescaled.
const HIGH: f64 = 20.0;

/// Softness of the greatest overlap.
#[derive(Clone, Copy, Debug)]
pub struct Softness {
    /// ε [rad].
    pub width: f64,
    /// √(2π ρ ε) [rad].
    pub measure: f64,
    /// Largest excess of the soft maximum over the greatest overlap [rad].
    pub ahead: f64,
}

impl Softness {
    /// Distance of flanks (negative: overlap) below which they contribute where others touch [rad].
    pub fn reach(&self) -> f64 {
        self.ahead - NEGLIGIBLE * self.width
    }

    /// Softness ε of overlaps between flanks of relative radius of curvature ρ that face each other over `length`, all [rad].
    pub fn new(width: f64, relative: f64, length: f64) -> Self {
        let measure = sqrt(TAU * relative * width);
        Self { width, measure, ahead: width * libm::log(1.0 + length / measure) }
    }
}

/// A corner of either polygon within both.
#[derive(Clone, Copy, Default)]
struct Corner {
    /// The last ray of planet and side gear at or before it.
    after: [usize; 2],
    /// Whether it is the side gear's.
    of_side: bool,
    /// Overlap without regard to slopes [rad].
    overlap: f64,
}

/// End of a stretch.
#[derive(Clone, Copy)]
struct StretchEnd<T> {
    u: T,
    /// Overlap [rad].
    overlap: T,
    /// The gear whose facet the corner lies over, and the ray before it.
    mate: usize,
    ray: usize,
}

/// Where the patch of a section lies.
#[derive(Clone, Copy, Debug, Default)]
pub struct Patch {
    /// Place in the plane of projection [rad].
    pub place: [f64; 2],
    /// Mean normal into the side gear, in rows of a pose.
    pub normal: [f64; 3],
}

/// A section of both flanks.
pub struct FlankSection<'a> {
    /// Rays of planet and side gear that are near each other; along both the planet's root and the side gear's tip come last.
    pub rays: [&'a [Ray]; 2],
    /// The rays at the tips.
    pub tips: [&'a Ray; 2],
    /// Material missing on the planet's flank [rad].
    pub relief: f64,
    /// Displacement of the planet, in rows of a pose [rad].
    pub offset: [f64; 3],
}

impl FlankSection<'_> {
    /// Material missing on a gear's flank, and its displacement: the planet has both for the pair.
    #[inline(always)]
    fn moved(&self, gear: usize) -> (f64, [f64; 3]) {
        if gear == 0 { (self.relief, self.offset) } else { (0.0, [0.0; 3]) }
    }

    #[inline(always)]
    fn projected<T: Smooth>(&self, poses: &[Pose<T>; 2], gear: usize, i: usize) -> ProjectedRay<T> {
        let (relief, offset) = self.moved(gear);
        ProjectedRay::new(&self.rays[gear][i], relief, &poses[gear], offset)
    }

    /// Place and height of a ray of a gear.
    #[inline(always)]
    fn place<T: Smooth>(&self, ray: &Ray, poses: &[Pose<T>; 2], gear: usize) -> [T; 2] {
        let (relief, offset) = self.moved(gear);
        project(ray, relief, &poses[gear], offset)
    }

    /// The span between the tips.
    fn span<T: Smooth>(&self, poses: &[Pose<T>; 2]) -> TipSpan<T> {
        let [planet, side] = [0, 1].map(|gear| self.place(self.tips[gear], poses, gear)[0]);
        TipSpan { low: planet, per_length: (side - planet).reciprocal() }
    }

    /// The corners of both polygons where both are, in order.
    fn corners<'w>(&'w self, poses: &'w [Pose<f64>; 2]) -> Corners<'w> {
        let mut corners = Corners { section: self, poses, index: [0; 2], last: [None; 2], next: [None; 2] };
        corners.next = [corners.place(0, 0), corners.place(1, 0)];
        corners
    }

    /// Calls `visit` with the ends of each stretch between corners whose overlap contributes.
    #[inline(always)]
    fn stretches<T: Smooth>(
        &self,
        poses: &[Pose<T>; 2],
        near: &OverlapScan,
        mut visit: impl FnMut(&[StretchEnd<T>; 2]),
    ) {
        let span = self.span(poses);
        // heights alone show where to begin
        let mut corners = self.corners(&near.values);
        let Some(mut begin) = corners.next() else { return };
        while begin.overlap < near.floor {
            match corners.next() {
                Some(stop) if stop.overlap < near.floor => begin = stop,
                _ => break,
            }
        }
        // the facets at the place: rays before and after it, of which the one before is the corner itself on one flank
        let mut next = begin.after.map(|i| i + 1);
        let mut from = [self.projected(poses, 0, begin.after[0]), self.projected(poses, 1, begin.after[1])];
        let ray = |gear: usize, i: usize| (i < self.rays[gear].len()).then(|| self.projected(poses, gear, i));
        let [Some(planet), Some(side)] = [ray(0, next[0]), ray(1, next[1])] else { return };
        let mut to = [planet, side];
        let end = |own: usize,
                   at: &ProjectedRay<T>,
                   from: &[ProjectedRay<T>; 2],
                   to: &[ProjectedRay<T>; 2],
                   next: &[usize; 2]| {
            let (here, there) = ([at.h, at.metric], from[1 - own].until(&to[1 - own], at.u));
            let (planet, side) = if own == 0 { (here, there) } else { (there, here) };
            StretchEnd { u: at.u, overlap: span.overlap(at.u, planet, side), mate: 1 - own, ray: next[1 - own] - 1 }
        };
        let own = usize::from(begin.of_side);
        let mut last = end(own, &from[own], &from, &to, &next);
        let mut greatest = f64::NEG_INFINITY;
        loop {
            greatest = greatest.max(last.overlap.value());
            if last.overlap.value() < greatest - near.reach {
                // between convex flanks the overlap has a single maximum
                return;
            }
            let own = usize::from(to[1].u.value() < to[0].u.value());
            let at = end(own, &to[own], &from, &to, &next);
            let ends = [last, at];
            visit(&ends);
            [_, last] = ends;
            from[own] = to[own];
            next[own] += 1;
            match ray(own, next[own]) {
                Some(seen) if seen.u.value() > from[own].u.value() => to[own] = seen,
                _ => return,
            }
        }
    }

    /// Values of `poses` and the greatest overlap, where the flanks are near each other.
    fn look<T: Smooth>(&self, poses: &[Pose<T>; 2], soft: &Softness) -> Option<OverlapScan> {
        let values = poses.map(|pose| pose.map(|row| row.map(Smooth::value)));
        let mut greatest = f64::NEG_INFINITY;
        for stop in self.corners(&values) {
            if stop.overlap < greatest + NEGLIGIBLE * soft.width {
                break;
            }
            greatest = greatest.max(stop.overlap);
        }
        let reach = -NEGLIGIBLE * soft.width;
        let floor = greatest - reach / LEAST_METRIC - SLOPING * greatest.abs();
        (greatest > -soft.ahead / LEAST_METRIC).then_some(OverlapScan { values, floor, reach })
    }

    /// Depth p [rad] where it is positive, and some distance below.
    pub fn depth<T: Smooth>(&self, poses: &[Pose<T>; 2], soft: &Softness) -> Option<T> {
        let near = self.look(poses, soft)?;
        let per = 1.0 / soft.width;
        let mut sum = T::constant(0.0);
        // what exponents count from, where the last stretch ended and the exponential there
        let (mut from, mut place, mut known) = (f64::NAN, f64::NAN, 0.0);
        self.stretches(
            poses,
            &near,
            |[StretchEnd { u: u0, overlap: d0, .. }, StretchEnd { u: u1, overlap: d1, .. }]| {
                let (u0, d0, u1, d1) = (*u0, *d0, *u1, *d1);
                let top = d0.value().max(d1.value());
                if from.is_nan() {
                    from = top;
                } else if top > from + HIGH * soft.width {
                    let less = libm::exp((from - top) * per);
                    sum = sum * less;
                    (from, known) = (top, known * less);
                }
                let (a, b) = ((d0 - from) * per, (d1 - from) * per);
                let before = if u0.value() == place { known } else { libm::exp(a.value()) };
                let after = libm::exp(b.value());
                (place, known) = (u1.value(), after);
                sum =
                    sum + (u1 - u0) * T::through_both(a, b, &mean_exponential([a.value(), b.value()], [before, after]));
            },
        );
        (sum.value() > 0.0).then(|| {
            let r = 1.0 / sum.value();
            sum.through([libm::log(sum.value() / soft.measure), r, -r * r]) * soft.width + from
        })
    }

    /// Where the patch lies.
    pub fn patch(&self, poses: &[Pose<f64>; 2], soft: &Softness) -> Option<Patch> {
        let (near, from) = (self.look(poses, soft)?, self.depth(poses, soft)?);
        let (mut sum, mut out) = (0.0, Patch::default());
        self.stretches(poses, &near, |ends| {
            let [a, b] = [&ends[0], &ends[1]].map(|end| (end.overlap - from) / soft.width);
            let weight = (ends[1].u - ends[0].u) * mean_exponential([a, b], [libm::exp(a), libm::exp(b)]).v;
            sum += weight;
            for &StretchEnd { u, mate, ray, .. } in ends {
                // the flank that the corner is pressed into
                let normal = self.rays[mate][ray].normal;
                let [height, _] = self.projected(poses, mate, ray).until(&self.projected(poses, mate, ray + 1), u);
                out.place[0] += 0.5 * weight * u;
                out.place[1] += 0.5 * weight * height;
                for (sum, row) in out.normal.iter_mut().zip(&poses[mate]) {
                    *sum += 0.5 * weight * (row[0] * normal.x + row[1] * normal.y + row[2] * normal.z);
                }
            }
        });
        let [x, y, z] = out.normal;
        let length = sqrt(x * x + y * y + z * z);
        (sum > 0.0 && length > 0.0)
            .then(|| Patch { place: out.place.map(|p| p / sum), normal: out.normal.map(|n| n / length) })
    }
}

/// Flanks that are near each other.
struct OverlapScan {
    values: [Pose<f64>; 2],
    /// Overlap without regard to slopes below which nothing contributes [rad].
    floor: f64,
    /// Distance below the greatest overlap within which others contribute [rad].
    reach: f64,
}

/// Walks along both polygons by heights alone.
struct Corners<'a> {
    section: &'a FlankSection<'a>,
    poses: &'a [Pose<f64>; 2],
    /// Rays that come next.
    index: [usize; 2],
    last: [Option<[f64; 2]>; 2],
    next: [Option<[f64; 2]>; 2],
}

impl Corners<'_> {
    #[inline(always)]
    fn place(&self, gear: usize, i: usize) -> Option<[f64; 2]> {
        self.section.rays[gear].get(i).map(|ray| self.section.place(ray, self.poses, gear))
    }
}

impl Iterator for Corners<'_> {
    type Item = Corner;

    #[inline(always)]
    fn next(&mut self) -> Option<Corner> {
        loop {
            let [Some(planet), Some(side)] = self.next else { return None };
            let of_side = side[0] < planet[0];
            let (own, at, to) = if of_side { (1, side, planet) } else { (0, planet, side) };
            // a corner counts where the other polygon has begun
            let stop = self.last[1 - own].map(|from| {
                let there = from[1] + (at[0] - from[0]) * (to[1] - from[1]) / (to[0] - from[0]);
                let mut after = self.index;
                after[1 - own] -= 1;
                Corner { after, of_side, overlap: if of_side { there - at[1] } else { at[1] - there } }
            });
            self.index[own] += 1;
            self.last[own] = Some(at);
            self.next[own] = self.place(own, self.index[own]).filter(|next| next[0] > at[0]);
            if stop.is_some() {
                return stop;
            }
        }
    }
}
