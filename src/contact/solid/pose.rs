//! Position of the teeth of a pair, seen along the line of action.
//!
//! Frame of a mesh: u and v away from the axes of planet and side gear in their common plane, each toward the other axis,
//! t across it, the way in which the carrier turns forward; a_p, a_s along the axes from apex to heel. Tooth k of the
//! planet stands at θ_p = (x + k p_b)/sinδ_bp from u toward t, the tooth of the side gear that it drives at
//! θ_s = (q + x + k p_b)/sinδ_bs + π/z_s from v toward t. A misaligned planet leans by δΣ about the apex away from the side
//! gear, and is displaced; a displaced side gear counts as a planet displaced the other way.
//!
//! Both flanks are drawn in the plane that touches the unit sphere at the pitch point (gnomonic projection, in which plane
//! facets through the apex are straight lines), h along the line of action into the side gear, u across it toward the
//! side gear's tip. All contacts of involutes then lie at u = 0, with their normals along h.

use nalgebra::{Matrix3, Vector3};

use super::flank::half_pitch;
use crate::geometry::Pair;
use crate::numeric::{Smooth, atan2, cos, sin};

/// Rigid displacement of a planet against its side gear, as its drive flank sees it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Displacement {
    /// Along the axes of planet and side gear from apex to heel; of a displaced side gear the negative [m].
    pub along: [f64; 2],
    /// Across, the way in which the carrier turns forward [m].
    pub across: f64,
    /// Error of the shaft angle δΣ: the planet's axis leans away from the side gear [rad].
    pub lean: f64,
}

impl Displacement {
    /// The same in the mirror image in which a coast flank is a drive flank.
    pub fn mirrored(&self) -> Self {
        Self { across: -self.across, ..*self }
    }
}

/// Constants of the placement.
#[derive(Clone, Debug)]
pub struct Placement {
    sin_base: [f64; 2],
    base_pitch: f64,
    half_pitch: f64,
    /// Rows across, along the line of action and toward the pitch point; columns of each gear's (away, t, axis).
    frames: [Matrix3<f64>; 2],
    /// Displacement in these rows [m].
    offset: Vector3<f64>,
    /// Directions a_p, a_s and t in these rows.
    axes: [Vector3<f64>; 3],
}

/// Rows across, along the line of action and toward the pitch point for directions in a tooth's own frame.
pub type Pose<T> = [[T; 3]; 3];

impl Placement {
    /// Placement of the gears of `pair`, displaced by `d`.
    pub fn new(pair: &Pair, d: &Displacement) -> Self {
        let (ss, cs) = (sin(pair.shaft_angle), cos(pair.shaft_angle));
        // all in (u, t, a_p)
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
            sin_base: pair.sin_base(),
            base_pitch: pair.base_pitch,
            half_pitch: half_pitch(&pair.gears[1]),
            frames: [chart * lean, chart * Matrix3::from_columns(&[side_away, across, side_axis])],
            offset: chart * moved,
            axes: [chart * planet_axis, chart * side_axis, chart * across],
        }
    }

    /// Displacement of the planet's apex, in rows of a pose [m].
    pub fn offset(&self) -> [f64; 3] {
        self.offset.into()
    }

    /// Angles θ_p and θ_s of the teeth of pair `k` [rad].
    fn angles<T: Smooth>(&self, q: T, x: T, k: i32) -> [T; 2] {
        let travel = x + f64::from(k) * self.base_pitch;
        [travel * (1.0 / self.sin_base[0]), (travel + q) * (1.0 / self.sin_base[1]) + self.half_pitch]
    }

    /// Both teeth of pair `k` at (q, x) [rad].
    #[inline(always)]
    pub fn poses<T: Smooth>(&self, q: T, x: T, k: i32) -> [Pose<T>; 2] {
        let angles = self.angles(q, x, k);
        [0, 1].map(|gear| {
            let (angle, frame) = (angles[gear], &self.frames[gear]);
            let (s, c) = (sin(angle.value()), cos(angle.value()));
            let (sine, cosine) = (angle.through([s, c, -s]), angle.through([c, -s, -c]));
            std::array::from_fn(|row| {
                let (away, across) = (frame[(row, 0)], frame[(row, 1)]);
                [cosine * away + sine * across, cosine * across - sine * away, T::constant(frame[(row, 2)])]
            })
        })
    }

    /// From the planet's frame, turned with its tooth 0, to the side gear's, turned with its gap 0.
    pub fn between(&self, q: f64, x: f64) -> Matrix3<f64> {
        let [planet, side] = [x / self.sin_base[0], (q + x) / self.sin_base[1]];
        about_axis(-side) * self.frames[1].transpose() * self.frames[0] * about_axis(planet)
    }

    /// Polar angles on planet and side gear, as they stand, of the place in the direction `point` at cone distance
    /// `cone` [m], in rows of a pose [rad].
    pub fn polars(&self, point: Vector3<f64>, cone: f64) -> [f64; 2] {
        let on_gears = [point - self.offset / cone, point];
        [0, 1].map(|gear| {
            let (axis, place) = (self.frames[gear].column(2), on_gears[gear]);
            atan2(axis.cross(&place).norm(), axis.dot(&place))
        })
    }

    /// A vector in rows of a pose in parts along a_p, a_s and t.
    pub fn parts(&self, w: [f64; 3]) -> [f64; 3] {
        let w = Vector3::from(w);
        [0, 1, 2].map(|i| self.axes[i].dot(&w))
    }
}

fn about_axis(angle: f64) -> Matrix3<f64> {
    let (s, c) = (sin(angle), cos(angle));
    Matrix3::new(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0)
}
