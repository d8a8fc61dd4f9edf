//! Stress and fatigue of the teeth: declaration, load of a mesh, rating of a step, damage, and stresses above the
//! strength.
//!
//! Passages of teeth through their mesh are counted by relative revolutions (`strength::counting`). Load swings while a
//! tooth is in mesh are counted by the rainflow method, tooth by tooth (`strength::TeethInMesh`).

mod along_step;
mod fatigue;
mod gear_strength;
mod mesh_load;
mod overload;
mod spec;
mod utilisation;

pub use along_step::{Rated, RatedStep, Rolled, Sample};
pub use fatigue::Fatigue;
pub use gear_strength::{CONTACT_TEMPERATURE, GearStrength};
pub use mesh_load::{FlankLoad, MeshLoad};
pub use overload::Stressed;
pub use spec::StrengthSpec;
