//! Gaps of individual tooth pairs: tooth errors and a broken tooth.

use std::num::NonZero;

use super::Flank;
use super::detailed::{Opening, PairName};
use super::errors::{Chip, MeshId, PairId, ToothErrors};
use crate::geometry::Pair;

/// Maximum number of planets.
const MAX_PLANETS: usize = 4;

/// Number of side gear teeth from planet 1 to another planet.
#[derive(Clone, Copy, Debug, Default)]
struct Turned {
    /// Whole teeth, with a half tooth rounded down and up.
    ahead: [i64; 2],
    /// 1 if half a tooth remains, else 0.
    odd: i64,
}

/// Number of teeth of a gear.
#[derive(Clone, Copy, Debug)]
struct Count {
    teeth: NonZero<u32>,
    /// A multiple of `teeth`, large enough to make tooth numbers positive.
    revolutions: i64,
}

impl Count {
    /// Returns the count of a gear with `teeth` teeth.
    fn new(teeth: i32) -> Self {
        let teeth = NonZero::new(teeth.unsigned_abs()).unwrap_or(NonZero::<u32>::MIN);
        let count = i64::from(teeth.get());
        Self { teeth, revolutions: count * ((1 << 30) / count) }
    }

    /// Index of the gear's tooth with number `number` in the unrolled sequence.
    #[inline(always)]
    fn tooth(&self, number: i64) -> usize {
        // a 32-bit division is faster
        match u32::try_from(number.wrapping_add(self.revolutions)) {
            Ok(positive) => (positive % self.teeth) as usize,
            Err(_) => number.rem_euclid(i64::from(self.teeth.get())) as usize,
        }
    }
}

/// Gaps of all tooth pairs.
#[derive(Clone, Debug)]
pub struct FlankGaps {
    /// Errors of the teeth.
    pub errors: Option<ToothErrors>,
    /// The broken tooth.
    pub chip: Option<Chip>,
    /// Numbers of planet teeth and side gear teeth.
    teeth_of: [Count; 2],
    /// Offset of each planet around the side gears.
    turned: [Turned; MAX_PLANETS],
    /// Lower bound of all gaps [m].
    pub least: f64,
}

impl FlankGaps {
    /// Returns the gaps of error-free teeth of `pair`: all zero.
    pub fn perfect(pair: &Pair, planets: i32) -> Self {
        let side_teeth = i64::from(pair.gears[1].teeth);
        // planets whose meshes are shifted by half a pitch (assembly::phases) have their tooth 0 advanced by half a
        // pitch
        let turned = std::array::from_fn(|planet| {
            let halves = 2 * side_teeth * planet as i64 / i64::from(planets);
            Turned { ahead: [halves / 2, (halves + halves % 2) / 2], odd: halves % 2 }
        });
        Self { errors: None, chip: None, teeth_of: pair.gears.map(|g| Count::new(g.teeth)), turned, least: 0.0 }
    }

    /// Indices of mesh and teeth as the tooth errors count them. Planet teeth count with positive spin: up the path on
    /// the drive flank in the left mesh, down in the right mesh, which is half a turn away. Side gear teeth count
    /// forward. The drive flank pushes the side gear tooth ahead of the planet tooth, the coast flank the one behind
    /// it.
    #[inline(always)]
    fn ids(&self, name: &PairName) -> (MeshId, PairId) {
        let [planet, side] = &self.teeth_of;
        let [planet_tooth, side_tooth] = self.unrolled(name);
        (
            MeshId { planet: name.planet, side: name.side },
            PairId { planet_tooth: planet.tooth(planet_tooth), side_tooth: side.tooth(side_tooth), flank: name.flank },
        )
    }

    /// Number of side gear teeth from `planet` to the planet `other` in their meshes with `side`, from 0.
    pub fn teeth_between(&self, [planet, other]: [usize; 2], side: usize) -> usize {
        let tooth = |planet: usize| self.teeth(PairName { planet, side, flank: Flank::Drive, tooth: 0 })[1];
        let turn = self.teeth_of[1].teeth.get() as usize;
        (turn + tooth(other) - tooth(planet)) % turn
    }

    /// Number of the planet tooth whose position in the right mesh corresponds to the position of tooth 0 in the left
    /// mesh.
    pub fn opposite(&self, planet: usize) -> i64 {
        let z_p = i64::from(self.teeth_of[0].teeth.get());
        z_p / 2 - if z_p % 2 == 0 { self.turned[planet].odd } else { 0 }
    }

    /// Numbers of the planet tooth and the side gear tooth. They are not reduced by whole turns of the gears.
    #[inline(always)]
    pub fn unrolled(&self, name: &PairName) -> [i64; 2] {
        let z_p = i64::from(self.teeth_of[0].teeth.get());
        let Turned { ahead, .. } = self.turned[name.planet];
        let planet_tooth =
            if name.side == 0 { name.tooth } else { self.opposite(name.planet).wrapping_sub(name.tooth) };
        let ahead = name.tooth + if name.side == 1 && z_p % 2 == 1 { ahead[0] } else { ahead[1] };
        [planet_tooth, if name.flank == Flank::Drive { ahead } else { ahead - 1 }]
    }

    /// True if all teeth of each gear are identical, so that the gaps repeat with every pitch.
    pub fn repeat_every_pitch(&self) -> bool {
        self.chip.is_none() && self.errors.as_ref().is_none_or(ToothErrors::repeats_every_pitch)
    }

    /// Opening of a pair of teeth in `mesh` at position `s` [rad].
    #[inline(always)]
    pub fn of(&self, mesh: MeshId, pair: PairId, s: f64) -> Opening {
        let mut opening = self.errors.as_ref().map_or(Opening::NONE, |errors| errors.opening(mesh, pair, s));
        opening.edge = self.chip.as_ref().and_then(|chip| chip.edge(mesh, pair));
        opening
    }

    /// Indices of the teeth of a pair: the planet's and the side gear's.
    pub fn teeth(&self, name: PairName) -> [usize; 2] {
        let (_, pair) = self.ids(&name);
        [pair.planet_tooth, pair.side_tooth]
    }

    /// Opening of a pair at position `s` [rad].
    pub fn opening(&self, name: &PairName, s: f64) -> Opening {
        let (mesh, pair) = self.ids(name);
        self.of(mesh, pair, s)
    }
}
