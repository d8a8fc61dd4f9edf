//! Fatigue damage and mesh history of completed steps. Damage follows from the loads of the teeth; the history contains
//! side speeds and transmission errors over mesh cycles. Both use the dense output, so that extremes within steps
//! count. Without dense output, extremes are those at the ends of the steps.

use std::sync::Arc;

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::completed_step::StepMotion;
use crate::integrate::{Curve, Point};
use crate::model::assembly::{Model, Watch};
use crate::model::dynamics::{Largest, MAX_SIZE};
use crate::model::effects::mesh_history::{MOST_QUANTITIES, MeshHistory};
use crate::model::effects::strength::{Fatigue, GearStrength, MeshLoad, RatedPlanet, RatedStep, Sample};
use crate::model::scene::layout::LEFT;
use crate::model::scene::{MAX_GROUPS, MAX_PLANETS};
use crate::numeric::Finite;

/// Fatigue damage of the teeth, and peak-to-peak values over mesh cycles.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Watched {
    /// Fatigue damage of the teeth, in scenes with strength. Copies share it until one of them changes it.
    pub fatigue: Option<SharedFatigue>,
    /// Peak-to-peak values over mesh cycles.
    pub mesh_history: MeshHistory,
    /// Cache of the loads at the start of the next step. Saved states omit it, because loads follow from the state.
    #[serde(skip)]
    pub last_loads: Option<LastLoads>,
}

/// Loads of the teeth at the end of a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LastLoads {
    /// Point at the end of the step.
    pub at: Point<MAX_SIZE>,
    /// Number of planet groups, and true if a tooth is broken. Together with the point, both determine the loads.
    pub teeth: (usize, bool),
    /// Loads at this point.
    pub loads: Sample,
}

/// Damage that copies of a simulation share.
#[derive(Clone, Debug, PartialEq)]
pub struct SharedFatigue(Arc<Fatigue>);

impl SharedFatigue {
    /// Shares `fatigue`.
    pub fn new(fatigue: Fatigue) -> Self {
        Self(Arc::new(fatigue))
    }

    /// Damage, to be changed. It is copied if another copy of the simulation shares it.
    pub fn make_mut(&mut self) -> &mut Fatigue {
        Arc::make_mut(&mut self.0)
    }
}

impl std::ops::Deref for SharedFatigue {
    type Target = Fatigue;

    fn deref(&self) -> &Fatigue {
        &self.0
    }
}

impl Serialize for SharedFatigue {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for SharedFatigue {
    #[inline(never)] // its frame is large for a small stack
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        Fatigue::deserialize(from).map(Self::new)
    }
}

/// Watched values to which [`Watched::roll_back`] returns, besides those that the damage remembers itself.
#[derive(Clone, Copy)]
pub struct Checkpoint(MeshHistory);

impl Watched {
    /// Returns watched values of a run of `model` that begins at `start` [s].
    pub fn new(model: &Model, start: f64, in_equilibrium: bool) -> Self {
        let fatigue = model.strength().map(|strength| {
            let later = model.parameters.specs.strength.rate_from;
            SharedFatigue::new(strength.fatigue(model.layout.groups, (start, later), in_equilibrium))
        });
        Self { fatigue, ..Self::default() }
    }

    /// True if a simulation can continue from these values.
    pub fn is_valid(&self) -> bool {
        // the cache is not saved
        let Self { fatigue, mesh_history, last_loads: _ } = self;
        fatigue.as_deref().is_none_or(Finite::is_finite) && mesh_history.is_valid()
    }

    /// True if these values belong to a run of `model`.
    pub fn fits(&self, model: &Model) -> bool {
        match (model.strength(), &self.fatigue) {
            (Some(strength), Some(fatigue)) => strength.fits(fatigue, model.layout.groups),
            (strength, fatigue) => strength.is_none() && fatigue.is_none(),
        }
    }

    /// Remembers the present values for [`Self::roll_back`].
    pub fn checkpoint(&mut self) -> Checkpoint {
        if let Some(fatigue) = &mut self.fatigue {
            fatigue.make_mut().set_checkpoint();
        }
        Checkpoint(self.mesh_history)
    }

    /// Returns to the values at `checkpoint`, the last one.
    pub fn roll_back(&mut self, Checkpoint(mesh_history): Checkpoint) {
        if let Some(fatigue) = &mut self.fatigue {
            fatigue.make_mut().roll_back();
        }
        (self.mesh_history, self.last_loads) = (mesh_history, None);
    }
}

/// Adds a completed step to damage and history, if the scene needs them.
///
/// Not inlined, so that the loop over the steps is the same in every scene.
#[cold]
#[inline(never)]
pub fn watch_step(equations: &Largest, (model, watch): (&Model, &Watch), step: &StepMotion, watched: &mut Watched) {
    if let (Some(strength), Some(fatigue)) = (&watch.strength, &mut watched.fatigue) {
        count_fatigue(equations, (model, strength), step, (fatigue.make_mut(), &mut watched.last_loads));
    }
    if watch.keeps_mesh_history {
        add_to_history(equations, model, step, &mut watched.mesh_history);
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
    (fatigue, last): (&mut Fatigue, &mut Option<LastLoads>),
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
    let are_known = last.as_ref().is_some_and(|last| from == 0.0 && last.teeth == teeth && last.at == extension.start);
    let last = last.get_or_insert_default();
    let (planets, count) = rated_planets(equations, model);
    let numbers = &equations.teeth.contact.perfect;
    let mut rated = RatedStep { begin: *begin, h: *h, from, planets: &planets[..count], numbers, sample: &mut sample };
    strength.count(fatigue, &mut rated, &mut last.loads, are_known);
    (last.at, last.teeth) = (extension.at(*accepted_fraction), teeth);
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

/// Adds a completed step to the mesh history. Only the accepted fraction of its dense output counts. If only the ends of
/// the step are known, quantities follow straight lines.
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
