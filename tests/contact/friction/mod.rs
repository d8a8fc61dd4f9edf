//! Friction between flanks: each law by hand, and what all have in common.

mod benedict_kelley;
mod coulomb;
mod iso14179;
mod laws;
mod smooth;
mod spec;
mod xu_kahraman;
