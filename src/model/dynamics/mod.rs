//! The equations of motion, and the state they move: with teeth (`equations` and its parts), and of ideal gears (`ideal_equations`,
//! `ideal_step`). Forces, exact derivatives and the rates of the ledger come together.

pub mod accepted;
pub mod acting;
mod blocks;
pub mod clock;
pub mod cycle;
mod energy_floor;
#[cfg(test)]
#[path = "tests/energy_floor.rs"]
mod energy_floor_tests;
pub mod equations;
pub mod event;
mod friction;
pub mod ideal_equations;
mod ideal_step;
mod in_detail;
pub mod jacobian;
pub mod ledger_rates;
mod linearised;
mod loads;
mod motion;
mod on_bodies;
mod pair_loads;
pub mod pending_step;
pub mod pv;
pub mod rattle;
pub mod sizes;
pub mod state;
pub mod torque_means;
mod twists;
pub mod watched;
mod with_effects;

pub use accepted::Accepted;
pub use acting::{Acted, Acting};
pub use clock::Clock;
pub use equations::Equations;
pub use ideal_equations::{IdealEquations, IdealTorques};
pub use jacobian::Jacobian;
pub use pv::each_pv;
pub use sizes::{LARGEST, Largest};
pub use state::State;
pub use watched::{LastLoads, Watched};
