//! Couplings of tooth pairs through the elastic bodies of their gears, while the gears turn.
//!
//! The bodies are linear elastic and the same at every tooth. A unit load on the pair at position s moves the pair at
//! position s′ by the coupling t, and conversely. The coupling depends on s, s′ and the difference of the tooth
//! numbers. Teeth of one gear keep their distance. Therefore s − s′ is constant on the same flank of one mesh and on
//! unlike flanks of a planet's two meshes. The sum s + s′ is constant on unlike flanks of one mesh and on like flanks
//! of a planet's two meshes. Each coupling is therefore a smooth function of one variable, u = (s + s′)/2 or (s −
//! s′)/2, and is stored as a polynomial.

use super::mesh::{LoadedTooth, MeshOnBodies};
use super::polynomial::Polynomial;
use crate::contact::Flank;

/// Largest number of pairs that pull at one pair at the same time.
const PULLING: f64 = 3.0;
/// Largest pull. It is below 1, because a pair yields less to a load on another pair than to its own.
const MAX_PULL: f64 = 0.9;
/// Distance past the ends of the path beyond which couplings are constant [base pitches].
const PAST_END: f64 = 0.25;
/// Number of next pairs on the same flank with a separate coupling. Many small teeth on elastic bodies also touch past
/// both ends of the path. Without the couplings among these pairs the common compliance would be indefinite, and there
/// would be no equilibrium.
const SAME_FLANK_PAIRS: i64 = 16;
/// Largest magnitude of the sum of the pair numbers on unlike flanks of a mesh.
const MAX_FACING: i64 = 16;
/// Search points on each side of the middle for the minimum of a coupling.
const SEARCH_PLACES: i32 = 8;

/// Couplings through the elastic bodies of a planet and its side gears.
#[derive(Clone, Debug)]
pub struct PairCouplings {
    /// Couplings on the same flank of a mesh, indexed by the difference of the pair numbers minus 1.
    same_flank: Vec<Polynomial>,
    /// Couplings on unlike flanks of a mesh, indexed by the sum of the pair numbers plus `MAX_FACING`.
    opposite_flank: Vec<Polynomial>,
    /// Couplings between a planet's two meshes, indexed by the flanks on the left and right and the difference of the
    /// planet's tooth numbers.
    other_mesh: [Vec<Polynomial>; 4],
    /// Bounds of the approach that loads on other pairs add to a pair.
    pub pull: Pull,
}

/// Bounds of the approach that loads on other pairs add to a pair, relative to the approach of the loaded flanks. Each
/// is −t over the smallest compliance of a single pair, times the number of pairs that pull at the same time.
#[derive(Clone, Copy, Debug, Default)]
pub struct Pull {
    /// Bound for pairs on the same flank.
    pub same_flank: f64,
    /// Bound for pairs on the other flank of the mesh.
    pub opposite_flank: f64,
    /// Bounds for pairs on a like (0) or unlike (1) flank of the planet's other mesh.
    pub other_mesh: [f64; 2],
}

impl Pull {
    /// Largest approach that other pairs add to a pair, by side and flank (0 drive, 1 coast) [rad]. `depth` is the
    /// approach of the flanks [rad].
    #[inline(always)]
    pub fn margins(&self, depth: &[[f64; 2]; 2]) -> [[f64; 2]; 2] {
        let mut margins = [[0.0; 2]; 2];
        for side in 0..2 {
            for flank in 0..2 {
                let [own, other] = [&depth[side], &depth[1 - side]];
                margins[side][flank] = self.same_flank * own[flank].clamp(0.0, 1.0)
                    + self.opposite_flank * own[1 - flank].clamp(0.0, 1.0)
                    + self.other_mesh[0] * other[flank].clamp(0.0, 1.0)
                    + self.other_mesh[1] * other[1 - flank].clamp(0.0, 1.0);
            }
        }
        margins
    }
}

/// A loaded pair: the data that its couplings depend on.
#[derive(Clone, Copy, Debug)]
pub struct LoadedPair {
    /// Left (0) or right (1) side gear.
    pub side: usize,
    /// Flank.
    pub flank: Flank,
    /// Number of the pair along the path.
    pub number: i64,
    /// Number of the planet's tooth, counted on beyond whole turns.
    pub tooth: i64,
    /// Position on the path [rad].
    pub s: f64,
}

/// A coupling t(s, s′) with its derivatives.
#[derive(Clone, Copy, Debug, Default)]
pub struct Coupling {
    /// t [1/Pa].
    pub value: f64,
    /// ∂t/∂s and ∂t/∂s′ of t as a function of u. Only their combination along the motion of the gears is correct, not
    /// each derivative.
    pub gradient: [f64; 2],
    /// ∂²t/∂s², ∂²t/∂s∂s′, ∂²t/∂s′².
    pub hessian: [f64; 3],
}

/// Coupling `t` as a polynomial of u about `middle` [rad]. `positions` returns both positions at u. The polynomial
/// covers the range of u in which both positions are between `low` and `high`; this range is shorter by `apart`. If the
/// range is empty, the polynomial is constant: `t` with the positions at `middle`, limited to `low` and `high`.
fn polynomial_of(
    [low, high]: [f64; 2],
    (middle, apart): (f64, f64),
    positions: impl Fn(f64) -> [f64; 2],
    t: &dyn Fn([f64; 2]) -> f64,
) -> Polynomial {
    let half = 0.5 * (high - low - apart.abs());
    if half > 0.0 {
        Polynomial::new([middle - half, middle + half], |u| t(positions(u)))
    } else {
        Polynomial::constant(t(positions(middle).map(|s| s.clamp(low, high))))
    }
}

impl PairCouplings {
    /// Computes the couplings of `mesh`. `path` is the path of contact [rad], and `beams` the range of the path on
    /// which both teeth are beams. `centred` is the position of a pair whose tooth is in the middle of its gap, and
    /// `pitch` is the base pitch [rad].
    pub fn new(mesh: &MeshOnBodies, [path, beams]: [[f64; 2]; 2], (centred, pitch): (f64, f64)) -> Self {
        let reach = [path[0] - PAST_END * pitch, path[1] + PAST_END * pitch];
        let middle = 0.5 * (reach[0] + reach[1]);
        // the formula for the load angle is also used at positions at which a tooth is no longer a beam
        let tooth = |side, flank, s| LoadedTooth { side, flank, s };
        // s − s′ = apart: both positions move in the same direction
        let with = |apart: f64, t: &dyn Fn([f64; 2]) -> f64| {
            polynomial_of(reach, (middle, apart), |u| [u + 0.5 * apart, u - 0.5 * apart], t)
        };
        // s + s′ = sum: both positions move in opposite directions
        let against = |sum: f64, t: &dyn Fn([f64; 2]) -> f64| {
            polynomial_of(reach, (0.0, sum - 2.0 * middle), |u| [0.5 * sum + u, 0.5 * sum - u], t)
        };
        let same_flank = (1..=SAME_FLANK_PAIRS)
            .map(|k| {
                let at = |[a, b]: [f64; 2]| {
                    let [a, b] = [a, b].map(|s| tooth(0, Flank::Drive, s));
                    mesh.coupling_of([k, k], &a, &b)
                };
                with(k as f64 * pitch, &at)
            })
            .collect();
        let opposite_flank = (-MAX_FACING..=MAX_FACING)
            .map(|k| {
                let at = |[a, b]: [f64; 2]| {
                    mesh.coupling_of([k, k + 1], &tooth(0, Flank::Drive, a), &tooth(0, Flank::Coast, b))
                };
                against(2.0 * centred + k as f64 * pitch, &at)
            })
            .collect();
        let count = mesh.teeth_of(0) as i64;
        let other_mesh = [0, 1, 2, 3].map(|flanks| {
            let [left, right] = flanks_of(flanks);
            let forward = if left == Flank::Drive { 1.0 } else { -1.0 };
            let difference = |d: i64| {
                // distance from the opposite tooth, the shorter way round
                let off = d as f64 - 0.5 * count as f64;
                let off = forward * (off - count as f64 * libm::rint(off / count as f64)) * pitch;
                let at = |[a, b]: [f64; 2]| mesh.coupling_of([d, 0], &tooth(0, left, a), &tooth(1, right, b));
                if left == right { against(2.0 * centred + off, &at) } else { with(off, &at) }
            };
            (0..count).map(difference).collect()
        });
        let mut couplings = Self { same_flank, opposite_flank, other_mesh, pull: Pull::default() };
        let least = mesh.least_alone(beams);
        let pull = |all: &[Polynomial]| {
            // only couplings of pairs that can both be on the path; more distant pairs touch only if many more pairs
            // touch
            let most = all.iter().filter(|t| t.varies()).map(Polynomial::least).fold(0.0, f64::min);
            let pull = -PULLING * most / least;
            // the loads that cause the pull can themselves grow by the pull
            if pull < 0.5 { (pull / (1.0 - pull)).min(MAX_PULL) } else { MAX_PULL }
        };
        couplings.pull = Pull {
            same_flank: pull(&couplings.same_flank),
            opposite_flank: pull(&couplings.opposite_flank),
            other_mesh: [[0, 3], [1, 2]]
                .map(|[a, b]| pull(&couplings.other_mesh[a]).max(pull(&couplings.other_mesh[b]))),
        };
        couplings
    }

    /// The coupling of `a` and `b`, with second derivatives if `CURVATURE`.
    #[inline(always)]
    pub fn coupling<const CURVATURE: bool>(&self, a: &LoadedPair, b: &LoadedPair) -> Coupling {
        let alike = a.flank == b.flank;
        let (polynomial, with) = if a.side != b.side {
            let [left, right] = if a.side == 0 { [a, b] } else { [b, a] };
            let all = &self.other_mesh
                [2 * usize::from(left.flank == Flank::Coast) + usize::from(right.flank == Flank::Coast)];
            // the difference of tooth numbers, without whole turns of the planet
            let mut difference = left.tooth.wrapping_sub(right.tooth);
            if difference as u64 >= all.len() as u64 {
                difference = difference.rem_euclid(all.len() as i64);
            }
            (all.get(difference as usize), !alike)
        } else if alike {
            (self.same_flank.get(a.number.wrapping_sub(b.number).unsigned_abs().wrapping_sub(1) as usize), true)
        } else {
            (self.opposite_flank.get(a.number.wrapping_add(b.number).wrapping_add(MAX_FACING) as usize), false)
        };
        let Some(polynomial) = polynomial else { return Coupling::default() };
        // for u = (s − s′)/2, s is the position in the left mesh, or on the drive flank
        let turned = !with && if alike { a.side == 1 } else { a.flank == Flank::Coast };
        let [own, other] = if with {
            [0.5, 0.5]
        } else if turned {
            [-0.5, 0.5]
        } else {
            [0.5, -0.5]
        };
        let [value, slope, curvature] = polynomial.at::<CURVATURE>(own * a.s + other * b.s);
        let hessian = [own * own * curvature, own * other * curvature, other * other * curvature];
        Coupling { value, gradient: [own * slope, other * slope], hessian }
    }
}

/// Flanks on the left and right for an index of `other_mesh`.
fn flanks_of(number: usize) -> [Flank; 2] {
    [number / 2, number % 2].map(|coast| if coast == 1 { Flank::Coast } else { Flank::Drive })
}

impl Polynomial {
    /// Smallest value at evenly spaced positions.
    fn least(&self) -> f64 {
        (-SEARCH_PLACES..=SEARCH_PLACES)
            .map(|j| self.at_normalised(f64::from(j) / f64::from(SEARCH_PLACES)))
            .fold(f64::INFINITY, f64::min)
    }
}
