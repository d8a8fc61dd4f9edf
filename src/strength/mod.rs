//! Strength of the teeth: contact pressure, root stress, and the resulting damage while the gears turn.
//!
//! The formulas use forces and angles and have no access to the model state: a simulation passes the values of each
//! accepted step. [`Rating`] contains the constants of a pair of gears. [`ToothHistory`] contains the load history and
//! the damage of one tooth. [`RatedPoint`] and [`ToothInMesh`] tell which teeth roll through a mesh.

pub mod face_load;
pub mod flash;
pub mod hertz;
pub mod interval;
pub mod material;
pub mod mean_stress;
pub mod rainflow;
mod rating;
mod rolling;
pub mod root_stress;
pub mod tooth_form;
mod tooth_history;

pub use hertz::LineContact;
pub use material::{SnCurve, ToothStrength};
pub use mean_stress::pulsating_range;
pub use rainflow::{LoadCycle, Rainflow};
pub use rating::Rating;
pub use rolling::{Passing, RatedPoint, ToothInMesh};
pub use root_stress::RootStressFactors;
pub use tooth_form::{Profile, ToothForm};
pub use tooth_history::{Bending, RootDamage, ToothHistory, loaded_flank};
