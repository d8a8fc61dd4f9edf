//! Budget of attempts at steps, which limits the waiting time of a host.

use crate::model::assembly::{Gears, Model};
use crate::model::scene::Method;

/// Maximum number of attempted steps for plain teeth in a communication step. It limits the waiting time of a host to
/// some seconds. Long communication steps extend it ([`extend`]).
const BUDGET: u64 = 2_000_000;
/// Cost that effects on bodies (drag, shafts, dry friction) add to a step, relative to a step of plain teeth.
const EFFECTS: usize = 3;
/// Number of matrix entries for plain teeth with identical planets.
const PLAIN: usize = 16;
/// Maximum cost of a step of ideal gears with all effects, relative to a step of plain teeth.
const IDEAL: usize = 2;
/// Maximum cost of a step of `radau`, relative to a step of the default method. Plain teeth reach it, because their
/// evaluations are cheap compared with the complex matrices of `radau`.
const RADAU_IN_STEPS: usize = 3;

/// Maximum number of attempted steps, as [`BUDGET`]. It is smaller if a step costs more.
pub fn budget(model: &Model) -> u64 {
    let Gears::Teeth(teeth) = &model.gears else { return BUDGET / IDEAL as u64 };
    let work = teeth.contact.work(model.parameters.solid.facets as usize, teeth.layout.groups);
    let has_effects = teeth.effect_terms.body_effects.has_effects || teeth.effect_terms.records_steps;
    let effects = if has_effects { EFFECTS } else { 0 };
    // the cost of small matrices is proportional to their number of entries
    let freedoms = teeth.layout.count();
    let steps = if model.parameters.solver.method == Method::Radau { RADAU_IN_STEPS } else { 1 };
    BUDGET / ((work.max(freedoms * freedoms / PLAIN) + effects) * steps) as u64
}

/// Time of a communication step during which the limit of attempts grows [s]: an hour.
const LONGEST_GROWTH: f64 = 3600.0;
/// Share of the limit of attempts that each second of a communication step adds.
const GROWTH: f64 = 0.1;

/// Adds to a budget of attempts what a completed interval of the clock allows, so that the limit does not depend on
/// the length of a communication step. `advanced` [s] is the time since the start of the step; `remaining` [s] is the
/// time to its stop, which is negative only if a damaged state leads beyond it.
pub fn extend(of: &mut u64, model: &Model, advanced: f64, remaining: f64) {
    if advanced <= LONGEST_GROWTH && remaining >= 0.0 {
        let limit = budget(model);
        *of = limit.min(*of + (GROWTH * limit as f64) as u64);
    }
}
