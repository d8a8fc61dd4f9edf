//! Effects on bodies of a scene: forces, and sources of dry friction.

use std::sync::Arc;

use crate::model::effect_kinds::{BodyEffect, Friction, FrictionSource};
use crate::model::effects::half_shaft::HalfShafts;
use crate::model::scene::{InputDerivatives, Inputs, Plan};
use crate::model::setup::{Parameters, SceneEffects};

/// Effects on bodies, and dry friction.
#[derive(Clone, Debug)]
pub struct BodyEffects {
    /// Forces and torques.
    pub forces: Arc<Vec<Box<dyn BodyEffect>>>,
    /// Sources of dry friction.
    pub friction: Vec<FrictionSource>,
    /// The half-shafts.
    pub half_shafts: HalfShafts,
    /// Whether there are effects; without any, a lock may still be commanded.
    pub has_effects: bool,
    /// Whether wheels have brakes.
    pub has_brakes: bool,
}

impl BodyEffects {
    /// Effects of the scene `p` that act on bodies.
    pub fn new(p: &Parameters, effects: &SceneEffects, plan: &Plan) -> Self {
        let (forces, friction) = (effects.on_bodies(plan), effects.friction().collect::<Vec<_>>());
        Self {
            has_brakes: friction.iter().any(|source| source.wheel.is_some()),
            has_effects: !forces.is_empty() || friction.iter().any(|source| !source.by_lock),
            forces: Arc::new(forces),
            friction,
            half_shafts: HalfShafts::new(&p.specs.half_shaft, plan),
        }
    }

    /// Takes over tunable parameters.
    pub fn tune(&mut self, effects: &SceneEffects) {
        self.friction.clear();
        self.friction.extend(effects.friction());
    }

    /// Speed that an imposed carrier has at the positions `q` under its command [rad/s].
    pub fn carrier_speed(&self, q: &[f64], command: f64) -> f64 {
        self.forces.iter().fold(command, |speed, effect| effect.carrier_speed(q, speed))
    }

    /// Friction on all bodies with the lock at `lock`.
    pub fn friction(&self, lock: f64, inputs: &Inputs, input_derivatives: &InputDerivatives) -> Friction {
        Friction::new(&self.friction, lock, inputs, input_derivatives)
    }

    /// Whether friction that always acts depends on the loads of the meshes.
    pub fn needs_loads(&self) -> bool {
        self.friction.iter().any(|source| !source.by_lock && source.depends_on_load())
    }
}
