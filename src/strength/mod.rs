//! Strength of the teeth: contact pressure, root stress, and the resulting damage while the gears turn.
//!
//! The formulas use forces and angles and have no access to the model state: a simulation passes the values of each
//! accepted step. [`Rating`] contains the constants of a pair of gears. [`ToothDamage`] contains the damage of passages
//! through the mesh. [`TeethInMesh`] contains, tooth by tooth, the damage of load swings during the passages, which
//! [`Rainflow`] counts.

pub mod counting;
mod damage;
pub mod face_load;
pub mod flash;
pub mod hertz;
mod in_mesh;
pub mod interval;
pub mod material;
pub mod mean_stress;
pub mod miner;
mod passage;
mod place;
pub mod rainflow;
mod rating;
pub mod root_stress;
pub mod tooth_form;
mod tooth_sums;

pub use counting::{Rolling, loaded_flank};
pub use damage::{Cycle, FlankDamage, ToothDamage};
pub use hertz::LineContact;
pub use in_mesh::TeethInMesh;
pub use material::{SnCurve, ToothStrength};
pub use mean_stress::pulsating_range;
pub use miner::Damage;
pub use passage::Passage;
pub use place::MeshPlace;
pub use rainflow::{LoadCycle, Rainflow};
pub use rating::Rating;
pub use root_stress::RootStressFactors;
pub use tooth_form::{Profile, ToothForm};
pub use tooth_sums::ToothSums;
