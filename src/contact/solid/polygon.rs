//! Flanks as polygons in the plane of projection: their rays there, and the overlap of two of them at a place.

use super::flank::Ray;
use super::pose::Pose;
use crate::numeric::{Smooth, sqrt};

/// A ray in the plane of projection.
#[derive(Clone, Copy, Default)]
pub struct ProjectedRay<T> {
    /// Place along the flank [rad].
    pub u: T,
    /// Height [rad].
    pub h: T,
    /// n_h √(1 + u² + h²).
    pub metric: T,
}

/// A ray's place u and height h in the plane of projection.
#[inline(always)]
pub fn project<T: Smooth>(ray: &Ray, relief: f64, pose: &Pose<T>, offset: [f64; 3]) -> [T; 2] {
    let at = ray.direction - ray.normal * relief;
    let [across, along, toward]: [T; 3] = std::array::from_fn(|i| {
        let row = &pose[i];
        row[0] * at.x + row[1] * at.y + row[2] * at.z + offset[i]
    });
    let per = toward.reciprocal();
    [across * per, along * per]
}

impl<T: Smooth> ProjectedRay<T> {
    #[inline(always)]
    /// `ray` of a gear in `pose`, `relief` [rad] of its flank missing, displaced by `offset` [rad].
    pub fn new(ray: &Ray, relief: f64, pose: &Pose<T>, offset: [f64; 3]) -> Self {
        let [u, h] = project(ray, relief, pose, offset);
        let (row, normal) = (&pose[1], &ray.normal);
        let part = row[0] * normal.x + row[1] * normal.y + row[2] * normal.z;
        let square = u * u + h * h + 1.0;
        let root = sqrt(square.value());
        let root = square.through([root, 0.5 / root, -0.25 / (root * square.value())]);
        Self { u, h, metric: part * root }
    }

    /// Point and metric of the facet from `self` to `next` at `u`.
    #[inline(always)]
    pub fn until(&self, next: &Self, u: T) -> [T; 2] {
        let share = (u - self.u) * (next.u - self.u).reciprocal();
        [self.h + share * (next.h - self.h), self.metric + share * (next.metric - self.metric)]
    }
}

/// From the planet's tip to the side gear's.
#[derive(Clone, Copy)]
pub struct TipSpan<T> {
    /// Place of the planet's tip [rad].
    pub low: T,
    /// Reciprocal of the way to the side gear's tip [1/rad].
    pub per_length: T,
}

impl<T: Smooth> TipSpan<T> {
    /// Overlap at `u` of the surfaces with height and metric of `planet` and `side`.
    #[inline(always)]
    pub fn overlap(&self, u: T, planet: [T; 2], side: [T; 2]) -> T {
        let share = (u - self.low) * self.per_length;
        let metric = side[1] + share * (planet[1] - side[1]);
        (planet[0] - side[0]) * metric * (u * u + planet[0] * side[0] + 1.0).reciprocal()
    }
}
