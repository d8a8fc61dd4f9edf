//! Overlap of two faceted flanks in one section.
//!
//! Both sections are polygons in the plane of projection of [`super::pose`]: the planet's surface h_p(u) with material
//! below it, and the side gear's surface h_s(u) with material above it. Their overlap at u is the distance of one
//! surface inside the other, as an arc
//!
//! δ = (h_p − h_s) c / (1 + u² + h_p h_s), c = n_h √(1 + u² + h²), n_h the component along h of the normal.
//!
//! The overlap is negative if the flanks are apart. It is evaluated at the corners of both polygons and is linear
//! between them. On the path of contact, both normals are the same. A tip corner is measured along the normal of the
//! flank that it meets: c passes from the side gear's value at the planet's tip to the planet's value at the side
//! gear's tip. The depth of a section is a soft maximum of the overlap over the patch around the maximum:
//!
//! p = ε ln( ∫ exp(δ(u)/ε) du / √(2π ρ ε) ), ∂p = ∫ w ∂δ du with the weights w ∝ exp(δ/ε), ∫ w du = 1
//!
//! Every facet under the patch transmits its share w du of the load along its own normal, so force and torque are
//! continuous when the deepest corner changes. With only the deepest point, they would jump at each facet. The patch
//! has the half-width √(ρ ε) between flanks of relative radius of curvature ρ (Laplace's method: for δ = p − u²/2ρ the
//! formula returns exactly p). ε is proportional to the heights of the arcs over their facets and vanishes with them,
//! as the square of the facets' length. For ε → 0, the depth is the maximum overlap. On involutes this is exactly the
//! approach minus the gap of the tip corners, a − g.

use nalgebra::Vector3;

use super::Softness;
use super::exponential::{exp, mean_exponential};
use super::turned::Both;
use super::walk::{Corner, FlankSection, Follow};
use crate::numeric::lanes::{Task, in_lanes};

/// Largest exponent before the sum is rescaled.
const HIGH: f64 = 20.0;

/// Contact patch of a section.
#[derive(Clone, Copy, Debug, Default)]
pub struct Patch {
    /// Coordinates of its centre in the plane of projection [rad].
    pub position: [f64; 2],
    /// Mean normal into the side gear, in the rows of a placement.
    pub normal: [f64; 3],
}

/// ∫ exp(δ/ε) du along both walks, and its derivatives.
struct SoftIntegral<const N: usize> {
    /// ε [rad].
    width: f64,
    /// 1/ε [1/rad].
    per: f64,
    /// Overlap at which the exponents are zero [rad].
    from: f64,
    /// Overlap above which the integral is rescaled [rad].
    high: f64,
    /// Integral of the completed walks.
    sum: Both<N>,
    /// Integral of the present walk.
    walked: Both<N>,
    /// Exponent and its exponential at the corner at which both walks start.
    begin: (Both<N>, f64),
    /// Exponent and its exponential at the previous corner.
    before: (Both<N>, f64),
    /// Position of the previous corner [rad].
    before_u: Both<N>,
}

impl<const N: usize> SoftIntegral<N> {
    #[inline(always)]
    fn new(soft: &Softness) -> Self {
        let (zero, one) = (Both::default(), (Both::default(), 1.0));
        let (width, per) = (soft.width, 1.0 / soft.width);
        Self {
            width,
            per,
            from: f64::NAN,
            high: f64::NAN,
            sum: zero,
            walked: zero,
            begin: one,
            before: one,
            before_u: zero,
        }
    }

    /// Adds the present walk to the sum.
    #[inline(always)]
    fn finish(&mut self) {
        // walks toward lower positions have a negative integral
        self.sum = self.sum + self.walked * 1f64.copysign(self.walked.v);
        self.walked = Both::default();
    }

    #[inline(always)]
    fn count_from(&mut self, from: f64) {
        (self.from, self.high) = (from, from + HIGH * self.width);
    }

    /// Sets the reference of the exponents to the greater overlap `from`.
    #[inline(always)]
    fn rescale(&mut self, from: f64) {
        let shift = (self.from - from) * self.per;
        let less = exp(shift);
        (self.sum, self.walked) = (self.sum * less, self.walked * less);
        self.count_from(from);
        for (exponent, exponential) in [&mut self.before, &mut self.begin] {
            exponent.v += shift;
            *exponential *= less;
        }
    }

    /// Soft maximum of the overlap [rad]. `None` if the integral is not positive.
    #[inline(always)]
    fn greatest(mut self, soft: &Softness) -> Option<Both<N>> {
        self.finish();
        let sum = self.sum;
        (sum.v > 0.0).then(|| {
            let r = 1.0 / sum.v;
            let depth = sum.through([libm::log(sum.v / soft.measure), r, -r * r]) * soft.width;
            Both { v: depth.v + self.from, ..depth }
        })
    }
}

impl<const N: usize> Follow<N> for SoftIntegral<N> {
    #[inline(always)]
    fn begin(&mut self, at: &Corner<N>) {
        if self.from.is_nan() {
            self.count_from(at.overlap.v);
            self.begin.0 = Both { v: 0.0, ..at.overlap } * self.per;
        }
        self.finish();
        (self.before_u, self.before) = (at.u, self.begin);
    }

    #[inline(always)]
    fn pass(&mut self, at: &Corner<N>) {
        if at.overlap.v > self.high {
            self.rescale(at.overlap.v);
        }
        let exponent = Both { v: at.overlap.v - self.from, ..at.overlap } * self.per;
        let exponential = exp(exponent.v);
        let mean = mean_exponential([self.before.0.v, exponent.v], [self.before.1, exponential]);
        self.walked = self.walked + (at.u - self.before_u) * Both::through_both(self.before.0, exponent, &mean);
        (self.before_u, self.before) = (at.u, (exponent, exponential));
    }
}

/// Mean position and normal of a patch of depth `depth`. `normal` returns the normal of a ray.
struct PatchMean<'a, F> {
    normal: F,
    depth: f64,
    soft: &'a Softness,
    before: Corner<0>,
    weight: f64,
    position: [f64; 2],
    sum: Vector3<f64>,
}

impl<F: Fn(usize, usize) -> Vector3<f64>> Follow<0> for PatchMean<'_, F> {
    fn begin(&mut self, at: &Corner<0>) {
        self.before = *at;
    }

    fn pass(&mut self, at: &Corner<0>) {
        let exponents = [&self.before, at].map(|end| (end.overlap.v - self.depth) / self.soft.width);
        let length = (at.u.v - self.before.u.v).abs();
        let weight = length * mean_exponential(exponents, exponents.map(exp)).v;
        self.weight += weight;
        for end in [&self.before, at] {
            // normal of the flank into which the corner is pressed
            self.sum += (self.normal)(end.mate, end.ray) * (0.5 * weight);
            self.position[0] += 0.5 * weight * end.u.v;
            self.position[1] += 0.5 * weight * end.height;
        }
        self.before = *at;
    }
}

/// Task that computes the depth of a section with vectors of any width.
struct DepthOf<'a, const N: usize> {
    section: &'a FlankSection<'a>,
    soft: &'a Softness,
}

impl<const N: usize> Task for DepthOf<'_, N> {
    type Output = Option<Both<N>>;

    #[inline(always)]
    fn run(self) -> Option<Both<N>> {
        let mut integral = SoftIntegral::<N>::new(self.soft);
        self.section.walk(self.soft, &mut integral)?;
        integral.greatest(self.soft)
    }
}

impl FlankSection<'_> {
    /// Depth p [rad] if it is positive or slightly negative, else `None`.
    pub fn depth<const N: usize>(&self, soft: &Softness) -> Option<Both<N>> {
        in_lanes(DepthOf::<N> { section: self, soft })
    }

    /// Contact patch of the section, or `None` if the flanks are apart. `normal` returns the normal of a ray of a gear
    /// in the rows of a placement.
    pub fn patch(&self, soft: &Softness, normal: impl Fn(usize, usize) -> Vector3<f64>) -> Option<Patch> {
        let depth = self.depth::<0>(soft)?.v;
        let before = Corner::default();
        let mut mean =
            PatchMean { normal, depth, soft, before, weight: 0.0, position: [0.0; 2], sum: Vector3::zeros() };
        self.walk(soft, &mut mean)?;
        let length = mean.sum.norm();
        (mean.weight > 0.0 && length > 0.0)
            .then(|| Patch { position: mean.position.map(|p| p / mean.weight), normal: (mean.sum / length).into() })
    }
}
