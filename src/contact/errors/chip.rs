//! Broken tooth: where material is missing the gap is the removed depth, and nothing touches.
//!
//! Under the laws that integrate over the face the piece covers the slices beyond R_e − f b, f its fraction of the face
//! width b from the heel. The law that acts at R_m alone sees it only if it reaches the middle, f > ½. The piece
//! breaks off instantly and permanently, on both flanks and in every mesh of the tooth.

use super::spec::{FaultyGear, ToothFaultSpec};
use super::{MeshId, PairId};
use crate::geometry::Pair;
use crate::problem::Problem;

/// The broken tooth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chip {
    on_planet: bool,
    index: usize,
    tooth: usize,
    /// Cone distance beyond which material is missing [m].
    from: f64,
    depth: f64,
    onset: f64,
}

impl Chip {
    /// The tooth that `spec` breaks on the gears of `pair` with `planets` planets, if any.
    pub fn new(spec: &ToothFaultSpec, pair: &Pair, planets: usize) -> Result<Option<Self>, Problem> {
        spec.check(pair.gears.map(|g| g.teeth), planets)?;
        let on_planet = spec.gear == FaultyGear::Planet;
        let face_width = pair.outer_cone - pair.inner_cone;
        // all of it passed the check above
        let whole = |i: i32| usize::try_from(i).unwrap_or(0);
        Ok((spec.gear != FaultyGear::None).then(|| Self {
            on_planet,
            index: whole(spec.index),
            tooth: whole(spec.tooth),
            from: pair.outer_cone - spec.missing_fraction * face_width,
            depth: spec.depth,
            onset: spec.onset,
        }))
    }

    /// Time at which the piece breaks off without a trigger [s], if it does.
    pub fn onset(&self) -> Option<f64> {
        (self.onset > 0.0).then_some(self.onset)
    }

    /// Whether the broken tooth is in the pair.
    #[inline(always)]
    fn is_in(&self, mesh: MeshId, pair: PairId) -> bool {
        let (index, tooth) =
            if self.on_planet { (mesh.planet, pair.planet_tooth) } else { (mesh.side, pair.side_tooth) };
        index == self.index && tooth == self.tooth
    }

    /// Cone distance beyond which material is missing on the pair, its indices in range, and its depth [m], if it is.
    #[inline(always)]
    pub fn edge(&self, mesh: MeshId, pair: PairId) -> Option<(f64, f64)> {
        self.is_in(mesh, pair).then_some((self.from, self.depth))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::pairs::Flank;
    use crate::geometry::GearSpec;

    #[test]
    fn only_the_broken_tooth_misses_material_and_only_from_the_heel() {
        let pair = Pair::new(&GearSpec::default());
        let spec = ToothFaultSpec {
            gear: FaultyGear::Side,
            index: 1,
            tooth: 5,
            missing_fraction: 0.25,
            depth: 2e-3,
            ..ToothFaultSpec::default()
        };
        let chip = Chip::new(&spec, &pair, 2).unwrap().unwrap();
        let id = |side_tooth| PairId { planet_tooth: 3, side_tooth, flank: Flank::Coast };
        let (left, right) = (MeshId { planet: 0, side: 0 }, MeshId { planet: 1, side: 1 });
        let edge = pair.outer_cone - 0.25 * (pair.outer_cone - pair.inner_cone);
        assert_eq!(chip.edge(right, id(5)), Some((edge, 2e-3)));
        assert_eq!(chip.edge(right, id(4)), None);
        assert_eq!(chip.edge(left, id(5)), None);
        assert_eq!(Chip::new(&ToothFaultSpec::default(), &pair, 2), Ok(None));
        assert!(Chip::new(&ToothFaultSpec { index: 2, ..spec }, &pair, 2).is_err());
    }

    #[test]
    fn an_onset_of_zero_leaves_breaking_to_the_trigger() {
        let pair = Pair::new(&GearSpec::default());
        let onset = |onset| {
            let spec = ToothFaultSpec { gear: FaultyGear::Planet, onset, ..ToothFaultSpec::default() };
            Chip::new(&spec, &pair, 2).unwrap().unwrap().onset()
        };
        assert_eq!((onset(0.2), onset(0.0)), (Some(0.2), None));
    }
}
