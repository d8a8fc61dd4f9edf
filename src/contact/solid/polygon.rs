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

/// What distinguishes the flank of the planet from its mate's, which is where it is.
#[derive(Clone, Copy, Debug)]
pub struct Moved {
    /// Material missing [rad].
    pub relief: f64,
    /// Displacement, in rows of a pose [rad].
    pub offset: [f64; 3],
}

/// A ray's place u and height h in the plane of projection.
#[inline(always)]
pub fn project<const N: usize>(ray: &Ray, moved: Option<&Moved>, pose: &Pose) -> [Single<N>; 2] {
    let at = match moved {
        Some(moved) => ray.direction - ray.normal * moved.relief,
        None => ray.direction,
    };
    let row = |i: usize| {
        let w = part::<N>(&pose[i], &at);
        Single { v: if let Some(moved) = moved { w.v + moved.offset[i] } else { w.v }, ..w }
    };
    let (across, along, toward) = (row(0), row(1), row(2));
    let per = 1.0 / toward.v;
    [across.over(toward, per), along.over(toward, per)]
}

impl<const N: usize> ProjectedRay<N> {
    /// `ray` of a gear in `pose`.
    #[inline(always)]
    pub fn new(ray: &Ray, moved: Option<&Moved>, pose: &Pose) -> Self {
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
    /// At a place `u` of a ray of gear `OWN`, on a facet of its mate.
    #[inline(always)]
    fn at<const OWN: usize>(&self, u: Single<N>) -> Both<N> {
        let (c, g) = (self.at_zero, self.slope);
        Both::from_own::<OWN>(c.v + g.v * u.v, [g.v * u.d, c.d + g.d * u.v], [g.v * u.dd, g.d * u.d, c.dd + g.dd * u.v])
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

/// From the planet's tip to the side gear's.
#[derive(Clone, Copy, Debug)]
pub struct TipSpan<const N: usize> {
    /// Place of the planet's tip [rad].
    planet: Single<N>,
    /// Reciprocal of the way to the side gear's tip [1/rad].
    per_length: Both<N>,
}

impl<const N: usize> TipSpan<N> {
    /// Span between tips at the places `planet` and `side` [rad].
    #[inline(always)]
    pub fn new(planet: Single<N>, side: Single<N>) -> Self {
        let length = Both::of::<1>(side) - Both::of::<0>(planet);
        let per = 1.0 / length.v;
        Self { planet, per_length: length.through([per, -per * per, 2.0 * per * per * per]) }
    }

    /// Overlap at a ray of gear `OWN` over a facet of its mate [rad], and the height of that facet there [rad].
    #[inline(always)]
    pub fn overlap<const OWN: usize>(&self, own: &ProjectedRay<N>, mate: &ProjectedFacet<N>) -> (Both<N>, f64) {
        let there = mate.height.at::<OWN>(own.u);
        let (height, own_metric, mate_metric) =
            (Both::of::<OWN>(own.h), Both::of::<OWN>(own.metric), mate.metric.at::<OWN>(own.u));
        let share = if OWN == 0 {
            self.per_length.times::<0>(own.u - self.planet)
        } else {
            self.per_length * (Both::of::<1>(own.u) - Both::of::<0>(self.planet))
        };
        let (gap, metric) = if OWN == 0 {
            (height - there, mate_metric + share * (own_metric - mate_metric))
        } else {
            (there - height, own_metric + share * (mate_metric - own_metric))
        };
        let square = Both::of::<OWN>(own.u * own.u) + there.times::<OWN>(own.h);
        let square = Both { v: square.v + 1.0, ..square };
        ((gap * metric).over(square, 1.0 / square.v), there.v)
    }
}
