//! Gaps of individual tooth pairs, slice by slice: tooth errors and a broken tooth.

use super::detailed::{Gaps, PairName};
use super::errors::Chip;
use super::errors::ToothErrors;
use super::errors::{MeshId, PairId};
use super::pairs::Flank;
use crate::geometry::Pair;
use crate::numeric::{Dual, Scalar};

/// Gaps of all tooth pairs.
#[derive(Clone, Debug)]
pub struct FlankGaps {
    /// Errors of the teeth.
    pub errors: Option<ToothErrors>,
    /// The broken tooth.
    pub chip: Option<Chip>,
    /// Cone distances of the slices [m].
    pub cones: Vec<f64>,
    /// Numbers of planets, planet teeth and side gear teeth.
    pub counts: [i64; 3],
    /// Lower bound of all gaps [m].
    pub least: f64,
}

/// Step for differences of a gap's slope [rad]: the curvature enters the Jacobian only.
const STEP: f64 = 1e-5;

impl FlankGaps {
    /// Error-free teeth of `pair`.
    pub fn perfect(pair: &Pair, planets: i32, cones: Vec<f64>) -> Self {
        let teeth = pair.gears.map(|g| i64::from(g.teeth));
        Self { errors: None, chip: None, cones, counts: [i64::from(planets), teeth[0], teeth[1]], least: 0.0 }
    }

    /// Numbers of mesh and teeth as errors count them: planet teeth with positive spin, seen from the left mesh up the path
    /// on the drive flank and from the right mesh, half a turn on, down; side gear teeth forward. The drive flank pushes
    /// the side gear's tooth ahead of the planet's, the coast flank the one behind it.
    fn ids(&self, name: PairName) -> (MeshId, PairId) {
        let [planets, z_p, z_s] = self.counts;
        // planets whose meshes are shifted by half a pitch (assembly::phases) have their tooth 0 half a pitch forward
        let halves = 2 * z_s * name.planet as i64 / planets;
        let odd = halves % 2;
        let forward = if name.side == 1 && z_p % 2 == 1 { 0 } else { odd };
        let ahead = name.tooth + (halves + forward) / 2;
        let opposite = if z_p % 2 == 0 { z_p / 2 - odd } else { z_p / 2 };
        let planet_tooth = if name.side == 0 { name.tooth } else { opposite - name.tooth };
        let side_tooth = if name.flank == Flank::Drive { ahead } else { ahead - 1 };
        (
            MeshId { planet: name.planet, side: name.side },
            PairId {
                planet_tooth: planet_tooth.rem_euclid(z_p) as usize,
                side_tooth: side_tooth.rem_euclid(z_s) as usize,
                flank: name.flank,
            },
        )
    }

    /// Gap e [m] of a pair of teeth in `mesh` at any cone distance `r` [m]; on both sides of [`Self::edge`] a polynomial of
    /// second degree in it.
    pub fn gap(&self, mesh: MeshId, pair: PairId, r: f64, s: f64) -> f64 {
        let errors = self.errors.as_ref().map_or(0.0, |errors| errors.gap(mesh, pair, r, s));
        errors + self.chip.as_ref().map_or(0.0, |chip| chip.gap(mesh, pair, r))
    }

    /// Cone distance [m] beyond which a tooth of the pair is broken, if one is.
    pub fn edge(&self, mesh: MeshId, pair: PairId) -> Option<f64> {
        self.chip.as_ref().and_then(|chip| chip.edge(mesh, pair))
    }

    /// Numbers of the teeth of a pair: the planet's and the side gear's.
    pub fn teeth(&self, name: PairName) -> [usize; 2] {
        let (_, pair) = self.ids(name);
        [pair.planet_tooth, pair.side_tooth]
    }
}

impl Gaps for FlankGaps {
    fn at(&self, name: PairName, slice: usize, s: f64, twice: bool) -> [f64; 3] {
        let (mesh, pair) = self.ids(name);
        let r = self.cones[slice];
        let mut gap = [0.0; 3];
        if let Some(errors) = &self.errors {
            let at = |s: f64| errors.gap(mesh, pair, r, Dual::<1>::variable(s, 0));
            let here = at(s);
            let curvature = || (at(s + STEP).d[0] - at(s - STEP).d[0]) / (2.0 * STEP);
            gap = [here.value(), here.d[0], if twice { curvature() } else { 0.0 }];
        }
        if let Some(chip) = &self.chip {
            gap[0] += chip.gap(mesh, pair, r);
        }
        gap
    }

    fn least(&self) -> f64 {
        self.least
    }
}
