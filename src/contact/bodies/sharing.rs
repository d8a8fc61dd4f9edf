//! How pairs of teeth move each other while their gears turn.
//!
//! Bodies are linear and the same at every tooth: a load at s and one at s′ move each other by a coupling t that follows from s, s′
//! and the difference of their teeth's numbers. Teeth of one gear keep their distance, so that places go together: with the
//! same flank of the same mesh s − s′ is a constant, and so it is with unlike flanks of a planet's two meshes; with unlike flanks of
//! one mesh, and like flanks of both meshes, s + s′ is. So each coupling is a smooth function of one variable,
//! u = (s ± s′)/2, and is kept as a polynomial.

use super::mesh::{LoadedTooth, MeshOnBodies};
use super::polynomial::Polynomial;
use crate::contact::Flank;

/// Pairs that may pull at another at once.
const PULLING: f64 = 3.0;
/// Largest pull: a pair gives way less to another load than to the one that acts there.
const MOST_PULL: f64 = 0.9;
/// Base pitches past the ends of the path to which couplings are followed.
const PAST: f64 = 0.25;
/// Neighbours on one flank that are told apart: pairs touch beyond both ends of the path, where many small teeth stand on bodies
/// that give way. A coupling left out among them would make the compliance of all indefinite, so that nothing balances loads.
const NEIGHBOURS: i64 = 16;
/// Largest sum of numbers of two pairs on unlike flanks of a mesh.
const FACING: i64 = 16;
/// Places at which couplings are searched for their least.
const PLACES: i32 = 8;

/// The bodies of a planet and of its side gears.
#[derive(Clone, Debug)]
pub struct SharedBodies {
    /// On one flank of a mesh, by how many pairs further up the path.
    within: Vec<Polynomial>,
    /// On unlike flanks of a mesh, by the sum of their numbers.
    facing: Vec<Polynomial>,
    /// Between a planet's meshes, by flanks on the left and right and by the difference of the planet's teeth.
    across: [Vec<Polynomial>; 4],
    /// Bound of how far loads pull a pair together, over the approach of the flanks that carry them.
    pub pull: Pull,
}

/// Bounds of −t over the least compliance of a pair alone, times the pairs that may pull at once.
#[derive(Clone, Copy, Debug, Default)]
pub struct Pull {
    /// By pairs on the same flank.
    pub within: f64,
    /// By pairs on the other flank of the mesh.
    pub facing: f64,
    /// By pairs on a like (0) or unlike (1) flank of the planet's other mesh.
    pub across: [f64; 2],
}

impl Pull {
    /// How far others may pull a pair of `flank` (0 drive, 1 coast) of the mesh `side` together, where flanks approach by
    /// `depth`, by side and flank [rad].
    #[inline(always)]
    pub fn margin(&self, depth: &[[f64; 2]; 2], side: usize, flank: usize) -> f64 {
        let [own, other] = [side, 1 - side].map(|side| depth[side].map(|depth| depth.clamp(0.0, 1.0)));
        self.within * own[flank]
            + self.facing * own[1 - flank]
            + self.across[0] * other[flank]
            + self.across[1] * other[1 - flank]
    }
}

/// A loaded pair, as the bodies see it.
#[derive(Clone, Copy, Debug)]
pub struct Standing {
    /// Left (0) or right (1) side gear.
    pub side: usize,
    /// Flank.
    pub flank: Flank,
    /// Number of the pair along the path.
    pub number: i64,
    /// Number of the planet's tooth, of the unrolled sequence.
    pub tooth: i64,
    /// Place on the path [rad].
    pub s: f64,
}

/// A coupling t(s, s′) with its derivatives.
#[derive(Clone, Copy, Debug, Default)]
pub struct Coupling {
    /// t [1/Pa].
    pub value: f64,
    /// ∂t/∂s and ∂t/∂s′, of t as a function of u: their sum along the motion of the gears is what counts.
    pub by: [f64; 2],
    /// ∂²t/∂s², ∂²t/∂s∂s′, ∂²t/∂s′².
    pub twice: [f64; 3],
}

/// t of u about `middle` [rad], where both places, those of u in `places`, are within `reach`; of the ends of it where they never
/// are.
fn on(
    [low, high]: [f64; 2],
    (middle, apart): (f64, f64),
    places: impl Fn(f64) -> [f64; 2],
    t: &dyn Fn([f64; 2]) -> f64,
) -> Polynomial {
    let half = 0.5 * (high - low - apart.abs());
    if half > 0.0 {
        Polynomial::new([middle - half, middle + half], |u| t(places(u)))
    } else {
        Polynomial::constant(t(places(middle).map(|s| s.clamp(low, high))))
    }
}

impl SharedBodies {
    /// The bodies of `mesh`, the path of whose pairs is `path` [rad], of which both teeth are beams within `beams`; `centred` is the place of a pair whose tooth stands in the
    /// middle of its gap, `pitch` the base pitch [rad].
    pub fn new(mesh: &MeshOnBodies, [path, beams]: [[f64; 2]; 2], (centred, pitch): (f64, f64)) -> Self {
        let reach = [path[0] - PAST * pitch, path[1] + PAST * pitch];
        let middle = 0.5 * (reach[0] + reach[1]);
        // the angle of a load goes on past the beams as on them
        let tooth = |side, flank, s| LoadedTooth { side, flank, s };
        // places go together
        let with = |apart: f64, t: &dyn Fn([f64; 2]) -> f64| {
            on(reach, (middle, apart), |u| [u + 0.5 * apart, u - 0.5 * apart], t)
        };
        // places go against each other
        let against = |sum: f64, t: &dyn Fn([f64; 2]) -> f64| {
            on(reach, (0.0, sum - 2.0 * middle), |u| [0.5 * sum + u, 0.5 * sum - u], t)
        };
        let within = (1..=NEIGHBOURS)
            .map(|k| {
                let at = |[a, b]: [f64; 2]| {
                    let [a, b] = [a, b].map(|s| tooth(0, Flank::Drive, s));
                    mesh.coupling_of([k, k], &a, &b)
                };
                with(k as f64 * pitch, &at)
            })
            .collect();
        let facing = (-FACING..=FACING)
            .map(|k| {
                let at = |[a, b]: [f64; 2]| {
                    mesh.coupling_of([k, k + 1], &tooth(0, Flank::Drive, a), &tooth(0, Flank::Coast, b))
                };
                against(2.0 * centred + k as f64 * pitch, &at)
            })
            .collect();
        let count = mesh.teeth_of(0) as i64;
        let across = [0, 1, 2, 3].map(|flanks| {
            let [left, right] = flanks_of(flanks);
            let forward = if left == Flank::Drive { 1.0 } else { -1.0 };
            let difference = |d: i64| {
                // from the tooth opposite, the shortest way round
                let off = d as f64 - 0.5 * count as f64;
                let off = forward * (off - count as f64 * libm::rint(off / count as f64)) * pitch;
                let at = |[a, b]: [f64; 2]| mesh.coupling_of([d, 0], &tooth(0, left, a), &tooth(1, right, b));
                if left == right { against(2.0 * centred + off, &at) } else { with(off, &at) }
            };
            (0..count).map(difference).collect()
        });
        let mut bodies = Self { within, facing, across, pull: Pull::default() };
        let least = mesh.least_alone(beams);
        let pull = |all: &[Polynomial]| {
            // of pairs that can both be on the path; others are as far apart only under loads that press many more
            let most = all.iter().filter(|t| t.varies()).map(Polynomial::least).fold(0.0, f64::min);
            let pull = -PULLING * most / least;
            // the loads may grow by the same pull
            if pull < 0.5 { (pull / (1.0 - pull)).min(MOST_PULL) } else { MOST_PULL }
        };
        bodies.pull = Pull {
            within: pull(&bodies.within),
            facing: pull(&bodies.facing),
            across: [[0, 3], [1, 2]].map(|[a, b]| pull(&bodies.across[a]).max(pull(&bodies.across[b]))),
        };
        bodies
    }

    /// How `a` and `b` move each other; second derivatives where `TWICE`.
    #[inline(always)]
    pub fn coupling<const TWICE: bool>(&self, a: &Standing, b: &Standing) -> Coupling {
        let alike = a.flank == b.flank;
        let (polynomial, with) = if a.side != b.side {
            let [left, right] = if a.side == 0 { [a, b] } else { [b, a] };
            let all =
                &self.across[2 * usize::from(left.flank == Flank::Coast) + usize::from(right.flank == Flank::Coast)];
            // a remainder of a few turns
            let mut difference = left.tooth.wrapping_sub(right.tooth);
            if difference as u64 >= all.len() as u64 {
                difference = difference.rem_euclid(all.len() as i64);
            }
            (all.get(difference as usize), !alike)
        } else if alike {
            (self.within.get(a.number.wrapping_sub(b.number).unsigned_abs().wrapping_sub(1) as usize), true)
        } else {
            (self.facing.get(a.number.wrapping_add(b.number).wrapping_add(FACING) as usize), false)
        };
        let Some(polynomial) = polynomial else { return Coupling::default() };
        // against each other, u is counted from the left mesh, or from the drive flank
        let turned = !with && if alike { a.side == 1 } else { a.flank == Flank::Coast };
        let [own, other] = if with {
            [0.5, 0.5]
        } else if turned {
            [-0.5, 0.5]
        } else {
            [0.5, -0.5]
        };
        let [value, slope, bend] = polynomial.at::<TWICE>(own * a.s + other * b.s);
        let twice = [own * own * bend, own * other * bend, other * other * bend];
        Coupling { value, by: [own * slope, other * slope], twice }
    }
}

/// Flanks on the left and right of number 0 to 3.
fn flanks_of(number: usize) -> [Flank; 2] {
    [number / 2, number % 2].map(|coast| if coast == 1 { Flank::Coast } else { Flank::Drive })
}

impl Polynomial {
    /// The least of some values.
    fn least(&self) -> f64 {
        (-PLACES..=PLACES).map(|j| self.at_share(f64::from(j) / f64::from(PLACES))).fold(f64::INFINITY, f64::min)
    }
}
