//! Flanks as polygons in the plane of projection: their rays and facets there, and the overlap of two of them at a place.

use nalgebra::Vector3;

use super::flank::Ray;
use super::pose::Pose;
use super::turned::{Both, Single};
use crate::numeric::sqrt;

/// A ray in the plane of projection.
#[derive(Clone, Copy, Debug, Default)]
pub struct ProjectedRay<const N: usize> {
    /// Place along the flank [rad].
    pub u: Single<N>,
    /// Height [rad].
    pub h: Single<N>,
    /// n_h √(1 + u² + h²).
    pub metric: Single<N>,
}

/// Part along a row of a pose of a direction that turns with its gear.
#[inline(always)]
fn part<const N: usize>(row: &[f64; 3], w: &Vector3<f64>) -> Single<N> {
    let turning = row[0] * w.x + row[1] * w.y;
    Single::new(turning + row[2] * w.z, row[1] * w.x - row[0] * w.y, -turning)
}

/// How a flank differs from that of aligned gears.
#[derive(Clone, Copy, Debug, Default)]
pub struct Moved {
    /// Material missing [rad].
    pub relief: f64,
    /// Displacement, in rows of a pose [rad].
    pub offset: [f64; 3],
}

/// A ray's place u and height h in the plane of projection.
#[inline(always)]
pub fn project<const N: usize>(ray: &Ray, moved: &Moved, pose: &Pose) -> [Single<N>; 2] {
    let at = ray.direction - ray.normal * moved.relief;
    let row = |i: usize| {
        let w = part::<N>(&pose[i], &at);
        Single { v: w.v + moved.offset[i], ..w }
    };
    let (across, along, toward) = (row(0), row(1), row(2));
    let per = 1.0 / toward.v;
    [across.over(toward, per), along.over(toward, per)]
}

impl<const N: usize> ProjectedRay<N> {
    /// `ray` of a gear in `pose`.
    #[inline(always)]
    pub fn new(ray: &Ray, moved: &Moved, pose: &Pose) -> Self {
        let [u, h] = project(ray, moved, pose);
        let square = u * u + h * h;
        let square = Single { v: square.v + 1.0, ..square };
        let root = sqrt(square.v);
        let half = 0.5 / root;
        let root = square.through([root, half, -half * half / root]);
        Self { u, h, metric: part(&pose[1], &ray.normal) * root }
    }
}

/// A quantity that is linear along a facet.
#[derive(Clone, Copy, Debug, Default)]
struct Linear<const N: usize> {
    /// At u = 0.
    at_zero: Single<N>,
    /// By u.
    slope: Single<N>,
}

impl<const N: usize> Linear<N> {
    /// At the place `u` of a ray of the other gear, whose angle is the first variable.
    #[inline(always)]
    fn at(&self, u: Single<N>) -> Both<N> {
        let (c, g) = (self.at_zero, self.slope);
        Both::new(c.v + g.v * u.v, [g.v * u.d, c.d + g.d * u.v], [g.v * u.dd, g.d * u.d, c.dd + g.dd * u.v])
    }
}

/// A facet in the plane of projection.
#[derive(Clone, Copy, Debug, Default)]
pub struct ProjectedFacet<const N: usize> {
    height: Linear<N>,
    metric: Linear<N>,
}

impl<const N: usize> ProjectedFacet<N> {
    /// Slope of the height.
    #[inline(always)]
    pub fn slope(&self) -> f64 {
        self.height.slope.v
    }

    /// Facet between neighbouring rays.
    #[inline(always)]
    pub fn new(from: &ProjectedRay<N>, to: &ProjectedRay<N>) -> Self {
        let length = to.u - from.u;
        let per = 1.0 / length.v;
        let linear = |from: Single<N>, to: Single<N>, u: Single<N>| {
            let slope = (to - from).over(length, per);
            Linear { at_zero: from - slope * u, slope }
        };
        Self { height: linear(from.h, to.h, from.u), metric: linear(from.metric, to.metric, from.u) }
    }
}

/// How the overlap at a corner of one gear is measured: along the normal of its mate at its own tip, along its own at the
/// mate's. The own angle is the first variable.
#[derive(Clone, Copy, Debug)]
pub struct Measure<const N: usize> {
    /// The own tip [rad].
    tip: Single<N>,
    /// Reciprocal of the way from there to the mate's tip [1/rad].
    per_length: Both<N>,
    /// −1 for the planet, whose material is below, 1 for the side gear.
    sign: f64,
}

impl<const N: usize> Measure<N> {
    /// For corners of planet and side gear, whose tips are at the places `planet` and `side`.
    #[inline(always)]
    pub fn of_both(planet: Single<N>, side: Single<N>) -> [Self; 2] {
        let length = Both::of(side, 1) - Both::of(planet, 0);
        let per = 1.0 / length.v;
        let per_length = length.through([per, -per * per, 2.0 * per * per * per]);
        [
            Self { tip: planet, per_length, sign: -1.0 },
            Self { tip: side, per_length: per_length.exchanged() * -1.0, sign: 1.0 },
        ]
    }

    /// Overlap at the ray `own` over the facet `mate`, and the height of that facet there [rad].
    #[inline(always)]
    pub fn overlap(&self, own: &ProjectedRay<N>, mate: &ProjectedFacet<N>) -> (Both<N>, f64) {
        let (height, metric) = (mate.height.at(own.u), mate.metric.at(own.u));
        let share = self.per_length.times_first(own.u - self.tip);
        let metric = metric - share * metric.less_first(own.metric);
        let gap = height.less_first(own.h) * self.sign;
        let square = height.times_first(own.h).plus_first(own.u * own.u);
        let square = Both { v: square.v + 1.0, ..square };
        ((gap * metric).over(square, 1.0 / square.v), height.v)
    }
}
