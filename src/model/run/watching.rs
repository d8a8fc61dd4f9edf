//! Fatigue damage and mesh history of completed steps. Damage follows from the loads of the teeth; the history contains
//! side speeds and transmission errors over mesh cycles. Both use the dense output, so that extremes within steps
//! count. Without dense output, extremes are those at the ends of the steps.

use super::Simulation;
use super::completed_step::StepMotion;
use crate::integrate::{Curve, Point};
use crate::model::assembly::Model;
use crate::model::dynamics::{Largest, MAX_SIZE};
use crate::model::effect_kinds::{BUILT, Changes};
use crate::model::effects::Memories;
use crate::model::effects::mesh_history::{MOST_QUANTITIES, MeshHistory};
use crate::model::effects::strength::{Fatigue, GearStrength, MeshLoad, RatedPlanet, RatedStep, Sample};
use crate::model::scene::layout::LEFT;
use crate::model::scene::{MAX_GROUPS, MAX_PLANETS};
use crate::model::setup::effect_outputs::indices_of;
use crate::model::setup::{Parameters, STEP_READINGS};

/// Memories at the start of a run of `model` at `start` [s].
pub fn at_start(model: &Model, start: f64, in_equilibrium: bool) -> Memories {
    let Parameters { effects, specs, .. } = &model.parameters;
    let damage = |strength: &GearStrength| {
        strength.fatigue(model.layout.groups, (start, specs.strength.rate_from), in_equilibrium)
    };
    Memories {
        strength: model.strength.as_deref().map(damage).into(),
        mesh_history: (BUILT && effects.mesh_history).then(Default::default).into(),
        coupling_advice: (BUILT && effects.coupling_advice).then(Default::default).into(),
    }
}

impl Simulation {
    /// Remembers the damage of all teeth, because it is read.
    pub(in crate::model) fn remember_damage(&mut self) {
        if let (Some(strength), Some(fatigue)) = (&self.model.strength, self.memories.strength.get_mut()) {
            strength.remember(fatigue);
        }
    }

    /// Sets the readings of damage and mesh history.
    pub(in crate::model) fn read_damage_and_history(&self, readings: &mut [f64; STEP_READINGS]) {
        if let (Some(strength), Some(fatigue)) = (&self.model.strength, self.memories.strength.get()) {
            strength.read_damage(fatigue, &mut readings[const { indices_of("strength", Changes::ByStep) }]);
        }
        if let Some(history) = self.memories.mesh_history.get() {
            history.read(&self.model.ideal.plan, &mut readings[const { indices_of("mesh_history", Changes::ByStep) }]);
        }
    }
}

/// True if damage or mesh history record steps.
#[inline]
pub fn records_steps(model: &Model, memories: &Memories) -> bool {
    model.strength.is_some() || memories.mesh_history.is_on()
}

/// Adds a completed step to damage and history, if the scene needs them.
///
/// Not inlined, so that the loop over the steps is the same in every scene.
#[cold]
#[inline(never)]
pub fn watch_step(equations: &Largest, model: &Model, step: &StepMotion, memories: &mut Memories) {
    if let (Some(strength), Some(fatigue)) = (&model.strength, memories.strength.get_mut()) {
        count_fatigue(equations, (model, strength), step, fatigue);
    }
    if let Some(history) = memories.mesh_history.get_mut() {
        add_to_history(equations, model, step, history);
    }
}

/// Loads of the meshes, by group and side.
type Meshes = [[MeshLoad; 2]; MAX_GROUPS];

/// Adds a completed step to the damage of the teeth. If only the ends of the step are known, no load within the step
/// exceeds the loads at both ends.
fn count_fatigue(
    equations: &Largest,
    (model, strength): (&Model, &GearStrength),
    step: &StepMotion,
    fatigue: &mut Fatigue,
) {
    let StepMotion { h, begin, extension, accepted_fraction, ends_only } = step;
    let from = ((fatigue.tally.from - begin) / h).clamp(0.0, 1.0);
    if from == 1.0 {
        return;
    }
    let layout = &equations.teeth.layout;
    let (groups, first) = (layout.groups, layout.planet(0));
    let per_pitch = 1.0 / model.periods[first];
    let loads = |at: &Point<MAX_SIZE>, mesh: &mut Meshes| {
        for (g, mesh) in mesh[..groups].iter_mut().enumerate() {
            mesh.iter_mut().for_each(|mesh| mesh.clear());
            equations.pair_loads(&model.pair, at, g, |s, load| strength.add_load(&mut mesh[s], load));
        }
    };
    let mut known = None;
    let mut sample = |fraction: f64, sample: &mut Sample| {
        let at = extension.at(fraction * accepted_fraction);
        for g in 0..groups {
            sample.angle[g] = per_pitch * at.q[first + g];
        }
        if !ends_only || fraction == 0.0 || fraction == 1.0 {
            return loads(&at, &mut sample.mesh);
        }
        let [start, middle, end]: &[Meshes; 3] = known.get_or_insert_with(|| {
            let mut known = [Meshes::default(); 3];
            known.iter_mut().zip([0.0, 0.5, 1.0]).for_each(|(mesh, part)| loads(&extension.at(part), mesh));
            known
        });
        for g in 0..groups {
            let between = |s: usize| MeshLoad::between([&start[g][s], &middle[g][s], &end[g][s]], fraction);
            sample.mesh[g] = [between(0), between(1)];
        }
    };
    let teeth = (groups, equations.is_tooth_broken);
    let Some(mut last) = fatigue.last_loads.take() else { return };
    let are_known = from == 0.0 && last.teeth == teeth && last.at == extension.start;
    let (planets, count) = rated_planets(equations, model);
    let numbers = &equations.teeth.contact.perfect;
    let mut rated = RatedStep { begin: *begin, h: *h, from, planets: &planets[..count], numbers, sample: &mut sample };
    strength.count(fatigue, &mut rated, &mut last.loads, are_known);
    (last.at, last.teeth) = (extension.at(*accepted_fraction), teeth);
    fatigue.last_loads = Some(last);
}

/// Planets whose teeth are rated, and their number. The equations may have planets in one group that the model treats
/// separately.
fn rated_planets(equations: &Largest, model: &Model) -> ([RatedPlanet; MAX_PLANETS], usize) {
    let (acting, plan) = (&equations.teeth.plan, &model.ideal.plan);
    let numbers = &equations.teeth.contact.perfect;
    let planets = std::array::from_fn(|planet| {
        let (loads, histories) = (acting.group_of[planet], plan.group_of[planet]);
        let (phase, simulated) = (acting.group(loads).phase, acting.group(loads).planet);
        RatedPlanet {
            planet,
            loads,
            histories,
            represents: plan.group(histories).planet == planet,
            phase: phase.map(|phase| phase / model.pair.base_pitch),
            shift: [0, 1].map(|s| -equations.wrapped(loads, s)),
            ahead: [0, 1].map(|s| numbers.teeth_between([simulated, planet], s)),
        }
    });
    (planets, plan.planets)
}

/// Adds a completed step to the mesh history. Only the accepted fraction of its dense output counts. If only the ends
/// of the step are known, quantities follow straight lines.
pub fn add_to_history(equations: &Largest, model: &Model, step: &StepMotion, history: &mut MeshHistory) {
    let pitch = model.periods[LEFT];
    let curve = |of: &dyn Fn(&Point<MAX_SIZE>) -> f64| {
        let curve = Curve::of(&step.extension, of);
        if step.ends_only { Curve::line(curve.start, curve.end) } else { curve }
    };
    let rolling = curve(&|at| 0.5 * (at.q[0] - at.q[1]) / pitch);
    let speeds = [0, 1].map(|s| curve(&|at| at.v[s]));
    let mesh = &equations.teeth.contact.mesh;
    let error = |g: usize, s: usize| {
        curve(&|at| mesh.drive_approach(equations.mesh_state(at, g, s).position[0]) * model.pair.mean_cone)
    };
    let mut quantities = [speeds[0]; MOST_QUANTITIES];
    quantities[1] = speeds[1];
    let count = 2 + 2 * equations.groups();
    for (i, quantity) in quantities[2..count].iter_mut().enumerate() {
        *quantity = error(i / 2, i % 2);
    }
    history.add(&rolling, &quantities[..count], step.accepted_fraction);
}
