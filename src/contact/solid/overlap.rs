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
use super::peak::Peak;
use super::polygon::{ProjectedFacet, ProjectedRay, TipSpan, project};
use super::pose::Pose;
use super::turned::{Both, Single};
use crate::numeric::{TAU, sqrt};

/// Weights below e to this power vanish in double precision.
const NEGLIGIBLE: f64 = -36.0;

/// Least ratio of the flanks' distance to their height difference where they touch.
const LEAST_METRIC: f64 = 0.8;
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

/// End of a stretch.
#[derive(Clone, Copy)]
struct StretchEnd<const N: usize> {
    u: Both<N>,
    /// Overlap [rad].
    overlap: Both<N>,
    /// The gear whose facet the corner lies over, the lower ray of that facet, and its height there [rad].
    mate: usize,
    ray: usize,
    height: f64,
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
    /// Rays of planet and side gear; along both the planet's root and the side gear's tip come last.
    pub rays: [&'a [Ray]; 2],
    /// The rays near which exact flanks would touch on the path of contact, counted along each flank.
    pub start: [f64; 2],
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
    fn projected<const N: usize>(&self, poses: &[Pose; 2], gear: usize, i: usize) -> Option<ProjectedRay<N>> {
        let (relief, offset) = self.moved(gear);
        self.rays[gear].get(i).map(|ray| ProjectedRay::new(ray, relief, &poses[gear], offset))
    }

    /// Place and height of a ray of a gear.
    #[inline(always)]
    pub(super) fn place<const N: usize>(&self, poses: &[Pose; 2], gear: usize, ray: &Ray) -> [Single<N>; 2] {
        let (relief, offset) = self.moved(gear);
        project(ray, relief, &poses[gear], offset)
    }

    /// Calls `visit` with both ends of each stretch between corners that contributes, outward from the corner of the
    /// greatest overlap first to lower (`false`) and then to higher places; the end nearer to it comes first.
    #[inline(always)]
    fn stretches<const N: usize>(
        &self,
        poses: &[Pose; 2],
        soft: &Softness,
        mut visit: impl FnMut(bool, &[StretchEnd<N>; 2]),
    ) -> Option<()> {
        let tips = [(0, self.rays[0].first()?), (1, self.rays[1].last()?)];
        let tips = tips.map(|(gear, ray)| self.place::<N>(poses, gear, ray)[0]);
        let peak = self.peak(poses, tips.map(|u| u.v))?;
        if !(peak.overlap > -soft.ahead / LEAST_METRIC) {
            return None;
        }
        let span = TipSpan::new(tips);
        let end = |own: usize, at: &ProjectedRay<N>, facets: &[ProjectedFacet<N>; 2], ray: usize| {
            let (u, (overlap, height)) = if own == 0 {
                (Both::of::<0>(at.u), span.overlap::<0>(at, &facets[1]))
            } else {
                (Both::of::<1>(at.u), span.overlap::<1>(at, &facets[0]))
            };
            StretchEnd { u, overlap, mate: 1 - own, ray, height }
        };
        let Peak { own, ray, facet, .. } = peak;
        let top = self.projected(poses, own, ray)?;
        let below = [self.projected(poses, 1 - own, facet)?, self.projected(poses, 1 - own, facet + 1)?];
        let mut facets = [ProjectedFacet::new(&below[0], &below[1]); 2];
        let (under, begin) = (facets[0], end(own, &top, &facets, facet));
        let (reach, mut greatest) = (-NEGLIGIBLE * soft.width, begin.overlap.v);
        for up in [false, true] {
            // the rays ahead, and the facets on the way to them
            let onward = |i: usize| if up { i + 1 } else { i.wrapping_sub(1) };
            let follow = |gear: usize, i: usize, from: &ProjectedRay<N>| {
                let next = self.projected::<N>(poses, gear, i)?;
                (if up { next.u.v > from.u.v } else { next.u.v < from.u.v }).then_some(next)
            };
            let (mut index, mut ahead) = ([facet + usize::from(up); 2], [below[usize::from(up)]; 2]);
            index[own] = onward(ray);
            let Some(first) = follow(own, index[own], &top) else { continue };
            ahead[own] = first;
            facets[own] = ProjectedFacet::new(&top, &first);
            facets[1 - own] = under;
            let mut last = begin;
            loop {
                let own = usize::from((ahead[1].u.v < ahead[0].u.v) == up);
                let lower = if up { index[1 - own].wrapping_sub(1) } else { index[1 - own] };
                let at = end(own, &ahead[own], &facets, lower);
                visit(up, &[last, at]);
                greatest = greatest.max(at.overlap.v);
                if at.overlap.v < greatest - reach {
                    // between convex flanks the overlap has a single maximum
                    break;
                }
                last = at;
                index[own] = onward(index[own]);
                let Some(next) = follow(own, index[own], &ahead[own]) else { break };
                facets[own] = ProjectedFacet::new(&ahead[own], &next);
                ahead[own] = next;
            }
        }
        Some(())
    }

    /// Depth p [rad] where it is positive, and some distance below.
    pub fn depth<const N: usize>(&self, poses: &[Pose; 2], soft: &Softness) -> Option<Both<N>> {
        let per = 1.0 / soft.width;
        let mut sum = Both::<N>::default();
        // what exponents count from, where the last stretch ended and the exponential there
        let (mut from, mut place, mut known) = (f64::NAN, f64::NAN, 0.0);
        self.stretches::<N>(poses, soft, |up, [near, far]| {
            let top = near.overlap.v.max(far.overlap.v);
            if from.is_nan() {
                from = top;
            } else if top > from + HIGH * soft.width {
                let less = libm::exp((from - top) * per);
                sum = sum * less;
                (from, known) = (top, known * less);
            }
            let [a, b] = [near.overlap, far.overlap].map(|o| Both { v: o.v - from, ..o } * per);
            let before = if near.u.v == place { known } else { libm::exp(a.v) };
            let after = libm::exp(b.v);
            (place, known) = (far.u.v, after);
            let length = if up { far.u - near.u } else { near.u - far.u };
            sum = sum + length * Both::through_both(a, b, &mean_exponential([a.v, b.v], [before, after]));
        })?;
        (sum.v > 0.0).then(|| {
            let r = 1.0 / sum.v;
            let depth = sum.through([libm::log(sum.v / soft.measure), r, -r * r]) * soft.width;
            Both { v: depth.v + from, ..depth }
        })
    }

    /// Where the patch lies.
    pub fn patch(&self, poses: &[Pose; 2], soft: &Softness) -> Option<Patch> {
        let from = self.depth::<0>(poses, soft)?.v;
        let (mut sum, mut out) = (0.0, Patch::default());
        self.stretches::<0>(poses, soft, |_, ends| {
            let [a, b] = [&ends[0], &ends[1]].map(|end| (end.overlap.v - from) / soft.width);
            let weight = (ends[1].u.v - ends[0].u.v).abs() * mean_exponential([a, b], [libm::exp(a), libm::exp(b)]).v;
            sum += weight;
            for &StretchEnd { u, mate, ray, height, .. } in ends {
                // the flank that the corner is pressed into
                let normal = self.rays[mate][ray].normal;
                out.place[0] += 0.5 * weight * u.v;
                out.place[1] += 0.5 * weight * height;
                for (sum, row) in out.normal.iter_mut().zip(&poses[mate]) {
                    *sum += 0.5 * weight * (row[0] * normal.x + row[1] * normal.y + row[2] * normal.z);
                }
            }
        })?;
        let [x, y, z] = out.normal;
        let length = sqrt(x * x + y * y + z * z);
        (sum > 0.0 && length > 0.0)
            .then(|| Patch { place: out.place.map(|p| p / sum), normal: out.normal.map(|n| n / length) })
    }
}
