//! Pairs of teeth that share the bodies of their gears: loads of all pairs of a planet's two meshes, from one potential.
//!
//! The arc A_k of a pair is its own, a_k, of tooth, root and Hertz under its own load ω_k(a_k), and what the loads of the others
//! move it by:
//!
//!   a_k + Σ_l t_kl ω_l(a_l) = A_k,   l ≠ k.
//!
//! A pair with a_k ≤ 0 carries nothing. With U_k(a) the energy of a pair alone, M = ∂U/∂a = Jω and J = ∫R² dR,
//!
//!   V = Σ U_k(a_k) + ½ J Σ t_kl ω_k ω_l,   ∂V/∂A_k = M_k,   ∂V/∂s_k = ∂U_k/∂s − J ω_k Σ_l ∂t_kl/∂s_k ω_l:
//!
//! what depends on a through V drops out, as V is stationary in the loads. Damping scales or adds to M with the rate Ȧ, so that
//! it takes what the approach of the flanks gives.

mod arcs;
mod couplings;
mod gradients;
mod moved;
mod plain;

pub use arcs::Own;
pub use couplings::{Bends, Couplings, MOST, place_for};
pub use gradients::{Change, Gradients};
pub use moved::Moved;
pub use plain::{SharedForce, SharedMeshes};
