//! Description of a simulation, and the cost of its steps.

use crate::geometry::Pair;
use crate::model::assembly::{Gears, Inertias};
use crate::model::run::Simulation;
use crate::model::scene::Plan;
use crate::model::setup::Parameters;
use crate::problem::Problem;

impl Simulation {
    /// Warnings about the scene.
    pub fn warnings(&self) -> &[Problem] {
        &self.model.warnings
    }

    /// Geometry of the pair.
    pub fn pair(&self) -> &Pair {
        &self.model.pair
    }

    /// Masses of planet and side gear, always from their solids [kg].
    pub fn masses(&self) -> [f64; 2] {
        self.model.masses.map(|gear| gear.mass)
    }

    /// Inertias in use.
    pub fn inertias(&self) -> &Inertias {
        &self.model.ideal.inertia
    }

    /// Plan of the scene.
    pub fn plan(&self) -> &Plan {
        &self.model.ideal.plan
    }

    /// Present cost of a step; a lock or a broken tooth may change it.
    pub fn cost(&self) -> CostClass {
        match &self.model.gears {
            Gears::Ideal(ideal) if !ideal.body_effects.act_in(&self.state) => CostClass::ClosedForm,
            Gears::Ideal(_) => CostClass::Ideal,
            Gears::Teeth(teeth) if teeth.are_in_detail(&self.state) => CostClass::TeethInDetail,
            Gears::Teeth(teeth) if teeth.effect_terms.body_effects.act_in(&self.state) => CostClass::TeethAndBodies,
            Gears::Teeth(_) => CostClass::Teeth,
        }
    }

    /// Names of the switches that are on.
    pub fn active_effects(&self) -> impl Iterator<Item = &'static str> {
        self.model.parameters.effects.active()
    }

    /// Parameters in use.
    pub fn parameters(&self) -> &Parameters {
        &self.model.parameters
    }

    /// Describes the simulation in one line.
    pub fn describe(&self) -> String {
        let effects: Vec<&str> = self.active_effects().collect();
        let effects = if effects.is_empty() { "none".into() } else { effects.join(", ") };
        format!("{}; effects on: {effects}", self.model.ideal.plan.describe())
    }
}

/// Cost of a step by what must be evaluated, cheapest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum CostClass {
    /// No teeth and no effect on bodies, so a step has a closed form.
    ClosedForm,
    /// No teeth, but torques of effects, which are integrated without fast motion.
    Ideal,
    /// Teeth or springs without effects.
    Teeth,
    /// Teeth or springs with effects on bodies.
    TeethAndBodies,
    /// Teeth slice by slice: errors, friction, pins.
    TeethInDetail,
}
