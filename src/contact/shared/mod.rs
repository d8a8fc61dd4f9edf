//! Tooth pairs on shared gear bodies: loads of all pairs of a planet's two meshes, derived from one potential.
//!
//! The arc A_k of a pair has two parts. The own arc a_k is the deflection of tooth, root and Hertzian contact under the
//! pair's own load ω_k(a_k). The second part is the displacement by the loads of the other pairs:
//!
//!   a_k + Σ_l t_kl ω_l(a_l) = A_k,   l ≠ k.
//!
//! A pair with a_k ≤ 0 is not loaded. With U_k(a) the energy of a single pair, M = ∂U/∂a = Jω and J = ∫R² dR,
//!
//! V = Σ U_k(a_k) + ½ J Σ t_kl ω_k ω_l,   ∂V/∂A_k = M_k,   ∂V/∂s_k = ∂U_k/∂s − J ω_k Σ_l ∂t_kl/∂s_k ω_l.
//!
//! V is stationary in the loads, so the derivatives of the own arcs a contribute nothing. Damping scales M or is added
//! to it. Damping uses the rate Ȧ of the whole approach of the flanks.

mod arcs;
mod couplings;
mod gradients;
mod opening_by_others;
mod sharing;

pub use arcs::OwnArcs;
pub use couplings::{CouplingCurvatures, Couplings, MAX_PAIRS, Pairs};
pub use gradients::{Change, Gradients};
pub use opening_by_others::OpeningByOthers;
pub use sharing::{COORDINATES, Share, Sharing};
