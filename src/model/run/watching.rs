//! What steps are watched for beside the ledger.

use super::completed_step::Passed;
use super::load_history::count_fatigue;
use super::mesh_cycles::add_to_history;
use crate::model::assembly::{Model, Watch};
use crate::model::dynamics::{Largest, Watched};

/// Adds a completed step to what it is watched for.
///
/// Not compiled into the loop of steps, which is the same whether a scene asks for it or not.
#[cold]
#[inline(never)]
pub fn watch_step(equations: &Largest, (model, watch): (&Model, &Watch), step: &Passed, watched: &mut Watched) {
    if let Some(strength) = &watch.strength {
        count_fatigue(equations, (model, strength), step, (&mut watched.fatigue, &mut watched.last_loads));
    }
    if watch.mesh_history {
        add_to_history(equations, model, step, &mut watched.mesh_history);
    }
}
