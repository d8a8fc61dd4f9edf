//! Strength of the teeth: contact pressure, root stress, and the damage that both do as the gears turn.
//!
//! Formulas of forces and angles without model state: a simulation passes the values of each accepted step. [`Rating`] holds
//! the constants of a pair of gears, [`ToothDamage`] the accumulated damage; [`Rainflow`] counts load cycles of teeth that
//! stand still in mesh.

pub mod counting;
mod damage;
pub mod hertz;
pub mod material;
pub mod mean_stress;
pub mod miner;
pub mod rainflow;
mod rating;
pub mod root_stress;
pub mod tooth_form;

pub use counting::{Rolling, loaded_flank};
pub use damage::{FlankDamage, Load, ToothDamage};
pub use hertz::LineContact;
pub use material::{Material, SnCurve};
pub use mean_stress::pulsating_range;
pub use miner::Damage;
pub use rainflow::{LoadCycle, Rainflow};
pub use rating::Rating;
pub use root_stress::{LoadFactors, RootStress};
pub use tooth_form::{Profile, ToothForm};
