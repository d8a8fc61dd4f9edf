//! Equations in the shape of a scene. Each shape is compiled separately, with its number of degrees of freedom, or
//! called through a table of functions.

use crate::FULL;

use super::LedgerEquations;
use crate::model::assembly::ideal_with_effects::{IDEAL_SIZE, IdealWithEffects, SHAFTS_SIZE};
use crate::model::assembly::{Gears, Model, Teeth};
use crate::model::dynamics::shape::{
    Any, FEW_SIZE, MEDIUM_SIZE, PLAIN_SIZE, Plain, PlainDriven, Shape, TWO_GROUPS_SIZE, WithBodies, WithEffects,
    WithEnds, WithPinion,
};
use crate::model::dynamics::{Equations, IdealEquations, MAX_SIZE, State};
use crate::model::scene::{FEW, Inputs, Method};

/// Work with the equations in the shape of a scene.
pub trait InShape: Sized {
    /// Result of the work.
    type Output;

    /// Inputs that act, and the state.
    fn inputs_and_state(&self) -> (&Inputs, &State);

    /// Does the work with these `equations`.
    fn run<const N: usize, S: Shape<N>, E: LedgerEquations<N> + ?Sized>(self, equations: &mut E) -> Self::Output;
}

/// Does the `work` with the equations of the `model`.
pub fn in_shape<W: InShape>(model: &Model, work: W) -> W::Output {
    match &model.gears {
        Gears::Ideal(ideal) if !FULL || model.parameters.solver.method == Method::Adaptive => {
            with_ideal_gears(ideal, work)
        }
        Gears::Ideal(ideal) => with_ideal_gears_through_object(ideal, work),
        Gears::Teeth(teeth) => in_shape_of(teeth, model, work),
    }
}

/// Does the `work` with the equations of `teeth`, which may group planets that the model treats separately.
pub fn in_shape_of<W: InShape>(teeth: &Teeth, model: &Model, work: W) -> W::Output {
    let (groups, attached) = (teeth.layout.groups, teeth.layout.attached_without_pins());
    let method = model.parameters.solver.method;
    let is_default = method == Method::Adaptive;
    let state = work.inputs_and_state().1;
    if FULL && is_default && !teeth.effect_terms.body_effects.act_in(state) {
        match (groups, state.inputs.derivatives.is_some()) {
            (1, false) => return monomorphised::<PLAIN_SIZE, Plain<1>, W>(teeth, work),
            (1, true) => return monomorphised::<PLAIN_SIZE, PlainDriven, W>(teeth, work),
            (2, false) => return monomorphised::<TWO_GROUPS_SIZE, Plain<2>, W>(teeth, work),
            _ => {}
        }
    }
    match (groups, attached) {
        (1, Some(0)) if is_default || method == Method::FixedStep => {
            monomorphised::<PLAIN_SIZE, WithEffects<1>, W>(teeth, work)
        }
        (2, Some(0)) if FULL && is_default => monomorphised::<TWO_GROUPS_SIZE, WithEffects<2>, W>(teeth, work),
        (1, Some(FEW)) if teeth.layout.has_ends() && (is_default || !FULL) => {
            monomorphised::<FEW_SIZE, WithEnds, W>(teeth, work)
        }
        (1, Some(1..=FEW)) if FULL && is_default && !teeth.layout.has_ends() => {
            monomorphised::<FEW_SIZE, WithPinion, W>(teeth, work)
        }
        (1, Some(_)) if FULL && is_default => monomorphised::<MEDIUM_SIZE, WithBodies, W>(teeth, work),
        _ if FULL && teeth.layout.count() <= MEDIUM_SIZE => through_object::<MEDIUM_SIZE, W>(teeth, work),
        _ => through_object::<MAX_SIZE, W>(teeth, work),
    }
}

/// Does the work with ideal gears with effects, monomorphised for the shape with ends, which fits all their scenes,
/// and for a larger size if a drive in front of the carrier moves separately.
#[inline(never)]
fn with_ideal_gears<W: InShape>(ideal: &IdealWithEffects, work: W) -> W::Output {
    let (inputs, state) = work.inputs_and_state();
    if ideal.others.is_empty() {
        let equations = &mut IdealEquations::<SHAFTS_SIZE>::new(ideal, inputs, state);
        return work.run::<SHAFTS_SIZE, WithEnds, _>(equations);
    }
    let equations = &mut IdealEquations::<IDEAL_SIZE>::new(ideal, inputs, state);
    work.run::<IDEAL_SIZE, WithEnds, _>(equations)
}

/// Does the work with ideal gears through a trait object, for methods that are not monomorphised for them.
#[inline(never)]
fn with_ideal_gears_through_object<W: InShape>(ideal: &IdealWithEffects, work: W) -> W::Output {
    let (inputs, state) = work.inputs_and_state();
    let equations: &mut dyn LedgerEquations<IDEAL_SIZE> = &mut IdealEquations::<IDEAL_SIZE>::new(ideal, inputs, state);
    work.run::<IDEAL_SIZE, Any, _>(equations)
}

/// Does the work with plain teeth, or with teeth with effects and planets in one or two groups. Monomorphised for each
/// shape.
#[inline(never)]
fn monomorphised<const N: usize, S: Shape<N>, W: InShape>(teeth: &Teeth, work: W) -> W::Output {
    let (inputs, state) = work.inputs_and_state();
    let equations = &mut Equations::<S, N>::new(teeth, inputs, state);
    work.run::<N, S, _>(equations)
}

/// Does the work with all other teeth and methods through a trait object.
#[inline(never)]
fn through_object<const N: usize, W: InShape>(teeth: &Teeth, work: W) -> W::Output {
    let (inputs, state) = work.inputs_and_state();
    let equations: &mut dyn LedgerEquations<N> = &mut Equations::<Any, N>::new(teeth, inputs, state);
    work.run::<N, Any, _>(equations)
}
