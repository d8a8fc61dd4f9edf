//! The mesh in detail: with plain teeth it is the plain mesh; with gaps, displacements and friction its forces derive from
//! its energy, its derivatives are exact, and friction dissipates the power of the sliding flanks.

#![allow(clippy::needless_range_loop)] // an index names the same axis or variable on both sides

mod derivatives;
mod friction;
#[path = "../mesh_explicit/mod.rs"]
mod mesh_explicit;
#[path = "../mesh_laws/mod.rs"]
mod mesh_laws;
mod parts;
mod patches;
mod plain;
mod setup;
