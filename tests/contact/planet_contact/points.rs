//! Random points inside and outside the backlash, and differences whose steps avoid switches.

use std::ops::Range;

use bevel_differential::contact::{Flank, Spot};
use fastrand::Rng;

use super::kinds::{At, Contact, GEARS, Planet, READINGS, Teeth, WRAPPED, kinds};
use crate::mesh_laws::PER_FULL_DEPTH;
use crate::random::Draws;

/// Depths of loaded flanks from which the steps of differences are derived [rad]. The opening of crowned flanks is
/// rounded to 1e-17, and tables of teeth have kinks of third order.
const DEPTHS: [f64; 2] = [2e-5, 3e-3];

/// The present case, printed if the test fails.
struct Case<'a>(&'a Contact, &'a At);

impl Drop for Case<'_> {
    fn drop(&mut self) {
        if std::thread::panicking() {
            eprintln!("under {:?} at {:?}", self.0, self.1);
        }
    }
}

/// Returns the kinds of contact that are `wanted`.
pub fn those(wanted: impl Fn(&Contact) -> bool) -> Vec<Contact> {
    kinds().into_iter().filter(|contact| wanted(contact)).collect()
}

/// Calls `test` with `count` points of each of these kinds of contact. `test` returns false at a point next to a
/// switch.
pub fn for_each_point(seed: u64, count: usize, of: Vec<Contact>, mut test: impl FnMut(&Planet, &At) -> bool) {
    for contact in of {
        // the gears and points of a kind do not depend on the other kinds
        let bytes = format!("{contact:?}").into_bytes();
        let number = bytes.into_iter().fold(seed, |number, byte| number.wrapping_mul(31).wrapping_add(u64::from(byte)));
        let planet = Planet::new(contact, &GEARS[(number % GEARS.len() as u64) as usize]);
        let mut random = Rng::with_seed(number);
        let tested = (0..count).filter(|_| {
            let at = planet.point(&mut random);
            let _case = Case(&contact, &at);
            test(&planet, &at)
        });
        assert!(tested.count() >= count / 10, "{contact:?}");
    }
}

impl At {
    /// Both meshes in the middle of their backlash.
    pub const FREE: Self = Self { position: [[0.0; 3]; 2], rate: [[0.0; 3]; 2], wrapped: WRAPPED };

    pub fn at_rest(self) -> Self {
        Self { rate: [[0.0; 3]; 2], ..self }
    }

    /// Keeps the mesh `side` and frees the other one.
    pub fn only(mut self, side: usize) -> Self {
        (self.position[1 - side], self.rate[1 - side]) = ([0.0; 3], [0.0; 3]);
        self
    }

    /// Moves coordinate `i`: q, x, w left and right, then their rates.
    pub fn moved(mut self, i: usize, h: f64) -> Self {
        let values = if i < 6 { &mut self.position } else { &mut self.rate };
        values[i / 3 % 2][i % 3] += h;
        self
    }

    /// Fourth-order central difference.
    pub fn difference<const N: usize>(&self, i: usize, h: f64, f: impl Fn(&Self) -> [f64; N]) -> [f64; N] {
        let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|k| f(&self.moved(i, k * h)));
        std::array::from_fn(|n| (8.0 * (c[n] - b[n]) - (d[n] - a[n])) / (12.0 * h))
    }
}

/// Side, flank and teeth of a pair.
type Name = (usize, Flank, [usize; 2]);
/// Pair of a loaded point, kind of contact, and cone distance if the point does not move. The flags tell which ends of
/// the face and of a broken tooth's parts are loaded, whether flanks are about to separate, and whether damping is
/// full. At changes of these values, derivatives jump or have kinks.
type Point = (Name, Spot, Option<f64>, [bool; 4], [bool; 2]);

/// Loaded points of both meshes.
#[derive(Default)]
pub struct Pattern {
    pub points: Vec<Point>,
    /// Deepest arc of each mesh [rad].
    deepest: [f64; 2],
    /// Distance of each mesh from the nearest switch [rad].
    nearest: [f64; 2],
}

impl Planet {
    /// Position q at which the flanks of direction `hand` approach by `approach` [rad].
    pub fn pressed(&self, hand: f64, approach: f64) -> f64 {
        hand * (self.gears.pair.normal_backlash / 2.0 + approach).max(0.0)
    }

    /// A random point: on either flank, within or barely outside the backlash, next to a tip corner, or under loads
    /// beyond those of any gear. In half of the points, the teeth of both meshes belong to one body.
    fn point(&self, random: &mut Rng) -> At {
        let (pair, mut at) = (&self.gears.pair, At::FREE);
        // excess material also presses teeth whose flanks would not touch yet
        let least = if matches!(self.contact.teeth, Teeth::Perfect) { -3e-4 } else { -1.3e-3 };
        for side in 0..2 {
            let depth = match random.below(8) {
                0 | 1 => random.between(least, 3e-4),
                2 => random.about(1e-4, 10.0),
                3 => random.between(3e-3, 9e-3),
                _ => random.between(1e-5, 3e-3),
            };
            let hand = random.pick(&[-1.0, 1.0]);
            let ends =
                [self.constants.mesh.engagement.corner[0].end, depth - self.constants.mesh.engagement.corner[1].end];
            let x = match random.below(4) {
                0 => -hand * (random.pick(&ends) + random.between(-3e-3, 3e-3) - pair.centred_position()),
                _ => random.between(-2.0, 2.0) * pair.base_pitch,
            };
            let [w, dw] = if self.contact.is_displaced { [3e-5, 0.02] } else { [0.0; 2] };
            at.position[side] = [self.pressed(hand, depth), x, w * random.between(-1.0, 1.0)];
            at.rate[side] = [1.0, 1.0, dw].map(|most| random.between(-most, most));
            if self.contact.friction.is_some() {
                // flanks roll, because friction has a kink at zero rolling speed
                let [q, x, _] = at.rate[side];
                at.rate[side][..2].copy_from_slice(&[0.4 * q, 0.5 * (x + x.signum())]);
            }
        }
        if random.chance(2) { self.joined(at) } else { at }
    }

    /// Sets the travel of the right mesh to that of teeth on the same body as those of the left mesh.
    pub fn joined(&self, mut at: At) -> At {
        at.position[1][1] = 0.5 * self.off_opposite() - at.position[0][1];
        at
    }

    /// Twice the travel between the planet tooth at the right mesh's line and the position opposite to the left line
    /// [rad].
    pub fn off_opposite(&self) -> f64 {
        let pair = &self.gears.pair;
        (i64::from(pair.gears[0].teeth) - 2 * self.gears.opposite()) as f64 * pair.base_pitch
    }

    /// Returns the coordinates in `of` that this kind of contact has.
    pub fn coordinates(&self, of: Range<usize>) -> Vec<usize> {
        of.filter(|i| i % 3 < if self.contact.is_displaced { 3 } else { 2 }).collect()
    }

    /// Unit of coordinate `i`, and of the reciprocal of its force: w is a length.
    pub fn unit(&self, i: usize) -> f64 {
        if i % 3 == 2 { self.cone() } else { 1.0 }
    }

    /// Largest force of both meshes as a torque. Flanks of both sides may cancel, except for their thrusts.
    pub fn scale(&self, at: &At) -> f64 {
        let scale = |[q, x, w, planet, side, _]: [f64; READINGS]| {
            q.abs().max(x.abs()).max(w.abs().max(planet.abs()).max(side.abs()) * self.cone())
        };
        self.forces(at).readings.into_iter().map(scale).fold(0.0, f64::max)
    }

    pub fn pattern(&self, at: &At) -> Pattern {
        let mut pattern = Pattern { nearest: [f64::INFINITY; 2], ..Pattern::default() };
        let mut pairs: Vec<(Name, f64)> = Vec::new();
        self.loaded(at, |load, slice| {
            let arc = load.depth / load.cone;
            // other pairs can also pull teeth into contact that then do not touch
            if arc <= 0.0 {
                return;
            }
            let (name, (cone, ends)) = ((load.side, load.flank, load.teeth), self.fixed(load, slice));
            let is_full = arc * self.cone() * PER_FULL_DEPTH >= 1.0;
            pattern.points.push((name, load.spot, cone, ends, [load.normal <= 0.0, is_full]));
            // the table of a corner's gap has ever shorter cells toward the end of the path
            let past_end = if load.spot == Spot::Path { f64::INFINITY } else { load.spot_arc };
            pattern.nearest[load.side] = pattern.nearest[load.side].min(past_end);
            match pairs.iter_mut().find(|(pair, _)| *pair == name) {
                Some((_, deepest)) => *deepest = deepest.max(arc),
                None => pairs.push((name, arc)),
            }
        });
        for ((side, ..), arc) in pairs {
            pattern.nearest[side] = pattern.nearest[side].min(arc);
            pattern.deepest[side] = pattern.deepest[side].max(arc);
        }
        pattern
    }

    /// Steps of differences by `coordinates`: the fraction `share` of the depth of each mesh, or `None` if anything
    /// switches within them.
    pub fn smooth_steps(&self, at: &At, share: f64, coordinates: &[usize]) -> Option<([f64; 12], Pattern)> {
        let here = self.pattern(at);
        let depth = here.deepest.map(|depth| depth.clamp(DEPTHS[0], DEPTHS[1]));
        // travel moves pairs past kinks of third order
        let share_of = |i: usize| if i % 3 == 1 { 0.3 * share } else { share };
        let steps = std::array::from_fn(|i| self.unit(i) * if i < 6 { share_of(i) * depth[i / 3] } else { 1e-3 });
        let is_deep = |depth: f64| depth == 0.0 || depth >= DEPTHS[0];
        let is_clear = (0..2).all(|s| is_deep(here.deepest[s]) && here.nearest[s] >= 60.0 * share * depth[s]);
        let is_same = |at: At| self.pattern(&at).points == here.points;
        let is_same = |i: &usize| [-2.0, 2.0].iter().all(|k| is_same(at.moved(*i, k * steps[*i])));
        (is_clear && coordinates.iter().all(is_same)).then_some((steps, here))
    }
}

impl Pattern {
    /// True if some pair has a partly loaded face, whose points move with the load.
    pub fn is_partly_loaded(&self) -> bool {
        self.points.iter().any(|(_, _, cone, ..)| cone.is_none())
    }

    /// Counts points with a partly loaded face, pairs by kind of contact, and flanks that separate.
    pub fn count(&self, counts: &mut [usize; 5]) {
        counts[0] += usize::from(self.is_partly_loaded());
        for (_, spot, _, _, [is_clipped, _]) in &self.points {
            counts[1 + *spot as usize] += 1;
            counts[4] += usize::from(*is_clipped);
        }
    }
}
