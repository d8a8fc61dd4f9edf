//! Friction between flanks: hand calculations for each law, and properties of all laws.

mod benedict_kelley;
mod coulomb;
mod iso14179;
mod laws;
mod smooth;
mod spec;
mod xu_kahraman;
