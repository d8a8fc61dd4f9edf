//! Peak-to-peak values over whole mesh cycles: declaration and history.

mod history;
mod spec;

pub use history::{MOST_QUANTITIES, MeshHistory};
pub use spec::MeshHistorySpec;
