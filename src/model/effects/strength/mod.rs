//! Stress and fatigue of the teeth: declaration, load of a mesh, rating of a step, damage, and stresses above the
//! strength.
//!
//! Each tooth of each gear has its own history (`strength::ToothHistory`).

mod along_step;
mod fatigue;
mod gear_strength;
mod mesh_load;
mod overload;
mod spec;
mod utilisation;

pub use along_step::{RatedPlanet, RatedStep};
pub use fatigue::{Fatigue, Tally};
pub use gear_strength::{CONTACT_TEMPERATURE, GearStrength};
pub use mesh_load::{FlankLoad, MeshLoad, Sample};
pub use overload::Stressed;
pub use spec::StrengthSpec;
