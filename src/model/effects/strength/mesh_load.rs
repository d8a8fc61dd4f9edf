//! Load of a mesh, from which the strength of its teeth is rated.

use crate::contact::Flank;
use crate::model::scene::MAX_GROUPS;

/// Maximum number of loaded pairs of a mesh. With a contact ratio below 3, a flank has at most three pairs on its path.
const MOST_PAIRS: usize = 6;

/// Load of one flank of a mesh: sums over its pairs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FlankLoad {
    /// Normal force [N], as if it acted at the cone distance at which the law's resultant acts under an even load.
    pub normal: f64,
    /// Normal force as in `normal`, but with each pair's force multiplied by its face load factor K_Hβ [N]. The rated
    /// contact pressure follows from it.
    pub normal_face_loaded: f64,
    /// Largest pressure of a pair [Pa].
    pub pressure: f64,
}

/// Stress at the roots of a tooth pair.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BentPair {
    /// True if the drive flanks touch.
    pub drives: bool,
    /// Numbers of the planet's and the side gear's tooth, from 0. If one spring represents the mesh, it has no teeth.
    pub teeth: [usize; 2],
    /// Root stress of the planet's and the side gear's tooth [Pa].
    pub stress: [f64; 2],
}

/// Load of one mesh. Both flanks are loaded at the same time only if errors or displacements use up the backlash.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MeshLoad {
    flanks: [FlankLoad; 2],
    pairs: [BentPair; MOST_PAIRS],
    count: usize,
}

/// Value at the fraction `part` of a step, from its values at both ends and an estimate in the middle. The parabola
/// through them is limited so that it is monotonic and does not exceed the values at the ends.
fn between([start, middle, end]: [f64; 3], part: f64) -> f64 {
    let rise = end - start;
    let bend = (4.0 * middle - 2.0 * (start + end)).max(-rise.abs()).min(rise.abs());
    start + part * (rise + (1.0 - part) * bend)
}

impl MeshLoad {
    /// Load at the fraction `part` of a step of which only the loads at both ends are known, with an estimate in the
    /// middle. A pair that is loaded at one end only loses its load toward the other end.
    pub fn between(loads: [&Self; 3], part: f64) -> Self {
        let flanks = [0, 1].map(|flank| {
            let value = |of: fn(&FlankLoad) -> f64| between(loads.map(|load| of(&load.flanks[flank])), part);
            FlankLoad {
                normal: value(|load| load.normal),
                normal_face_loaded: value(|load| load.normal_face_loaded),
                pressure: value(|load| load.pressure),
            }
        });
        let mut load = Self { flanks, ..Self::default() };
        let [start, _, end] = loads;
        let entered = end.pairs().iter().filter(|pair| start.stress_of(pair).is_none());
        for pair in start.pairs().iter().chain(entered) {
            let stresses = loads.map(|load| load.stress_of(pair).unwrap_or_default());
            load.add_pair(BentPair { stress: [0, 1].map(|i| between(stresses.map(|of| of[i]), part)), ..*pair });
        }
        load
    }

    /// Root stresses of the pair with the flank and the teeth of `name`, or `None` if it is not loaded [Pa].
    fn stress_of(&self, name: &BentPair) -> Option<[f64; 2]> {
        self.pairs().iter().find(|pair| pair.drives == name.drives && pair.teeth == name.teeth).map(|pair| pair.stress)
    }

    /// Removes the load. Pairs beyond the count keep their values, because clearing them costs more than their use.
    pub fn clear(&mut self) {
        (self.flanks, self.count) = (Default::default(), 0);
    }

    /// Load of a flank.
    pub fn flank(&mut self, flank: Flank) -> &mut FlankLoad {
        &mut self.flanks[usize::from(flank == Flank::Coast)]
    }

    /// Loads of the drive flank and the coast flank.
    pub fn flanks(&self) -> &[FlankLoad; 2] {
        &self.flanks
    }

    /// Adds a pair. If there are too many, those with the largest stress stay.
    pub fn add_pair(&mut self, pair: BentPair) {
        if self.count < MOST_PAIRS {
            self.pairs[self.count] = pair;
            self.count += 1;
        } else if let Some(least) = self.pairs.iter_mut().min_by(|a, b| a.stress[0].total_cmp(&b.stress[0]))
            && least.stress[0] < pair.stress[0]
        {
            *least = pair;
        }
    }

    /// Loaded pairs.
    pub fn pairs(&self) -> &[BentPair] {
        &self.pairs[..self.count]
    }

    /// Larger value of `of` over both flanks.
    pub fn largest(&self, of: impl Fn(&FlankLoad) -> f64) -> f64 {
        let [drive, coast] = &self.flanks;
        of(drive).max(of(coast))
    }

    /// Largest root stress of gear `i` (0 planet, 1 side gear) [Pa].
    pub fn root_stress(&self, i: usize) -> f64 {
        self.pairs().iter().map(|pair| pair.stress[i]).fold(0.0, f64::max)
    }
}

/// Loads and motion at an instant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sample {
    /// Fraction of the step at which the sample was taken.
    pub part: f64,
    /// Angles of the planets relative to the carrier by group, in pitches of their teeth. Side gears roll with the
    /// planets. Their own angles are not used, because they contain the elastic wind-up under load, which brings no
    /// tooth into mesh.
    pub angle: [f64; MAX_GROUPS],
    /// Loads of the meshes, by group and side.
    pub mesh: [[MeshLoad; 2]; MAX_GROUPS],
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_within_a_step_stay_between_those_at_its_ends() {
        for (start, end) in [(1.0, 3.0), (3.0, 1.0), (0.0, 2.0), (2.0, 2.0)] {
            for middle in [-9.0, 0.0, 1.5, 2.0, 2.4, 50.0] {
                let values: Vec<f64> = (0..=64).map(|k| between([start, middle, end], f64::from(k) / 64.0)).collect();
                let is_monotonic = |sign: f64| values.windows(2).all(|pair| sign * (pair[1] - pair[0]) >= -1e-14);
                assert!(is_monotonic(if end > start { 1.0 } else { -1.0 }), "{start} {middle} {end}");
                assert_eq!([values[0], values[64]], [start, end]);
            }
        }
        // an estimate that needs no limit is met
        assert!((between([1.0, 2.3, 3.0], 0.5) - 2.3).abs() < 1e-15);
    }

    #[test]
    fn a_pair_that_is_loaded_at_one_end_only_has_no_load_at_the_other() {
        let with = |pairs: &[(usize, f64)]| {
            let mut load = MeshLoad::default();
            for &(tooth, stress) in pairs {
                load.add_pair(BentPair { drives: true, teeth: [tooth; 2], stress: [stress; 2] });
            }
            load
        };
        let [start, middle, end] =
            [with(&[(1, 5.0), (2, 4.0)]), with(&[(1, 90.0), (2, 4.0)]), with(&[(2, 4.0), (3, 6.0)])];
        let at = |part: f64| {
            let load = MeshLoad::between([&start, &middle, &end], part);
            [1, 2, 3].map(|tooth| {
                let name = BentPair { drives: true, teeth: [tooth; 2], ..BentPair::default() };
                load.stress_of(&name).map_or(f64::NAN, |stress| stress[0])
            })
        };
        assert_eq!((at(0.0), at(1.0)), ([5.0, 4.0, 0.0], [0.0, 4.0, 6.0]));
        assert_eq!(at(0.5), [3.75, 4.0, 1.5]);
    }
}
