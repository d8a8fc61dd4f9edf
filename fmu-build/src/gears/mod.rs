//! What a user of gears runs: the study, scenes and their tooth loads, which effects matter, dimensions and solids, contact
//! patterns. Commands: `study`, `scene`, `loads`, `effects`, `geometry`, `pattern`.

pub mod effects;
pub mod geometry;
pub mod pattern;
pub mod scene;
pub mod study;
