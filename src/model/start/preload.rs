//! The load at the start: teeth are pressed together and half-shafts wound up until both carry it.

use super::carried::Carried;
use super::equilibrium::{ROUNDS, check_settled, press_sides, pressed_as_they_are, settle, settle_as_they_are};
use crate::integrate::Point;
use crate::model::assembly::{Ideal, Model};
use crate::model::dynamics::{LARGEST, Largest, State};
use crate::model::effects::half_shaft::HalfShafts;
use crate::model::scene::{CARRIER, Inputs};
use crate::problem::Problem;

/// Winds the half-shafts of an ideal differential up.
pub fn wind(model: &Model, shafts: &HalfShafts, inputs: &Inputs, state: &mut State) {
    let carried = Carried::new(model, &model.ideal, inputs, state);
    let plan = &model.ideal.plan;
    for s in (0..2).filter(|&s| plan.shafts[s]) {
        state.q[plan.layout().end(s)] = shafts.static_twist(s, carried.shaft[s]);
    }
}

/// Result of [`preload`].
#[derive(Clone, Copy, Debug)]
pub struct Preload {
    /// What teeth and half-shafts carry, and the accelerations that go with it.
    pub carried: Carried,
    /// Whether all is in balance with these accelerations alone, and no planet begins to roll.
    pub settled: bool,
}

/// Presses the meshes together until tooth torques balance the loads, and winds up the half-shafts.
///
/// First a balance without rolling planets is sought, a minimum of the potential V + Σ T α near ψ = 0 (stiffness that
/// varies along the path holds small imbalances). Where there is none, the planets roll, and the loads are those under
/// the accelerations of the ideal differential: plain teeth carry them at ψ = 0, others at the minimum, or as they are
/// pressed at ψ = 0 where none is found.
pub fn preload(equations: &Largest, model: &Model, inputs: &Inputs, state: &mut State) -> Result<Preload, Problem> {
    let (teeth, ideal) = (equations.teeth, &model.ideal);
    let plan = &teeth.plan;
    let held = Ideal { plan: plan.with_spin_held(), ..*ideal };
    let mut carried = Carried::new(model, &held, inputs, state);
    let mut point = Point::ZERO;
    press_sides(model, equations, carried.teeth, &mut point)?;
    // where pairs move each other, or slices of the face carry, the balance cannot be found mesh by mesh
    let not_mesh_by_mesh = !teeth.have_independent_meshes(state);
    let mut settled = true;
    if !plan.spin_imposed || not_mesh_by_mesh {
        let found = settle(equations, &carried, &point);
        settled = found.is_some();
        if let Some(found) = found {
            check_settled(model, equations, carried.teeth, &found)?;
            point = found;
        } else if !plan.spin_imposed {
            carried = Carried::new(model, ideal, inputs, state);
            press_sides(model, equations, carried.teeth, &mut point)?;
            if not_mesh_by_mesh {
                let pressed = || pressed_as_they_are(equations, &carried, ROUNDS);
                point = settle_as_they_are(equations, &carried).or_else(pressed).unwrap_or(point);
            }
        }
    }
    let (_, by_position) = equations.statics(&point);
    let speeds = state.v;
    point.v = state.point::<LARGEST>().v;
    // quasi-static: while the planets spin, α follows the changing stiffness
    let spin = |g: usize| teeth.layout.planet(g);
    let by_spins =
        [0, 1].map(|s| (0..equations.groups()).map(|g| by_position[s][spin(g)] * speeds[spin(g)]).sum::<f64>());
    let follows = [0, 1].map(|s| by_position[s][s] != 0.0 && !(plan.shafts[s] && plan.side_imposed[s]));
    for s in 0..2 {
        if follows[s] {
            // elastic bodies of planets couple both sides
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
                teeth.effect_terms.body_effects.half_shafts.static_twist(s, carried.shaft[s]);
        }
    }
    state.set_point(&point);
    state.wrap(&model.periods, &teeth.layout);
    Ok(Preload { carried, settled })
}
