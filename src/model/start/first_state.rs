//! First state of a simulation, as defined by `scene.start`.

use std::sync::Arc;

use super::{preload, report};
use crate::model::assembly::{Gears, Given, Model, SIGMA};
use crate::model::dynamics::{Actuated, Largest, State};
use crate::model::run::events::{apply_changes, break_tooth};
use crate::model::run::{Simulation, imposed, watching};
use crate::model::scene::{CARRIER, Dogs, GearContact, Inputs, Start};
use crate::model::setup::{HEATS, Parameters};
use crate::model::thermal::of_scene;
use crate::problem::Problem;

/// Size of the first attempted step after a start [s]. It resolves the fastest motion of stiff teeth, and the
/// controller enlarges it within a few steps.
const FIRST_STEP: f64 = 1e-6;

impl Simulation {
    /// Starts a simulation at `time` [s]. Values must be within the ranges of the interface. Fails with all problems of
    /// the scene.
    pub fn start(parameters: &Parameters, inputs: &Inputs, time: f64) -> Result<Self, Vec<Problem>> {
        Self::start_with(parameters, inputs, time, &Given::default())
    }

    /// Starts a simulation at `time` [s] as [`Self::start`] does, with the optional data in `given`.
    pub fn start_with(
        parameters: &Parameters,
        inputs: &Inputs,
        time: f64,
        given: &Given,
    ) -> Result<Self, Vec<Problem>> {
        let mut simulation = Self::resume_with(parameters, inputs, (State::at_rest(time, FIRST_STEP), None), given)?;
        let (model, state, inputs) = (&simulation.model, &mut simulation.state, &{ simulation.inputs });
        state.dogs = Dogs::at_start(&model.body_effects().half_shafts.dogs, inputs);
        state.inputs.actuated = Actuated::settled(&model.body_effects().actuators, inputs);
        state.sums.thermal = of_scene::at_start(parameters, model.thermal.as_deref(), inputs);
        set_speeds(model, inputs, state);
        // a tooth that is broken from the start
        break_tooth(model, inputs, state);
        let mut preload = None;
        if parameters.scene.start.is_in_equilibrium() {
            match &model.gears {
                Gears::Ideal(ideal) => preload::wind(model, &ideal.body_effects.half_shafts, inputs, state),
                Gears::Teeth(teeth) => {
                    let equations = Largest::new(teeth, inputs, state);
                    let pressed = preload::preload(&equations, model, inputs, state);
                    preload = Some(pressed.map_err(|problem| vec![problem])?);
                }
            }
        }
        imposed::follow_commands(&simulation.model, inputs, &mut simulation.state);
        let events = simulation.state.events;
        apply_changes(&simulation.model, inputs, &mut simulation.state);
        // friction that holds from the start causes no event
        simulation.state.events = events;
        let mut in_equilibrium = parameters.scene.start.is_in_equilibrium();
        if let Some(preload) = &preload {
            let outcome = report::judge(&simulation.model, inputs, &simulation.state, preload);
            in_equilibrium = outcome.in_equilibrium;
            Arc::make_mut(&mut simulation.model).warnings.extend(outcome.warnings);
        }
        if parameters.scene.start == Start::SteadyHeat {
            simulation.begin_with_steady_heat().map_err(|problem| vec![problem])?;
        }
        simulation.state.sums.work = 0.0;
        simulation.state.sums.heat = [0.0; HEATS];
        simulation.state.energy_at_start = simulation.energy(&simulation.state);
        simulation.memories = watching::at_start(&simulation.model, time, in_equilibrium);
        Ok(simulation)
    }
}

/// Sets the speeds at the start. Imposed speeds equal their commands. The others follow Willis' equation, unless the
/// start is from rest.
fn set_speeds(model: &Model, inputs: &Inputs, state: &mut State) {
    let (plan, ratio) = (&model.ideal.plan, model.ideal.ratio);
    let layout = plan.layout();
    let rest = model.parameters.scene.start == Start::Rest;
    let joint = model.body_effects().speed_ratio();
    let mut carrier = if rest && !plan.drive_imposed { 0.0 } else { joint * inputs.drive_speed };
    let mut spin = if plan.spin_imposed { inputs.planet_spin } else { 0.0 };
    let [left, right] = inputs.side_speed;
    match plan.side_imposed {
        [true, true] => (carrier, spin) = (0.5 * (left + right), 0.5 * (left - right) / ratio),
        [false, false] => {}
        [imposed_left, _] => {
            let s = usize::from(!imposed_left);
            let (speed, sigma) = (inputs.side_speed[s], SIGMA[s]);
            if plan.spin_imposed {
                carrier = speed - sigma * ratio * spin;
            } else {
                spin = sigma * (speed - carrier) / ratio;
            }
        }
    }
    let v = &mut state.v;
    // ideal gears cannot stay at rest if a speed is imposed
    let follow = !rest || plan.contact == GearContact::Ideal;
    if follow || plan.drive_imposed && plan.drives_carrier() {
        v[CARRIER] = carrier;
    }
    for g in (0..layout.groups).filter(|_| follow || plan.spin_imposed) {
        v[layout.planet(g)] = spin;
        if layout.has_pins {
            v[layout.pin(g)] = v[CARRIER];
        }
    }
    for s in 0..2 {
        if follow {
            v[s] = carrier + SIGMA[s] * ratio * spin;
        }
    }
    for (i, to) in layout.attached() {
        v[i] = v[to];
    }
    if !plan.drives_carrier() {
        v[layout.port] = if plan.drive_imposed { inputs.drive_speed } else { v[CARRIER] / joint };
    }
    for s in (0..2).filter(|&s| plan.shafts[s] && plan.side_imposed[s]) {
        v[layout.end(s)] = inputs.side_speed[s];
    }
}
