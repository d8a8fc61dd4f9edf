//! Strength of the teeth: contact pressure, root stress, and the damage that both do as the gears turn.
//!
//! Formulas of forces and angles without model state: a simulation passes the values along each accepted step. [`Rating`] holds
//! the constants of a pair of gears, [`ToothDamage`] the damage of teeth that roll, [`StandingTeeth`] that of teeth that stand
//! still in mesh, whose load cycles [`Rainflow`] counts.

pub mod counting;
mod damage;
pub mod face_load;
pub mod flash;
pub mod hertz;
pub mod material;
pub mod mean_stress;
pub mod miner;
pub mod rainflow;
mod rating;
pub mod root_stress;
mod standing;
pub mod tooth_form;

pub use counting::{Rolling, loaded_flank};
pub use damage::{Cycle, FlankDamage, ToothDamage};
pub use hertz::LineContact;
pub use material::{SnCurve, ToothStrength};
pub use mean_stress::pulsating_range;
pub use miner::Damage;
pub use rainflow::{LoadCycle, Rainflow};
pub use rating::Rating;
pub use root_stress::RootStress;
pub use standing::StandingTeeth;
pub use tooth_form::{Profile, ToothForm};
