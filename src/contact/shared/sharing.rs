//! Shares of the load: what each pair of a planet's two meshes carries, and how this changes with the coordinates of both.
//!
//! The solution is compiled for the usual numbers of pairs: arrays that just fit need not be cleared for more.

use super::couplings::MOST_PAIRS;
use super::{Change, Couplings, Gradients, OwnArcs};
use crate::contact::bodies::{PairCouplings, PairPlace};

/// Coordinates of both meshes: q, x and w, left and right.
pub const COORDINATES: usize = 6;

/// Numbers of pairs up to this one have room for just as many.
const EXACT: usize = 4;

/// Pairs that share the bodies of their gears.
pub struct Sharing<'a> {
    /// The bodies.
    pub bodies: &'a PairCouplings,
    /// Approaches A_k of the flanks [rad], one of each pair.
    pub arcs: &'a [f64],
    /// Place of a pair.
    pub place: &'a dyn Fn(usize) -> Option<&'a PairPlace>,
    /// Load ω of a pair at its own arc a [N/m²], and ∂ω/∂a.
    pub law: &'a dyn Fn(usize, f64) -> [f64; 2],
    /// True if ω is proportional to a where a is positive.
    pub is_linear: bool,
}

/// Share of a pair.
pub struct Share<'a> {
    /// Own arc a_k [rad].
    pub own: f64,
    /// Load ω_k [N/m²].
    pub load: f64,
    /// τ_k = Σ_l ∂t_kl/∂s_k ω_l.
    pub along: f64,
    /// ∂a_k and ∂(ω_k τ_k) by the coordinates of both meshes, if they were asked for.
    pub slopes: Option<[&'a [f64; COORDINATES]; 2]>,
}

/// Derivatives of the approach A_k of a pair by the coordinates, and its other changes.
pub type Changes = ([f64; COORDINATES], Change);

impl Sharing<'_> {
    /// Calls `see` with the number and the share of each pair; with slopes if `changes` are given, by number and own arc.
    pub fn solve(&self, changes: Option<&dyn Fn(usize, f64) -> Changes>, see: &mut dyn FnMut(usize, &Share)) {
        match self.arcs.len() {
            0 => {}
            1 => self.solve_in::<1>(changes, see),
            2 => self.solve_in::<2>(changes, see),
            3 => self.solve_in::<3>(changes, see),
            4 => self.solve_in::<4>(changes, see),
            5..=8 => self.solve_in::<8>(changes, see),
            _ => self.solve_in::<MOST_PAIRS>(changes, see),
        }
    }

    #[inline(never)]
    fn solve_in<const K: usize>(
        &self,
        changes: Option<&dyn Fn(usize, f64) -> Changes>,
        see: &mut dyn FnMut(usize, &Share),
    ) {
        // a constant where there is room for just as many
        let n = if K <= EXACT { K } else { self.arcs.len().min(K) };
        let mut arcs = [0.0; K];
        arcs[..n].copy_from_slice(&self.arcs[..n]);
        let places: [Option<&PairPlace>; K] = std::array::from_fn(|k| if k < n { (self.place)(k) } else { None });
        let Some(changes) = changes else {
            let couplings = Couplings::new(self.bodies, n, &places);
            let own = self.own_arcs(&couplings, &arcs);
            let along = couplings.along(&own.load);
            for k in 0..n {
                see(k, &Share { own: own.arc[k], load: own.load[k], along: along[k], slopes: None });
            }
            return;
        };
        let (couplings, curvatures) = Couplings::with_curvatures(self.bodies, n, &places);
        let own = self.own_arcs(&couplings, &arcs);
        let along = couplings.along(&own.load);
        let (mut by, mut change) = ([[0.0; COORDINATES]; K], [Change::default(); K]);
        for k in 0..n {
            (by[k], change[k]) = changes(k, own.arc[k]);
        }
        let gradients = Gradients::new((&couplings, &curvatures), &own, &along, by, &change);
        for k in 0..n {
            let slopes = Some([&gradients.own[k], &gradients.along[k]]);
            see(k, &Share { own: own.arc[k], load: own.load[k], along: along[k], slopes });
        }
    }

    #[inline(always)]
    fn own_arcs<const K: usize>(&self, couplings: &Couplings<K>, arcs: &[f64; K]) -> OwnArcs<K> {
        // a pair whose flanks do not approach each other by themselves hardly ever carries
        if self.is_linear && arcs.iter().all(|&arc| arc > 0.0) {
            OwnArcs::linear(couplings, arcs, self.law)
        } else {
            OwnArcs::new(couplings, arcs, self.law)
        }
    }
}
