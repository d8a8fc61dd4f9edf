//! Meshes of a planet that share elastic bodies: forces of all pairs from one energy, exact derivatives, and loads of pairs as
//! the compliance between them says.

mod derivatives;
mod many_teeth;
mod pairs;
mod setup;
