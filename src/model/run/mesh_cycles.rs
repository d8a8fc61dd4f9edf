//! Side speeds and transmission errors through a completed step, as the history of mesh cycles takes them: curves of the
//! integrator's continuous extension, so that extremes between the ends of steps count.

use super::completed_step::{CompletedStep, extension};
use crate::integrate::{Curve, Extension, Point};
use crate::model::assembly::model::Model;
use crate::model::dynamics::equations::Equations;
use crate::model::effects::mesh_history::{MOST_QUANTITIES, MeshHistory};
use crate::model::scene::layout::LEFT;

/// Adds a step to the history; one that was cut short counts as far as it was taken.
pub fn add_to_history<const N: usize, const G: usize, const P: usize, const WITH_EFFECTS: bool>(
    equations: &Equations<N, G, P, WITH_EFFECTS>,
    model: &Model,
    step: CompletedStep<N>,
    history: &mut MeshHistory,
) {
    let (extension, part) = extension(equations, step);
    let extension = &extension;
    let pitch = model.periods[LEFT];
    let rolling = curve(extension, |at| 0.5 * (at.q[0] - at.q[1]) / pitch);
    let speeds = [0, 1].map(|s| curve(extension, |at| at.v[s]));
    let mesh = &equations.teeth.mesh;
    let error = |g: usize, s: usize| {
        curve(extension, |at| mesh.drive_approach(equations.mesh_state(at, g, s).position[0]) * model.pair.mean_cone)
    };
    let errors: [[Curve; 2]; G] = std::array::from_fn(|g| [0, 1].map(|s| error(g, s)));
    let mut quantities = [speeds[0]; MOST_QUANTITIES];
    quantities[1] = speeds[1];
    // of three planets that differ there is a fourth group, without members
    let groups = model.ideal.plan.groups().len();
    let count = 2 + 2 * groups;
    quantities[2..count].copy_from_slice(errors[..groups].as_flattened());
    history.add(&rolling, &quantities[..count], part);
}

/// A quantity that depends linearly on the motion.
fn curve<const N: usize>(extension: &Extension<N>, of: impl Fn(&Point<N>) -> f64) -> Curve {
    let Extension { start, end, bends } = extension;
    let nothing = of(&Point::ZERO);
    Curve { start: of(start), end: of(end), bends: bends.each_ref().map(|bend| of(bend) - nothing) }
}
