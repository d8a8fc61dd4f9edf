//! Interference check of planet and side gear: penetration of their teeth while turning, and their smallest clearance.
//!
//! Both apexes coincide and the gears turn by Willis' equation. A planet turned by θ from a tooth in the plane of both
//! axes faces a gap of the side gear turned by θ z_p/z_s. All meshes of a differential pass through the same positions,
//! half a tooth pitch apart, and left and right are mirror images. One pair over one pitch therefore covers all meshes.
//! The pair is examined in two stances. In the first, teeth are in the middle of the tooth spaces, with equal backlash
//! on both flanks. In the second, all backlash is closed on one side, as in running gears; flanks then touch, and
//! nothing else may touch.
//!
//! A ray of one gear can be inside the other gear. Its *depth* is then the distance from the nearest face of the other
//! gear, along the normal of this face. Each gear has one ray through each node of its outline, including the corners
//! of the tip. The rays of either gear are tested against the other gear. The gap between flanks that do not touch is
//! found in the same way. All faces are cones with one apex, so depth and gap are proportional to the cone distance.
//! They are given per cone distance [rad]; depth is largest at the heel, gap smallest at the toe.
//!
//! Facets are chords of the exact faces. Results are accurate to the *resolution*: twice the largest distance of the
//! facets from the faces, summed over both gears, because rays of one gear also meet the other between its nodes.

use nalgebra::Vector3;

use super::outline::Part;
use super::skin::Skin;
use crate::geometry::assembly::between_planets;
use crate::geometry::involute::direction;
use crate::geometry::{GearSpec, Pair};
use crate::numeric::{TAU, acos, atan2, cos, sin};

/// Facets per flank.
pub const FACETS: usize = 128;
/// Number of positions in a tooth pitch.
pub const POSITIONS: usize = 24;
/// Number of bisections of the step between positions near the worst position.
const HALVINGS: usize = 8;
/// Rays farther than this beyond the mate's tip cone [rad] are skipped.
const REACH: f64 = 0.05;

/// Smallest distance, or deepest penetration, of two parts of teeth over the whole cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Approach {
    /// Parts of planet and side gear.
    pub parts: [Part; 2],
    /// Distance per cone distance [rad]; negative is depth.
    pub gap: f64,
    /// Gear of the ray (0 planet, 1 side gear). The distance is from a face of the other gear.
    pub ray: usize,
    /// Angle of the ray from the axes of planet and side gear [rad].
    pub polar: [f64; 2],
    /// Angle of the ray out of the plane of both axes, about the planet's axis [rad].
    pub azimuth: f64,
    /// Rotation θ of the planet from a tooth in the plane of both axes [rad], within half a pitch.
    pub turn: f64,
    /// Tooth of each gear, counted from the tooth in or next to the plane by rising azimuth about the gear's own axis.
    pub teeth: [i32; 2],
}

/// Position of teeth in their gaps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stance {
    /// In the middle of the gap.
    Middle,
    /// At one flank, with all backlash on the other side.
    Driving,
}

/// Result of the check.
#[derive(Clone, Debug, PartialEq)]
pub struct Interference {
    /// Smallest distance or deepest penetration of every two parts, the worst first. Two flanks come first unless
    /// another distance is smaller by more than the resolution.
    pub approaches: Vec<Approach>,
    /// Accuracy of gaps and depths per cone distance [rad].
    pub resolution: f64,
    /// Angle between the tip cones of neighbouring planets, and between those of the two side gears [rad]; negative if
    /// they overlap.
    pub between_tips: [f64; 2],
}

/// Meaning of a gap.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Nothing touches.
    Clear,
    /// The distance or depth is within the resolution.
    Touching,
    /// Something penetrates.
    Interfering,
}

impl Interference {
    /// Examines `pair`, built from `spec`, in one stance. Returns `None` if its surface cannot be built. Backlash may
    /// be negative.
    pub fn new(pair: &Pair, spec: &GearSpec, stance: Stance) -> Option<Self> {
        Self::stoppable(pair, spec, stance, &mut || true)
    }

    /// Examines `pair` like [`Self::new`]. It calls `go_on` at every position and returns `None` if `go_on` returns
    /// false.
    pub fn stoppable(pair: &Pair, spec: &GearSpec, stance: Stance, go_on: &mut dyn FnMut() -> bool) -> Option<Self> {
        let skins = [Skin::new(pair, spec, 0, FACETS)?, Skin::new(pair, spec, 1, FACETS)?];
        let resolution = 2.0 * skins.iter().map(|skin| skin.coarseness(pair, spec, FACETS)).sum::<f64>();
        let nodes = [0, 1].map(|i| Vec::from_iter(skins[i].nodes.iter().map(|n| direction(n.polar, n.azimuth))));
        let lag = match stance {
            Stance::Middle => 0.0,
            Stance::Driving => pair.normal_backlash.max(0.0) / 2.0 / sin(pair.gears[1].base),
        };
        let cycle = MeshingCycle { pair, skins, nodes, lag };
        let mut found = Vec::new();
        let mut step = pair.gears[0].tooth_pitch() / POSITIONS as f64;
        for k in 0..POSITIONS {
            go_on().then_some(())?;
            cycle.examine(step * (k as f64 - (POSITIONS / 2) as f64), &mut found);
        }
        // refine around the worst position
        for _ in 0..HALVINGS {
            go_on().then_some(())?;
            step /= 2.0;
            let middle = worst(&found).map_or(0.0, |approach| approach.turn);
            cycle.examine(middle - step, &mut found);
            cycle.examine(middle + step, &mut found);
        }
        let rank = |a: &Approach| if a.parts == [Part::Flank; 2] { a.gap - resolution } else { a.gap };
        found.sort_by(|a, b| rank(a).total_cmp(&rank(b)));
        let between_tips = [between_planets(pair, spec.planet_count), TAU / 2.0 - 2.0 * pair.gears[1].tip];
        Some(Self { approaches: found, resolution, between_tips })
    }

    /// Meaning of `gap`.
    pub fn verdict(&self, gap: f64) -> Verdict {
        match gap {
            gap if gap > self.resolution => Verdict::Clear,
            gap if gap < -self.resolution => Verdict::Interfering,
            _ => Verdict::Touching,
        }
    }

    /// Smallest distance or deepest penetration of all teeth.
    pub fn worst(&self) -> Option<&Approach> {
        self.approaches.first()
    }

    /// True if teeth penetrate or tip cones overlap.
    pub fn any(&self) -> bool {
        let teeth = self.worst().is_some_and(|worst| self.verdict(worst.gap) == Verdict::Interfering);
        teeth || self.between_tips.iter().any(|&angle| angle < 0.0)
    }
}

fn worst(found: &[Approach]) -> Option<&Approach> {
    found.iter().min_by(|a, b| a.gap.total_cmp(&b.gap))
}

/// Both gears of a pair with their surfaces, for any rotation.
struct MeshingCycle<'a> {
    pair: &'a Pair,
    skins: [Skin; 2],
    /// Rays of tooth 0 of either gear.
    nodes: [Vec<Vector3<f64>>; 2],
    /// Rotation of the side gear from the middle of its backlash [rad].
    lag: f64,
}

impl MeshingCycle<'_> {
    /// Rotations of planet and side gear about their own axes if the planet is turned by `turn` [rad].
    fn turns(&self, turn: f64) -> [f64; 2] {
        let [planet, side] = &self.pair.gears;
        [turn, self.lag + side.tooth_pitch() / 2.0 - turn * f64::from(planet.teeth) / f64::from(side.teeth)]
    }

    /// Examines one position and keeps approaches that are nearer than those in `found`.
    fn examine(&self, turn: f64, found: &mut Vec<Approach>) {
        let turns = self.turns(turn);
        for own in 0..2 {
            let mate = 1 - own;
            let (skin, gear) = (&self.skins[own], &self.skins[own].gear);
            let back = Turn::new(-turns[mate]);
            let reach = cos(self.skins[mate].gear.tip + REACH);
            for tooth in (0..gear.teeth).map(|k| k - gear.teeth / 2) {
                let angle = Turn::new(turns[own] + gear.tooth_pitch() * f64::from(tooth));
                for (node, ray) in skin.nodes.iter().zip(&self.nodes[own]) {
                    let here = angle.of(ray);
                    let there = across(&here, self.pair.shaft_angle);
                    if there.z < reach {
                        continue;
                    }
                    let nearest = self.skins[mate].nearest(&back.of(&there));
                    let ordered = |mine: f64, others: f64| if own == 0 { [mine, others] } else { [others, mine] };
                    let planets = if own == 0 { here } else { there };
                    let new = Approach {
                        parts: if own == 0 { [node.part, nearest.part] } else { [nearest.part, node.part] },
                        gap: nearest.gap,
                        ray: own,
                        polar: ordered(node.polar, acos(there.z.clamp(-1.0, 1.0))),
                        azimuth: atan2(planets.y, planets.x),
                        turn,
                        teeth: if own == 0 { [tooth, nearest.tooth] } else { [nearest.tooth, tooth] },
                    };
                    keep(found, new);
                }
            }
        }
    }
}

fn keep(found: &mut Vec<Approach>, new: Approach) {
    match found.iter_mut().find(|known| known.parts == new.parts) {
        Some(known) if new.gap < known.gap => *known = new,
        Some(_) => {}
        None => found.push(new),
    }
}

/// Converts a vector from one gear's unrotated frame to that of its mate. In both frames, x points toward the other
/// axis and the mate is across the same plane y = 0, so the conversion is its own inverse.
fn across(v: &Vector3<f64>, shaft_angle: f64) -> Vector3<f64> {
    let (s, c) = (sin(shaft_angle), cos(shaft_angle));
    Vector3::new(s * v.z - c * v.x, -v.y, s * v.x + c * v.z)
}

/// A rotation about z, as its sine and cosine.
struct Turn(f64, f64);

impl Turn {
    fn new(angle: f64) -> Self {
        Self(sin(angle), cos(angle))
    }

    fn of(&self, v: &Vector3<f64>) -> Vector3<f64> {
        Vector3::new(self.1 * v.x - self.0 * v.y, self.0 * v.x + self.1 * v.y, v.z)
    }
}
