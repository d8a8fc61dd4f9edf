//! Everything derived from the parameters before the first step: geometry, plan, inertias, meshes, effects.

use super::gear_cache::GearCache;
use super::ideal_with_effects::IdealWithEffects;
use super::laws::Laws;
use super::{BodyEffects, EffectTerms, Ideal, Inertias, Teeth, solid};
use crate::contact::detailed::Detailed;
use crate::contact::errors::GearTeeth;
use crate::contact::planet::Contact;
use crate::contact::{FlankGaps, Mesh};
use crate::geometry::Pair;
use crate::geometry::solid::mass::GearMass;
use crate::model::effect_kinds::{BUILT, ToothEffects};
use crate::model::effects::strength::GearStrength;
use crate::model::scene::{GearContact, Layout, MAX_DOF, Plan, Requests};
use crate::model::setup::{CONTACT_HEAT, HEATS, Parameters, SceneEffects, advice, validation};
use crate::model::thermal::Network;
use crate::model::thermal::of_scene::{network, with_parameters};
use crate::problem::Problem;

/// Representation of the gears.
#[derive(Clone, Debug)]
pub enum Gears {
    /// Willis' equation, solved in closed form while no effect acts on bodies, and integrated otherwise.
    Ideal(Box<IdealWithEffects>),
    /// Teeth in mesh.
    Teeth(Box<Teeth>),
}

/// Data from which a model is built, in addition to the parameters.
#[derive(Clone, Copy, Debug, Default)]
pub struct Given<'a> {
    /// Teeth of all gears, instead of those from the seed of the tooth errors.
    pub teeth: Option<&'a [GearTeeth]>,
    /// Cache from earlier starts.
    pub cache: Option<&'a GearCache>,
}

/// Everything derived from the parameters. It does not change during a simulation, except by tunable parameters.
#[derive(Clone, Debug)]
pub struct Model {
    /// Parameters from which the model was built.
    pub parameters: Parameters,
    /// Geometry of the pair.
    pub pair: Pair,
    /// Masses of the solids of planet and side gear.
    pub masses: [GearMass; 2],
    /// Ideal differential of the same scene.
    pub ideal: Ideal,
    /// Representation of the gears.
    pub gears: Gears,
    /// Teeth with all planets in one group, until a tooth breaks.
    pub merged: Option<Box<Teeth>>,
    /// Thermal network, if the scene has the effect `warm_up`.
    pub thermal: Option<Box<Network<HEATS>>>,
    /// Stress and fatigue, if the scene has the effect `strength`.
    pub strength: Option<Box<GearStrength>>,
    /// Index of each degree of freedom.
    pub layout: Layout,
    /// Periods of the positions: a tooth pitch, or a turn for the carrier [rad].
    pub periods: [f64; MAX_DOF],
    /// Warnings about the scene.
    pub warnings: Vec<Problem>,
}

impl Model {
    /// Model of the scene, whose values must be within the ranges of the interface. Fails with all problems of the
    /// scene.
    pub fn new(parameters: &Parameters, given: &Given) -> Result<Self, Vec<Problem>> {
        let own = GearCache::default();
        let cache = given.cache.unwrap_or(&own);
        let spec = parameters.gears();
        let checked = cache.pair(&spec);
        let pair = checked.pair;
        let mut problems = checked.errors.clone();
        problems.extend(validation::problems(parameters, &pair));
        if !problems.is_empty() {
            return Err(problems);
        }
        let mut effects = parameters.scene_effects(&pair);
        effects.setting.teeth = given.teeth;
        let setting = effects.setting;
        let tooth = tooth_effects(parameters, &effects).map_err(|p| vec![p])?;
        let requests = effects.requests();
        let individual = tooth.individual || !parameters.solver.merge_planets;
        let plan = Plan::new(&parameters.scene, &spec, &pair, &Requests { individual, ..requests });
        let plan = plan.map_err(|p| vec![p])?;
        let masses = cache.masses(&pair, &parameters.geometry, parameters.material.density);
        let mut inertia = Inertias::new(parameters, &masses);
        inertia.carrier += plan.on_carrier;
        let ratio = f64::from(spec.planet_teeth) / f64::from(spec.side_teeth);
        let ideal = Ideal { plan, inertia, ratio };
        let mut warnings = checked.warnings.clone();
        warnings.extend(effects.warnings());
        warnings.extend(advice::warnings(parameters));
        let gears = gears(parameters, &effects, &ideal, tooth, cache).map_err(|p| vec![p])?;
        let merged = match &gears {
            Gears::Teeth(teeth) if parameters.solver.merge_planets => teeth.merged(),
            _ => None,
        };
        let strength = if BUILT && parameters.effects.strength {
            Some(Box::new(GearStrength::new(&parameters.specs.strength, &setting).map_err(|p| vec![p])?))
        } else {
            None
        };
        let thermal = network(parameters, &masses);
        Ok(Self {
            parameters: *parameters,
            thermal,
            masses,
            ideal,
            gears,
            merged,
            strength,
            layout: plan.layout(),
            periods: plan.periods(&pair),
            warnings,
            pair,
        })
    }

    /// Effects that act on bodies.
    pub fn body_effects(&self) -> &BodyEffects {
        match &self.gears {
            Gears::Ideal(ideal) => &ideal.body_effects,
            Gears::Teeth(teeth) => &teeth.effect_terms.body_effects,
        }
    }

    /// Applies the tunable parameters of `parameters`. All other parameters must be unchanged.
    pub fn tune(&mut self, parameters: &Parameters) {
        self.parameters = *parameters;
        if let Some(thermal) = &mut self.thermal {
            **thermal = with_parameters(parameters, &self.masses);
        }
        let effects = parameters.scene_effects(&self.pair);
        match &mut self.gears {
            Gears::Ideal(ideal) => ideal.body_effects.tune(&effects),
            Gears::Teeth(teeth) => {
                let damping = Laws::damping(parameters);
                let Teeth { contact, effect_terms, .. } = &mut **teeth;
                contact.set_damping(damping);
                contact.detailed.friction = effects.on_flanks().map(|friction| friction.law);
                effect_terms.body_effects.tune(&effects);
                // a coefficient that was 0 may need the loads from now on
                contact.detailed.needs_thrust = effect_terms.body_effects.needs_loads();
                contact.in_detail |= contact.detailed.needs_thrust;
                if let Some(merged) = &mut self.merged {
                    merged.contact.set_damping(damping);
                }
            }
        }
    }
}

/// Gears of the scene with the effects on bodies. Fails if the effects contradict the gears.
fn gears(
    parameters: &Parameters,
    effects: &SceneEffects,
    ideal: &Ideal,
    tooth: ToothEffects,
    cache: &GearCache,
) -> Result<Gears, Problem> {
    let mut body_effects = BodyEffects::new(parameters, effects, &ideal.plan);
    body_effects.check()?;
    if ideal.plan.contact == GearContact::Ideal {
        // the closed form has no steps that an effect could record
        body_effects.has_effects |= parameters.effects.record_steps();
        return Ok(Gears::Ideal(Box::new(IdealWithEffects::new(ideal, body_effects))));
    }
    let laws = Laws::new(parameters, effects.setting.pair, &tooth, cache)?;
    Ok(Gears::Teeth(Box::new(teeth(parameters, effects, ideal, (laws, tooth, body_effects), cache))))
}

/// Influence of effects on single teeth. Solid teeth include their errors directly.
fn tooth_effects(p: &Parameters, effects: &SceneEffects) -> Result<ToothEffects, Problem> {
    if p.scene.gear_contact == GearContact::Solid {
        return Ok(ToothEffects { individual: solid::is_individual(p), ..ToothEffects::default() });
    }
    effects.on_teeth()
}

fn teeth(
    p: &Parameters,
    effects: &SceneEffects,
    ideal: &Ideal,
    (laws, tooth, mut body_effects): (Laws, ToothEffects, BodyEffects),
    cache: &GearCache,
) -> Teeth {
    let (pair, plan) = (effects.setting.pair, ideal.plan);
    let friction = effects.on_flanks();
    // a tooth may neither bend by the working depth nor reach the next gap
    let deflection_limit = pair.working_depth().min(0.5 * pair.base_pitch);
    let single = plan.contact == GearContact::Lumped;
    let in_detail = tooth.gaps[0].is_some() || friction.is_some() || plan.has_pins || body_effects.needs_loads();
    body_effects.has_effects |= in_detail || laws.bodies.is_some();
    let engagement = cache.engagement(pair, p.effects.teeth.corner_contact, deflection_limit);
    let damping = Laws::damping(p);
    let mesh = Mesh { spring: laws.spring, damping, whole: laws.whole, is_single: single, engagement };
    let mut detailed =
        Detailed::new(pair, mesh.spring.clone(), damping, laws.face, single, friction.map(|friction| friction.law));
    (detailed.needs_thrust, detailed.has_seats) = (body_effects.needs_loads(), plan.has_pins);
    if let Some(face) = laws.friction_face {
        detailed.set_friction_face(face);
    }
    let contact = Contact {
        mesh,
        solid: laws.solid,
        bodies: laws.bodies,
        detailed,
        gaps: tooth.gaps,
        perfect: FlankGaps::perfect(pair, p.geometry.planet_count),
        in_detail,
    };
    let effect_terms = EffectTerms {
        records_steps: BUILT && p.effects.record_steps(),
        friction_heat_index: friction.map_or(CONTACT_HEAT, |f| f.heat_index),
        planet_mass_moment: ideal.inertia.planet_mass_moment,
        body_effects,
    };
    Teeth::new(pair, contact, plan, &ideal.inertia, deflection_limit, effect_terms)
}
