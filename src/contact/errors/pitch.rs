//! Pitch deviations: tolerances of an accuracy grade, and random teeth that just meet them.
//!
//! ISO 17485:2006, 5.4, for grade B = 2 to 11, with tolerance diameter d_T and mean normal module m_mn in mm, in µm:
//!
//!   single pitch      f_ptT = (0.003 d_T + 0.3 m_mn + 5) (√2)^(B−4)
//!   cumulative pitch  F_pT  = (0.025 d_T + 0.3 m_mn + 19) (√2)^(B−4)
//!   runout            F_rT  = 0.8 F_pT
//!
//! d_T is the diameter of the gear in the middle of the working depth at the mean cone distance.
//!
//! The positions of the teeth are drawn independently. They are scaled until the largest difference between neighbours,
//! the single pitch deviation, is f_ptT, so the gear just meets its grade. Positions have zero mean, and pitch
//! deviations add up to zero over the revolution. Slow variation over the revolution belongs to `runout`. A position
//! error is a rotation of the flank about the gear's axis, so the normal gap grows with R.

use super::{GearTeeth, MeshId, PairId, Random};
use crate::contact::Flank;
use crate::geometry::Pair;
use crate::numeric::{cos, pow};
use crate::problem::Problem;

/// Tolerances of one gear [m].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerances {
    /// Single pitch tolerance f_ptT.
    pub single_pitch: f64,
    /// Cumulative pitch tolerance F_pT.
    pub cumulative_pitch: f64,
    /// Runout tolerance F_rT.
    pub runout: f64,
}

/// Maximum number of draws of a flank's positions. A draw beyond F_pT is repeated, which is rare.
const DRAWS: usize = 32;

impl Tolerances {
    /// Tolerances of ISO 17485 for accuracy grade `grade`, tolerance diameter [m] and mean normal module [m].
    pub fn iso_17485(grade: i32, tolerance_diameter: f64, mean_module: f64) -> Self {
        let (d, m) = (tolerance_diameter * 1e3, mean_module * 1e3);
        let step = 1e-6 * pow(2.0, 0.5 * f64::from(grade - 4));
        let cumulative_pitch = (0.025 * d + 0.3 * m + 19.0) * step;
        Self { single_pitch: (0.003 * d + 0.3 * m + 5.0) * step, cumulative_pitch, runout: 0.8 * cumulative_pitch }
    }

    /// Tolerances of gear `i` of `pair` (0 planet, 1 side gear).
    pub fn of_gear(grade: i32, pair: &Pair, i: usize) -> Self {
        Self::iso_17485(grade, tolerance_diameter(pair, i), mean_module(pair))
    }

    /// True if gear `i` of `pair` is within the ranges of the standard's formulas.
    pub fn covers(pair: &Pair, i: usize) -> bool {
        (1e-3..=50e-3).contains(&mean_module(pair))
            && (5e-3..=2.5).contains(&tolerance_diameter(pair, i))
            && (5..=400).contains(&pair.gears[i].teeth)
    }
}

/// Mean normal module m_mn [m] of straight teeth.
pub fn mean_module(pair: &Pair) -> f64 {
    pair.module * pair.mean_cone / pair.outer_cone
}

/// Tolerance diameter d_T of gear `i` [m]: pitch diameter at R_m, moved to the middle of the working depth.
pub fn tolerance_diameter(pair: &Pair, i: usize) -> f64 {
    let (own, mate) = (&pair.gears[i], &pair.gears[1 - i]);
    let at_mean = pair.mean_cone / pair.outer_cone;
    at_mean * (pair.outer_pitch_diameter(i) + (own.addendum - mate.addendum) * cos(own.pitch))
}

/// Random positions of the teeth of one flank [m], with zero mean. The largest difference between neighbours equals
/// f_ptT.
pub fn positions(teeth: usize, tolerances: &Tolerances, random: &mut Random) -> Box<[f64]> {
    let mut drawn = vec![0.0; teeth];
    let mut scale = 0.0;
    for _ in 0..DRAWS {
        drawn.iter_mut().for_each(|p| *p = 2.0 * random.unit() - 1.0);
        let mean = drawn.iter().sum::<f64>() / teeth as f64;
        drawn.iter_mut().for_each(|p| *p -= mean);
        let largest_step = single_pitches(&drawn).map(f64::abs).fold(f64::MIN_POSITIVE, f64::max);
        scale = tolerances.single_pitch / largest_step;
        let allowed = tolerances.cumulative_pitch / range(&drawn).max(f64::MIN_POSITIVE);
        if scale <= allowed {
            break;
        }
        // if no draw succeeds, F_pT is met but f_ptT is not reached
        scale = allowed;
    }
    drawn.iter_mut().for_each(|p| *p *= scale);
    drawn.into()
}

/// Single pitch deviations of teeth at `positions`: the position of each tooth minus that of the tooth before it.
pub fn single_pitches(positions: &[f64]) -> impl Iterator<Item = f64> + '_ {
    let before = positions.iter().cycle().skip(positions.len().saturating_sub(1));
    positions.iter().zip(before).map(|(here, before)| here - before)
}

/// Total cumulative pitch deviation of teeth at `positions`: the largest position minus the smallest.
pub fn range(positions: &[f64]) -> f64 {
    let (low, high) = positions.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), p| (l.min(*p), h.max(*p)));
    (high - low).max(0.0)
}

/// Deviations of all flanks of a differential.
#[derive(Clone, Debug)]
pub struct PitchDeviations {
    /// Positions along the line of action at R_m [m], positive in the direction of the tooth count. Side gears come
    /// first, then planets. Each gear has the flanks that face in the direction of the tooth count, then the others.
    gears: Box<[[Box<[f64]>; 2]]>,
    /// Missing material of every flank [m], ordered by gear, facing direction and tooth.
    missing: Box<[f64]>,
    /// Largest number of teeth of a gear: the length of a row of `missing`.
    most: usize,
}

impl PitchDeviations {
    /// Returns the deviations of gears of accuracy grade `grade`, drawn from `seed`, or `None` for grade 0.
    pub fn new(grade: i32, seed: i32, pair: &Pair, planets: usize) -> Option<Self> {
        (grade != 0).then(|| {
            let gear = |number: usize| {
                let i = usize::from(number < 2);
                let tolerances = Tolerances::of_gear(grade, pair, i);
                // per radian, the tolerance circle moves by d_T/2, and the flank moves along the line of action by R_m
                // sinδ_b
                let along_action = 2.0 * pair.mean_cone * pair.sin_base()[i] / tolerance_diameter(pair, i);
                [1, 2].map(|stream| {
                    let mut random = Random::new(seed, number, stream);
                    let mut flank = positions(pair.gears[i].teeth.unsigned_abs() as usize, &tolerances, &mut random);
                    flank.iter_mut().for_each(|p| *p *= along_action);
                    flank
                })
            };
            Self::of_gears((0..2 + planets).map(gear).collect())
        })
    }

    fn of_gears(gears: Box<[[Box<[f64]>; 2]]>) -> Self {
        let most = gears.iter().flatten().map(|flank| flank.len()).max().unwrap_or(0);
        let mut missing = vec![0.0; 2 * most * gears.len()];
        for (flank, row) in gears.iter().flatten().zip(missing.chunks_mut(most.max(1))) {
            row[..flank.len()].copy_from_slice(flank);
        }
        // a forward-facing flank that is ahead has more material
        for row in missing.chunks_mut(most.max(1)).step_by(2) {
            row.iter_mut().for_each(|position| *position = -*position);
        }
        Self { gears, missing: missing.into(), most }
    }

    /// Positions of the flanks of gear `number`, as in [`GearTeeth`]. `number` must be in range.
    pub fn of(&self, number: usize) -> [Vec<f64>; 2] {
        self.gears[number].clone().map(Vec::from)
    }

    /// Replaces the positions by those of `gears`, one entry per gear. Fails if the number of teeth is wrong or a value
    /// is not finite.
    pub fn replace(&mut self, gears: &[GearTeeth]) -> Result<(), Problem> {
        for (own, given) in self.gears.iter_mut().zip(gears) {
            for (own, given) in own.iter_mut().zip(&given.positions) {
                if own.len() != given.len() || !given.iter().all(|position| position.is_finite()) {
                    let what =
                        format!("{} tooth positions are given; {} finite values are needed", given.len(), own.len());
                    return Err(Problem::new("tooth_errors.accuracy_grade", what));
                }
                own.copy_from_slice(given);
            }
        }
        *self = Self::of_gears(std::mem::take(&mut self.gears));
        Ok(())
    }

    /// Upper bound of the excess material of a pair at R_m [m].
    pub fn max_excess(&self) -> f64 {
        let most = |gears: &[[Box<[f64]>; 2]]| {
            gears.iter().flatten().flatten().fold(0.0f64, |most, position| most.max(position.abs()))
        };
        let (sides, planets) = self.gears.split_at(2);
        most(sides) + most(planets)
    }

    /// Gap of a pair at R_m [m]. The indices of mesh and pair must be in range.
    #[inline(always)]
    pub fn gap(&self, mesh: MeshId, pair: PairId) -> f64 {
        // a planet's drive flank faces along t: in the direction of the planet's tooth count at the left mesh, against
        // it at the right mesh; a side gear's drive flank faces against t, and therefore against the side gear's tooth
        // count
        let planet_forward = (pair.flank == Flank::Drive) == (mesh.side == 0);
        let side_forward = pair.flank == Flank::Coast;
        let missing = |gear: usize, forward: bool, tooth: usize| {
            self.missing[(2 * gear + usize::from(!forward)) * self.most + tooth]
        };
        missing(2 + mesh.planet, planet_forward, pair.planet_tooth) + missing(mesh.side, side_forward, pair.side_tooth)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::GearSpec;

    #[test]
    fn tolerances_match_the_formulas() {
        let t = Tolerances::iso_17485(4, 0.1, 5e-3);
        assert!((t.single_pitch - 6.8e-6).abs() < 1e-18);
        assert!((t.cumulative_pitch - 23e-6).abs() < 1e-18);
        assert!((t.runout - 18.4e-6).abs() < 1e-18);
        // every two grades double the tolerances
        let t = Tolerances::iso_17485(8, 0.1, 5e-3);
        assert!((t.single_pitch - 27.2e-6).abs() < 1e-17);
    }

    #[test]
    fn the_tolerance_diameters_of_a_pair_touch_in_the_middle_of_the_working_depth() {
        let pair = Pair::new(&GearSpec::default());
        for i in 0..2 {
            let g = &pair.gears[i];
            // from the pitch line outward on the back cone at R_m
            let out = (g.addendum - pair.gears[1 - i].addendum) / 2.0 * pair.mean_cone / pair.outer_cone;
            let radius = pair.mean_cone * g.pitch.sin() + out * g.pitch.cos();
            assert!((tolerance_diameter(&pair, i) - 2.0 * radius).abs() < 1e-15);
            assert!(Tolerances::covers(&pair, i));
        }
    }

    #[test]
    fn a_gear_of_a_grade_just_meets_it_and_its_pitches_close() {
        for seed in 0..200 {
            for (teeth, d) in [(5, 0.02), (10, 0.04), (16, 0.06), (41, 0.2), (200, 1.0)] {
                let tolerances = Tolerances::iso_17485(2 + seed % 10, d, 4e-3);
                let teeth_at = positions(teeth, &tolerances, &mut Random::new(seed, 2, 1));
                let single: Vec<f64> = single_pitches(&teeth_at).collect();
                let largest = single.iter().fold(0.0, |m: f64, f| m.max(f.abs()));
                assert!((largest / tolerances.single_pitch - 1.0).abs() < 1e-12, "{seed} {teeth}");
                assert!(range(&teeth_at) <= tolerances.cumulative_pitch * (1.0 + 1e-12));
                assert!(single.iter().sum::<f64>().abs() < 1e-18 * teeth as f64);
                assert!(teeth_at.iter().sum::<f64>().abs() < 1e-18 * teeth as f64);
                assert_eq!(single.len(), teeth);
                assert_eq!(single[0], teeth_at[0] - teeth_at[teeth - 1]);
            }
        }
    }

    #[test]
    fn deviations_are_reproducible_and_differ_with_seed_gear_and_flank() {
        let pair = Pair::new(&GearSpec::default());
        let new = |seed| PitchDeviations::new(6, seed, &pair, 2).unwrap();
        let (a, b) = (new(3), new(3));
        assert_eq!(a.gears, b.gears);
        assert_ne!(a.gears, new(4).gears);
        for (i, one) in a.gears.iter().enumerate() {
            assert_eq!(one[0].len(), if i < 2 { 16 } else { 10 });
            assert_ne!(one[0], one[1]);
            assert!(a.gears[..i].iter().all(|other| other != one));
        }
        // golden: the same bits on every system
        assert_eq!(a.gears[2][0][0].to_bits(), 4526759135138734982);
        assert!(PitchDeviations::new(0, 3, &pair, 2).is_none());
    }

    #[test]
    fn a_displaced_tooth_lacks_material_on_one_flank_and_has_more_of_it_on_the_other() {
        let pair = Pair::new(&GearSpec::default());
        let mut all = PitchDeviations::new(6, 3, &pair, 2).unwrap();
        for gear in all.gears.iter_mut() {
            gear.iter_mut().for_each(|flank| flank.fill(0.0));
        }
        // tooth 3 of planet 1 is ahead by the same amount on both flanks
        (all.gears[3][0][3], all.gears[3][1][3]) = (1e-6, 1e-6);
        let all = PitchDeviations::of_gears(all.gears);
        let gap = |side, flank| all.gap(MeshId { planet: 1, side }, PairId { planet_tooth: 3, side_tooth: 0, flank });
        // spin moves the tooth along t at the left mesh: the drive flank is early at the left mesh and late at the
        // right mesh
        assert_eq!([gap(0, Flank::Drive), gap(0, Flank::Coast)], [-1e-6, 1e-6]);
        assert_eq!([gap(1, Flank::Drive), gap(1, Flank::Coast)], [1e-6, -1e-6]);
    }
}
