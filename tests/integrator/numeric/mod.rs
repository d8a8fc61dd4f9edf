//! The numerics under everything.

mod elementary;
mod jet;
mod minimum;
mod root;
mod scalar;
