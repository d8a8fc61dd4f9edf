//! Opening of the flanks of a pair: tooth errors, and the axial displacement of the side gear.

use super::directions::Arcs;
use super::{Detailed, DetailedState, MeshTeeth, Opening, PairName};
use crate::contact::Flank;

/// Opening of the flanks of a pair with the data that depend on its position.
#[derive(Clone)]
pub struct Opened {
    /// The opening.
    pub opening: Opening,
    /// ν and ∂ν/∂s of the side gear's axial displacement.
    pub axial: [f64; 2],
    /// Arcs of the pair, computed only with axial seats.
    pub arcs: Arcs,
}

impl Opened {
    /// Flanks that fit, with side gears that stay on their axes.
    pub const NONE: Self = Self { opening: Opening::NONE, axial: [0.0; 2], arcs: Arcs::NONE };
}

impl Detailed {
    /// True if there may be gaps or excess material between the flanks of pairs.
    pub(super) fn is_open(&self, teeth: &MeshTeeth) -> bool {
        self.has_seats || teeth.gaps.is_some()
    }

    /// Opening of the flanks of pair `number` of `flank` at position `s` [rad] and cone distance `cone` [m], as an arc
    /// [rad].
    pub fn opened(
        &self,
        teeth: &MeshTeeth,
        state: &DetailedState,
        (flank, number, s): (Flank, i64, f64),
        cone: f64,
    ) -> f64 {
        let name = teeth.name(flank, number, state.wrapped);
        self.opened_pair(teeth, &name, s, state.position[2]).opening.at(cone) / cone
    }

    /// Opening of the flanks of a pair at the position `s` [rad] and the axial displacement `w` [m] of its side gear.
    #[inline(always)]
    pub(super) fn opened_pair(&self, teeth: &MeshTeeth, name: &PairName, s: f64, w: f64) -> Opened {
        let mut opened =
            Opened { opening: teeth.gaps.map_or(Opening::NONE, |gaps| gaps.opening(name, s)), ..Opened::NONE };
        if self.has_seats {
            opened.arcs = self.directions.arcs(s);
            opened.axial = self.directions.axial(&opened.arcs);
            opened.opening.displace(w, opened.axial);
        }
        opened
    }
}
