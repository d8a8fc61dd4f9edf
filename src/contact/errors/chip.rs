//! Broken tooth: if material is missing, the gap is the removed depth, and nothing touches.
//!
//! Under laws that integrate over the face, the piece covers the slices beyond R_e − f b. f is the piece's fraction of
//! the face width b, measured from the heel. The law that acts only at R_m is affected only if the piece reaches the
//! middle, f > ½. The piece breaks off instantly and permanently, on both flanks and in every mesh of the tooth.

use super::{FaultyGear, MeshId, PairId, ToothFaultSpec};
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
    /// Missing depth along the line of action [m].
    depth: f64,
}

impl Chip {
    /// Returns the tooth that `spec` breaks on the gears of `pair` with `planets` planets, or `None` if no tooth
    /// breaks. Fails if `spec` is invalid for these gears.
    pub fn new(spec: &ToothFaultSpec, pair: &Pair, planets: usize) -> Result<Option<Self>, Problem> {
        spec.check(pair.gears.map(|g| g.teeth), planets)?;
        let on_planet = spec.gear == FaultyGear::Planet;
        let face_width = pair.outer_cone - pair.inner_cone;
        // all values passed the check above
        let whole = |i: i32| usize::try_from(i).unwrap_or(0);
        Ok((spec.gear != FaultyGear::None).then(|| Self {
            on_planet,
            index: whole(spec.index),
            tooth: whole(spec.tooth),
            from: pair.outer_cone - spec.missing_fraction * face_width,
            depth: spec.depth,
        }))
    }

    /// True if the broken tooth is in the pair.
    #[inline(always)]
    fn is_in(&self, mesh: MeshId, pair: PairId) -> bool {
        let (index, tooth) =
            if self.on_planet { (mesh.planet, pair.planet_tooth) } else { (mesh.side, pair.side_tooth) };
        index == self.index && tooth == self.tooth
    }

    /// Cone distance beyond which material is missing on the pair, and the missing depth [m], or `None`. The indices
    /// must be in range.
    #[inline(always)]
    pub fn edge(&self, mesh: MeshId, pair: PairId) -> Option<(f64, f64)> {
        self.is_in(mesh, pair).then_some((self.from, self.depth))
    }
}
