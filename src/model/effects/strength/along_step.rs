//! Damage and largest stresses along a step, by a quadrature over its dense output.
//!
//! Step-size control considers only the motion, but damage grows with the ninth or thirteenth power of the load. Loads
//! are therefore sampled at both ends and in the middle of a step. The step is halved while Simpson's rule differs from
//! the trapezoidal rule by more than [`ROUGH`] of the damage; the error of Simpson's rule is then about 1e-5. Peaks are
//! the maxima of the parabolas through these loads.

use super::overload::{Overload, Stressed};
use super::{Fatigue, FlankLoad, GearStrength, MeshLoad};
use crate::model::scene::MAX_GROUPS;
use crate::strength::interval::{Three, crest, extremum, mean, second_difference};
use crate::strength::{Cycle, Rating, loaded_flank};

/// Tolerated difference between Simpson's rule and the trapezoidal rule, as a fraction of the mean damage per cycle in
/// the step or the run.
const ROUGH: f64 = 0.02;
/// Tolerated second difference of a load at an extremum, as a fraction of the largest load. The extremum of the
/// parabola is then within an eighth of this difference from the nearest sample.
const BLUNT: f64 = 0.005;
/// Maximum number of halvings of a step.
const HALVINGS: u32 = 6;

/// Angles of the planets relative to the carrier by group [rad], or their rates [rad/s].
///
/// Side gears roll with the planets. Their own angles are not used, because they contain the elastic wind-up under
/// load, which brings no tooth into mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rolled {
    /// Values of the planets by group.
    pub spin: [f64; MAX_GROUPS],
}

impl Rolled {
    /// Mean over all planets, with `members` planets in each group.
    fn mean(&self, members: &[f64]) -> f64 {
        let (sum, count) =
            self.spin.iter().zip(members).fold((0.0, 0.0), |(sum, count), (spin, n)| (sum + n * spin, count + n));
        if count > 0.0 { sum / count } else { 0.0 }
    }

    /// Rolling of the side gears, up to the sign.
    fn side(&self, members: &[f64], rating: &Rating) -> f64 {
        self.mean(members) * rating.pitch[1] / rating.pitch[0]
    }
}

/// Loads and motion at an instant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sample {
    /// Angles.
    pub angle: Rolled,
    /// Rates of the angles.
    pub rate: Rolled,
    /// Loads of the meshes, by group and side.
    pub mesh: [[MeshLoad; 2]; MAX_GROUPS],
}

/// A completed step whose damage is to be counted.
pub struct RatedStep<'a> {
    /// Time at the beginning of the step [s].
    pub begin: f64,
    /// Size of the step [s].
    pub h: f64,
    /// Fraction of the step before which nothing is counted.
    pub from: f64,
    /// Number of planets in each group.
    pub members: &'a [f64],
    /// Writes the sample at a fraction of the step.
    pub sample: &'a mut dyn FnMut(f64, &mut Sample),
}

/// Damage per cycle to the planet's root, the side gear's root and the flanks.
type PerCycle = [f64; 3];
const PLANET_ROOT: usize = 0;
const SIDE_ROOT: usize = 1;
const PITTING: usize = 2;

/// Sample of a step, and the damage under its loads. It is large, so it is written in place.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rated {
    /// Fraction of the step at which the sample was taken.
    part: f64,
    sample: Sample,
    /// Damage per cycle, by group, side and flank.
    damage: [[[PerCycle; 2]; 2]; MAX_GROUPS],
}

/// Values of the worst tooth, with which differences are compared.
struct Scale {
    /// Damage per cycle.
    damage: PerCycle,
    /// Force that bends the tooth [N].
    bending: f64,
}

impl GearStrength {
    /// Advances the rolling of the gears over a step without counting its damage.
    pub fn roll(&self, fatigue: &mut Fatigue, members: &[f64], [from, to]: [&Rolled; 2]) {
        let Fatigue { planets, sides, in_mesh, .. } = fatigue;
        let rating = &self.rating;
        let pitch = rating.pitch;
        for (g, planet) in planets.iter_mut().enumerate() {
            planet.rolling.advance(to.spin[g] - from.spin[g], pitch[0]);
        }
        for side in sides {
            side.rolling.advance(to.side(members, rating) - from.side(members, rating), pitch[1]);
        }
        in_mesh.roll(rating, to.mean(members) - from.mean(members));
    }

    /// Counts the damage of a step. If `are_known` is true, `loads` contains the loads at its beginning. On return,
    /// `loads` contains the loads at its end, for the next step.
    pub fn count(&self, fatigue: &mut Fatigue, step: &mut RatedStep, loads: &mut Rated, are_known: bool) {
        if !are_known {
            self.rate(step, step.from, loads);
        }
        let begin = Rated { part: step.from, ..*loads };
        let mut middle = Rated::default();
        self.rate(step, 0.5 * (step.from + 1.0), &mut middle);
        self.rate(step, 1.0, loads);
        let parts = [&begin, &middle, &*loads];
        let mut scale =
            Scale { damage: fatigue.worst_per_cycle(), bending: self.force_of(fatigue.utilisation.root.share) };
        for_each_flank(step.members.len(), |g, s, flank| {
            let damage = |kind: usize| mean(parts.map(|at| at.damage[g][s][flank][kind]), [1.0; 3]);
            scale.damage.iter_mut().enumerate().for_each(|(kind, worst)| *worst = worst.max(damage(kind)));
            let bending = parts.map(|at| at.sample.mesh[g][s].flanks()[flank].bending);
            scale.bending = bending.into_iter().fold(scale.bending, f64::max);
        });
        self.count_part(fatigue, step, parts, &scale, HALVINGS);
    }

    /// Writes the sample at the fraction `part` of the step, and the damage per cycle under its loads.
    fn rate(&self, step: &mut RatedStep, part: f64, rated: &mut Rated) {
        rated.part = part;
        (step.sample)(part, &mut rated.sample);
        let rating = &self.rating;
        for_each_flank(step.members.len(), |g, s, flank| {
            let load = &rated.sample.mesh[g][s].flanks()[flank];
            let root = |i: usize| rating.bending[i].damage_per_cycle(rating.root[i].stress(load.bending));
            rated.damage[g][s][flank] = if load.bending > 0.0 {
                let pitting = rating.pitting.damage_per_cycle(self.rated_pressure(load));
                [root(0), root(1), pitting]
            } else {
                [0.0; 3]
            };
        });
    }

    /// Counts the damage of an interval, which is halved if necessary.
    fn count_part(
        &self,
        fatigue: &mut Fatigue,
        step: &mut RatedStep,
        [begin, middle, end]: [&Rated; 3],
        scale: &Scale,
        halvings: u32,
    ) {
        let parts = [begin, middle, end];
        if halvings == 0 || self.is_smooth(fatigue, step.members, parts, scale) {
            return self.add(fatigue, step, parts);
        }
        for [begin, end] in [[begin, middle], [middle, end]] {
            let mut middle = Rated::default();
            self.rate(step, 0.5 * (begin.part + end.part), &mut middle);
            self.count_part(fatigue, step, [begin, &middle, end], scale, halvings - 1);
        }
    }

    /// True if parabolas describe the loads and the damage of an interval.
    fn is_smooth(&self, fatigue: &Fatigue, members: &[f64], parts: [&Rated; 3], scale: &Scale) -> bool {
        let pitch = self.rating.pitch;
        // fraction of the interval in which the teeth of a gear count, and the rates at which the gear turns
        let planet = |g: usize| {
            let step = parts[2].sample.angle.spin[g] - parts[0].sample.angle.spin[g];
            (fatigue.planets[g].rolling.counting(step, pitch[0]), parts.map(|at| at.sample.rate.spin[g]))
        };
        let side = |s: usize| {
            let of = |rolled: &Rolled| rolled.side(members, &self.rating);
            let step = of(&parts[2].sample.angle) - of(&parts[0].sample.angle);
            (fatigue.sides[s].rolling.counting(step, pitch[1]), parts.map(|at| of(&at.sample.rate)))
        };
        let mut smooth = true;
        for_each_flank(members.len(), |g, s, flank| {
            let bending = parts.map(|at| at.sample.mesh[g][s].flanks()[flank].bending);
            smooth &= extremum(bending).is_none() || second_difference(bending).abs() <= BLUNT * scale.bending;
            for (kind, (counting, rates)) in [(PLANET_ROOT, planet(g)), (PITTING, planet(g)), (SIDE_ROOT, side(s))] {
                let damage = parts.map(|at| at.damage[g][s][flank][kind]);
                smooth &= counting == 0.0 || is_smooth(damage, rates, counting, ROUGH * scale.damage[kind]);
            }
        });
        smooth
    }

    /// Adds the damage of an interval, and the swings of the forces that bend teeth in mesh.
    fn add(&self, fatigue: &mut Fatigue, step: &RatedStep, parts: [&Rated; 3]) {
        self.watch(fatigue, step, parts);
        let rating = &self.rating;
        let [begin, _, end] = parts.map(|at| &at.sample);
        let cycle = |(g, s, flank): (usize, usize, usize), far: bool, root: usize, rates: Three| {
            let damage = |kind: usize| mean(parts.map(|at| at.damage[g][s][flank][kind]), rates);
            Cycle { flank: loaded_flank(far, flank == 0), root: damage(root), pitting: damage(PITTING) }
        };
        for g in 0..step.members.len() {
            let rates = parts.map(|at| at.sample.rate.spin[g]);
            let of = |s: usize, flank: usize| cycle((g, s, flank), s == 1, PLANET_ROOT, rates);
            let cycles = [of(0, 0), of(0, 1), of(1, 0), of(1, 1)];
            fatigue.planets[g].add(end.angle.spin[g] - begin.angle.spin[g], rating.pitch[0], cycles);
        }
        let of_side = |rolled: &Rolled| rolled.side(step.members, rating);
        let (angle, rates) = (of_side(&end.angle) - of_side(&begin.angle), parts.map(|at| of_side(&at.sample.rate)));
        for s in 0..2 {
            let cycles = step.members.iter().enumerate().flat_map(|(g, &members)| {
                let both = [0, 1].map(|flank| cycle((g, s, flank), false, SIDE_ROOT, rates));
                std::iter::repeat_n(both, members as usize).flatten()
            });
            fatigue.sides[s].add(angle, rating.pitch[1], cycles);
        }
        let forces = [0, 1].map(|s| {
            parts.map(|at| {
                let forces = at.sample.mesh[..step.members.len()].iter().map(|both| both[s].bending());
                forces.reduce(|a, b| if b.abs() > a.abs() { b } else { a }).unwrap_or_default()
            })
        });
        let (from, to) = (begin.angle.mean(step.members), end.angle.mean(step.members));
        let planets = step.members.iter().sum::<f64>() as usize;
        fatigue.in_mesh.add(rating, planets, to - from, forces);
    }

    /// Records the largest ratios of stress to strength, and the first stresses above the strength. While a planet
    /// rolls, its bending strength is reduced by the idler factor.
    fn watch(&self, fatigue: &mut Fatigue, step: &RatedStep, parts: [&Rated; 3]) {
        let rating = &self.rating;
        let span = parts[2].part - parts[0].part;
        for_each_flank(step.members.len(), |group, side, flank| {
            let load =
                |of: fn(&FlankLoad) -> f64| crest(parts.map(|at| of(&at.sample.mesh[group][side].flanks()[flank])));
            let (bending, normal) = (load(|flank| flank.bending), load(|flank| flank.normal_face_loaded));
            if bending.0 <= 0.0 {
                return;
            }
            let angle = parts[2].sample.angle.spin[group] - parts[0].sample.angle.spin[group];
            let rolls = fatigue.planets[group].rolling.counting(angle, rating.pitch[0]) > 0.0;
            let at = |place: f64, stress: f64, strength: f64| {
                let time = step.begin + (parts[0].part + place * span) * step.h;
                Overload { time, stress, strength, group, side }
            };
            let root = |i: usize, strength: f64| at(bending.1, rating.root[i].stress(bending.0), strength);
            let pressure = rating.contact.rated_pressure(normal.0).unwrap_or(0.0);
            let loads = [
                (Stressed::PlanetRoot, root(0, rating.bending[usize::from(!rolls)].strength)),
                (Stressed::SideRoot, root(1, rating.bending[1].strength)),
                (Stressed::Flanks, at(normal.1, pressure, rating.pitting.strength)),
            ];
            for (what, load) in loads {
                fatigue.overloads.watch(what, load);
                fatigue.utilisation.watch(what, &load);
            }
        });
    }

    /// Force on the teeth that uses `share` of the strength of the weaker root [N].
    fn force_of(&self, share: f64) -> f64 {
        let of = |i: usize| self.rating.bending[i].strength / self.rating.root[i].per_force;
        share * of(0).min(of(1))
    }
}

/// True if a parabola describes the damage at these rates to within `least`. `counting` is the fraction of the interval
/// that counts.
fn is_smooth(damage: Three, rates: Three, counting: f64, least: f64) -> bool {
    let rates = rates.map(f64::abs);
    let fastest = rates.into_iter().fold(0.0, f64::max);
    let done = [0, 1, 2].map(|k| damage[k] * rates[k]);
    // if only a fraction of the interval counts, the load within it is unknown, so the damage must be almost constant
    let spread = damage.into_iter().fold(0.0, f64::max) - damage.into_iter().fold(f64::INFINITY, f64::min);
    second_difference(done).abs() <= 3.0 * least * fastest && (counting == 1.0 || spread <= least)
}

/// Visits all flanks with group, side, and 0 for drive or 1 for coast.
fn for_each_flank(groups: usize, mut visit: impl FnMut(usize, usize, usize)) {
    for g in 0..groups {
        for s in 0..2 {
            visit(g, s, 0);
            visit(g, s, 1);
        }
    }
}
