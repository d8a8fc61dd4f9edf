//! What is simulated, and what a step of it costs.

use crate::geometry::Pair;
use crate::model::assembly::{Gears, Inertias};
use crate::model::run::Simulation;
use crate::model::scene::Plan;
use crate::model::setup::Parameters;
use crate::problem::Problem;

impl Simulation {
    /// What is unusual about the gears.
    pub fn warnings(&self) -> &[Problem] {
        &self.model.warnings
    }

    /// Geometry of the pair.
    pub fn pair(&self) -> &Pair {
        &self.model.pair
    }

    /// Masses of planet and side gear, always those of their solids [kg].
    pub fn masses(&self) -> [f64; 2] {
        self.model.masses.map(|gear| gear.mass)
    }

    /// Inertias in use.
    pub fn inertias(&self) -> &Inertias {
        &self.model.ideal.inertia
    }

    /// What is simulated.
    pub fn plan(&self) -> &Plan {
        &self.model.ideal.plan
    }

    /// What a step costs at present; a lock or a broken tooth may change it.
    pub fn cost(&self) -> CostClass {
        match &self.model.gears {
            Gears::Ideal(ideal) if ideal.body_effects.have_closed_form(&self.state) => CostClass::ClosedForm,
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

    /// One line that says what is simulated.
    pub fn describe(&self) -> String {
        let effects: Vec<&str> = self.active_effects().collect();
        let effects = if effects.is_empty() { "none".into() } else { effects.join(", ") };
        format!("{}; effects on: {effects}", self.model.ideal.plan.describe())
    }
}

/// What a step costs, by what has to be evaluated, cheapest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum CostClass {
    /// No teeth and no effect on bodies: a step is a formula.
    ClosedForm,
    /// No teeth, but torques of effects: integrated, without fast motion.
    Ideal,
    /// Teeth or springs that see no effect.
    Teeth,
    /// The same with effects on bodies.
    TeethAndBodies,
    /// Teeth slice by slice: errors, friction, pins.
    TeethInDetail,
}
