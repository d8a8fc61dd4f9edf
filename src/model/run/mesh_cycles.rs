//! Side speeds and transmission errors through a completed step, as the history of mesh cycles takes them: curves of the
//! integrator's continuous extension, so that extremes between the ends of steps count.

use super::completed_step::Passed;
use crate::integrate::{Curve, Extension, Point};
use crate::model::assembly::Model;
use crate::model::dynamics::{LARGEST, Largest};
use crate::model::effects::mesh_history::{MOST_QUANTITIES, MeshHistory};
use crate::model::scene::layout::LEFT;

/// Adds a step to the history; one that was cut short counts as far as it was taken.
pub fn add_to_history(equations: &Largest, model: &Model, step: &Passed, history: &mut MeshHistory) {
    let extension = &step.way;
    let pitch = model.periods[LEFT];
    let rolling = curve(extension, |at| 0.5 * (at.q[0] - at.q[1]) / pitch);
    let speeds = [0, 1].map(|s| curve(extension, |at| at.v[s]));
    let mesh = &equations.teeth.mesh;
    let error = |g: usize, s: usize| {
        curve(extension, |at| mesh.drive_approach(equations.mesh_state(at, g, s).position[0]) * model.pair.mean_cone)
    };
    let mut quantities = [speeds[0]; MOST_QUANTITIES];
    quantities[1] = speeds[1];
    // of three planets that differ there is a fourth group, without members
    let groups = model.ideal.plan.groups().len();
    let count = 2 + 2 * groups;
    for (i, quantity) in quantities[2..count].iter_mut().enumerate() {
        *quantity = error(i / 2, i % 2);
    }
    history.add(&rolling, &quantities[..count], step.part);
}

/// A quantity that depends linearly on the motion.
fn curve(extension: &Extension<LARGEST>, of: impl Fn(&Point<LARGEST>) -> f64) -> Curve {
    let Extension { start, end, bends } = extension;
    let nothing = of(&Point::ZERO);
    Curve { start: of(start), end: of(end), bends: bends.each_ref().map(|bend| of(bend) - nothing) }
}
