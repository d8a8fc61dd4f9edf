//! The mesh in detail: with plain teeth it is the plain mesh; with gaps, displacements and friction its forces derive from
//! its energy, its derivatives are exact, and friction dissipates the power of the sliding flanks.

mod derivatives;
mod friction;
mod parts;
mod patches;
mod plain;
mod setup;
