//! Sizes in which the equations are compiled: sizes that are known at compile time let loops unroll and need no allocation.

use super::Equations;
use crate::model::scene::MAX_GROUPS;

/// Degrees of freedom of the least scene with teeth: planets that are alike, and no additions.
pub const LEAST: usize = 4;
/// The same of two planets that differ.
pub const DIFFERENT: usize = 5;
/// Most degrees of freedom with effects that have equations of just this size: planets that are alike, and half-shafts that twist.
pub const EXACT: usize = 6;
/// Degrees of freedom that every scene fits in, a whole number of vectors of any width.
pub const LARGEST: usize = 16;
/// Equations with teeth of any scene: for all that is not done in every step.
pub type Largest<'a> = Equations<'a, LARGEST, MAX_GROUPS, true>;

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
                const N: usize = $crate::model::dynamics::sizes::LARGEST;
                #[allow(unused_mut)]
                let mut $equations = $crate::model::dynamics::sizes::Largest::new(teeth, $inputs, $state);
                $body
            }
        }
    };
}

pub(in crate::model) use with_equations;
