//! Effects on bodies of a scene: forces, and surfaces with dry friction.

use std::sync::Arc;

use crate::model::dynamics::Actuators;
use crate::model::effect_kinds::{BodyEffect, Friction, Loss, RubbingSurface, SurfaceTemperature};
use crate::model::effects::half_shaft::HalfShafts;
use crate::model::scene::{
    ACTUATED_LOCK, GearContact, InputDerivatives, Inputs, OilSpec, PAIRS, Plan, RubbingKind, RubbingPair, Viscosity,
};
use crate::model::setup::{Parameters, SceneEffects};
use crate::model::thermal::{NODES, OIL};
use crate::problem::Problem;

/// Effects on bodies, and dry friction.
#[derive(Clone, Debug)]
pub struct BodyEffects {
    /// Forces and torques.
    pub forces: Arc<Vec<Box<dyn BodyEffect>>>,
    /// Surfaces with dry friction.
    pub surfaces: Vec<RubbingSurface>,
    /// Pairs that may rub on each other, by their numbers.
    pub pairs: [Option<RubbingPair>; PAIRS],
    /// The half-shafts.
    pub half_shafts: HalfShafts,
    /// Friction of the pinion in proportion to the torque of its mesh, if there is any.
    pub loss: Option<Loss>,
    /// True if anything other than a commanded lock acts in addition to plain gears.
    pub has_effects: bool,
    /// True if inputs command limit torques of friction.
    pub has_commanded: bool,
    /// True if there is dry friction other than that of a lock.
    pub has_friction: bool,
    /// Actuators that commands pass.
    pub actuators: Actuators,
    /// Oil, if an effect needs its viscosity.
    oil: Option<OilSpec>,
}

impl BodyEffects {
    /// Effects of the scene `p` that act on bodies.
    pub fn new(p: &Parameters, effects: &SceneEffects, plan: &Plan) -> Self {
        let (forces, mut surfaces) = (effects.on_bodies(plan), Vec::new());
        effects.set_surfaces(&mut surfaces);
        let actuators = effects.actuators();
        let has_friction = has_friction(&surfaces, &actuators);
        Self {
            has_commanded: surfaces.iter().any(|surface| surface.kind.is_commanded()),
            has_effects: !forces.is_empty() || has_friction,
            loss: forces.iter().find_map(|effect| effect.loss()),
            forces: Arc::new(forces),
            has_friction,
            surfaces,
            pairs: plan.rubbing(plan.contact != GearContact::Ideal),
            actuators,
            half_shafts: HalfShafts::new(&p.specs.half_shaft, plan),
            oil: effects.oil_acts().then_some(p.oil),
        }
    }

    /// Fails if there are too many surfaces with dry friction on one body, or if a dog clutch has no shaft.
    pub fn check(&self) -> Result<(), Problem> {
        self.half_shafts.check()?;
        Friction::check(&self.surfaces)
    }

    /// Applies changed tunable parameters.
    pub fn tune(&mut self, effects: &SceneEffects) {
        effects.set_surfaces(&mut self.surfaces);
        self.has_friction = has_friction(&self.surfaces, &self.actuators);
    }

    /// True if pairs of this `kind` have friction.
    pub fn rubs(&self, kind: RubbingKind) -> bool {
        self.surfaces.iter().any(|surface| surface.kind == kind)
    }

    /// Speed of the pinion over the speed of the drive at the start.
    pub fn speed_ratio(&self) -> f64 {
        self.forces.iter().map(|effect| effect.speed_ratio()).product()
    }

    /// Friction on all bodies with the lock at `lock` and all nodes at `temperatures` [K].
    pub fn friction(
        &self,
        (lock, temperatures): (f64, &[f64; NODES]),
        inputs: &Inputs,
        input_derivatives: &InputDerivatives,
    ) -> Friction {
        Friction::new(&self.surfaces, (lock, temperatures), inputs, input_derivatives)
    }

    /// Viscosity of the oil at the `temperatures` of all nodes [K], if an effect needs it.
    pub fn oil_viscosity(&self, temperatures: &[f64; NODES]) -> Option<Viscosity> {
        self.oil.map(|oil| oil.viscosity(temperatures[OIL]))
    }

    /// Nodes whose temperatures influence friction or the viscosity of the oil.
    pub fn influential_nodes(&self) -> Vec<usize> {
        let is_influential = |node: &usize| {
            let at_node = SurfaceTemperature::Node(*node);
            let has_friction_there =
                |of: &RubbingSurface| of.temperature == at_node && of.sliding.varies_with_temperature();
            *node == OIL && self.oil.is_some() || self.surfaces.iter().any(has_friction_there)
        };
        (0..NODES).filter(is_influential).collect()
    }

    /// True if friction, or an effect through the viscosity of the oil, depends on temperature.
    pub fn depends_on_temperature(&self) -> bool {
        self.oil.is_some() || self.surfaces.iter().any(|surface| surface.sliding.varies_with_temperature())
    }

    /// True if friction depends on the loads of the meshes.
    pub fn needs_loads(&self) -> bool {
        self.surfaces.iter().any(RubbingSurface::depends_on_meshes)
    }
}

/// True if there may be friction that no direct command of the lock announces.
fn has_friction(surfaces: &[RubbingSurface], actuators: &Actuators) -> bool {
    actuators[ACTUATED_LOCK].is_some() || surfaces.iter().any(|surface| !surface.is_lock())
}
