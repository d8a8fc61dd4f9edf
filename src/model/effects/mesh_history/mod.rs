//! Peak-to-peak values over whole mesh cycles: declaration, and what is kept from step to step.

mod history;
mod spec;

pub use history::{MOST_QUANTITIES, MeshHistory};
pub use spec::MeshHistorySpec;
