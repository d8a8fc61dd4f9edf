//! Shares of the load: the load on each pair of a planet's two meshes, and its changes with the coordinates of both
//! meshes.
//!
//! The solution is compiled separately for the usual numbers of pairs, because the compiler unrolls loops over arrays of
//! exactly that size.

use super::couplings::MAX_PAIRS;
use super::{Change, CouplingCurvatures, Couplings, Gradients, OwnArcs};
use crate::contact::bodies::{LoadedPair, PairCouplings};

/// Coordinates of both meshes: q, x and w, left and right.
pub const COORDINATES: usize = 6;

/// Pairs that share the bodies of their gears.
pub struct Sharing<'a> {
    /// Couplings through the bodies.
    pub bodies: &'a PairCouplings,
    /// Approaches A_k of the flanks [rad], one per pair.
    pub arcs: &'a [f64],
    /// Loaded pair by its index; `None` beyond the last pair.
    pub loaded_pair: &'a dyn Fn(usize) -> Option<LoadedPair>,
    /// Load ω of a pair at its own arc a [N/m²], and ∂ω/∂a.
    pub law: &'a dyn Fn(usize, f64) -> [f64; 2],
    /// True if ω is proportional to a for positive a.
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
    /// ∂a_k and ∂(ω_k τ_k) with respect to the coordinates of both meshes, if requested.
    pub slopes: Option<[&'a [f64; COORDINATES]; 2]>,
}

impl Share<'_> {
    /// Share of a pair that no other pair moves.
    #[inline(always)]
    pub fn alone(own: f64) -> Self {
        Self { own, load: 0.0, along: 0.0, slopes: None }
    }
}

/// Derivatives of the approach A_k of a pair with respect to the coordinates, and its direct changes.
pub type Changes = ([f64; COORDINATES], Change);

impl Sharing<'_> {
    /// Calls `see` with the shares of all pairs. If `changes` is given, as a function of number and own arc, the shares
    /// include slopes.
    pub fn solve(&self, changes: Option<&dyn Fn(usize, f64) -> Changes>, see: &mut dyn FnMut(&[Share])) {
        match self.arcs.len() {
            0 => {}
            1 => self.solve_in::<1>(changes, see),
            2 => self.solve_in::<2>(changes, see),
            3 => self.solve_in::<3>(changes, see),
            4 => self.solve_in::<4>(changes, see),
            5..=8 => self.solve_in::<8>(changes, see),
            _ => self.solve_in::<MAX_PAIRS>(changes, see),
        }
    }

    #[inline(never)]
    fn solve_in<const K: usize>(&self, changes: Option<&dyn Fn(usize, f64) -> Changes>, see: &mut dyn FnMut(&[Share])) {
        // loops over all K entries have a constant length, and missing pairs contribute zeros
        let n = self.arcs.len().min(K);
        let (mut arcs, mut positions) = ([0.0; K], [None; K]);
        for k in 0..n {
            (arcs[k], positions[k]) = (self.arcs[k], (self.loaded_pair)(k));
        }
        let mut couplings = Couplings::NONE;
        let Some(changes) = changes else {
            couplings.set(self.bodies, &positions);
            let own = self.own_arcs(&couplings, &arcs);
            let along = couplings.along(&own.load);
            see(&shares(&own, &along, |_| None)[..n]);
            return;
        };
        let mut curvatures = CouplingCurvatures::NONE;
        couplings.set_with_curvatures(&mut curvatures, self.bodies, &positions);
        let own = self.own_arcs(&couplings, &arcs);
        let along = couplings.along(&own.load);
        let (mut by, mut change) = ([[0.0; COORDINATES]; K], [Change::default(); K]);
        for k in 0..K {
            (by[k], change[k]) = changes(k, own.arc[k]);
        }
        let gradients = Gradients::new((&couplings, &curvatures), &own, &along, by, &change);
        see(&shares(&own, &along, |k| Some([&gradients.own[k], &gradients.along[k]]))[..n]);
    }

    #[inline(always)]
    fn own_arcs<const K: usize>(&self, couplings: &Couplings<K>, arcs: &[f64; K]) -> OwnArcs<K> {
        // a pair whose flanks do not approach each other by themselves is rarely loaded
        if self.is_linear && arcs.iter().all(|&arc| arc > 0.0) {
            OwnArcs::linear(couplings, arcs, self.law)
        } else {
            OwnArcs::new(couplings, arcs, self.law)
        }
    }
}

/// Shares of all pairs with τ_k = `along` and their `slopes`.
#[inline(always)]
fn shares<'a, const K: usize>(
    own: &OwnArcs<K>,
    along: &[f64; K],
    slopes: impl Fn(usize) -> Option<[&'a [f64; COORDINATES]; 2]>,
) -> [Share<'a>; K] {
    std::array::from_fn(|k| Share { own: own.arc[k], load: own.load[k], along: along[k], slopes: slopes(k) })
}
