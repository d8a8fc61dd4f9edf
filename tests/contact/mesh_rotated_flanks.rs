//! The program's gap functions and phases against explicit flanks, rotated in space until they touch.
//!
//! Axes, signs and the assembled position are those of docs/inside/theory.md. The flanks and the touching are found
//! only with vectors and rotations (`mesh_explicit`). For every tooth pair near the mesh, the side gear's rotation at
//! first touch must be the rotation at which `Engagement::pairs` begins to visit that pair.

use crate::mesh_explicit::{Differential, Toothed, Touch, gears, pitch_angles, random_spec, roll_at, rolled};
use crate::random::Draws;
use bevel_differential::contact::spring::{ImpactSpring, Resultant};
use bevel_differential::contact::{AnySpring, Damping, Flank, Impact, Mesh, Spot, ToothPair};
use bevel_differential::geometry::{AddendumSystem, GearSpec, Pair, assembly};
use fastrand::Rng;
use std::f64::consts::TAU;

/// Approach up to which tooth pairs are compared [rad on the unit sphere]: 0.65 mm at R_m, twenty times the approach
/// under a heavy load.
const REACH: f64 = 0.02;

const LAW: Impact = Impact { stiffness: 1e10, exponent: 1.5, damping: 0.0, per_full_depth: 1e4 };

/// Pairs of 10/16, 9/14, 11/15, 10/18 with every N for which 2 z_s / N is an integer.
const CASES: [(i32, i32, &[i32]); 4] = [(10, 16, &[2, 4]), (9, 14, &[2, 4]), (11, 15, &[2, 3]), (10, 18, &[2, 3, 4])];

fn spec(z_p: i32, z_s: i32, planets: i32, backlash: f64) -> GearSpec {
    GearSpec { planet_teeth: z_p, side_teeth: z_s, planet_count: planets, backlash, ..GearSpec::default() }
}

/// Addenda of planet and side gear, computed independently from docs/inside/theory.md: the addendum of the larger gear
/// is given, and the working depth is 2 m.
fn addenda(spec: &GearSpec) -> [f64; 2] {
    let ([d_p, d_s], _) = pitch_angles(spec);
    let ratio = f64::from(spec.side_teeth) * d_p.cos() / (f64::from(spec.planet_teeth) * d_s.cos());
    let side_is_larger = spec.side_teeth >= spec.planet_teeth;
    let u_v = if side_is_larger { ratio } else { 1.0 / ratio };
    let larger = spec.module
        * match spec.addendum_system {
            AddendumSystem::Standard => 1.0,
            AddendumSystem::Gleason => 0.540 + 0.460 / u_v,
            AddendumSystem::Iso23509 => 2.0 * (0.21 + 0.29 / u_v),
            AddendumSystem::Explicit => panic!("not used here"),
        };
    let smaller = 2.0 * spec.module - larger;
    if side_is_larger { [smaller, larger] } else { [larger, smaller] }
}

/// Cuts tips that would pass the mate's base circle (9/14: the side gear's tip undercuts the planet). The program ends
/// such a tooth 0.3 % of a base pitch before the circle, and the explicit tooth is cut at the same position.
fn cut_at_base_circle([planet, side]: [Toothed; 2], spec: &GearSpec) -> [Toothed; 2] {
    let ([d_p, d_s], _) = pitch_angles(spec);
    let base_pitch = TAU * planet.base.sin() / f64::from(spec.planet_teeth);
    let limit = roll_at(planet.base, d_p) + roll_at(side.base, d_s) - 3e-3 * base_pitch;
    [planet, side].map(|g| {
        let p = rolled(g.base, limit);
        if g.tip_roll() > limit { Toothed { tip: p.xy().norm().atan2(p.z), ..g } } else { g }
    })
}

/// A mesh of planet `i` with side `sigma` at spin `psi`, pushed forward (+1: drive) or backward (−1: coast), in both
/// descriptions.
struct Seen {
    mesh: Mesh,
    pair: Pair,
    push: f64,
    /// Side gear rotation with the tooth in the middle of its gap.
    free: f64,
    travel: f64,
    x: f64,
}

impl Seen {
    /// q and x of docs/inside/theory.md at side gear rotation `alpha`.
    fn position(&self, alpha: f64) -> [f64; 2] {
        [self.pair.sin_base()[1] * alpha - self.travel, self.x]
    }

    /// Position along the path of the program's loaded pair `p` at rotation `alpha`.
    fn arc_of(&self, p: &ToothPair, alpha: f64) -> f64 {
        let approach = -self.push * self.position(alpha)[0] - self.pair.normal_backlash / 2.0;
        match p.spot {
            Spot::Path => p.spot_arc,
            Spot::PlanetTip => self.mesh.engagement.corner[0].end + p.spot_arc,
            Spot::SideTip => -self.mesh.engagement.corner[1].end - p.spot_arc + approach,
        }
    }

    /// Rotation at which the program's tooth pair at `s` is first loaded, with its kind of contact, or `None` within
    /// REACH.
    fn first_load(&self, s: f64) -> Option<(f64, Spot)> {
        self.first(|seen, p, alpha| (seen.arc_of(p, alpha) - s).abs() < 0.25 * seen.pair.base_pitch)
    }

    /// Rotation at which any wanted pair is loaded, by bisection to the last bit.
    fn first(&self, wanted: impl Fn(&Self, &ToothPair, f64) -> bool) -> Option<(f64, Spot)> {
        let loaded = |alpha: f64| {
            let mut spot = None;
            for p in self.mesh.engagement.pairs(self.position(alpha)) {
                let forward = p.flank == Flank::Drive;
                if p.depth > 0.0 && forward == (self.push > 0.0) && wanted(self, &p, alpha) {
                    spot = Some(p.spot);
                }
            }
            spot
        };
        let reach = self.pair.normal_backlash / 2.0 + REACH;
        let (mut clear, mut pressed) = (self.free, self.free - self.push * reach / self.pair.sin_base()[1]);
        let mut spot = loaded(pressed)?;
        for _ in 0..80 {
            let middle = 0.5 * (clear + pressed);
            match loaded(middle) {
                Some(kind) => (pressed, spot) = (middle, kind),
                None => clear = middle,
            }
        }
        Some((pressed, spot))
    }
}

/// Calls `check` with the explicit touches and the program's mesh for all cases.
fn for_each_mesh(backlash: f64, spins: usize, mut check: impl FnMut(&Seen, &[Touch], &str)) {
    let mut random = Rng::with_seed(20260);
    for (z_p, z_s, counts) in CASES {
        for &n in counts {
            for_each_flank(&spec(z_p, z_s, n, backlash), spins, &mut random, &mut check);
        }
    }
}

/// Calls `check` for all planets, sides and flanks of one differential at some random spins within a tooth pitch.
fn for_each_flank(spec: &GearSpec, spins: usize, random: &mut Rng, check: &mut impl FnMut(&Seen, &[Touch], &str)) {
    let (z_p, z_s, n) = (f64::from(spec.planet_teeth), f64::from(spec.side_teeth), spec.planet_count);
    let [planet, side] = cut_at_base_circle(gears(spec, addenda(spec)), spec);
    let explicit = Differential::new(planet, side, n);
    let pair = Pair::new(spec);
    let spring = AnySpring::Impact(ImpactSpring { law: LAW, cone: pair.mean_cone });
    let mesh = Mesh::new(&pair, (spring, Damping::NONE), Resultant::new(pair.mean_cone, 1.0), true, 2.0 * REACH);
    for i in 0..n {
        for (sigma, push) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
            for _ in 0..spins {
                let psi = random.between(0.0, TAU / z_p);
                let free = sigma * psi * z_p / z_s;
                let travel = sigma * pair.sin_base()[0] * psi;
                let phase = if explicit.shows_tooth(i, sigma) { 0.0 } else { pair.base_pitch / 2.0 };
                let seen = Seen { mesh: mesh.clone(), pair, push, free, travel, x: travel + phase };
                let touches = explicit.touches(i, sigma, psi, push, free, 1.5);
                let name = format!("{z_p}/{z_s} N {n} planet {i} side {sigma:+} push {push:+} psi {psi:.4}");
                check(&seen, &touches, &name);
            }
        }
    }
}

/// Position of a touch along the path. At the pitch point, the tooth's centre is half a tooth behind the plane of the
/// axes.
fn path_position(seen: &Seen, planet: &Touch) -> f64 {
    let gear = &seen.pair.gears[0];
    gear.base.sin() * (gear.half_pitch + seen.push * planet.tooth_angle)
}

/// Approach at the touch [rad on the unit sphere].
fn approach(seen: &Seen, alpha: f64) -> f64 {
    -seen.push * seen.position(alpha)[0] - seen.pair.normal_backlash / 2.0
}

#[test]
fn assembled_teeth_and_gaps_agree_with_the_program_s_phases() {
    for (z_p, z_s, counts) in CASES {
        for &n in counts {
            let spec = spec(z_p, z_s, n, 0.0);
            let [planet, side] = gears(&spec, addenda(&spec));
            let explicit = Differential::new(planet, side, n);
            let phases = assembly::phases(&spec).expect("assembles");
            assert_eq!(phases.len(), n as usize);
            for i in 0..n {
                for (side, sigma) in [(0, 1.0), (1, -1.0)] {
                    let expected = if explicit.shows_tooth(i, sigma) { 0.0 } else { 0.5 };
                    assert_eq!(phases[i as usize][side], expected, "{z_p}/{z_s} N {n} planet {i} side {sigma}");
                }
            }
        }
    }
}

#[test]
fn odd_counts_that_violate_the_assembly_condition_are_rejected() {
    for (z_p, z_s, n) in [(10, 16, 3), (9, 14, 3), (11, 15, 4)] {
        assert!(assembly::phases(&spec(z_p, z_s, n, 0.0)).is_err(), "{z_p}/{z_s} {n}");
    }
}

/// Largest differences of rotation between program and explicit flanks, and pairs compared, by kind of contact.
#[derive(Debug, Default)]
struct Tally {
    worst: [f64; 3],
    count: [usize; 3],
}

impl Tally {
    fn compare(&mut self, seen: &Seen, touches: &[Touch], name: &str) {
        for touch in touches {
            let g = approach(seen, touch.alpha);
            assert!(g > -1e-12, "{name}: explicit teeth interfere by {g:e} in mid-gap, {touch:?}");
            // the program's table of gaps ends one base pitch past the path, which is less than REACH for many teeth
            if g > REACH.min(0.06 * seen.pair.base_pitch) {
                continue;
            }
            let first_load = seen.first_load(path_position(seen, touch));
            let Some((alpha, spot)) = first_load else { panic!("the program misses {touch:?}, gap {g:e}: {name}") };
            let off = (alpha - touch.alpha).abs();
            assert!(off <= 1e-11, "{name}: {spot:?} at gap {g:e}: {alpha} explicit {} off {off:e}", touch.alpha);
            self.worst[spot as usize] = self.worst[spot as usize].max(off);
            self.count[spot as usize] += 1;
        }
    }
}

#[test]
fn every_tooth_pair_is_loaded_from_the_rotation_at_which_rotated_flanks_touch() {
    let mut tally = Tally::default();
    for backlash in [0.0, 1e-4] {
        for_each_mesh(backlash, 4, |seen, touches, name| tally.compare(seen, touches, name));
    }
    println!("[path, planet tip, side tip]: {tally:?}");
    assert!(tally.count.iter().all(|&n| n > 50), "too few pairs of some kind: {tally:?}");
}

#[test]
fn rotated_flanks_of_random_pairs_touch_as_the_program_computes() {
    let (mut random, mut tally) = (Rng::with_seed(77), Tally::default());
    for _ in 0..60 {
        let spec = random_spec(&mut random, true);
        for_each_flank(&spec, 3, &mut random, &mut |seen, touches, name| {
            tally.compare(seen, touches, &format!("{name} {spec:?}"));
        });
    }
    println!("[path, planet tip, side tip]: {tally:?}");
    assert!(tally.count.iter().all(|&n| n > 50), "too few pairs of some kind: {tally:?}");
}

#[test]
fn first_touch_of_all_teeth_is_at_the_rotation_at_which_the_largest_depth_crosses_zero() {
    let mut worst = 0.0f64;
    for_each_mesh(1e-4, 3, |seen, touches, name| {
        // the first touch needs the least rotation from mid-gap
        let explicit = touches.iter().map(|t| seen.push * t.alpha).fold(f64::NEG_INFINITY, f64::max) * seen.push;
        let (program, _) = seen.first(|_, _, _| true).expect("touches within reach");
        worst = worst.max((program - explicit).abs());
        assert!((program - explicit).abs() <= 1e-11, "{name}: {program} explicit {explicit}");
    });
    println!("worst {worst:e} rad");
}

#[test]
fn the_program_finds_no_pair_that_the_teeth_do_not_have() {
    for_each_mesh(1e-4, 2, |seen, touches, name| {
        let alpha = seen.free - seen.push * (REACH + seen.pair.normal_backlash / 2.0) / seen.pair.sin_base()[1];
        let mut visited = Vec::new();
        for p in seen.mesh.engagement.pairs(seen.position(alpha)) {
            if p.depth > 0.0 {
                visited.push((seen.arc_of(&p, alpha), p));
            }
        }
        for (s, p) in visited {
            let touch = touches.iter().find(|t| (path_position(seen, t) - s).abs() < 1e-11);
            let touch = touch.unwrap_or_else(|| panic!("{name}: no tooth at {s}: {p:?}"));
            let g = approach(seen, touch.alpha);
            assert!(g <= REACH + 1e-11, "{name}: pair {p:?} has gap {g:e}");
            // the depth is the rotation from the touch to here, except that the gap of a side tip opens as it turns
            if p.spot != Spot::SideTip {
                assert!((p.depth - (REACH - g)).abs() < 1e-11, "{name}: {p:?} gap {g:e}");
            }
        }
    });
}
