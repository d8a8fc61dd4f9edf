//! Couplings of all pairs that can be loaded.

use crate::contact::bodies::{Coupling, LoadedPair, PairCouplings};

/// Maximum number of pairs of a planet's two meshes that can be loaded at the same time. Flanks approach by at most
/// half a base pitch. At this limit, a mesh with a dozen teeth has four such pairs, and a mesh with two hundred teeth
/// has up to eighteen; at a tenth of the limit, it has six. If there are more pairs, only the deepest count.
pub const MAX_PAIRS: usize = 16;

/// Storage for the pairs of a planet's two meshes, each with the approach of its flanks. It is large, so it is filled
/// in place.
pub struct Pairs<T> {
    pairs: [Option<T>; MAX_PAIRS],
    arc: [f64; MAX_PAIRS],
    count: usize,
}

impl<T> Pairs<T> {
    /// No pairs.
    #[inline(always)]
    pub fn none() -> Self {
        Self { pairs: std::array::from_fn(|_| None), arc: [0.0; MAX_PAIRS], count: 0 }
    }

    /// Adds a pair whose flanks approach by `arc` [rad]. If the storage is full, the pair replaces the shallowest pair,
    /// or is dropped if none is shallower.
    #[inline(always)]
    pub fn add(&mut self, arc: f64, pair: impl FnOnce() -> T) {
        let mut index = self.count;
        if self.count < MAX_PAIRS {
            self.count += 1;
        } else {
            let shallowest = (0..MAX_PAIRS).min_by(|&k, &l| self.arc[k].total_cmp(&self.arc[l]));
            index = shallowest.filter(|&k| self.arc[k] < arc).unwrap_or(MAX_PAIRS);
        }
        if let (Some(to), Some(depth)) = (self.pairs.get_mut(index), self.arc.get_mut(index)) {
            (*to, *depth) = (Some(pair()), arc);
        }
    }

    /// Pair `k`.
    #[inline(always)]
    pub fn get(&self, k: usize) -> Option<&T> {
        self.pairs.get(k).and_then(Option::as_ref)
    }

    /// Approaches of the flanks of all pairs [rad].
    #[inline(always)]
    pub fn arcs(&self) -> &[f64] {
        &self.arc[..self.count]
    }
}

/// Couplings t_kl of up to `K` pairs, with their derivatives with respect to the positions.
#[derive(Clone, Copy, Debug)]
pub struct Couplings<const K: usize> {
    /// t_kl, 0 for k = l and for missing pairs [1/Pa].
    pub value: [[f64; K]; K],
    /// ∂t_kl/∂s_k.
    pub by_own: [[f64; K]; K],
}

/// Second derivatives of the couplings t_kl.
#[derive(Clone, Copy, Debug)]
pub struct CouplingCurvatures<const K: usize> {
    /// ∂²t_kl/∂s_k².
    pub own: [[f64; K]; K],
    /// ∂²t_kl/∂s_k∂s_l.
    pub both: [[f64; K]; K],
}

impl<const K: usize> CouplingCurvatures<K> {
    /// Curvatures of an empty set of pairs.
    pub const NONE: Self = Self { own: [[0.0; K]; K], both: [[0.0; K]; K] };
}

impl<const K: usize> Couplings<K> {
    /// Couplings of an empty set of pairs.
    pub const NONE: Self = Self { value: [[0.0; K]; K], by_own: [[0.0; K]; K] };

    /// Sets the couplings of the pairs at their `positions`.
    #[inline(always)]
    pub fn set(&mut self, bodies: &PairCouplings, positions: &[Option<LoadedPair>; K]) {
        for_each_two::<false, K>(bodies, positions, |k, l, t: &Coupling| self.set_one(k, l, t));
    }

    /// Sets the couplings of the pairs at their `positions`, and their second derivatives.
    #[inline(always)]
    pub fn set_with_curvatures(
        &mut self,
        curvatures: &mut CouplingCurvatures<K>,
        bodies: &PairCouplings,
        positions: &[Option<LoadedPair>; K],
    ) {
        for_each_two::<true, K>(bodies, positions, |k, l, t: &Coupling| {
            self.set_one(k, l, t);
            (curvatures.own[k][l], curvatures.own[l][k]) = (t.hessian[0], t.hessian[2]);
            (curvatures.both[k][l], curvatures.both[l][k]) = (t.hessian[1], t.hessian[1]);
        });
    }

    #[inline(always)]
    fn set_one(&mut self, k: usize, l: usize, t: &Coupling) {
        (self.value[k][l], self.value[l][k]) = (t.value, t.value);
        (self.by_own[k][l], self.by_own[l][k]) = (t.gradient[0], t.gradient[1]);
    }

    /// Σ_l t_kl ω_l.
    #[inline(always)]
    pub fn moved(&self, load: &[f64; K]) -> [f64; K] {
        let mut product = [0.0; K];
        // t is symmetric, so whole rows can be summed as vectors; entries beyond the pairs are zero
        for l in 0..K {
            for k in 0..K {
                product[k] += self.value[l][k] * load[l];
            }
        }
        product
    }

    /// τ_k = Σ_l ∂t_kl/∂s_k ω_l.
    #[inline(always)]
    pub fn along(&self, load: &[f64; K]) -> [f64; K] {
        let mut product = [0.0; K];
        for k in 0..K {
            for l in 0..K {
                product[k] += self.by_own[k][l] * load[l];
            }
        }
        product
    }
}

/// Calls `visit` with every two of the pairs at `positions` and their coupling, with second derivatives if `CURVATURE`.
#[inline(always)]
fn for_each_two<const CURVATURE: bool, const K: usize>(
    bodies: &PairCouplings,
    positions: &[Option<LoadedPair>; K],
    mut visit: impl FnMut(usize, usize, &Coupling),
) {
    for k in 0..K {
        for l in 0..k {
            if let (Some(a), Some(b)) = (&positions[k], &positions[l]) {
                visit(k, l, &bodies.coupling::<CURVATURE>(a, b));
            }
        }
    }
}
