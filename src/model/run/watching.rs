//! What steps are watched for beside the ledger.

use super::completed_step::CompletedStep;
use super::load_history::count_fatigue;
use super::mesh_cycles::add_to_history;
use crate::model::assembly::model::Model;
use crate::model::assembly::watch::Watch;
use crate::model::dynamics::equations::Equations;
use crate::model::dynamics::watched::Watched;

/// Adds a completed step to what it is watched for; times of steps count from `begin` [s].
///
/// Not compiled into the loop of steps, which is the same whether a scene asks for it or not.
#[cold]
#[inline(never)]
pub fn watch_step<const N: usize, const G: usize, const P: usize, const WITH_EFFECTS: bool>(
    equations: &Equations<N, G, P, WITH_EFFECTS>,
    (model, watch): (&Model, &Watch),
    step: CompletedStep<N>,
    (begin, watched): (f64, &mut Watched),
) {
    if let Some(strength) = &watch.strength {
        count_fatigue(equations, (model, strength), step, (begin, &mut watched.fatigue));
    }
    if watch.mesh_history {
        add_to_history(equations, model, step, &mut watched.mesh_history);
    }
}
