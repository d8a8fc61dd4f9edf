//! Tooth contact: the law of one pair, and the elastic potential of a mesh.

pub mod hertz;
pub mod impact;
pub mod mesh;
mod spec;
pub mod spring;

pub use spec::{ContactLaw, ContactSpec};
