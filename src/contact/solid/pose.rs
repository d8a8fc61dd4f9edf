//! Position of the teeth of a pair, seen along the line of action.
//!
//! Frame of a mesh: u and v away from the axes of planet and side gear in their common plane, each toward the other
//! axis; t across this plane, in the direction in which the carrier turns forward; a_p, a_s along the axes from apex to
//! heel. Tooth k of the planet is at θ_p = (x + k p_b)/sinδ_bp from u toward t. The tooth of the side gear that it
//! drives is at θ_s = (q + x + k p_b)/sinδ_bs + π/z_s from v toward t. A misaligned planet leans by δΣ about the apex
//! away from the side gear, and is displaced. A displaced side gear is treated as a planet displaced in the opposite
//! direction.
//!
//! Both flanks are drawn in the plane that touches the unit sphere at the pitch point. In this gnomonic projection,
//! plane facets through the apex are straight lines. h is along the line of action into the side gear, u across it
//! toward the side gear's tip. All contacts of involutes are then at u = 0, with their normals along h.

use nalgebra::{Matrix3, Vector3};

use super::flank::{Ray, half_pitch};
use super::turned::Both;
use crate::geometry::Pair;
use crate::numeric::{TAU, atan2, cos, sin};

/// Rigid displacement of a planet relative to its side gear, in the directions of its drive flank.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Displacement {
    /// Displacement along the axes of planet and side gear, from apex to heel. A displaced side gear counts with the
    /// opposite sign [m].
    pub along: [f64; 2],
    /// Displacement across, in the direction in which the carrier turns forward [m].
    pub across: f64,
    /// Error of the shaft angle δΣ, by which the planet's axis leans away from the side gear [rad].
    pub lean: f64,
}

impl Displacement {
    /// Returns the displacement in the mirror image in which a coast flank is a drive flank.
    pub fn mirrored(&self) -> Self {
        Self { across: -self.across, ..*self }
    }
}

/// Largest tooth number on either side of the middle.
pub const MAX_TEETH: i32 = 6;

/// Sine and cosine of an angle.
pub type SineCosine = [f64; 2];

/// Angles of the teeth of both gears.
#[derive(Clone, Debug)]
pub struct ToothAngles {
    per_sin_base: [f64; 2],
    half_pitch: f64,
    /// Rotations by whole pitches, from −[`MAX_TEETH`] to [`MAX_TEETH`], of planet and side gear.
    pitches: [Vec<SineCosine>; 2],
}

/// Angles of tooth 0 of both gears.
#[derive(Clone, Copy, Debug)]
pub struct Stance([SineCosine; 2]);

impl ToothAngles {
    /// Returns the tooth angles of `pair`.
    pub fn new(pair: &Pair) -> Self {
        let pitches = pair.gears.map(|gear| {
            let angle = |k: i32| TAU * f64::from(k) / f64::from(gear.teeth);
            (-MAX_TEETH..=MAX_TEETH).map(|k| [sin(angle(k)), cos(angle(k))]).collect()
        });
        Self { per_sin_base: pair.sin_base().map(|s| 1.0 / s), half_pitch: half_pitch(&pair.gears[1]), pitches }
    }

    /// Angles of tooth 0 of both gears at (q, x) [rad].
    pub fn stance(&self, q: f64, x: f64) -> Stance {
        let [planet, side] = self.per_sin_base;
        Stance([x * planet, (q + x) * side + self.half_pitch].map(|angle| [sin(angle), cos(angle)]))
    }

    /// Angles θ_p and θ_s of the teeth of pair `k`, with tooth 0 of both gears in `stance`. `None` if `k` is beyond the
    /// largest number.
    #[inline(always)]
    pub fn angles(&self, stance: &Stance, k: i32) -> Option<[SineCosine; 2]> {
        let k = usize::try_from(k + MAX_TEETH).ok()?;
        let turned = |gear: usize| {
            let ([s, c], [sk, ck]) = (stance.0[gear], self.pitches[gear].get(k)?);
            Some([s * ck + c * sk, c * ck - s * sk])
        };
        Some([turned(0)?, turned(1)?])
    }

    /// Converts derivatives with respect to θ_p and θ_s into derivatives with respect to (q, x). The first derivatives
    /// change sign with `sign` = −1, for the mirror image.
    #[inline(always)]
    pub fn by_position<const N: usize>(&self, f: Both<N>, sign: f64) -> Both<N> {
        let [planet, side] = self.per_sin_base;
        let [by_planet, by_side] = [f.d[0] * planet, f.d[1] * side];
        let [pp, ps, ss] = [f.dd[0] * planet * planet, f.dd[1] * planet * side, f.dd[2] * side * side];
        Both::new(f.v, [sign * by_side, sign * (by_planet + by_side)], [ss, ps + ss, pp + 2.0 * ps + ss])
    }
}

/// Constants of the placement.
#[derive(Clone, Debug)]
pub struct Placement {
    /// Rows: across, along the line of action, and toward the pitch point. Columns: each gear's (away, t, axis).
    frames: [Matrix3<f64>; 2],
    /// Displacement in the rows of `frames` [m].
    offset: Vector3<f64>,
    /// Directions a_p, a_s and t in the rows of `frames`.
    axes: [Vector3<f64>; 3],
}

/// A ray that turns with its gear, in two pairs of components: across and along the line of action; toward the pitch
/// point, and the component of its flank's normal along the line of action.
#[derive(Clone, Copy, Debug)]
#[repr(align(16))]
pub struct TurningRay {
    /// Coefficients of the sine of the tooth's angle.
    pub sine: [[f64; 2]; 2],
    /// Coefficients of the cosine of the tooth's angle.
    pub cosine: [[f64; 2]; 2],
    /// Constant components.
    pub fixed: [[f64; 2]; 2],
}

impl Placement {
    /// Returns the placement of the gears of `pair`, displaced by `d`.
    pub fn new(pair: &Pair, d: &Displacement) -> Self {
        let (ss, cs) = (sin(pair.shaft_angle), cos(pair.shaft_angle));
        // all vectors in (u, t, a_p)
        let (planet_axis, across) = (Vector3::z(), Vector3::y());
        let side_axis = Vector3::new(ss, 0.0, cs);
        let side_away = Vector3::new(-cs, 0.0, ss);
        let pitch = pair.gears[0].pitch;
        let pitch_point = Vector3::new(sin(pitch), 0.0, cos(pitch));
        let depthwise = Vector3::new(cos(pitch), 0.0, -sin(pitch));
        let action = depthwise * sin(pair.pressure_angle) + across * cos(pair.pressure_angle);
        // toward the planet's root
        let toward_root = action.cross(&pitch_point);
        let toward_root = if toward_root.dot(&depthwise) < 0.0 { toward_root } else { -toward_root };
        let chart = Matrix3::from_rows(&[toward_root.transpose(), action.transpose(), pitch_point.transpose()]);
        let (sl, cl) = (sin(d.lean), cos(d.lean));
        let lean = Matrix3::new(cl, 0.0, -sl, 0.0, 1.0, 0.0, sl, 0.0, cl);
        let moved = planet_axis * d.along[0] + side_axis * d.along[1] + across * d.across;
        Self {
            frames: [chart * lean, chart * Matrix3::from_columns(&[side_away, across, side_axis])],
            offset: chart * moved,
            axes: [chart * planet_axis, chart * side_axis, chart * across],
        }
    }

    /// Rays of the planet's flank in a section at cone distance `cone` [m], with the depth `relief` [m] removed.
    pub fn planet_rays(&self, rays: &[Ray], cone: f64, relief: f64) -> Vec<TurningRay> {
        rays.iter().map(|ray| self.turning(0, ray, relief / cone, self.offset / cone)).collect()
    }

    /// Rays of the side gear's flank.
    pub fn side_rays(&self, rays: &[Ray]) -> Vec<TurningRay> {
        rays.iter().map(|ray| self.turning(1, ray, 0.0, Vector3::zeros())).collect()
    }

    fn turning(&self, gear: usize, ray: &Ray, relief: f64, offset: Vector3<f64>) -> TurningRay {
        let frame = &self.frames[gear];
        let by = |w: Vector3<f64>| {
            let [away, across, axis] = [0, 1, 2].map(|i| frame.column(i).into_owned());
            [across * w.x - away * w.y, away * w.x + across * w.y, axis * w.z]
        };
        let (point, normal) = (by(ray.direction - ray.normal * relief), by(ray.normal));
        let part = |i: usize, moved: Vector3<f64>| {
            let w = point[i] + moved;
            [[w.x, w.y], [w.z, normal[i].y]]
        };
        TurningRay { sine: part(0, Vector3::zeros()), cosine: part(1, Vector3::zeros()), fixed: part(2, offset) }
    }

    /// A direction in the frame of a gear's tooth, converted to the rows of this placement, with the tooth at the given
    /// angle.
    pub fn turned(&self, gear: usize, [s, c]: SineCosine, w: &Vector3<f64>) -> Vector3<f64> {
        self.frames[gear] * Vector3::new(c * w.x - s * w.y, s * w.x + c * w.y, w.z)
    }

    /// Rotation from the planet's frame, turned by the angle `planet`, to the side gear's frame, turned by `side`
    /// [rad].
    pub fn between(&self, [planet, side]: [f64; 2]) -> Matrix3<f64> {
        about_axis(-side) * self.frames[1].transpose() * self.frames[0] * about_axis(planet)
    }

    /// Polar angles [rad] of a point on the displaced planet and side gear. `point` is its direction in rows of a
    /// placement, and `cone` its cone distance [m].
    pub fn polars(&self, point: Vector3<f64>, cone: f64) -> [f64; 2] {
        let on_gears = [point - self.offset / cone, point];
        [0, 1].map(|gear| {
            let (axis, point) = (self.frames[gear].column(2), on_gears[gear]);
            atan2(axis.cross(&point).norm(), axis.dot(&point))
        })
    }

    /// Components along a_p, a_s and t of a vector in the rows of a placement.
    pub fn components(&self, w: [f64; 3]) -> [f64; 3] {
        let w = Vector3::from(w);
        [0, 1, 2].map(|i| self.axes[i].dot(&w))
    }
}

fn about_axis(angle: f64) -> Matrix3<f64> {
    let (s, c) = (sin(angle), cos(angle));
    Matrix3::new(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0)
}
