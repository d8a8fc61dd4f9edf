//! Gaps caused by misalignment and runout, checked against explicit flanks that are displaced in space and turned until
//! they touch.
//!
//! The flanks of planet and side gear are moved by about a micrometre. The side gear's rotation at first touch on the
//! sphere of radius R is then searched over the whole flank and compared with that of the undisplaced gears. Their
//! difference times R sinδ_b is the gap that the displacement opens. Axes, flanks and displacements are vectors in the
//! world frame. The tests do not use the normal, the point of contact, or mirror symmetry.

use crate::mesh_explicit::{Toothed, V3, about, gears};
use bevel_differential::contact::errors::{MeshId, PairId, ToothErrorSpec, ToothErrors};
use bevel_differential::contact::pairs::Flank;
use bevel_differential::geometry::{AddendumSystem, GearSpec, Pair};
use std::f64::consts::{PI, TAU};

/// Size of the displacements [m], so small that second-order terms are a thousandth of the gap.
const SMALL: f64 = 1e-6;

/// One mesh at side `side` in the world frame: x along the carrier axis, z in the direction in which a planet is
/// carried forward.
struct Scene {
    planet: Toothed,
    side: Toothed,
    pair: Pair,
    /// +1 left, −1 right.
    hand: f64,
    planet_axis: V3,
    /// Direction from the planet's axis toward the side gear's axis.
    toward_side: V3,
}

/// A touch of two teeth: the azimuths of both tooth centres from the plane of the axes, along z.
struct Touch {
    planet: f64,
    side: f64,
}

impl Scene {
    fn new(spec: &GearSpec, side: usize) -> Self {
        let pair = Pair::new(spec);
        let [planet, side_gear] = gears(spec, [pair.gears[0].addendum, pair.gears[1].addendum]);
        let hand = if side == 0 { 1.0 } else { -1.0 };
        let planet_axis = V3::new(hand * spec.shaft_angle.cos(), spec.shaft_angle.sin(), 0.0);
        let toward_side = (V3::x() * hand - planet_axis * spec.shaft_angle.cos()).normalize();
        Self { planet, side: side_gear, pair, hand, planet_axis, toward_side }
    }

    fn planet_radial(&self, azimuth: f64) -> V3 {
        self.toward_side * azimuth.cos() + V3::z() * azimuth.sin()
    }

    fn side_radial(&self, azimuth: f64) -> V3 {
        V3::y() * azimuth.cos() + V3::z() * azimuth.sin()
    }

    /// First touch on the sphere of radius `r` of the planet tooth centred on azimuth `chi`, displaced by `place`. It
    /// touches the side gear's tooth ahead (`push` = 1) or behind (−1).
    fn touch(&self, chi: f64, push: f64, r: f64, place: impl Fn(V3) -> V3) -> Touch {
        let (u, t) = (self.planet_radial(chi), self.planet_radial(chi + PI / 2.0));
        let needed = |roll: f64| {
            let q = self.planet.flank(roll, push);
            let ray = u * q.x + t * q.y + self.planet_axis * q.z;
            let mut scale = r;
            for _ in 0..4 {
                scale *= r / place(ray * scale).norm();
            }
            let p = place(ray * scale);
            let cosine = p.x * self.hand / r;
            let on_flank = cosine <= self.side.base.cos() && cosine >= self.side.tip.cos();
            on_flank.then(|| push * (p.z.atan2(p.y) + push * self.side.half_at_cosine(cosine)))
        };
        let value = |roll: f64| needed(roll).unwrap_or(f64::NEG_INFINITY);
        let step = self.planet.tip_roll() / 400.0;
        let best = (0..=400).map(|k| step * f64::from(k)).max_by(|a, b| value(*a).total_cmp(&value(*b))).unwrap();
        let (mut a, mut b) = (best - step, best + step);
        let golden = (5f64.sqrt() - 1.0) / 2.0;
        for _ in 0..60 {
            let (c, d) = (b - golden * (b - a), a + golden * (b - a));
            if value(c) > value(d) { b = d } else { a = c }
        }
        assert!(0.5 * (a + b) < self.planet.tip_roll(), "contact within the flank");
        Touch { planet: chi, side: push * value(0.5 * (a + b)) }
    }

    /// Gap that `place` opens at position `s`. `place` displaces the planet's points relative to the side gear, given
    /// the touch of undisplaced gears.
    fn gap(&self, flank: Flank, r: f64, s: f64, place: impl Fn(&Touch, V3) -> V3) -> f64 {
        let push = if flank == Flank::Drive { 1.0 } else { -1.0 };
        let chi = push * (s - self.pair.centred_position()) / self.pair.sin_base()[0];
        let free = self.touch(chi, push, r, |p| p);
        let displaced = self.touch(chi, push, r, |p| place(&free, p));
        push * (free.side - displaced.side) * r * self.pair.sin_base()[1]
    }

    /// Compares the gap with the program along the whole path, for both flanks and over the face.
    fn compare(&self, spec: ToothErrorSpec, planets: usize, planet: usize, place: impl Fn(&Touch, PairId, V3) -> V3) {
        let errors = ToothErrors::new(&spec, &self.pair, planets).unwrap();
        let mesh = MeshId { planet, side: if self.hand > 0.0 { 0 } else { 1 } };
        let path = self.pair.path;
        let mut largest: f64 = 0.0;
        for flank in [Flank::Drive, Flank::Coast] {
            for r in [self.pair.inner_cone, self.pair.outer_cone] {
                for k in 1..8 {
                    let s = path.low + (path.high - path.low) * f64::from(k) / 8.0;
                    let pair = PairId { planet_tooth: k as usize, side_tooth: 2 * k as usize, flank };
                    let expected = self.gap(flank, r, s, |free, p| place(free, pair, p));
                    let e = errors.gap(mesh, pair, r, s);
                    assert!((e - expected).abs() < 1e-3 * SMALL, "{spec:?} {flank:?} {s}: {e} {expected}");
                    largest = largest.max(e.abs());
                }
            }
        }
        assert!(largest > 0.1 * SMALL, "an effect to compare");
    }
}

/// Pairs with right and other shaft angles.
fn specs() -> [GearSpec; 3] {
    let spec = |planet_teeth, side_teeth, shaft: f64, pressure: f64| GearSpec {
        planet_teeth,
        side_teeth,
        shaft_angle: shaft.to_radians(),
        pressure_angle: pressure.to_radians(),
        addendum_system: AddendumSystem::Gleason,
        ..GearSpec::default()
    };
    [spec(10, 16, 90.0, 20.0), spec(14, 20, 75.0, 22.5), spec(12, 15, 110.0, 20.0)]
}

fn scenes() -> Vec<Scene> {
    specs().iter().flat_map(|spec| [Scene::new(spec, 0), Scene::new(spec, 1)]).collect()
}

#[test]
fn offsets_along_the_axes_open_the_gap_of_displaced_flanks() {
    let none = ToothErrorSpec::default();
    for scene in scenes() {
        let out = scene.planet_axis * SMALL;
        scene.compare(ToothErrorSpec { planet_axial_offset: SMALL, ..none }, 2, 1, |_, _, p| p + out);
        let out = V3::x() * (scene.hand * SMALL);
        scene.compare(ToothErrorSpec { side_axial_offset: SMALL, ..none }, 2, 1, |_, _, p| p - out);
    }
}

#[test]
fn an_offset_of_the_pins_opens_the_gap_of_displaced_flanks_at_every_planet() {
    let spec = ToothErrorSpec { axis_offset: SMALL, ..ToothErrorSpec::default() };
    for side in 0..2 {
        let scene = Scene::new(&specs()[0], side);
        for planet in 0..3 {
            // world frame rotated so that the planet is along y
            let offset = about(V3::x(), -TAU * planet as f64 / 3.0) * V3::z() * SMALL;
            scene.compare(spec, 3, planet, |_, _, p| p + offset);
        }
    }
}

#[test]
fn a_leaning_planet_axis_opens_the_gap_of_turned_flanks() {
    let angle = SMALL / 0.03;
    for scene in scenes() {
        // about +z, from the left side gear's axis +x toward the planet's axis and beyond
        let lean = about(V3::z(), angle);
        let spec = ToothErrorSpec { shaft_angle_error: angle, ..ToothErrorSpec::default() };
        scene.compare(spec, 2, 0, |_, _, p| lean * p);
    }
}

#[test]
fn eccentric_teeth_open_the_gap_of_displaced_flanks_at_every_tooth() {
    for scene in scenes() {
        for seed in 0..3 {
            let spec = ToothErrorSpec { planet_runout: 2.0 * SMALL, seed, ..ToothErrorSpec::default() };
            let [size, azimuth] = ToothErrors::new(&spec, &scene.pair, 2).unwrap().eccentricity(0, 1);
            let pitch = TAU / f64::from(scene.planet.teeth);
            scene.compare(spec, 2, 1, |free, pair, p| {
                // spin is positive about the axis toward the apex
                let from_tooth = about(-scene.planet_axis, azimuth - pitch * pair.planet_tooth as f64);
                p + from_tooth * scene.planet_radial(free.planet) * size
            });
            let spec = ToothErrorSpec { side_runout: 2.0 * SMALL, seed, ..ToothErrorSpec::default() };
            let side = if scene.hand > 0.0 { 0 } else { 1 };
            let [size, azimuth] = ToothErrors::new(&spec, &scene.pair, 2).unwrap().eccentricity(1, side);
            let pitch = TAU / f64::from(scene.side.teeth);
            scene.compare(spec, 2, 1, |free, pair, p| {
                let from_tooth = about(V3::x(), azimuth - pitch * pair.side_tooth as f64);
                p - from_tooth * scene.side_radial(free.side) * size
            });
        }
    }
}

#[test]
fn all_displacements_together_add_up() {
    let spec = ToothErrorSpec {
        planet_axial_offset: 0.4 * SMALL,
        side_axial_offset: -0.3 * SMALL,
        shaft_angle_error: -10e-6,
        ..ToothErrorSpec::default()
    };
    for scene in scenes() {
        let lean = about(V3::z(), -10e-6);
        let shift = scene.planet_axis * 0.4 * SMALL + V3::x() * (scene.hand * 0.3 * SMALL);
        scene.compare(spec, 2, 0, |_, _, p| lean * p + shift);
    }
}
