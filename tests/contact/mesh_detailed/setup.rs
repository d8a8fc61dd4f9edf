//! Meshes with gaps and friction, random states, and differences that stay clear of switches.

use crate::random::Draws;
use bevel_differential::contact::damping::Damping;
use bevel_differential::contact::detailed::{
    Detailed, DetailedLoad, DetailedState, Face, Gaps, MeshTeeth, Opening, PairName, SliceLoad,
};
use bevel_differential::contact::mesh::{Mesh, MeshState};
use bevel_differential::contact::pairs::{Engagement, Flank, Spot};
use bevel_differential::contact::tooth_friction::ToothFriction;
use bevel_differential::friction::ToothFrictionSpec;
use bevel_differential::geometry::Pair;
use bevel_differential::numeric::{Dual, Jet};
use fastrand::Rng;

use crate::mesh_laws::{Built, Kind, PER_FULL_DEPTH, gears};

pub const STATES: usize = 2000;

/// Deepest approach tried [rad]: 0.1 mm at R_m.
pub const DEEPEST: f64 = 3e-3;

pub const KINDS: [Kind; 5] = [Kind::Impact, Kind::DampedImpact, Kind::Line, Kind::LineWeber, Kind::Lumped];

pub const NAMES: (usize, usize) = (1, 0);

/// A plain mesh and the same in detail.
pub struct Both {
    pub pair: Pair,
    pub plain: Mesh,
    pub detailed: Detailed,
}

impl Both {
    /// In detail with one resultant for the face.
    pub fn new(of: (i32, i32, f64, f64), kind: Kind, damping: Damping) -> Self {
        Self::made(of, kind, damping, false, None)
    }

    /// In detail with loads that differ over the face where the law can be cut, otherwise as it is.
    pub fn sliced(of: (i32, i32, f64, f64), kind: Kind, damping: Damping, friction: Option<ToothFriction>) -> Self {
        Self::made(of, kind, damping, true, friction)
    }

    pub fn made(
        of: (i32, i32, f64, f64),
        kind: Kind,
        damping: Damping,
        cut: bool,
        friction: Option<ToothFriction>,
    ) -> Self {
        let pair = gears(of);
        let Built { law, spring, whole, cone } = Built::new(&pair, kind, of.2, damping);
        let plain = Mesh::new(&pair, law, cone, true, 0.05);
        let face = match kind {
            Kind::Line if cut => Face::cut(pair.inner_cone, pair.outer_cone),
            Kind::LineWeber if cut => Face::sliced(pair.inner_cone, pair.outer_cone),
            _ => Face::whole(whole),
        };
        let detailed = Detailed::new(&pair, spring, damping, face, !kind.has_pairs(), friction);
        Self { pair, plain, detailed }
    }

    pub fn engagement(&self) -> &Engagement {
        &self.plain.engagement
    }

    pub fn teeth<'a>(&'a self, gaps: Option<&'a dyn Gaps>) -> MeshTeeth<'a> {
        let (planet, side) = NAMES;
        MeshTeeth { engagement: self.engagement(), gaps, viscosity: None, planet, side }
    }

    pub fn load(&self, gaps: Option<&dyn Gaps>, state: &DetailedState) -> DetailedLoad<f64> {
        self.detailed.load(&self.teeth(gaps), state)
    }

    pub fn linearise(&self, gaps: Option<&dyn Gaps>, state: &DetailedState) -> DetailedLoad<Dual<6>> {
        self.detailed.linearise(&self.teeth(gaps), state)
    }

    pub fn look(
        &self,
        gaps: Option<&dyn Gaps>,
        state: &DetailedState,
        mut look: impl FnMut(&SliceLoad),
    ) -> DetailedLoad<f64> {
        self.detailed.look(&self.teeth(gaps), state, &mut look)
    }

    pub fn energy(&self, gaps: Option<&dyn Gaps>, state: &DetailedState) -> f64 {
        self.detailed.energy(&self.teeth(gaps), state)
    }
}

/// Gaps that differ from tooth to tooth and over the face and are smooth along the path.
#[derive(Debug)]
pub struct Waves {
    /// Amplitude [m].
    pub size: f64,
}

impl Gaps for Waves {
    fn opening(&self, name: &PairName, s: f64) -> Opening {
        let flank = if name.flank == Flank::Drive { 0.0 } else { 0.7 };
        let phase = name.tooth as f64 * 1.3 + flank;
        let k = 9.0;
        let (sin, cos) = (k * s + phase).sin_cos();
        let even = Jet { v: self.size * sin, d: self.size * k * cos, dd: -self.size * k * k * sin };
        // the turn opens up to half the size at 50 mm, the bend up to a quarter of it
        let turn = 10.0 * self.size * phase.cos();
        Opening { even, turn, bend: 50.0 * self.size * (1.0 + phase.sin()), edge: None }
    }
    fn least(&self) -> f64 {
        -1.5 * self.size
    }
}

/// The same gap for every pair [m].
#[derive(Debug)]
pub struct Even(pub f64);

impl Gaps for Even {
    fn opening(&self, _: &PairName, _: f64) -> Opening {
        Opening { even: Jet { v: self.0, d: 0.0, dd: 0.0 }, ..Opening::NONE }
    }
    fn least(&self) -> f64 {
        self.0.min(0.0)
    }
}

pub fn random_state(random: &mut Rng, pair: &Pair, w: f64) -> DetailedState {
    let depth = random.between(1e-5, DEEPEST);
    let hand = if random.between(-1.0, 1.0) < 0.0 { -1.0 } else { 1.0 };
    DetailedState {
        position: [
            hand * (pair.normal_backlash / 2.0 + depth),
            random.between(-2.0 * pair.base_pitch, 2.0 * pair.base_pitch),
            w * random.between(-1.0, 1.0),
        ],
        rate: [
            random.between(-1.0, 1.0),
            random.between(-1.0, 1.0),
            if w == 0.0 { 0.0 } else { random.between(-0.02, 0.02) },
        ],
        wrapped: 3,
    }
}

pub fn plain_state(state: &DetailedState) -> MeshState {
    let ([q, x, _], [q_rate, x_rate, _]) = (state.position, state.rate);
    MeshState { position: [q, x], rate: [q_rate, x_rate], ..MeshState::default() }
}

/// State with position or rate `i` of six moved by `h`.
pub fn shifted(state: &DetailedState, i: usize, h: f64) -> DetailedState {
    let mut s = *state;
    if i < 3 {
        s.position[i] += h
    } else {
        s.rate[i - 3] += h
    }
    s
}

/// Fourth-order central difference by variable `i`.
pub fn difference(state: &DetailedState, i: usize, h: f64, f: impl Fn(&DetailedState) -> f64) -> f64 {
    let at = |k: f64| f(&shifted(state, i, k * h));
    (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * h)
}

/// A loaded slice as far as it must stay the same.
pub type Loaded = (PairName, u64, Spot, bool, bool, [bool; 2]);

/// Loaded slices with their kind of contact, whether flanks are about to part, whether damping is full, and which ends of the
/// face carry: where this changes, derivatives jump or bend. Nothing if a slice that stands still, or the deepest of those
/// that move with a part of the face, is less than `least` deep [rad].
pub fn pattern(both: &Both, gaps: Option<&dyn Gaps>, state: &DetailedState, least: f64) -> Option<Vec<Loaded>> {
    let mut pattern = Vec::new();
    let mut shallow = false;
    let mut deepest: Vec<(PairName, f64)> = Vec::new();
    let ends = both.detailed.face.ends().unwrap_or([both.plain.cone; 2]);
    let fixed: Vec<u64> = match &both.detailed.face {
        Face::Whole(node) => vec![node.cone.to_bits()],
        Face::Cut(_, nodes) => nodes.iter().map(|node| node.cone.to_bits()).collect(),
        Face::Sliced(_, nodes) => nodes.iter().map(|node| node.cone.to_bits()).collect(),
    };
    both.look(gaps, state, |slice| {
        let sign = if slice.name.flank == Flank::Drive { -1.0 } else { 1.0 };
        let approach = sign * state.position[0] - both.engagement().half_backlash();
        let past_side_tip = approach - slice.s - both.engagement().corner[1].end > 0.0;
        let spot = match slice.pair.spot {
            Spot::SideTip if !past_side_tip => Spot::Path,
            spot => spot,
        };
        let full = slice.arc * slice.cone * PER_FULL_DEPTH >= 1.0;
        // points move over a part of the face that carries
        let place = Some(slice.cone.to_bits()).filter(|place| fixed.contains(place)).unwrap_or(0);
        match deepest.iter_mut().find(|(name, _)| *name == slice.name) {
            _ if place != 0 => shallow |= slice.arc < least,
            Some((_, arc)) => *arc = arc.max(slice.arc),
            None => deepest.push((slice.name, slice.arc)),
        }
        let carry = ends.map(|end| slice.approach.arc - slice.opening.at(end) / end > 0.0);
        pattern.push((slice.name, place, spot, slice.normal <= 0.0, full, carry));
    });
    shallow |= deepest.iter().any(|(_, arc)| *arc < least);
    (!shallow).then_some(pattern)
}

/// Whether a part of the face of some pair carries alone.
pub fn carries_in_part(both: &Both, gaps: Option<&dyn Gaps>, state: &DetailedState) -> bool {
    pattern(both, gaps, state, 0.0).is_some_and(|pattern| pattern.iter().any(|&(_, place, ..)| place == 0))
}

/// Whether nothing switches within two steps `h` of each of the variables.
pub fn smooth(both: &Both, gaps: Option<&dyn Gaps>, state: &DetailedState, h: &[f64]) -> bool {
    let least = 60.0 * h[0];
    let Some(here) = pattern(both, gaps, state, least) else { return false };
    (0..h.len()).all(|i| {
        [-2.0, 2.0].iter().all(|k| pattern(both, gaps, &shifted(state, i, k * h[i]), 0.0).is_some_and(|p| p == here))
    })
}

pub fn coulomb(coefficient: f64, regularisation_speed: f64) -> ToothFriction {
    friction(ToothFrictionSpec { coefficient, regularisation_speed, ..ToothFrictionSpec::default() })
}

pub fn friction(spec: ToothFrictionSpec) -> ToothFriction {
    ToothFriction { spec, modulus: 2.07e11 / (2.0 * (1.0 - 0.0625)) }
}

/// All readings of a load.
pub fn readings<T: Copy>(load: &DetailedLoad<T>) -> [T; 7] {
    let [q, x, w] = load.force;
    [q, x, w, load.normal, load.planet_axial, load.side_axial, load.tangential]
}
