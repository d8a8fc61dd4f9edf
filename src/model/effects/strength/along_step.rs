//! Damage and largest stresses along a step, from its dense output.
//!
//! Step-size control considers only the motion, but damage grows with the ninth or thirteenth power of the load. Loads
//! are therefore sampled at both ends and in the middle of a step. The step is halved until parabolas through the
//! samples describe the peaks of root stress to [`BLUNT`], and the loads of flanks that pass their rated point to
//! [`ROUGH`]. Each tooth has its own load history ([`crate::strength::ToothHistory`]).

use super::fatigue::MeshRolling;
use super::overload::{Overload, Stressed};
use super::{Fatigue, GearStrength, MeshLoad, Sample};
use crate::contact::detailed::PairName;
use crate::contact::{Flank, FlankGaps};
use crate::model::scene::MAX_PLANETS;
use crate::strength::interval::{Three, at, crest, extremum, is_loaded_throughout, load_at, second_difference};
use crate::strength::{Passing, loaded_flank};

/// Tolerated second difference of the root stress of a tooth at its largest peak, as a fraction of this stress. The
/// peak of the parabola is then within an eighth of this difference from the nearest sample. Lower peaks do less
/// damage, and their tolerance grows with the fourth power of the ratio.
const BLUNT: f64 = 0.005;
/// Tolerated second difference of the load of a flank that passes its rated point, as a fraction of the load.
const ROUGH: f64 = 0.02;
/// Largest roll of a planet in an interval in which the loads of its tooth pairs are parabolas, in pitches.
const LONGEST_ROLL: f64 = 0.25;
/// Largest roll of a planet after which its teeth still meet one side gear only, as a fraction of a revolution.
const ONE_MESH: f64 = 0.4;
/// Maximum number of pieces into which an interval is divided, so that teeth meet the side gears in the right order.
const MOST_PIECES: f64 = 256.0;
/// Maximum number of halvings of a step.
const HALVINGS: u32 = 6;
/// Sense of the roll of a planet's teeth through the left and the right mesh.
const SENSE: [f64; 2] = [-1.0, 1.0];
/// Maximum number of teeth of a gear in a mesh at the three instants of an interval.
const MOST_TEETH: usize = 18;

/// A planet whose teeth are rated.
#[derive(Clone, Copy, Debug)]
pub struct RatedPlanet {
    /// Index of the planet.
    pub planet: usize,
    /// Group of planets whose loads it has.
    pub loads: usize,
    /// Group of planets whose teeth have the same histories.
    pub histories: usize,
    /// True for one planet of each group with the same histories.
    pub represents: bool,
    /// Phases of both meshes in pitches.
    pub phase: [f64; 2],
    /// Number by which the teeth in mesh are ahead of those at the present angle, by side: the whole pitches that were
    /// removed from the angle.
    pub shift: [i64; 2],
    /// Number of side gear teeth from the planet that represents its group to this one, by side.
    pub ahead: [usize; 2],
}

/// A completed step whose damage is to be counted.
pub struct RatedStep<'a> {
    /// Time at the beginning of the step [s].
    pub begin: f64,
    /// Size of the step [s].
    pub h: f64,
    /// Fraction of the step before which nothing is counted.
    pub from: f64,
    /// Planets.
    pub planets: &'a [RatedPlanet],
    /// Numbers of the teeth.
    pub numbers: &'a FlankGaps,
    /// Writes the sample at a fraction of the step.
    pub sample: &'a mut dyn FnMut(f64, &mut Sample),
}

/// Instants at the start, in the middle and at the end of an interval.
struct Interval<'a> {
    parts: [&'a Sample; 3],
    /// True if parabolas describe the loads.
    is_smooth: bool,
}

impl RatedPlanet {
    /// Positions of the teeth in the mesh of side `s`, in pitches: tooth n is in the middle at position n.
    fn positions(&self, parts: &[&Sample; 3], s: usize) -> Three {
        parts.map(|at| SENSE[s] * at.angle[self.loads] - self.phase[s])
    }

    /// Loads of the mesh of side `s`.
    fn meshes<'a>(&self, parts: &[&'a Sample; 3], s: usize) -> [&'a MeshLoad; 3] {
        parts.map(|at| &at.mesh[self.loads][s])
    }
}

impl GearStrength {
    /// Counts the damage of a step. If `are_known` is true, `loads` contains the loads at its beginning. On return,
    /// `loads` contains the loads at its end, for the next step.
    pub fn count(&self, fatigue: &mut Fatigue, step: &mut RatedStep, loads: &mut Sample, are_known: bool) {
        if !are_known {
            sample(step, step.from, loads);
            self.unload_others(fatigue, step, loads);
        }
        let begin = Sample { part: step.from, ..*loads };
        let mut middle = Sample::default();
        sample(step, 0.5 * (step.from + 1.0), &mut middle);
        sample(step, 1.0, loads);
        self.count_part(fatigue, step, [&begin, &middle, &*loads], HALVINGS);
    }

    /// Counts the damage of an interval, which is halved if necessary.
    fn count_part(
        &self,
        fatigue: &mut Fatigue,
        step: &mut RatedStep,
        [begin, middle, end]: [&Sample; 3],
        halvings: u32,
    ) {
        let parts = [begin, middle, end];
        let is_smooth = self.is_smooth(fatigue, step, &parts);
        if halvings == 0 || is_smooth {
            return self.add(fatigue, step, &Interval { parts, is_smooth });
        }
        for [begin, end] in [[begin, middle], [middle, end]] {
            let mut middle = Sample::default();
            sample(step, 0.5 * (begin.part + end.part), &mut middle);
            self.count_part(fatigue, step, [begin, &middle, end], halvings - 1);
        }
    }

    /// True if parabolas describe the loads of an interval.
    fn is_smooth(&self, fatigue: &Fatigue, step: &RatedStep, parts: &[&Sample; 3]) -> bool {
        step.planets.iter().filter(|planet| planet.represents).all(|planet| {
            [0, 1].into_iter().all(|s| {
                let (positions, meshes) = (planet.positions(parts, s), planet.meshes(parts, s));
                if !self.is_single && (positions[2] - positions[0]).abs() > LONGEST_ROLL {
                    return false;
                }
                let passes = |flank: usize| {
                    let [begin, _, end] = self.rated_positions(positions, flank).map(f64::floor);
                    begin != end || extremum(positions).is_some()
                };
                let are_flanks_smooth = [0, 1].into_iter().all(|flank| {
                    let load = meshes.map(|mesh| mesh.flanks()[flank].normal_face_loaded);
                    let largest = load.into_iter().fold(0.0, f64::max);
                    !is_loaded_throughout(load) || !passes(flank) || second_difference(load).abs() <= ROUGH * largest
                });
                let mut smooth = are_flanks_smooth;
                self.for_each_tooth(planet, s, 0, meshes, |_, stress| {
                    smooth &= is_peak_smooth(stress, fatigue.tally.largest_stress);
                });
                smooth
            })
        })
    }

    /// Adds an interval to the damage.
    fn add(&self, fatigue: &mut Fatigue, step: &RatedStep, interval: &Interval) {
        if self.is_single {
            let pieces = self.pieces(step, &interval.parts);
            for piece in 0..pieces {
                let span = [piece, piece + 1].map(|end| f64::from(end) / f64::from(pieces));
                for planet in step.planets.iter().filter(|planet| planet.represents) {
                    (0..2).for_each(|s| self.bend_tooth_in_mesh(fatigue, step, interval, (planet, s), span));
                }
            }
        } else {
            for planet in step.planets {
                (0..2).for_each(|s| self.bend_pairs(fatigue, step, interval, (planet, s)));
            }
        }
        for planet in step.planets.iter().filter(|planet| planet.represents) {
            (0..2).for_each(|s| self.pass_rated_points(fatigue, step, &interval.parts, (planet, s)));
        }
        self.watch_flanks(fatigue, step, interval);
    }

    /// Number of pieces of an interval in each of which a planet's tooth meets only one side gear.
    fn pieces(&self, step: &RatedStep, parts: &[&Sample; 3]) -> u32 {
        let rolled = |planet: &RatedPlanet| {
            let [begin, middle, end] = planet.positions(parts, 0);
            (middle - begin).abs() + (end - middle).abs()
        };
        let most = step.planets.iter().map(rolled).fold(0.0, f64::max);
        (most / (ONE_MESH * self.rating.teeth[0] as f64)).ceil().clamp(1.0, MOST_PIECES) as u32
    }

    /// Bends the teeth of all pairs of a mesh.
    fn bend_pairs(
        &self,
        fatigue: &mut Fatigue,
        step: &RatedStep,
        interval: &Interval,
        (planet, s): (&RatedPlanet, usize),
    ) {
        let meshes = planet.meshes(&interval.parts, s);
        for gear in [0, 1] {
            if gear == 1 || planet.represents {
                self.for_each_tooth(planet, s, gear, meshes, |tooth, stress| {
                    let index = self.index(fatigue, planet, s, gear, tooth);
                    self.bend(fatigue, (step, interval), (index, gear, planet, s), (stress, [0.0, 1.0], 1.0));
                });
            }
        }
    }

    /// Visits the teeth of `gear` (0 planet, 1 side gear) in the pairs of a mesh, with their root stress at the three
    /// instants [Pa], positive under load on flank 0.
    fn for_each_tooth(
        &self,
        planet: &RatedPlanet,
        s: usize,
        gear: usize,
        meshes: [&MeshLoad; 3],
        mut visit: impl FnMut(usize, Three),
    ) {
        let (mut teeth, mut count) = ([(0, [0.0; 3]); MOST_TEETH], 0);
        for (instant, mesh) in meshes.into_iter().enumerate() {
            for pair in mesh.pairs() {
                let tooth = if self.is_single { 0 } else { pair.teeth[gear] };
                let known = teeth[..count].iter().position(|(known, _)| *known == tooth);
                let index = known.unwrap_or_else(|| {
                    (teeth[count], count) = ((tooth, [0.0; 3]), count + 1);
                    count - 1
                });
                let flank = loaded_flank(gear == 0 && s == 1, pair.drives);
                teeth[index].1[instant] += if flank == 0 { pair.stress[gear] } else { -pair.stress[gear] };
            }
        }
        let ahead = if gear == 1 { planet.ahead[s] } else { 0 };
        teeth[..count].iter().for_each(|&(tooth, stress)| visit(tooth + ahead, stress));
    }

    /// Index of the history of a tooth.
    fn index(&self, fatigue: &Fatigue, planet: &RatedPlanet, s: usize, gear: usize, tooth: usize) -> usize {
        if gear == 0 { fatigue.of_planet(planet.histories, tooth) } else { fatigue.of_side(s, tooth) }
    }

    /// Bends the tooth that represents a mesh with one spring, and the teeth that enter the mesh, during the span
    /// `[from, until]` of an interval.
    fn bend_tooth_in_mesh(
        &self,
        fatigue: &mut Fatigue,
        step: &RatedStep,
        interval: &Interval,
        (planet, s): (&RatedPlanet, usize),
        [mut from, until]: [f64; 2],
    ) {
        let (positions, meshes) = (planet.positions(&interval.parts, s), planet.meshes(&interval.parts, s));
        let mut stresses = [[0.0; 3]; 2];
        for gear in [0, 1] {
            self.for_each_tooth(planet, s, gear, meshes, |_, stress| stresses[gear] = stress);
        }
        let bend = |fatigue: &mut Fatigue, tooth: i64, span: Option<[f64; 2]>, weight: f64| {
            for member in step.planets.iter().filter(|member| member.histories == planet.histories) {
                let teeth = step.numbers.teeth(PairName { planet: member.planet, side: s, flank: Flank::Drive, tooth });
                for gear in [0, 1] {
                    if gear == 1 || member.represents {
                        let index = self.index(fatigue, member, s, gear, teeth[gear]);
                        match span {
                            Some(span) => {
                                let load = (stresses[gear], span, weight);
                                self.bend(fatigue, (step, interval), (index, gear, member, s), load);
                            }
                            None => {
                                let stress = fatigue.tooth_mut(index).bend(&self.rating.bending, 0.0, weight);
                                self.watch_root(fatigue, (step, interval), (gear, member, s), (stress, until));
                            }
                        }
                    }
                }
            }
        };
        let mut rolling = fatigue.tally.meshes[planet.histories][s].in_mesh;
        let before = rolling.tooth;
        let (mut tooth, mut weight) = (rolling.at(at(positions, from), planet.shift[s]), 1.0);
        if let Some(left) = before.filter(|&before| before != tooth) {
            bend(fatigue, left, None, 1.0);
            bend(fatigue, tooth, None, 1.0);
        }
        rolling.roll(positions, planet.shift[s], [from, until], |passing| {
            bend(fatigue, tooth, Some([from, passing.part]), weight);
            bend(fatigue, tooth, None, weight);
            (tooth, from, weight) = (passing.tooth, passing.part, passing.weight);
            bend(fatigue, tooth, None, weight);
        });
        bend(fatigue, tooth, Some([from, until]), weight);
        fatigue.tally.meshes[planet.histories][s].in_mesh = rolling;
    }

    /// Bends the tooth with the history `index` under a `stress` [Pa] during a span of an interval. The cycles count
    /// `weight` times.
    fn bend(
        &self,
        fatigue: &mut Fatigue,
        (step, interval): (&RatedStep, &Interval),
        (index, gear, planet, side): (usize, usize, &RatedPlanet, usize),
        (stress, [from, to], weight): (Three, [f64; 2], f64),
    ) {
        let bending = &self.rating.bending;
        let within = |part: f64| part > from && part < to;
        let turn = extremum(stress).filter(|_| interval.is_smooth && is_loaded_throughout(stress));
        let turn = turn.map(|(_, part)| part).filter(|&part| within(part));
        let middle = Some(0.5).filter(|&part| within(part));
        let between = if turn < middle { [turn, middle] } else { [middle, turn] };
        let (mut largest, mut when) = (0.0f64, from);
        for part in [Some(from), between[0], between[1], Some(to)].into_iter().flatten() {
            let now = load_at(stress, part);
            fatigue.tally.largest_stress = fatigue.tally.largest_stress.max(now.abs());
            let found = now.abs().max(fatigue.tooth_mut(index).bend(bending, now, weight));
            if found > largest {
                (largest, when) = (found, part);
            }
        }
        self.watch_root(fatigue, (step, interval), (gear, planet, side), (largest, when));
    }

    /// Records a root `stress` [Pa] at the fraction `part` of an interval if it is the largest so far.
    fn watch_root(
        &self,
        fatigue: &mut Fatigue,
        (step, interval): (&RatedStep, &Interval),
        (gear, planet, side): (usize, &RatedPlanet, usize),
        (stress, part): (f64, f64),
    ) {
        let (strength, group) = (self.rating.bending.curve.strength, planet.histories);
        let load = Overload { time: time(step, interval, part), stress, strength, group, side };
        fatigue.tally.watch(if gear == 0 { Stressed::PlanetRoot } else { Stressed::SideRoot }, load);
    }

    /// Removes the load from teeth that no pair of `begin` loads. Loads jump where the inputs do.
    fn unload_others(&self, fatigue: &mut Fatigue, step: &RatedStep, begin: &Sample) {
        if self.is_single {
            return;
        }
        let (mut loaded, mut count) = ([0; MAX_PLANETS * 2 * 2 * MOST_TEETH], 0);
        for planet in step.planets {
            for (s, gear) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                self.for_each_tooth(planet, s, gear, [&begin.mesh[planet.loads][s]; 3], |tooth, _| {
                    loaded[count] = self.index(fatigue, planet, s, gear, tooth);
                    count += 1;
                });
            }
        }
        for index in 0..fatigue.count() {
            if fatigue.tooth(index).is_loaded() && !loaded[..count].contains(&index) {
                fatigue.tooth_mut(index).bend(&self.rating.bending, 0.0, 1.0);
            }
        }
    }

    /// Positions of the contact of a flank relative to the rated point of tooth 0, in pitches.
    fn rated_positions(&self, positions: Three, flank: usize) -> Three {
        positions.map(|position| if flank == 0 { position + self.rated_point } else { position - self.rated_point })
    }

    /// Counts the passages of the contact over the rated points of the flanks of a mesh.
    fn pass_rated_points(
        &self,
        fatigue: &mut Fatigue,
        step: &RatedStep,
        parts: &[&Sample; 3],
        (planet, s): (&RatedPlanet, usize),
    ) {
        let (positions, meshes) = (planet.positions(parts, s), planet.meshes(parts, s));
        let MeshRolling { mut rated, .. } = fatigue.tally.meshes[planet.histories][s];
        for (number, flank) in [Flank::Drive, Flank::Coast].into_iter().enumerate() {
            let force = meshes.map(|mesh| mesh.flanks()[number].normal_face_loaded);
            rated[number].pass(self.rated_positions(positions, number), planet.shift[s], |passing| {
                self.pass(fatigue, step, (planet, s, flank), (force, &passing));
            });
        }
        fatigue.tally.meshes[planet.histories][s].rated = rated;
    }

    /// Counts a passage of the contact over the rated point of a `flank` in the mesh of side `s`, under the `force` [N]
    /// during the interval.
    fn pass(
        &self,
        fatigue: &mut Fatigue,
        step: &RatedStep,
        (planet, s, flank): (&RatedPlanet, usize, Flank),
        (force, passing): (Three, &Passing),
    ) {
        let force = load_at(force, passing.part);
        let pressure = self.rating.contact.rated_pressure(force).unwrap_or(0.0);
        let damage = passing.weight * self.rating.pitting.damage_per_cycle(pressure);
        if damage == 0.0 {
            return;
        }
        let drives = flank == Flank::Drive;
        for member in step.planets.iter().filter(|member| member.histories == planet.histories) {
            let name = PairName { planet: member.planet, side: s, flank, tooth: passing.tooth };
            let teeth = step.numbers.teeth(name);
            if member.represents {
                let index = fatigue.of_planet(member.histories, teeth[0]);
                fatigue.tooth_mut(index).pass(loaded_flank(s == 1, drives), damage);
            }
            let index = fatigue.of_side(s, teeth[1]);
            fatigue.tooth_mut(index).pass(loaded_flank(false, drives), damage);
        }
    }

    /// Records the largest ratios of contact stress to strength, and the first contact stress above the strength.
    fn watch_flanks(&self, fatigue: &mut Fatigue, step: &RatedStep, interval: &Interval) {
        for planet in step.planets.iter().filter(|planet| planet.represents) {
            for side in 0..2 {
                for flank in 0..2 {
                    let load = planet.meshes(&interval.parts, side).map(|mesh| mesh.flanks()[flank].normal_face_loaded);
                    let (force, part) =
                        if interval.is_smooth && is_loaded_throughout(load) { crest(load) } else { largest(load) };
                    let load = Overload {
                        time: time(step, interval, part),
                        stress: self.rating.contact.rated_pressure(force).unwrap_or(0.0),
                        strength: self.rating.pitting.strength,
                        group: planet.histories,
                        side,
                    };
                    fatigue.tally.watch(Stressed::Flanks, load);
                }
            }
        }
    }
}

/// Writes the sample at the fraction `part` of the step.
fn sample(step: &mut RatedStep, part: f64, to: &mut Sample) {
    to.part = part;
    (step.sample)(part, to);
}

/// Time at the fraction `part` of an interval [s].
fn time(step: &RatedStep, interval: &Interval, part: f64) -> f64 {
    let [begin, _, end] = interval.parts.map(|at| at.part);
    step.begin + (begin + part * (end - begin)) * step.h
}

/// True if a parabola describes the peak of the root stress of a tooth; `scale` is the largest root stress so far [Pa].
fn is_peak_smooth(stress: Three, scale: f64) -> bool {
    if !is_loaded_throughout(stress) || extremum(stress).is_none() {
        return true;
    }
    let peak = stress.into_iter().map(f64::abs).fold(0.0, f64::max);
    let ratio = (scale / peak).max(1.0);
    second_difference(stress).abs() <= BLUNT * peak * ratio * (ratio * ratio) * (ratio * ratio)
}

/// Largest value, and the fraction of the interval at which it was sampled.
fn largest(values: Three) -> (f64, f64) {
    let [begin, middle, end] = values;
    if middle >= begin && middle >= end {
        (middle, 0.5)
    } else if begin > end {
        (begin, 0.0)
    } else {
        (end, 1.0)
    }
}
