//! The equations of motion, and the state they move: with teeth (`equations` and its parts), and of ideal gears (`ideal_equations`,
//! `ideal_step`). Forces, exact derivatives and the rates of the ledger come together.

pub mod accepted;
pub mod acting;
mod bodies;
pub mod clock;
pub mod cycle;
mod dry_friction;
mod energy_floor;
#[cfg(test)]
#[path = "tests/energy_floor.rs"]
mod energy_floor_tests;
pub mod equations;
pub mod event;
pub mod ideal_equations;
mod ideal_step;
pub mod ledger_rates;
mod motion;
pub mod pending_step;
pub mod planet_contact;
pub mod rattle;
pub mod shape;
pub mod state;
pub mod torque_means;
pub mod watched;

pub use accepted::Accepted;
pub use acting::{Acted, Acting};
pub use clock::Clock;
pub use equations::{Equations, Jacobian, Largest};
pub use ideal_equations::{IdealEquations, IdealTorques};
pub use shape::LARGEST;
pub use state::State;
pub use watched::{LastLoads, Watched};

/// Evaluates an expression with the equations of any model bound to `$equations`, `N` the most degrees of freedom they have.
macro_rules! with_equations {
    ($model:expr, $state:expr, $inputs:expr, |$equations:ident| $body:expr) => {
        match &$model.gears {
            $crate::model::assembly::model::Gears::Ideal(ideal) => {
                #[allow(unused)]
                const N: usize = $crate::model::assembly::ideal_with_effects::MOST;
                #[allow(unused_mut)]
                let mut $equations =
                    $crate::model::dynamics::ideal_equations::IdealEquations::new(ideal, $inputs, $state);
                $body
            }
            $crate::model::assembly::model::Gears::Teeth(teeth) => {
                #[allow(unused)]
                const N: usize = $crate::model::dynamics::LARGEST;
                #[allow(unused_mut)]
                let mut $equations = $crate::model::dynamics::Largest::new(teeth, $inputs, $state);
                $body
            }
        }
    };
}
pub(in crate::model) use with_equations;
