//! Preload at the start: teeth are pressed together and half-shafts wound up until both carry the loads.

use super::carried::{Carried, StartingScene};
use super::equilibrium::{ROUNDS, check_settled, press_actual_teeth, press_sides, settle, settle_actual_teeth};
use super::friction;
use crate::integrate::Point;
use crate::model::assembly::{Ideal, Model};
use crate::model::dynamics::{FrictionEquations, Largest, MAX_SIZE, State};
use crate::model::effect_kinds::SurfaceLoad;
use crate::model::effects::half_shaft::HalfShafts;
use crate::model::scene::{CARRIER, Inputs, PAIRS};
use crate::problem::Problem;

/// Number of rounds in which dry friction and the loads of the meshes, on which it depends, find each other.
const FRICTION_ROUNDS: usize = 60;
/// Number of these rounds in which the loads are not damped.
const UNDAMPED_ROUNDS: usize = 5;

/// Winds up the half-shafts of an ideal differential. Returns the torques that they carry.
pub fn wind(model: &Model, shafts: &HalfShafts, inputs: &Inputs, state: &mut State) -> Carried {
    let start = StartingScene::new(model, &model.ideal, inputs, state);
    let carried = friction::carried(&start, &[SurfaceLoad::default(); PAIRS]);
    let plan = &model.ideal.plan;
    for s in (0..2).filter(|&s| plan.shafts[s]) {
        state.q[plan.layout().end(s)] = shafts.static_twist(s, carried.shaft[s], &state.dogs);
    }
    wind_up(model, &carried, state);
    carried
}

/// Winds up what is in front of the carrier. An imposed speed of the drive remains.
fn wind_up(model: &Model, carried: &Carried, state: &mut State) {
    let (port, imposed) = (model.layout.port, model.ideal.plan.drive_imposed);
    let driven = state.v[port];
    for effect in model.body_effects().forces.iter() {
        effect.wind_up(&carried.in_front, [&mut state.q, &mut state.v]);
    }
    if imposed {
        state.v[port] = driven;
    }
}

/// Result of [`preload`].
#[derive(Clone, Copy, Debug)]
pub struct Preload {
    /// Torques of teeth and half-shafts, and the corresponding accelerations.
    pub carried: Carried,
    /// True if all bodies are in balance with the accelerations in `carried`, and no planet starts to roll.
    pub settled: bool,
}

/// Torques at the `start` of gears with teeth. Dry friction acts under the loads that they put on its surfaces.
fn under_own_loads(equations: &Largest, start: &StartingScene) -> Carried {
    let mut on_meshes = [SurfaceLoad::default(); PAIRS];
    let mut carried = friction::carried(start, &on_meshes);
    if !equations.applied().friction().depends_on_load() {
        return carried;
    }
    for round in 0..FRICTION_ROUNDS {
        let mut point = Point::ZERO;
        // teeth that cannot carry the torques are an error of the start itself
        if press_sides(start.model, equations, carried.teeth, &mut point).is_err() {
            break;
        }
        point.v = start.state.point::<MAX_SIZE>().v;
        let pressed = equations.mesh_loads(&point);
        if pressed == on_meshes {
            break;
        }
        // friction that rises steeply with the load would overshoot
        let weight = if round < UNDAMPED_ROUNDS { 1.0 } else { 0.5 };
        on_meshes = std::array::from_fn(|i| on_meshes[i].toward(&pressed[i], weight));
        carried = friction::carried(start, &on_meshes);
    }
    carried
}

/// Presses the meshes together until tooth torques balance the loads, and winds up the half-shafts.
///
/// The first search is for a balance without rolling planets: a minimum of the potential V + Σ T α near ψ = 0.
/// Stiffness that varies along the path can hold small differences of the loads. Without such a minimum, the planets
/// roll, and the loads follow from the accelerations of the ideal differential. Dry friction is a load like others.
/// Plain teeth are then pressed together at ψ = 0. If meshes are coupled, a second search is for a minimum under the new
/// loads. If it fails, actual teeth are pressed together at ψ = 0. Fails if the teeth cannot carry the loads.
pub fn preload(equations: &Largest, model: &Model, inputs: &Inputs, state: &mut State) -> Result<Preload, Problem> {
    let (teeth, ideal) = (equations.teeth, &model.ideal);
    let plan = &teeth.plan;
    let held = Ideal { plan: plan.with_spin_held(), ..*ideal };
    let rolling = under_own_loads(equations, &StartingScene::new(model, ideal, inputs, state));
    let mut carried = Carried::under(&StartingScene::new(model, &held, inputs, state), &rolling.friction);
    let mut point = Point::ZERO;
    press_sides(model, equations, carried.teeth, &mut point)?;
    // if tooth pairs deflect each other or loads are summed over the face, meshes cannot be balanced individually
    let is_coupled = !teeth.have_independent_meshes(state);
    let mut settled = true;
    if !plan.spin_imposed || is_coupled {
        let found = settle(equations, &carried, &point);
        settled = found.is_some();
        if let Some(found) = found {
            check_settled(model, equations, carried.teeth, &found)?;
            point = found;
        } else if !plan.spin_imposed {
            carried = rolling;
            press_sides(model, equations, carried.teeth, &mut point)?;
            if is_coupled {
                let pressed = || press_actual_teeth(equations, &carried, ROUNDS);
                point = settle_actual_teeth(equations, &carried).or_else(pressed).unwrap_or(point);
            }
        }
    }
    let (_, by_position) = equations.statics(&point);
    let speeds = state.v;
    point.v = state.point::<MAX_SIZE>().v;
    // quasi-static: while the planets spin, α follows the changing stiffness
    let spin = |g: usize| teeth.layout.planet(g);
    let by_spins =
        [0, 1].map(|s| (0..equations.groups()).map(|g| by_position[s][spin(g)] * speeds[spin(g)]).sum::<f64>());
    let follows = [0, 1].map(|s| by_position[s][s] != 0.0 && !(plan.shafts[s] && plan.side_imposed[s]));
    for s in 0..2 {
        if follows[s] {
            // elastic planet bodies couple both sides
            let other = 1 - s;
            let across = by_position[s][other];
            let (mut by_spin, mut own) = (by_spins[s], by_position[s][s]);
            if across != 0.0 && follows[other] {
                let share = across / by_position[other][other];
                by_spin -= share * by_spins[other];
                own -= share * by_position[other][s];
            }
            point.v[s] = speeds[CARRIER] - by_spin / own;
        }
        if plan.shafts[s] {
            point.q[teeth.layout.end(s)] =
                teeth.effect_terms.body_effects.half_shafts.static_twist(s, carried.shaft[s], &state.dogs);
        }
    }
    state.set_point(&point);
    wind_up(model, &carried, state);
    state.wrap(&model.periods, &model.body_effects().pairs);
    Ok(Preload { carried, settled })
}
