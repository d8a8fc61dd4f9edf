//! A mesh in full detail: tooth errors slice by slice, friction along the flanks, gears that give way along their axes,
//! and the loads that bearings see. Written once for values and for values with exact derivatives.
//!
//! A slice at cone distance R_j penetrates by d_j = R_j (a − g) − e_j(s) − w ν(s): w is what the side gear has moved away
//! from the apex, ν = cosδ_bs sin(ψ_s − s) the part of the flank's normal along its axis. V = Σ_k Σ_j J_j Φ(d_j/R_j, s)
//! over tooth pairs k and slices j. Friction μ F along the flank has the lever arms R cosδ_b sinψ about both axes and is
//! opposed to the sliding speed v = R (u_p cotδ_bp sinψ_p − u_s cotδ_bs sinψ_s), where u are the travels of both flanks
//! along the line of action.

mod forces;
mod loads;
mod mesh;

pub use loads::{DetailedLoad, DetailedState, Gaps, PairName, Slice, SliceLoad};
pub use mesh::Detailed;
