//! One planet with both side gears under every kind of contact: laws, plain and detailed meshes, tooth errors,
//! friction, displaced side gears, stiff and elastic gear bodies.

mod bodies;
mod derivatives;
mod dissipation;
mod kinds;
mod patches;
mod points;
mod symmetry;
