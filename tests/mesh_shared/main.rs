//! Meshes of a planet that share elastic bodies: forces of all pairs from one energy, exact derivatives, and loads of pairs as
//! the compliance between them says.

#![allow(clippy::needless_range_loop)] // an index names the same axis or variable on both sides

mod derivatives;
#[path = "../mesh_explicit/mod.rs"]
mod mesh_explicit;
mod pairs;
mod setup;
