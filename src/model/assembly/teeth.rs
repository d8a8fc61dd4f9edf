//! Constants of the equations of motion of a differential with teeth.

use super::{BodyEffects, Inertias};
use crate::contact::planet::Contact;
use crate::geometry::Pair;
use crate::model::scene::{GearContact, Layout, MAX_DOF, Plan};
use crate::numeric::quotient;

/// Sign σ of the left and right side.
pub const SIGMA: [f64; 2] = [1.0, -1.0];

/// Constants of a differential with teeth.
#[derive(Clone, Debug)]
pub struct Teeth {
    /// Contact of a planet with both side gears, identical for all planets.
    pub contact: Contact,
    /// Scene plan.
    pub plan: Plan,
    /// Index of each degree of freedom.
    pub layout: Layout,
    /// Inertia of each degree of freedom, for a single planet and pin of each group [kg·m², for seats kg].
    pub inertia: [f64; MAX_DOF],
    /// Reciprocals of the inertias, or 0 if the motion is imposed.
    pub inverse_inertia: [f64; MAX_DOF],
    /// Inertias of the wheel-side ends that are rigid on their side gears [kg·m²].
    pub rigid_end: [f64; 2],
    /// sinδ_b of planet and side gear.
    pub sin_base: [f64; 2],
    /// Base pitch on the unit sphere [rad].
    pub base_pitch: f64,
    /// Largest approach of flanks: the working depth or half the base pitch, whichever is smaller [rad].
    pub deflection_limit: f64,
    /// True if completed steps record more than work and heat of contact.
    pub records_more: bool,
    /// Constants of the effects; boxed, so the layout of `Teeth` is the same in every build.
    pub effect_terms: Box<EffectTerms>,
}

impl Teeth {
    /// Returns the teeth with all planets in one group, until an event such as a broken tooth makes one planet differ.
    /// Returns `None` unless planets are in phase and their teeth are plain until then.
    pub fn merged(&self) -> Option<Box<Self>> {
        let plan = self.plan.with_merged_planets()?;
        let is_plain = !self.effect_terms.body_effects.has_effects
            && !self.effect_terms.records_steps
            && self.layout.attached_without_pins() == Some(0)
            && plan.contact != GearContact::Solid;
        is_plain.then(|| Box::new(Self { plan, layout: plan.layout(), ..self.clone() }))
    }

    /// Constants for the scene plan `plan` and the gears `pair`, with their contact.
    pub fn new(
        pair: &Pair,
        contact: Contact,
        plan: Plan,
        inertias: &Inertias,
        deflection_limit: f64,
        effect_terms: EffectTerms,
    ) -> Self {
        let layout = plan.layout();
        let (inertia, rigid_end) = inertias.by_freedom(&plan);
        let mut inverse_inertia = [0.0; MAX_DOF];
        for i in 0..layout.count() {
            // imposed motion and rigid ends have no inertia; their entries follow
            inverse_inertia[i] = quotient(1.0, inertia[i]).unwrap_or(f64::INFINITY);
        }
        if plan.drive_imposed {
            inverse_inertia[layout.port] = 0.0;
        }
        for g in (0..layout.groups).filter(|_| plan.spin_imposed) {
            inverse_inertia[layout.planet(g)] = 0.0;
        }
        for s in (0..2).filter(|_| layout.has_ends()) {
            // a side with a rigid half-shaft has no moving end
            if plan.side_imposed[s] || !plan.shafts[s] {
                inverse_inertia[layout.end(s)] = 0.0;
            }
        }
        Self {
            records_more: !contact.mesh.engagement.corner_contact() || effect_terms.records_steps,
            contact,
            plan,
            layout,
            inertia,
            inverse_inertia,
            rigid_end,
            sin_base: pair.sin_base(),
            base_pitch: pair.base_pitch,
            deflection_limit,
            effect_terms: Box::new(effect_terms),
        }
    }
}

/// Constants of the effects that act in addition to plain teeth.
#[derive(Clone, Debug)]
pub struct EffectTerms {
    /// True if steps update temperatures, damage or histories, which cause no forces themselves.
    pub records_steps: bool,
    /// Index of the heat of friction along the flanks.
    pub friction_heat_index: usize,
    /// Mass of a planet times the distance of its centre of mass from the carrier's axis [kg·m].
    pub planet_mass_moment: f64,
    /// Effects on bodies.
    pub body_effects: BodyEffects,
}
