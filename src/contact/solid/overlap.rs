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

use nalgebra::Vector3;

use super::exponential::mean_exponential;
use super::polygon::{Measure, ProjectedFacet, ProjectedRay, place};
use super::pose::{SineCosine, TurningRay};
use super::turned::Both;
use crate::numeric::{TAU, sqrt};

/// Weights below e to this power are left out: of a parabola's integral they are erfc √24 = 4·10⁻¹².
const NEGLIGIBLE: f64 = -24.0;

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

/// A corner of one flank over a facet of the other, at the end of a stretch.
#[derive(Clone, Copy)]
struct Corner<const N: usize> {
    u: Both<N>,
    /// Overlap [rad].
    overlap: Both<N>,
    /// The gear of the facet, its lower ray, and its height there [rad].
    mate: usize,
    ray: usize,
    height: f64,
}

/// How far a walk along both polygons has come.
struct Walk<'a, const N: usize> {
    section: &'a FlankSection<'a>,
    measures: &'a [Measure<N>; 2],
    /// 1 to higher places, −1 to lower ones.
    sense: f64,
    /// The facets of planet and side gear at the place, and the rays at which they end.
    facets: [ProjectedFacet<N>; 2],
    ahead: [ProjectedRay<N>; 2],
    index: [usize; 2],
    /// The gear of the last corner.
    passed: Option<usize>,
}

impl<const N: usize> Walk<'_, N> {
    /// The next corner, if both flanks go on.
    #[inline(always)]
    fn next(&mut self) -> Option<Corner<N>> {
        if let Some(gear) = self.passed {
            let i = self.index[gear].wrapping_add(if self.sense > 0.0 { 1 } else { usize::MAX });
            let (from, to) = (self.ahead[gear], self.section.projected(gear, i)?);
            self.facets[gear] = ProjectedFacet::new(&from, &to);
            (self.ahead[gear], self.index[gear]) = (to, i);
            // written so that NaN is no way on
            if !((to.u.v - from.u.v) * self.sense > 0.0) {
                return None;
            }
        }
        let own = usize::from((self.ahead[1].u.v - self.ahead[0].u.v) * self.sense < 0.0);
        self.passed = Some(own);
        let (at, mate) = (&self.ahead[own], 1 - own);
        let (overlap, height) = self.measures[own].overlap(at, &self.facets[mate]);
        let overlap = if own == 0 { overlap } else { overlap.exchanged() };
        let ray = self.index[mate].wrapping_sub(usize::from(self.sense > 0.0));
        Some(Corner { u: Both::of(at.u, own), overlap, mate, ray, height })
    }
}

/// Where the patch of a section lies.
#[derive(Clone, Copy, Debug, Default)]
pub struct Patch {
    /// Place in the plane of projection [rad].
    pub place: [f64; 2],
    /// Mean normal into the side gear, in rows of a placement.
    pub normal: [f64; 3],
}

/// A section of both flanks.
pub struct FlankSection<'a> {
    /// Rays of planet and side gear; along both the planet's root and the side gear's tip come last.
    pub rays: [&'a [TurningRay]; 2],
    /// Angles of their teeth.
    pub angles: [SineCosine; 2],
    /// Where to begin: the rays that would be closest on exact flanks, counted along each.
    pub start: [f64; 2],
}

impl FlankSection<'_> {
    #[inline(always)]
    fn projected<const N: usize>(&self, gear: usize, i: usize) -> Option<ProjectedRay<N>> {
        self.rays[gear].get(i).map(|ray| ProjectedRay::new(ray, self.angles[gear]))
    }

    /// The rays before and behind the place `u` on a flank, and the number of the first; `None` off the flank.
    #[inline(always)]
    fn around<const N: usize>(&self, gear: usize, u: f64) -> Option<(usize, [ProjectedRay<N>; 2])> {
        let last = self.rays[gear].len().checked_sub(2)?;
        let mut i = (self.start[gear] as u32 as usize).min(last);
        let mut rays = [self.projected::<N>(gear, i)?, self.projected(gear, i + 1)?];
        if !(rays[0].u.v <= u && u <= rays[1].u.v) {
            // facets are nearly alike
            let ahead = (u - rays[0].u.v) / (rays[1].u.v - rays[0].u.v);
            i = ((i as f64 + ahead) as u32 as usize).min(last);
            let at = |i: usize| self.rays[gear].get(i).map(|ray| place::<0>(ray, self.angles[gear]).v);
            while at(i + 1)? < u {
                i += 1;
            }
            while at(i)? > u {
                i = i.checked_sub(1)?;
            }
            rays = [self.projected(gear, i)?, self.projected(gear, i + 1)?];
        }
        Some((i, rays))
    }

    /// Calls `visit` with each corner that contributes, in two walks from a place inside both flanks: first the way in which
    /// the overlap grows, and then, beginning with the same corner, the other way. With `true` a walk begins.
    #[inline(always)]
    fn corners<const N: usize>(&self, soft: &Softness, mut visit: impl FnMut(bool, &Corner<N>)) -> Option<()> {
        let planet_tip = place::<N>(self.rays[0].first()?, self.angles[0]);
        let side_tip = place::<N>(self.rays[1].last()?, self.angles[1]);
        // contacts of involutes are at u = 0 or at a tip
        let u = 0.0f64.max(planet_tip.v).min(side_tip.v);
        let (planet, side) = (self.around::<N>(0, u)?, self.around::<N>(1, u)?);
        let facets = [ProjectedFacet::new(&planet.1[0], &planet.1[1]), ProjectedFacet::new(&side.1[0], &side.1[1])];
        let grows_up = facets[0].slope() > facets[1].slope();
        // over convex flanks no overlap grows faster than at first
        let room = if grows_up { side_tip.v - u } else { planet_tip.v - u };
        let (reach, least) = (-NEGLIGIBLE * soft.width, -soft.ahead / LEAST_METRIC);
        // written so that NaN is apart
        if !(facets[0].height(u) - facets[1].height(u) + (facets[0].slope() - facets[1].slope()) * room > least) {
            return None;
        }
        let measures = Measure::of_both(planet_tip, side_tip);
        let walk = |up: bool| {
            let (sense, end) = (if up { 1.0 } else { -1.0 }, usize::from(up));
            let (ahead, index) = ([planet.1[end], side.1[end]], [planet.0 + end, side.0 + end]);
            Walk { section: self, measures: &measures, sense, facets, ahead, index, passed: None }
        };
        let (mut forward, mut back) = (walk(grows_up), walk(!grows_up));
        let begin = back.next()?;
        let (mut greatest, mut floor) = (f64::NEG_INFINITY, f64::NEG_INFINITY);
        for walk in [&mut forward, &mut back] {
            let (mut at, mut begins) = (begin, true);
            loop {
                visit(begins, &at);
                if at.overlap.v > greatest {
                    greatest = at.overlap.v;
                    floor = if greatest > least { greatest - reach } else { greatest };
                }
                // between convex flanks the overlap has a single maximum
                if !(at.overlap.v >= floor) {
                    break;
                }
                let Some(next) = walk.next() else { break };
                (at, begins) = (next, false);
            }
            if !(greatest > least) {
                return None;
            }
        }
        Some(())
    }

    /// Depth p [rad] where it is positive, and some distance below.
    pub fn depth<const N: usize>(&self, soft: &Softness) -> Option<Both<N>> {
        let per = 1.0 / soft.width;
        // the integral of a walk and the sum of both; what exponents count from
        let (mut integral, mut sum, mut from) = (Both::<N>::default(), Both::<N>::default(), f64::NAN);
        // exponent of a corner and its exponential: where walks begin and of the corner before, with the place of that
        let mut begin = (Both::<N>::default(), 1.0);
        let (mut place, mut before) = (Both::<N>::default(), begin);
        self.corners::<N>(soft, |begins, at| {
            if begins {
                if from.is_nan() {
                    from = at.overlap.v;
                    begin.0 = Both { v: 0.0, ..at.overlap } * per;
                }
                (sum, integral) = (sum + integral * 1f64.copysign(integral.v), Both::default());
                (place, before) = (at.u, begin);
                return;
            }
            if at.overlap.v > from + HIGH * soft.width {
                let shift = (from - at.overlap.v) * per;
                let less = libm::exp(shift);
                (sum, integral, from) = (sum * less, integral * less, at.overlap.v);
                for (exponent, exponential) in [&mut before, &mut begin] {
                    exponent.v += shift;
                    *exponential *= less;
                }
            }
            let exponent = Both { v: at.overlap.v - from, ..at.overlap } * per;
            let exponential = libm::exp(exponent.v);
            let mean = mean_exponential([before.0.v, exponent.v], [before.1, exponential]);
            integral = integral + (at.u - place) * Both::through_both(before.0, exponent, &mean);
            (place, before) = (at.u, (exponent, exponential));
        })?;
        let sum = sum + integral * 1f64.copysign(integral.v);
        (sum.v > 0.0).then(|| {
            let r = 1.0 / sum.v;
            let depth = sum.through([libm::log(sum.v / soft.measure), r, -r * r]) * soft.width;
            Both { v: depth.v + from, ..depth }
        })
    }

    /// Where the patch lies, given the normal of each ray of a gear in rows of a placement.
    pub fn patch(&self, soft: &Softness, normal: impl Fn(usize, usize) -> Vector3<f64>) -> Option<Patch> {
        let from = self.depth::<0>(soft)?.v;
        let (mut sum, mut place, mut sum_normal) = (0.0, [0.0; 2], Vector3::zeros());
        let mut last: Option<(Corner<0>, f64)> = None;
        self.corners::<0>(soft, |begins, at| {
            let exponent = (at.overlap.v - from) / soft.width;
            if let Some((near, before)) = last.filter(|_| !begins) {
                let ends = [before, exponent];
                let weight = (at.u.v - near.u.v).abs() * mean_exponential(ends, ends.map(libm::exp)).v;
                sum += weight;
                for &Corner { u, mate, ray, height, .. } in [&near, at] {
                    // the flank that the corner is pressed into
                    sum_normal += normal(mate, ray) * (0.5 * weight);
                    place[0] += 0.5 * weight * u.v;
                    place[1] += 0.5 * weight * height;
                }
            }
            last = Some((*at, exponent));
        })?;
        let length = sum_normal.norm();
        (sum > 0.0 && length > 0.0)
            .then(|| Patch { place: place.map(|p| p / sum), normal: (sum_normal / length).into() })
    }
}
