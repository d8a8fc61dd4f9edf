//! The mesh's force is the gradient of its energy, its Jacobian that of its force, and damping only ever dissipates.
//!
//! First for IMPACT, then for the other laws, whose energy also depends on the place of a pair on the path. The references
//! are central differences of the program's own energy and force; each comparison states their error.

#![allow(clippy::needless_range_loop)] // an index names the same axis or gear on both sides

mod damping;
mod gradient;
#[path = "../mesh_explicit/mod.rs"]
mod mesh_explicit;
#[path = "../mesh_laws/mod.rs"]
mod mesh_laws;
mod setup;
mod symmetry;
