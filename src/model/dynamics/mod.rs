//! The equations of motion, and the state they move: with teeth (`equations` and its parts), and of ideal gears (`rigid_equations`,
//! `ideal_step`). Forces, exact derivatives and the rates of the ledger come together.

pub mod accepted;
pub mod acting;
pub mod ahead;
pub mod bias;
mod blocks;
pub mod clock;
pub mod cycle;
pub mod equations;
mod friction;
mod ideal_step;
mod in_detail;
pub mod jacobian;
mod linearised;
mod loads;
mod motion;
mod on_bodies;
mod pair_loads;
pub mod power;
pub mod rigid_equations;
pub mod sizes;
pub mod state;
mod twists;
pub mod watched;
mod with_effects;

pub use accepted::Accepted;
pub use acting::{Acted, Acting};
pub use clock::Clock;
pub use equations::Equations;
pub use jacobian::Jacobian;
pub use rigid_equations::{RigidEquations, RigidTorques};
pub use sizes::{LARGEST, Largest};
pub use state::State;
pub use watched::{LastLoads, Watched};
