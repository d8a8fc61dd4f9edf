//! Stress and fatigue of the teeth: declaration, load of a mesh, rating of a step, damage, and stresses above the strength.
//!
//! Damage of rolling teeth is counted by relative revolutions (`strength::counting`). Teeth that stay in mesh are loaded by
//! the torque alone: the stress of their roots is counted by rainflow until they roll on (`strength::StandingTeeth`).

mod along_step;
mod fatigue;
mod gear_strength;
mod interval;
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
