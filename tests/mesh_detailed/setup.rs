//! Meshes with gaps and friction, random states, and differences that stay clear of switches.

use bevel_differential::contact::any_spring::AnySpring;
use bevel_differential::contact::damping::Damping;
use bevel_differential::contact::detailed::{Detailed, DetailedLoad, DetailedState, Gaps, PairName, Slice};
use bevel_differential::contact::mesh::{Mesh, MeshState};
use bevel_differential::contact::pairs::{Engagement, Flank, Spot};
use bevel_differential::contact::tooth_friction::ToothFriction;
use bevel_differential::friction::ToothFrictionSpec;
use bevel_differential::geometry::Pair;
use bevel_differential::numeric::Scalar;

use crate::mesh_explicit::Lcg;
use crate::mesh_laws::{Built, Kind, PER_FULL_DEPTH, gears};

pub const STATES: usize = 2000;

/// Deepest approach tried [rad]: 0.1 mm at R_m.
pub const DEEPEST: f64 = 3e-3;

pub const KINDS: [Kind; 5] = [Kind::Impact, Kind::Power, Kind::Line, Kind::LineWeber, Kind::Lumped];

pub const NAMES: (usize, usize) = (1, 0);

/// A plain mesh and the same in detail.
pub struct Both {
    pub pair: Pair,
    pub plain: Mesh,
    pub detailed: Detailed<AnySpring>,
}

impl Both {
    pub fn new(of: (i32, i32, f64, f64), kind: Kind, damping: Damping) -> Self {
        let pair = gears(of);
        let Built { law, spring, whole, cone } = Built::new(&pair, kind, of.2, damping);
        let plain = Mesh::new(&pair, law, cone, true, 0.05);
        let single = !kind.has_pairs();
        Self { pair, plain, detailed: Detailed::new(&pair, spring, damping, vec![whole], single, None) }
    }

    /// In detail with eight slices where the law can be cut, otherwise as it is.
    pub fn sliced(of: (i32, i32, f64, f64), kind: Kind, damping: Damping, friction: Option<ToothFriction>) -> Self {
        let mut both = Self::new(of, kind, damping);
        let slices = if kind.can_be_sliced() { gauss(&both.pair) } else { both.detailed.slices.clone() };
        let spring = both.detailed.spring.clone();
        both.detailed = Detailed::new(&both.pair, spring, damping, slices, !kind.has_pairs(), friction);
        both
    }

    pub fn engagement(&self) -> &Engagement {
        &self.plain.engagement
    }

    pub fn load<T: Scalar>(&self, gaps: Option<&dyn Gaps>, state: &DetailedState<T>) -> DetailedLoad<T> {
        self.detailed.load(self.engagement(), gaps, NAMES, state, |_| {})
    }

    pub fn energy(&self, gaps: Option<&dyn Gaps>, state: &DetailedState<f64>) -> f64 {
        self.detailed.energy(self.engagement(), gaps, NAMES, state)
    }
}

/// Eight Gauss points over the face with weights times R², the nodes by Newton's method on Legendre's polynomial.
pub fn gauss(pair: &Pair) -> Vec<Slice> {
    let (outer, inner) = (pair.outer_cone, pair.inner_cone);
    let legendre = |x: f64| {
        let (mut p, mut before) = (x, 1.0);
        for n in 2..=8 {
            let n = f64::from(n);
            (p, before) = (((2.0 * n - 1.0) * x * p - (n - 1.0) * before) / n, p);
        }
        (p, 8.0 * (x * p - before) / (x * x - 1.0))
    };
    (0..8)
        .rev()
        .map(|i| {
            let mut x = (std::f64::consts::PI * (f64::from(i) + 0.75) / 8.5).cos();
            for _ in 0..20 {
                let (p, slope) = legendre(x);
                x -= p / slope;
            }
            let slope = legendre(x).1;
            let cone = 0.5 * (outer + inner) + 0.5 * (outer - inner) * x;
            let width = (outer - inner) / ((1.0 - x * x) * slope * slope);
            Slice { cone, weight: width * cone * cone, width }
        })
        .collect()
}

/// Gaps that differ from tooth to tooth and from slice to slice and are smooth along the path.
#[derive(Debug)]
pub struct Waves {
    /// Amplitude [m].
    pub size: f64,
}

impl Gaps for Waves {
    fn at(&self, name: PairName, slice: usize, s: f64, _: bool) -> [f64; 3] {
        let flank = if name.flank == Flank::Drive { 0.0 } else { 0.7 };
        let phase = name.tooth as f64 * 1.3 + slice as f64 * 0.4 + flank;
        let k = 9.0;
        let (sin, cos) = (k * s + phase).sin_cos();
        [self.size * sin, self.size * k * cos, -self.size * k * k * sin]
    }
    fn least(&self) -> f64 {
        -self.size
    }
}

/// The same gap for every pair [m].
#[derive(Debug)]
pub struct Even(pub f64);

impl Gaps for Even {
    fn at(&self, _: PairName, _: usize, _: f64, _: bool) -> [f64; 3] {
        [self.0, 0.0, 0.0]
    }
    fn least(&self) -> f64 {
        self.0.min(0.0)
    }
}

pub fn random_state(random: &mut Lcg, pair: &Pair, w: f64) -> DetailedState<f64> {
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

pub fn plain_state(state: &DetailedState<f64>) -> MeshState {
    let ([q, x, _], [q_rate, x_rate, _]) = (state.position, state.rate);
    MeshState { position: [q, x], rate: [q_rate, x_rate], ..MeshState::default() }
}

/// State with position or rate `i` of six moved by `h`.
pub fn shifted(state: &DetailedState<f64>, i: usize, h: f64) -> DetailedState<f64> {
    let mut s = *state;
    if i < 3 {
        s.position[i] += h
    } else {
        s.rate[i - 3] += h
    }
    s
}

/// Fourth-order central difference by variable `i`.
pub fn difference(state: &DetailedState<f64>, i: usize, h: f64, f: impl Fn(&DetailedState<f64>) -> f64) -> f64 {
    let at = |k: f64| f(&shifted(state, i, k * h));
    (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * h)
}

/// A loaded slice as far as it must stay the same.
pub type Loaded = (PairName, u64, Spot, bool, bool);

/// Loaded slices with their kind of contact, whether flanks are about to part, and whether damping is full: where this
/// changes, derivatives jump or bend. Nothing if a slice is less than `least` deep [rad].
pub fn pattern(both: &Both, gaps: Option<&dyn Gaps>, state: &DetailedState<f64>, least: f64) -> Option<Vec<Loaded>> {
    let mut pattern = Vec::new();
    let mut shallow = false;
    both.detailed.load(both.engagement(), gaps, NAMES, state, |slice| {
        let sign = if slice.name.flank == Flank::Drive { -1.0 } else { 1.0 };
        let approach = sign * state.position[0] - both.engagement().half_backlash();
        let past_side_tip = approach - slice.s - both.engagement().corner[1].end > 0.0;
        let spot = match slice.pair.spot {
            Spot::SideTip if !past_side_tip => Spot::Path,
            spot => spot,
        };
        shallow |= slice.arc < least;
        let full = slice.arc * slice.cone * PER_FULL_DEPTH >= 1.0;
        pattern.push((slice.name, slice.cone.to_bits(), spot, slice.normal <= 0.0, full));
    });
    (!shallow).then_some(pattern)
}

/// Whether nothing switches within two steps `h` of each of the variables.
pub fn smooth(both: &Both, gaps: Option<&dyn Gaps>, state: &DetailedState<f64>, h: &[f64]) -> bool {
    let least = 30.0 * h[0];
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
pub fn readings<T: Scalar>(load: &DetailedLoad<T>) -> [T; 7] {
    let [q, x, w] = load.force;
    [q, x, w, load.normal, load.planet_axial, load.side_axial, load.tangential]
}
