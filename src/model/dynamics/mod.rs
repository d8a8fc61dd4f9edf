//! The equations of motion, and the state they move: with teeth (`equations` and its parts), and of ideal gears (`rigid`,
//! `ideal_step`). Forces, exact derivatives and the rates of the ledger come together.

pub mod cycle;
pub mod equations;
mod ideal_step;
mod in_detail;
mod linearised;
mod loads;
mod motion;
pub mod power;
pub mod rigid;
mod rigid_sticking;
pub mod sizes;
pub mod state;
mod sticking;
mod with_effects;
