//! Everything derived from the parameters before the first step: geometry, plan, inertias, meshes, effects.

use std::sync::Arc;

use super::beside::Full;
use super::bodies::Inertias;
use super::combinations;
use super::effects::{Setting, body_effects, grips, lock_grip};
use super::ideal::Ideal;
use super::laws::Laws;
use super::layout::{Layout, MAX_DOF};
use super::parameters::{GearContact, Parameters};
use super::plan::Plan;
use super::rigid::Rigid;
use super::strength::Strength;
use super::teeth::Teeth;
use super::tooth_effects::ToothEffects;
use crate::contact::detailed::Detailed;
use crate::contact::gaps::FlankGaps;
use crate::contact::mesh::Mesh;
use crate::geometry::{Pair, checks};
use crate::problem::Problem;

/// How the gears are represented.
#[derive(Clone, Debug)]
pub enum Gears {
    /// Willis' equation: in closed form while nothing acts on bodies, integrated otherwise.
    Rigid(Box<Rigid>),
    /// Meshes.
    Teeth(Box<Teeth>),
}

/// Everything derived from the parameters; it does not change while a simulation runs, but for tunable parameters.
#[derive(Clone, Debug)]
pub struct Model {
    /// Parameters it was made from.
    pub parameters: Parameters,
    /// Geometry of the pair.
    pub pair: Pair,
    /// Ideal differential of the same scene.
    pub ideal: Ideal,
    /// How the gears are represented.
    pub gears: Gears,
    /// Stress and fatigue, where the scene asks for them.
    pub strength: Option<Box<Strength>>,
    /// Where each degree of freedom stands.
    pub layout: Layout,
    /// Periods of the positions: a tooth pitch, for the carrier a turn [rad].
    pub periods: [f64; MAX_DOF],
    /// What is unusual about the scene.
    pub warnings: Vec<Problem>,
}

impl Model {
    /// Model of the scene, or all that is wrong with it; values must be within the ranges of the interface.
    pub fn new(parameters: &Parameters) -> Result<Self, Vec<Problem>> {
        let spec = parameters.gears();
        if let Some(problem) = checks::shaft_angle(&spec) {
            return Err(vec![problem]);
        }
        let pair = Pair::new(&spec);
        let mut problems = checks::errors(&spec, &pair);
        problems.extend(combinations::problems(parameters, &pair));
        if !problems.is_empty() {
            return Err(problems);
        }
        let tooth = ToothEffects::new(parameters, &pair).map_err(|p| vec![p])?;
        let plan = Plan::new(parameters, &pair, tooth.individual).map_err(|p| vec![p])?;
        let inertia = Inertias::new(parameters, &pair);
        let ratio = f64::from(spec.planet_teeth) / f64::from(spec.side_teeth);
        let ideal = Ideal { plan, inertia, ratio };
        let mut warnings = checks::warnings(&spec, &pair);
        warnings.extend(tooth.warning(parameters, &pair));
        let setting = Setting { parameters, pair: &pair, plan: &plan };
        let gears = match plan.contact {
            GearContact::Ideal => Gears::Rigid(Box::new(Rigid::new(&setting, &ideal))),
            GearContact::Lumped | GearContact::Tooth | GearContact::Solid => {
                let laws = Laws::new(parameters, &pair, tooth.slices()).map_err(|p| vec![p])?;
                Gears::Teeth(Box::new(teeth(&setting, &inertia, laws, tooth)))
            }
        };
        let strength = Strength::new(parameters, &pair).map_err(|p| vec![p])?.map(Box::new);
        Ok(Self {
            parameters: *parameters,
            ideal,
            gears,
            strength,
            layout: plan.layout(),
            periods: plan.periods(&pair),
            warnings,
            pair,
        })
    }

    /// Takes over what may be tuned while a simulation runs.
    pub fn tune(&mut self, parameters: &Parameters) {
        self.parameters = parameters.with_tuned(&self.parameters);
        let plan = self.ideal.plan;
        let setting = Setting { parameters: &self.parameters, pair: &self.pair, plan: &plan };
        match &mut self.gears {
            Gears::Rigid(rigid) => rigid.grips = grips(&setting),
            Gears::Teeth(teeth) => {
                let damping = Laws::damping(&self.parameters);
                teeth.mesh.law.set_damping(damping);
                teeth.full.detailed.damping = damping;
                teeth.full.detailed.friction = ToothEffects::friction(&self.parameters, &self.pair);
                teeth.full.grips = grips(&setting);
                // a coefficient that was 0 needs the loads from now on
                teeth.full.in_detail |= teeth.full.grips.iter().any(|g| g.depends_on_load());
            }
        }
    }
}

fn teeth(setting: &Setting, inertia: &Inertias, laws: Laws, tooth: ToothEffects) -> Teeth {
    let (p, pair, plan) = (setting.parameters, setting.pair, *setting.plan);
    // neither may a tooth bend by the working depth nor reach the next gap
    let working_depth = (pair.gears[0].addendum + pair.gears[1].addendum) / pair.outer_cone;
    let jump = working_depth.min(0.5 * pair.base_pitch);
    let single = plan.contact == GearContact::Lumped;
    let damping = Laws::damping(p);
    let grips = grips(setting);
    let bodies = body_effects(setting);
    let friction = ToothEffects::friction(p, pair);
    let pressed = grips.iter().any(|g| g.depends_on_load());
    let in_detail = tooth.gaps[1].is_some() || friction.is_some() || plan.pins || pressed;
    let mesh = Mesh::new(pair, laws.law, laws.cone, p.effects.corner_contact, jump);
    let full = Full {
        detailed: Detailed::new(pair, laws.spring, damping, laws.slices, single, friction),
        in_detail,
        gaps: tooth.gaps,
        always: in_detail || p.effects.strength || !grips.is_empty() || !bodies.is_empty(),
        bodies: Arc::new(bodies),
        grips,
        lock: lock_grip(&p.specs),
        sound: FlankGaps::perfect(pair, p.geometry.planet_count, Vec::new()),
        half_shaft: p.specs.half_shaft,
    };
    Teeth::new(pair, mesh, plan, inertia, jump, full)
}
