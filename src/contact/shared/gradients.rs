//! Gradients of own arcs, loads and forces along the path with respect to the coordinates of both meshes.

use super::{CouplingCurvatures, Couplings, OwnArcs};

/// Direct changes of a pair with the coordinate that moves its position, and with a coordinate that opens its flanks.
#[derive(Clone, Copy, Debug, Default)]
pub struct Change {
    /// Index of the coordinate, ∂s, and ∂ω at a constant own arc.
    pub position: (usize, f64, f64),
    /// Index of the coordinate, and ∂ω at a constant own arc.
    pub opening: (usize, f64),
}

/// Gradients of own arcs and forces along the path with respect to `Z` coordinates.
#[derive(Clone, Copy, Debug)]
pub struct Gradients<const K: usize, const Z: usize> {
    /// ∂a_k.
    pub own: [[f64; Z]; K],
    /// ∂(ω_k τ_k), τ_k = Σ_l ∂t_kl/∂s_k ω_l.
    pub along: [[f64; Z]; K],
}

impl<const K: usize, const Z: usize> Gradients<K, Z> {
    /// Computes the gradients of pairs with the own arcs `own` and τ_k = `along`. `arc` contains the gradients of their
    /// approaches A_k, and `changes` their direct changes.
    #[inline(always)]
    pub fn new(
        (couplings, curvatures): (&Couplings<K>, &CouplingCurvatures<K>),
        own: &OwnArcs<K>,
        along: &[f64; K],
        arc: [[f64; Z]; K],
        changes: &[Change; K],
    ) -> Self {
        let mut right = arc;
        for k in 0..K {
            let (coordinate, slope, _) = changes[k].position;
            right[k][coordinate] -= along[k] * slope;
            for l in (0..K).filter(|&l| l != k) {
                let Change { position: (coordinate, slope, load), opening: (opening, opened) } = changes[l];
                right[k][coordinate] -= couplings.by_own[l][k] * own.load[l] * slope + couplings.value[k][l] * load;
                right[k][opening] -= couplings.value[k][l] * opened;
            }
        }
        own.solve(couplings, &mut right);
        let mut load = right;
        for k in 0..K {
            load[k] = load[k].map(|by| own.stiffness[k] * by);
            load[k][changes[k].position.0] += changes[k].position.2;
            load[k][changes[k].opening.0] += changes[k].opening.1;
        }
        let mut along_by = [[0.0; Z]; K];
        for k in 0..K {
            let (coordinate, slope, _) = changes[k].position;
            along_by[k] = load[k].map(|by| by * along[k]);
            for l in (0..K).filter(|&l| l != k) {
                let of_other = own.load[k] * own.load[l];
                along_by[k][coordinate] += curvatures.own[k][l] * of_other * slope;
                along_by[k][changes[l].position.0] += curvatures.both[k][l] * of_other * changes[l].position.1;
                let by_other = own.load[k] * couplings.by_own[k][l];
                for z in 0..Z {
                    along_by[k][z] += by_other * load[l][z];
                }
            }
        }
        Self { own: right, along: along_by }
    }
}
