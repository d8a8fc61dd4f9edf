//! Equations of motion, and the state that they change. In the order of an evaluation:
//!
//! - `shape`: degrees of freedom of equations with teeth, and their indices;
//! - `inputs_and_friction`: inputs and dry friction, with and without teeth;
//! - `planet_contact`: loads of the meshes; `mesh_transform`: their forces on gears, carrier, pins and seats;
//!   `dry_friction`: friction under these loads;
//! - `equations`: effects on bodies, inputs, and the resulting accelerations; `driven`: inputs that change with time;
//! - `motion`: interface of the equations to an integrator;
//! - `ideal`, `ideal_motion`: equations without teeth, and their interface to an integrator; `closed_form`: motion of
//!   ideal gears without effects, in closed form;
//! - `ledger_rates`, `energy_floor`: powers that are computed with the forces, and the energy that a step does not
//!   resolve;
//! - `state`, `acting_inputs`, `timeline`, `pending_step`, `sums`, `shaft_means`, `event`, `rattle`: results of
//!   the steps.

pub mod acting_inputs;
pub mod actuated;
pub mod applied;
mod closed_form;
pub mod dogs;
mod driven;
#[cfg(test)]
#[path = "tests/driven.rs"]
mod driven_tests;
mod dry_friction;
mod energy_floor;
#[cfg(test)]
#[path = "tests/energy_floor.rs"]
mod energy_floor_tests;
pub mod equations;
pub mod event;
pub mod ideal;
mod ideal_motion;
#[cfg(test)]
#[path = "tests/ideal.rs"]
mod ideal_tests;
pub mod inputs_and_friction;
pub mod ledger_rates;
mod mesh_transform;
mod motion;
pub mod pending_step;
mod pinion_loss;
pub mod planet_contact;
pub mod rattle;
pub mod shaft_means;
pub mod shape;
pub mod state;
pub mod sums;
pub mod timeline;

pub use actuated::{Actuated, Actuators};
pub use applied::InputsAndFriction;
pub use equations::{Equations, Largest};
pub use ideal::{IdealEquations, IdealTorques};
pub use inputs_and_friction::{FrictionEquations, Jacobian};
pub use pinion_loss::PinionLoss;
pub use shape::MAX_SIZE;
pub use state::State;
pub use sums::Sums;
pub use timeline::{Clock, CommunicationPoint, Stop};

/// Evaluates an expression with the equations of any model bound to `$equations`. `N` is their maximum number of
/// degrees of freedom.
macro_rules! with_equations {
    ($model:expr, $state:expr, $inputs:expr, |$equations:ident| $body:expr) => {
        match &$model.gears {
            $crate::model::assembly::model::Gears::Ideal(ideal) => {
                #[allow(unused)]
                const N: usize = $crate::model::assembly::ideal_with_effects::IDEAL_SIZE;
                #[allow(unused_mut)]
                let mut $equations = $crate::model::dynamics::ideal::IdealEquations::<N>::new(ideal, $inputs, $state);
                $body
            }
            $crate::model::assembly::model::Gears::Teeth(teeth) => {
                #[allow(unused)]
                const N: usize = $crate::model::dynamics::MAX_SIZE;
                #[allow(unused_mut)]
                let mut $equations = $crate::model::dynamics::Largest::new(teeth, $inputs, $state);
                $body
            }
        }
    };
}
pub(in crate::model) use with_equations;
