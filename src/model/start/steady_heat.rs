//! Start in thermal equilibrium: temperatures at which the mean heat flows of a cycle balance the heat given off.
//!
//! The cycle uses the inputs at the start. It runs twice at constant temperatures. The first run damps the transients
//! of the start; the second one counts.

use std::cell::Cell;
use std::sync::Arc;

use crate::declaration::units::TEMPERATURES;
use crate::model::effects::Memories;
use crate::model::run::Simulation;
use crate::model::setup::HEATS;
use crate::model::thermal::steady::{CycleMeans, Steady};
use crate::model::thermal::{NODES, Network, OIL, Thermal, of_scene};
use crate::problem::Problem;

/// Difference of temperatures above which there are two steady states [K].
const APART: f64 = 0.1;
/// The zero of degrees Celsius [K].
const ZERO: f64 = 273.15;
/// Maximum number of attempted steps in all cycles.
const MOST_ATTEMPTS: f64 = 3e5;
/// Variable that selects this start.
const START: &str = "scene.start";

impl Simulation {
    /// Returns the steady temperatures of a cycle. If there are several steady states, it selects the one that is reached
    /// from cold. Fails if no steady temperatures are found, or if a cycle cannot be run. Not inlined, because its
    /// simulations need stack that other starts may not have.
    #[inline(never)]
    pub(super) fn steady_heat(&mut self) -> Result<Thermal, Problem> {
        let Some(mut network) = self.model.thermal.clone() else { return Ok(self.state.sums.thermal) };
        network.around = network.around.changed(self.inputs.changes_outside());
        let mut still = Box::new(self.clone());
        let model = Arc::make_mut(&mut still.model);
        (model.thermal, model.strength) = (None, None);
        still.memories = Memories::default();
        let mut influential = model.body_effects().influential_nodes();
        // a given sump temperature does not change
        influential.retain(|&node| node != OIL || network.around.sump.is_none());
        let attempts = Cell::new(0.0);
        let heats = |at: &[f64; NODES]| still.cycle(&network, at, &attempts);
        let cold = network.around.ambient.min(self.model.parameters.oil.temperature);
        let length = of_scene::cycle(&self.model.parameters);
        let not_periodic = |at: &[f64; NODES]| still.not_periodic(&network, at, length);
        let found = network.steady(cold, &influential, heats);
        let temperatures = match found {
            Ok(Steady::At(temperatures)) => temperatures,
            Ok(none) => {
                let change = not_periodic(&[cold; NODES]).map(no_cycle);
                return Err(problem!(START, "{}", change.unwrap_or_else(|| no_steady_heat(none))));
            }
            Err(problem) => {
                let change = still.runs_away(&network, &[cold; NODES]).map(no_cycle);
                return Err(change.map_or(problem, |reason| problem!(START, "{reason}")));
            }
        };
        if let Some(change) = not_periodic(&temperatures) {
            Arc::make_mut(&mut self.model).warnings.push(problem!(
                START,
                "the motion is not periodic, so that the run leaves the temperatures of steady_heat, which balance the heat of its \
                 second cycle only: {change}"
            ));
        }
        if !influential.is_empty() {
            let from_hot = network.steady(TEMPERATURES.max, &influential, heats)?;
            Arc::make_mut(&mut self.model).warnings.extend(several(&temperatures, from_hot));
        }
        Ok(Thermal::at(temperatures))
    }

    /// Mean heat flows of a cycle with all nodes at the temperatures `at` [K]. Adds its attempted steps to `attempts`.
    /// Fails if the cycle cannot be run, or if all cycles together need too many steps.
    #[inline(never)]
    fn cycle(&self, network: &Network<HEATS>, at: &[f64; NODES], attempts: &Cell<f64>) -> Result<CycleMeans, Problem> {
        let mut run = Box::new(self.clone());
        run.state.sums.thermal = Thermal::at(*at);
        let (begin, length) = (self.time(), of_scene::cycle(&self.model.parameters));
        let [from, to] = [1.0, 2.0].map(|part| -> Result<_, Problem> {
            let moved = run.advance(begin + part * length);
            moved.map_err(|failure| problem!(START, "the cycle whose heat is to balance cannot be run: {failure}"))?;
            Ok((run.ledger(), run.motion().carrier_angle))
        });
        let ((from, begun_at), (to, ended_at)) = (from?, to?);
        attempts.set(attempts.get() + to.steps + to.rejected);
        if attempts.get() > MOST_ATTEMPTS {
            return Err(problem!(
                of_scene::CYCLE,
                "{length} s: the cycles that scene.start = steady_heat runs take more than {MOST_ATTEMPTS:e} steps; shorten it, or \
                 set scene.start = equilibrium"
            ));
        }
        let entered = [from, to].map(|ledger| network.entering(&ledger.heat));
        Ok(CycleMeans {
            power: std::array::from_fn(|i| (entered[1][i] - entered[0][i]) / length),
            speed: (ended_at - begun_at).abs() / length,
        })
    }
}

/// Reason why there are no steady temperatures if the motion changes from cycle to cycle. `change` describes the
/// change.
fn no_cycle(change: String) -> String {
    format!(
        "there are no steady temperatures, because the motion is not periodic: {change}, or set scene.start = equilibrium"
    )
}

/// Reason why there are no steady temperatures, from the `end` of their search.
fn no_steady_heat(end: Steady) -> String {
    let Steady::Beyond(node, temperature) = end else {
        return "no steady temperatures were found; scene.start = equilibrium begins at oil.temperature instead".into();
    };
    let (name, path) = of_scene::node_and_path(node);
    format!(
        "there are no steady temperatures from {:.0} to {:.0} degC: the {name} would reach {:.4e} degC; raise {path}, by \
         which their heat leaves, or lower the friction",
        TEMPERATURES.min - ZERO,
        TEMPERATURES.max - ZERO,
        temperature - ZERO
    )
}

/// Warning if the nodes do not cool down from hot to the temperatures that they reach from cold.
fn several(cold: &[f64; NODES], hot: Steady) -> Option<Problem> {
    let oil = cold[OIL] - ZERO;
    match hot {
        Steady::At(hot) => {
            let apart = cold.iter().zip(&hot).any(|(cold, hot)| (cold - hot).abs() > APART);
            apart.then(|| {
                problem!(
                    START,
                    "there are several steady states: the oil warms up to {oil:.1} degC from cold, where this run begins, and \
                     cools down to {:.1} degC from {:.0} degC",
                    hot[OIL] - ZERO,
                    TEMPERATURES.max - ZERO
                )
            })
        }
        _ => Some(problem!(
            START,
            "the oil warms up to {oil:.1} degC, where this run begins; from {:.0} degC it would not cool down to this",
            TEMPERATURES.max - ZERO
        )),
    }
}
