//! What acts in a scene beside plain teeth: a mesh in detail, effects on bodies, dry friction.

use std::sync::Arc;

use super::dry::Clamp;
use super::effect_specs::HalfShaftSpec;
use super::effects::BodyEffect;
use super::grip::Grip;
use super::state::State;
use crate::contact::any_spring::AnySpring;
use crate::contact::detailed::Detailed;
use crate::contact::gaps::FlankGaps;

/// What acts in a scene beside plain teeth.
#[derive(Clone, Debug)]
pub struct Full {
    /// The mesh in detail.
    pub detailed: Detailed<AnySpring>,
    /// Whether an effect needs it.
    pub in_detail: bool,
    /// Gaps of the tooth pairs, while sound and once a tooth is broken.
    pub gaps: [Option<Arc<FlankGaps>>; 2],
    /// Teeth without errors, for their numbers.
    pub sound: FlankGaps,
    /// Effects on bodies.
    pub bodies: Arc<Vec<Box<dyn BodyEffect>>>,
    /// Dry friction that is always there.
    pub grips: Vec<Grip>,
    /// The lock at full command, if this build has one.
    pub lock: Option<Grip>,
    /// The half-shafts.
    pub half_shaft: HalfShaftSpec,
    /// Whether the scene has effects; without any, a lock may still be commanded.
    pub always: bool,
}

impl Full {
    /// Whether effects act: those of the scene, a lock that is commanded or still holds, or inputs on their way.
    pub fn acts(&self, state: &State) -> bool {
        self.always || state.course.is_some() || state.lock > 0.0 || state.holds.iter().any(|h| h.stiffness > 0.0)
    }

    /// Speed that an imposed carrier has instead of its command.
    pub fn carrier_speed(&self, state: &State, command: f64) -> f64 {
        self.bodies.iter().fold(command, |speed, effect| effect.carrier_speed(&state.q, speed))
    }

    /// What holds side gears and planets when the lock is at `command`.
    pub fn clamps(&self, command: f64) -> [Clamp; 2] {
        let lock = self.lock.filter(|_| command > 0.0).map(|g| g.scaled(command));
        Clamp::of(self.grips.iter().chain(&lock))
    }
}
