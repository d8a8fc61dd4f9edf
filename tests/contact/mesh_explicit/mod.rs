//! Explicit spherical-involute gears built only from vectors and rotations: the reference of the mesh tests.
//!
//! A great circle rolls without slip on the base circle, and its tracing point draws the flank. The program's formulas
//! for the involute, the line of action, the gap of tip corners and the phases are not used.

#![allow(dead_code)] // each test binary uses its own part

use crate::random::Draws;
use bevel_differential::geometry::{AddendumSystem, GearSpec};
use fastrand::Rng;
use nalgebra::{Matrix3, Rotation3, Unit, Vector3};
use std::f64::consts::{PI, TAU};

pub type V3 = Vector3<f64>;

/// Random gear pairs whose gears stay well inside a half space (tips below 85°). `right` fixes Σ at 90°.
pub fn random_spec(random: &mut Rng, right: bool) -> GearSpec {
    loop {
        let spec = GearSpec {
            module: random.between(1e-3, 10e-3),
            planet_teeth: random.whole(6, 40),
            side_teeth: random.whole(6, 40),
            pressure_angle: random.between(14.5, 27.0).to_radians(),
            shaft_angle: if right { PI / 2.0 } else { random.between(50.0, 130.0).to_radians() },
            backlash: 0.0,
            addendum_system: [AddendumSystem::Standard, AddendumSystem::Gleason, AddendumSystem::Iso23509]
                [random.whole(0, 2) as usize],
            ..GearSpec::default()
        };
        let (delta, _) = pitch_angles(&spec);
        let cone = spec.module * f64::from(spec.planet_teeth) / (2.0 * delta[0].sin());
        // the face width has no effect on the sphere, but must leave a toe
        let spec = GearSpec { face_width: 0.3 * cone, ..spec };
        // no addendum of these systems exceeds 1.5 modules
        if delta.iter().all(|d| d.to_degrees() + (1.5 * spec.module / cone).atan().to_degrees() < 85.0) {
            return spec;
        }
    }
}

/// Pitch angles by bisection for the common pitch line, z_s sinδ_p = z_p sinδ_s with δ_p + δ_s = Σ, and the residual.
pub fn pitch_angles(spec: &GearSpec) -> ([f64; 2], f64) {
    let (z_p, z_s) = (f64::from(spec.planet_teeth), f64::from(spec.side_teeth));
    let f = |d: f64| z_s * d.sin() - z_p * (spec.shaft_angle - d).sin();
    let (mut low, mut high) = (0.0, spec.shaft_angle);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if f(middle) > 0.0 { high = middle } else { low = middle }
    }
    ([low, spec.shaft_angle - low], f(low))
}

pub fn about(axis: V3, angle: f64) -> Rotation3<f64> {
    Rotation3::from_axis_angle(&Unit::new_normalize(axis), angle)
}

/// One gear about +z from apex to heel, with a tooth centred on the xz plane.
#[derive(Clone, Copy, Debug)]
pub struct Toothed {
    pub teeth: i32,
    pub base: f64,
    pub tip: f64,
    /// Azimuth of the left flank's base point: half tooth angle at the base circle.
    pub base_azimuth: f64,
}

/// Tracing point of the great circle rolled by `roll` on a base circle of angle `base`, starting on it at azimuth 0.
/// The circle touches at azimuth roll/sin(base), and the point is `roll` behind the point of tangency.
pub fn rolled(base: f64, roll: f64) -> V3 {
    let turn = roll / base.sin();
    let tangency = V3::new(base.sin() * turn.cos(), base.sin() * turn.sin(), base.cos());
    let tangent = V3::new(-turn.sin(), turn.cos(), 0.0);
    tangency * roll.cos() - tangent * roll.sin()
}

impl Toothed {
    pub fn new(teeth: i32, pitch: f64, pressure: f64, tip: f64, half_at_pitch: f64) -> Self {
        let base = (pitch.sin() * pressure.cos()).asin();
        let p = rolled(base, roll_at(base, pitch));
        Self { teeth, base, tip, base_azimuth: half_at_pitch + p.y.atan2(p.x) }
    }

    pub fn tip_roll(&self) -> f64 {
        roll_at(self.base, self.tip)
    }

    /// Point of the left (+1) or right (−1) flank: the involute bends toward the tooth's centre plane.
    pub fn flank(&self, roll: f64, side: f64) -> V3 {
        let p = rolled(self.base, roll);
        let left = about(V3::z(), self.base_azimuth) * V3::new(p.x, -p.y, p.z);
        V3::new(left.x, side * left.y, left.z)
    }

    /// Half tooth angle at the polar angle with the given cosine.
    pub fn half_at_cosine(&self, cosine: f64) -> f64 {
        let cb = self.base.cos();
        let roll = ((cb - cosine) * (cb + cosine)).max(0.0).sqrt().atan2(cosine);
        let p = rolled(self.base, roll);
        self.base_azimuth - p.y.atan2(p.x)
    }
}

/// Roll at which the tracing point of a great circle on `base` has the polar angle `polar`, by the spherical
/// Pythagorean theorem.
pub fn roll_at(base: f64, polar: f64) -> f64 {
    ((polar - base).sin() * (polar + base).sin()).max(0.0).sqrt().atan2(polar.cos())
}

/// Planet and side gear of `spec` with the addenda `addendum` [m], from Gleason's, the standard, the ISO or the
/// explicit system.
pub fn gears(spec: &GearSpec, addendum: [f64; 2]) -> [Toothed; 2] {
    let ([d_p, d_s], _) = pitch_angles(spec);
    let (z_p, z_s, m) = (f64::from(spec.planet_teeth), f64::from(spec.side_teeth), spec.module);
    let cone = m * z_p / (2.0 * d_p.sin());
    // arc of each tooth on the outer pitch circle: half the pitch, plus or minus the split, minus half the backlash
    let split = (addendum[0] - addendum[1]) * spec.pressure_angle.tan();
    let thickness = [PI * m / 2.0 + split - spec.backlash / 2.0, PI * m / 2.0 - split - spec.backlash / 2.0];
    let half = [thickness[0] / (m * z_p), thickness[1] / (m * z_s)];
    let tip = |d: f64, h: f64| d + (h / cone).atan();
    [
        Toothed::new(spec.planet_teeth, d_p, spec.pressure_angle, tip(d_p, addendum[0]), half[0]),
        Toothed::new(spec.side_teeth, d_s, spec.pressure_angle, tip(d_s, addendum[1]), half[1]),
    ]
}

/// The assembled differential, with x along the carrier axis and planet i at azimuth 2πi/N about +x.
pub struct Differential {
    pub planet: Toothed,
    pub side: Toothed,
    pub planets: i32,
    /// Angle by which each planet is mounted about its axis.
    mount: Vec<f64>,
    /// Azimuth about +x of one tooth centre of each side gear, L and R.
    side_tooth: [f64; 2],
}

/// A touch of a planet tooth's flank with a side gear tooth, and the side gear rotation at which it occurs.
#[derive(Clone, Copy, Debug)]
pub struct Touch {
    /// Angle of the planet tooth's centre past the plane of both axes, positive in the direction of the planet's
    /// travel.
    pub tooth_angle: f64,
    /// Side gear rotation at first touch [rad].
    pub alpha: f64,
    /// Polar angle of the touch about the side gear's axis, and roll on the planet.
    pub side_polar: f64,
    pub roll: f64,
}

impl Differential {
    /// Assembles the differential. Side gear L has a gap at the azimuth of planet 0. Every planet is mounted to fit L,
    /// and R is mounted to fit planet 0. Panics if any planet then does not fit R.
    pub fn new(planet: Toothed, side: Toothed, planets: i32) -> Self {
        let pitch_s = TAU / f64::from(side.teeth);
        let mut it = Self { planet, side, planets, mount: Vec::new(), side_tooth: [pitch_s / 2.0, 0.0] };
        // a symmetric mount has a tooth or a gap of both gears in the plane of the axes
        let at = |centre: f64, angle: f64, pitch: f64| {
            let n = (angle - centre) / pitch;
            let rest = n - n.round();
            if rest.abs() < 1e-9 {
                Some(true)
            } else if (rest.abs() - 0.5).abs() < 1e-9 {
                Some(false)
            } else {
                None
            }
        };
        let pitch_p = TAU / f64::from(planet.teeth);
        for i in 0..planets {
            let azimuth = it.azimuth(i);
            let side_has_tooth = at(it.side_tooth[0], azimuth, pitch_s).expect("planet fits the left side gear");
            it.mount.push(if side_has_tooth { pitch_p / 2.0 } else { 0.0 });
            // tooth pattern of the planet toward R, half a turn further
            let planet_has_tooth = at(it.mount[i as usize], PI, pitch_p).expect("planet is symmetric toward R");
            if i == 0 {
                it.side_tooth[1] = if planet_has_tooth { pitch_s / 2.0 } else { 0.0 };
            }
            let right_has_tooth = at(it.side_tooth[1], azimuth, pitch_s).expect("planet fits the right side gear");
            assert_ne!(planet_has_tooth, right_has_tooth, "planet {i} of {planets} meets R tooth on tooth");
        }
        it
    }

    pub fn azimuth(&self, i: i32) -> f64 {
        TAU * f64::from(i) / f64::from(self.planets)
    }

    /// True if planet `i` has a tooth (rather than a gap) toward side `sigma` as assembled.
    pub fn shows_tooth(&self, i: i32, sigma: f64) -> bool {
        let facing = if sigma > 0.0 { 0.0 } else { PI };
        let n = (facing - self.mount[i as usize]) * f64::from(self.planet.teeth) / TAU;
        (n - n.round()).abs() < 1e-9
    }

    /// Rotation from the planet's own frame, with tooth 0 on its x axis, to the world frame at spin `psi`.
    fn planet_to_world(&self, i: i32, psi: f64) -> Matrix3<f64> {
        let out = about(V3::x(), self.azimuth(i)) * V3::y();
        let frame = Matrix3::from_columns(&[V3::x(), out.cross(&V3::x()), out]);
        // spin is positive about the axis pointing to the apex
        about(-out, psi).matrix() * frame * about(V3::z(), self.mount[i as usize]).matrix()
    }

    /// First touches of each planet tooth within `window` of the plane of the axes. The planet tooth touches the side
    /// gear tooth ahead (`push` = +1: the planet drives the side gear toward +x rotation) or behind (−1). The side gear
    /// moves against the push from its rotation `free`, at which the teeth do not touch.
    pub fn touches(&self, i: i32, sigma: f64, psi: f64, push: f64, free: f64, window: f64) -> Vec<Touch> {
        // frame rotated about x so that the planet is along y
        let to_world =
            about(V3::x(), -self.azimuth(i)) * Rotation3::from_matrix_unchecked(self.planet_to_world(i, psi));
        let (axis, travel) = (V3::x() * sigma, V3::z());
        let first = self.side_tooth[if sigma > 0.0 { 0 } else { 1 }] - self.azimuth(i);
        let pitch = TAU / f64::from(self.side.teeth);
        // at L, the planet's own azimuth is opposite to the travel, at R along it
        let hand = -sigma * push;
        let mut found = Vec::new();
        for tooth in 0..self.planet.teeth {
            let turn = to_world * about(V3::z(), TAU * f64::from(tooth) / f64::from(self.planet.teeth));
            let centre = turn * V3::x();
            let tooth_angle = centre.dot(&travel).atan2(centre.dot(&axis));
            if tooth_angle.abs() > window {
                continue;
            }
            // rotation of a side gear tooth centred on y at which its flank contains the planet's point
            let turn_needed = |roll: f64| {
                let p = turn * self.planet.flank(roll, hand);
                let cosine = p.dot(&axis);
                let on_flank = cosine <= self.side.base.cos() && cosine >= self.side.tip.cos();
                on_flank.then(|| p.z.atan2(p.y) + push * self.side.half_at_cosine(cosine))
            };
            let Some((needed, roll)) = furthest(|roll| turn_needed(roll).map(|t| push * t), self.planet.tip_roll())
            else {
                continue;
            };
            // touch of the side gear's equal teeth that is within one pitch of `free`; a quarter pitch of tolerance is
            // needed because conjugate flanks without backlash touch at `free` itself
            let back = push * free - (needed - push * first);
            let alpha = free - push * (back - pitch * (back / pitch + 0.25).floor());
            let cosine = (turn * self.planet.flank(roll, hand)).dot(&axis);
            found.push(Touch { tooth_angle, alpha, side_polar: cosine.acos(), roll });
        }
        found
    }
}

/// Largest value of `f`, which is defined on part of [0, `end`], and its position. Uses samples, the edges of the part
/// by bisection, and golden section around the best sample.
fn furthest(f: impl Fn(f64) -> Option<f64>, end: f64) -> Option<(f64, f64)> {
    const SAMPLES: usize = 240;
    let at = |k: usize| end * k as f64 / SAMPLES as f64;
    let edge = |mut inside: f64, mut outside: f64| {
        for _ in 0..60 {
            let middle = 0.5 * (inside + outside);
            if f(middle).is_some() { inside = middle } else { outside = middle }
        }
        inside
    };
    let best = (0..=SAMPLES).filter_map(|k| f(at(k)).map(|v| (v, k))).max_by(|a, b| a.0.total_cmp(&b.0));
    // also check the ends of every admissible range, if only an edge is high
    let mut candidate = best.map(|(v, k)| (v, at(k)))?;
    let mut improve = |x: f64| {
        if let Some(v) = f(x)
            && v > candidate.0
        {
            candidate = (v, x);
        }
    };
    for k in 0..SAMPLES {
        match (f(at(k)).is_some(), f(at(k + 1)).is_some()) {
            (true, false) => improve(edge(at(k), at(k + 1))),
            (false, true) => improve(edge(at(k + 1), at(k))),
            _ => {}
        }
    }
    let k = best?.1;
    let bound = |other: usize| if f(at(other)).is_some() { at(other) } else { edge(at(k), at(other)) };
    let (mut a, mut b) = (bound(k.saturating_sub(1)), bound((k + 1).min(SAMPLES)));
    let golden = (5f64.sqrt() - 1.0) / 2.0;
    for _ in 0..80 {
        let (c, d) = (b - golden * (b - a), a + golden * (b - a));
        match (f(c), f(d)) {
            (Some(v), Some(w)) if v > w => b = d,
            (Some(_), None) => b = d,
            _ => a = c,
        }
        improve(c);
        improve(d);
    }
    Some(candidate)
}
