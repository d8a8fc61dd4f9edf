//! What a simulation reports once while it runs: a law used outside its published range, a stress above the strength.

use super::Simulation;
use crate::friction::FrictionLaw;
use crate::model::assembly::Gears;
use crate::model::dynamics::Largest;
use crate::model::effects::strength::{Fatigue, Stressed};
use crate::problem::Problem;

/// What has been reported in a run.
#[derive(Clone, Copy, Debug, Default)]
pub struct Reported {
    friction_law: bool,
    stress: [bool; Stressed::ALL.len()],
    start: bool,
}

impl Simulation {
    /// Warnings about the time up to now that are not in `reported` yet; they are from now on.
    pub fn unreported(&self, reported: &mut Reported) -> Vec<Problem> {
        let mut found = Vec::new();
        if !reported.friction_law
            && let Some(problem) = self.outside_friction_law()
        {
            reported.friction_law = true;
            found.push(problem);
        }
        if self.model.strength().is_some() {
            for (what, reported) in Stressed::ALL.into_iter().zip(&mut reported.stress).filter(|(_, done)| !**done) {
                if let Some(overload) = self.watched.fatigue.overloads.of(what) {
                    *reported = true;
                    found.push(overload.warning(what, &self.model.ideal.plan));
                }
            }
        }
        found
    }

    /// Where safety and damage include a start that was not in equilibrium: when they were the worst. The same once in a run, at
    /// its end.
    pub fn unreported_at_end(&self, reported: &mut Reported) -> Option<Problem> {
        if reported.start || self.model.strength().is_none() {
            return None;
        }
        let Fatigue { utilisation, has_blow, .. } = self.completed().1.fatigue;
        if !has_blow || utilisation.root.share == 0.0 {
            return None;
        }
        reported.start = true;
        let [root, flank] = [utilisation.root, utilisation.flank].map(|of| (of.safety(), of.time));
        Some(problem!(
            "strength.rate_from",
            "safety and damage include the start, which was not in equilibrium: the smallest safety factor of the roots was {:.3} at \
             t = {:.6} s, that of the flanks {:.3} at t = {:.6} s; let them count from after the run-in, or take scene.start = \
             equilibrium",
            root.0,
            root.1,
            flank.0,
            flank.1
        ))
    }

    /// What lies outside the range of the friction law at this instant; Coulomb's law has none.
    fn outside_friction_law(&self) -> Option<Problem> {
        let (model, inputs, state) = (&self.model, &self.inputs, &self.state);
        let p = &model.parameters;
        if !p.effects.tooth_friction || p.specs.tooth_friction.law == FrictionLaw::CoulombStribeck {
            return None;
        }
        let Gears::Teeth(teeth) = &model.gears else { return None };
        let friction = teeth.effect_terms.detailed.friction.as_ref()?;
        let mut found = None;
        let (equations, point) = (Largest::new(teeth, inputs, state), state.point());
        let viscosity = equations.acting.oil_viscosity;
        let friction = viscosity.map_or(*friction, |oil| friction.with_viscosity(oil.dynamic));
        for g in 0..model.ideal.plan.groups().len() {
            for s in 0..2 {
                equations.detail(&point, g, s, |slice| {
                    if found.is_none() {
                        found = slice.sliding.as_ref().and_then(|sliding| friction.outside(sliding));
                    }
                });
            }
        }
        found.map(|what| problem!("tooth_friction.law", "{what} at t = {:.6} s; reported once", state.time()))
    }
}
