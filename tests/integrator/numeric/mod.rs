//! Tests of the numerics on which everything else is built.

mod elementary;
mod jet;
mod minimum;
mod root;
mod scalar;
