//! Flanks as polygons in the plane of projection: projected rays and facets, and the overlap of two flanks at a
//! position.

use super::turned::{Both, Single, Twin};
use super::{SineCosine, TurningRay};
use crate::numeric::sqrt;

/// A ray in the plane of projection.
#[derive(Clone, Copy, Debug, Default)]
pub struct ProjectedRay<const N: usize> {
    /// Position along the flank [rad].
    pub u: Single<N>,
    /// Height h [rad] and metric c = n_h √(1 + u² + h²), see [`super::overlap`].
    level: Twin<N>,
}

/// A pair of components of a ray of a tooth at the given angle.
#[inline(always)]
fn parts<const N: usize>(ray: &TurningRay, pair: usize, angle: SineCosine) -> Twin<N> {
    Twin::turning(ray.sine[pair], ray.cosine[pair], ray.fixed[pair], angle)
}

/// Position along the flank of a ray of a tooth at the given angle [rad].
#[inline(always)]
pub fn position_of<const N: usize>(ray: &TurningRay, angle: SineCosine) -> Single<N> {
    let ((across, _), (toward, _)) = (parts(ray, 0, angle).parts(), parts(ray, 1, angle).parts());
    across.over(toward, 1.0 / toward.v)
}

impl<const N: usize> ProjectedRay<N> {
    /// Projects `ray` of a tooth at the given angle.
    #[inline(always)]
    pub fn new(ray: &TurningRay, angle: SineCosine) -> Self {
        let (toward, normal) = parts(ray, 1, angle).parts();
        let (u, h) = parts(ray, 0, angle).over(toward, 1.0 / toward.v).parts();
        let square = u * u + h * h;
        let square = Single { v: square.v + 1.0, ..square };
        let root = sqrt(square.v);
        let half = 0.5 / root;
        let root = square.through([root, half, -half * half / root]);
        Self { u, level: Twin::of(h, normal * root) }
    }
}

/// A facet in the plane of projection. Height and metric of its points are interpolated linearly in the position u.
#[derive(Clone, Copy, Debug, Default)]
pub struct ProjectedFacet<const N: usize> {
    /// Height and metric at u = 0.
    at_zero: Twin<N>,
    /// Slopes of height and metric with respect to u.
    slope: Twin<N>,
}

impl<const N: usize> ProjectedFacet<N> {
    /// Slope of the height.
    #[inline(always)]
    pub fn slope(&self) -> f64 {
        self.slope.parts().0.v
    }

    /// Height at the position `u`.
    #[inline(always)]
    pub fn height(&self, u: f64) -> f64 {
        self.at_zero.parts().0.v + self.slope() * u
    }

    /// Returns the facet between two neighbouring rays.
    #[inline(always)]
    pub fn new(from: &ProjectedRay<N>, to: &ProjectedRay<N>) -> Self {
        let length = to.u - from.u;
        let slope = (to.level - from.level).over(length, 1.0 / length.v);
        Self { at_zero: from.level - slope.times(from.u), slope }
    }
}

/// Direction in which the overlap at a corner of one gear is measured: along the mate's normal at the corner's own tip,
/// along the corner's own normal at the mate's tip. The corner's own angle is the first variable.
#[derive(Clone, Copy, Debug)]
pub struct Measure<const N: usize> {
    /// Position of the own tip [rad].
    tip: Single<N>,
    /// Reciprocal of the distance from the own tip to the mate's tip [1/rad].
    per_length: Both<N>,
}

impl<const N: usize> Measure<N> {
    /// Returns the measures for corners of planet and side gear, whose tips are at the positions `planet` and `side`.
    #[inline(always)]
    pub fn of_both(planet: Single<N>, side: Single<N>) -> [Self; 2] {
        let length = Both::of_first(side).exchanged() - Both::of_first(planet);
        let per = 1.0 / length.v;
        let per_length = length.through([per, -per * per, 2.0 * per * per * per]);
        [Self { tip: planet, per_length }, Self { tip: side, per_length: per_length.exchanged() * -1.0 }]
    }

    /// Overlap at the ray `own` of the side gear over the facet `mate`, and the height of the facet at this ray [rad].
    /// For a ray of the planet, the overlap has the opposite sign.
    #[inline(always)]
    pub fn overlap(&self, own: &ProjectedRay<N>, mate: &ProjectedFacet<N>) -> (Both<N>, f64) {
        let (height, metric) = mate.slope.linear(mate.at_zero, own.u);
        let (own_height, own_metric) = own.level.parts();
        let share = self.per_length.times_first(own.u - self.tip);
        let metric = metric - share * metric.less_first(own_metric);
        let gap = height.less_first(own_height);
        let square = height.times_first(own_height).plus_first(own.u * own.u);
        let square = Both { v: square.v + 1.0, ..square };
        ((gap * metric).over(square, 1.0 / square.v), height.v)
    }
}
