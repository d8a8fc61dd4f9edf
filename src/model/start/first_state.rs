//! First state of a simulation, as defined by `scene.start`.

use std::sync::Arc;

use super::report::Outcome;
use super::{preload, report};
use crate::model::assembly::{Gears, Given, Model, SIGMA};
use crate::model::dynamics::{Actuated, Largest, State};
use crate::model::run::events::{apply_changes, break_tooth, wind_friction};
use crate::model::run::moving_inputs::acting_inputs;
use crate::model::run::{Simulation, imposed, watching};
use crate::model::scene::{CARRIER, Dogs, GearContact, Inputs, Start};
use crate::model::setup::{HEATS, Parameters};
use crate::model::thermal::{Thermal, of_scene};
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
        let at_rest = State::at_rest(time, FIRST_STEP);
        let mut simulation = Self::resume_with(parameters, inputs, (at_rest, None), given)?;
        let mut thermal = of_scene::at_start(parameters, simulation.model.thermal.as_deref(), &simulation.inputs);
        if parameters.scene.start == Start::SteadyHeat {
            simulation.assemble(at_rest, thermal)?;
            thermal = simulation.steady_heat().map_err(|problem| vec![problem])?;
        }
        let Outcome { in_equilibrium, warnings } = simulation.assemble(at_rest, thermal)?;
        Arc::make_mut(&mut simulation.model).warnings.extend(warnings);
        simulation.memories = watching::at_start(&simulation.model, time, in_equilibrium);
        Ok(simulation)
    }

    /// Sets the first state with the temperatures `thermal`, beginning from a state `at_rest`. Fails if the teeth
    /// cannot carry the loads.
    fn assemble(&mut self, at_rest: State, thermal: Thermal) -> Result<Outcome, Vec<Problem>> {
        self.state = at_rest;
        let (model, state, inputs) = (&self.model, &mut self.state, &{ self.inputs });
        state.dogs = Dogs::at_start(&model.body_effects().half_shafts.dogs, inputs);
        state.inputs.actuated = Actuated::settled(&model.body_effects().actuators, inputs);
        state.sums.thermal = thermal;
        set_speeds(model, inputs, state);
        // a tooth that is broken from the start
        break_tooth(model, inputs, state);
        let acting = &acting_inputs(model, inputs, state);
        state.lock = acting.lock;
        let (mut preload, mut friction) = (None, None);
        let in_equilibrium = model.parameters.scene.start.is_in_equilibrium();
        if in_equilibrium {
            friction = Some(match &model.gears {
                Gears::Ideal(ideal) => preload::wind(model, &ideal.body_effects.half_shafts, acting, state).friction,
                Gears::Teeth(teeth) => {
                    let equations = Largest::new(teeth, inputs, state);
                    let pressed = preload::preload(&equations, model, acting, state);
                    preload.insert((teeth, pressed.map_err(|problem| vec![problem])?)).1.carried.friction
                }
            });
        }
        imposed::follow_commands(model, inputs, state);
        let events = state.events;
        apply_changes(model, inputs, state);
        if let Some(friction) = &friction {
            wind_friction(model, inputs, state, friction);
        }
        // friction that holds from the start causes no event
        state.events = events;
        state.sums.work = 0.0;
        state.sums.heat = [0.0; HEATS];
        self.state.energy_at_start = self.energy(&self.state);
        Ok(match &preload {
            Some((teeth, preload)) => report::judge(teeth, inputs, &self.state, preload),
            None => Outcome { in_equilibrium, warnings: Vec::new() },
        })
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
