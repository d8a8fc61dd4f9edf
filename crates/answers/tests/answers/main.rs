//! Answers to questions about scenes and gears.

mod accuracy;
mod clutch_curve;
mod geometry;
mod header;
mod interference;
mod off;
mod pattern;
mod refusals;
mod scene_inputs;
mod scenes;
mod suggestions;

use std::path::{Path, PathBuf};

/// Root of the repository.
fn workspace() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join("..")
}

/// The scenes of the repository.
fn folder() -> PathBuf {
    workspace().join("scenes")
}
