//! Detailed mesh: tooth errors over the face, friction along the flanks, axially displaced gears, and bearing loads,
//! with exact derivatives.
//!
//! A slice at cone distance R_j penetrates by d_j = R_j (a − g) − e(R_j, s) − w ν(s). w is the side gear's displacement
//! away from the apex, and ν = cosδ_bs sin(ψ_s − s) is the axial component of the flank's normal. The potential is V =
//! Σ_k Σ_j J_j Φ(d_j/R_j, s) over tooth pairs k and points j of the face (`face`). Friction μ F along the flank has the
//! moment arms R cosδ_b sinψ about both axes. It opposes the sliding speed v = R (u_p cotδ_bp sinψ_p − u_s cotδ_bs
//! sinψ_s), where u are the speeds of both flanks along the line of action.
//!
//! Gear bodies are rigid, or elastic so that pairs move each other (`planet`, `on_bodies`). Quantities of a pair are
//! computed once per pair (`directions`, `opening`, `pair`). `sums` adds up the face in the pair's own
//! coordinates, and `totals` converts the sums to the coordinates of the mesh.

mod directions;
mod face;
mod face_load;
mod largest_on_face;
mod loaded_span;
mod loads;
mod mesh;
mod on_bodies;
mod opening;
mod pair;
mod planet;
mod points;
mod sums;
mod totals;
mod touching;

pub use directions::SlidingGeometry;
pub use face::Face;
pub use face_load::KnownSlice;
pub use largest_on_face::SlidingPoint;
pub use loads::{DetailedLoad, DetailedState, Opening, PairName, Slice, SliceLoad};
pub use mesh::{Detailed, MeshTeeth};
pub use pair::PairMotion;
pub use planet::Meshes;
pub use points::Node;
pub use totals::Totals;

/// Variables of a mesh: q, x, w and their rates.
pub const LOCAL: usize = 6;
/// Variables of a mesh on shared elastic bodies: those of [`LOCAL`], then q, x, w of the planet's other mesh.
pub const WITH_OTHER: usize = LOCAL + 3;
