//! Sensitivities of the model: derivatives of state rates by the exact Jacobian, and directional derivatives of
//! outputs.
//!
//! Rates are linear in a direction (δq, δv, δu): δq̇ = B δv, δv̇ = ∂v̇/∂q δq + ∂v̇/∂v δv + ∂v̇/∂u δu. Angles and speeds
//! follow the direction themselves. Forces are evaluated at four points along it, for central differences of order 4.
//! The points are 3e-5 of the natural magnitudes apart, so that even the forces of teeth that just touch are straight
//! lines to within 1e-7.

use super::states::STATES;
use crate::integrate::SecondOrder;
use crate::model::assembly::Gears;
use crate::model::dynamics::actuated::courses;
use crate::model::dynamics::with_equations;
use crate::model::dynamics::{FrictionEquations, State};
use crate::model::outputs::forces::{Extent, Forces};
use crate::model::outputs::pairs::PairLines;
use crate::model::outputs::{LedgerReadings, Motion};
use crate::model::run::Simulation;
use crate::model::run::imposed::{add_impulse, imposed_speeds};
use crate::model::scene::{ACTUATED, CARRIER, InputDerivatives, Inputs, MAX_DOF, PLANET};
use crate::model::setup::{HEATS, STEP_READINGS};
use crate::model::thermal::network::Rates;
use crate::model::thermal::{NODES, Network, of_scene};

/// Distance between neighbouring points along a direction, in natural magnitudes.
const APART: f64 = 3e-5;
/// Central differences of order 4: positions of the points in multiples of their distance, and their weights.
const STENCIL: [(f64, f64); 4] = [(-2.0, 1.0 / 12.0), (-1.0, -8.0 / 12.0), (1.0, 8.0 / 12.0), (2.0, -1.0 / 12.0)];

/// Change of everything on which motion and forces depend.
#[derive(Clone, Copy, Debug)]
pub struct Direction {
    /// Change of the positions.
    pub q: [f64; MAX_DOF],
    /// Change of the velocities.
    pub v: [f64; MAX_DOF],
    /// Change of the inputs.
    pub inputs: Inputs,
    /// Change of the rates of the inputs.
    pub rates: Inputs,
    /// Change of what acts behind the actuators of commands. It changes only with time.
    pub actuated: [f64; ACTUATED],
    /// Change of the temperatures of the nodes [K]. They change only with time.
    pub temperatures: [f64; NODES],
}

impl Direction {
    /// No change.
    pub const NONE: Self = Self {
        q: [0.0; MAX_DOF],
        v: [0.0; MAX_DOF],
        inputs: Inputs::ZERO,
        rates: Inputs::ZERO,
        actuated: [0.0; ACTUATED],
        temperatures: [0.0; NODES],
    };

    /// True if positions or velocities change.
    fn moves(&self) -> bool {
        self.q.iter().chain(&self.v).any(|change| *change != 0.0)
    }
}

/// Readings at the points of the central difference along a direction.
pub struct StencilReadings<T> {
    read: [T; STENCIL.len()],
    /// Distance between neighbouring points, as a multiple of the direction.
    apart: f64,
}

impl<T> StencilReadings<T> {
    /// Derivative of the value `of` the readings.
    pub fn slope(&self, of: impl Fn(&T) -> f64) -> f64 {
        // differences from the first value, so that the slope of a constant is exactly 0
        let first = of(&self.read[0]);
        let sum: f64 = STENCIL.iter().zip(&self.read).map(|((_, weight), read)| weight * (of(read) - first)).sum();
        sum / self.apart
    }
}

impl Simulation {
    /// Derivatives of the rates of positions and velocities along `direction`.
    pub fn rate_slopes(&self, direction: &Direction) -> [[f64; MAX_DOF]; 2] {
        let (n, state) = (self.degrees_of_freedom(), &self.state);
        let mut slopes = [[0.0; MAX_DOF]; 2];
        if direction.moves() {
            let mut rows = [0.0; 4 * MAX_DOF * MAX_DOF];
            self.slopes(&state.q, &state.v, &mut rows);
            for (i, row) in rows.chunks_exact(2 * n).enumerate().take(2 * n) {
                let by = |columns: &[f64], change: &[f64]| columns.iter().zip(change).map(|(a, b)| a * b).sum::<f64>();
                slopes[i / n][i % n] = by(&row[..n], &direction.q[..n]) + by(&row[n..], &direction.v[..n]);
            }
        }
        let input_acceleration_slopes = self.input_acceleration_slopes(direction);
        for i in 0..n {
            slopes[1][i] += input_acceleration_slopes[i];
        }
        slopes
    }

    /// Derivatives of the accelerations along the inputs of `direction`.
    fn input_acceleration_slopes(&self, direction: &Direction) -> [f64; MAX_DOF] {
        let (inputs, state) = (&self.inputs, &self.state);
        let mut input_acceleration_slopes = [0.0; MAX_DOF];
        let input_derivatives = InputDerivatives { rates: [direction.rates, Inputs::ZERO] };
        let change = self.acting_change(direction);
        with_equations!(self.model, state, inputs, |equations| {
            let by_inputs = equations.input_accelerations(&state.point(), &change, &input_derivatives);
            input_acceleration_slopes.iter_mut().zip(by_inputs).for_each(|(slope, by_inputs)| *slope = by_inputs);
        });
        input_acceleration_slopes
    }

    /// Change of the inputs along `direction` as it acts behind the actuators of commands.
    fn acting_change(&self, direction: &Direction) -> Inputs {
        let (mut change, commands) = (direction.inputs, self.inputs.actuated());
        for (k, slot) in change.actuated_mut().into_iter().enumerate() {
            if let Some(of) = &self.model.body_effects().actuators[k] {
                *slot = of.feedthrough(commands[k]) * *slot + direction.actuated[k];
            }
        }
        change
    }

    /// Rates at which the outputs of the actuators of commands change with time [1/s].
    fn actuator_rates(&self) -> [f64; ACTUATED] {
        let (actuators, State { inputs: acting, .. }) = (&self.model.body_effects().actuators, &self.state);
        let Some(actuated) = &acting.actuated else { return [0.0; ACTUATED] };
        let present = actuated.at(actuators, [&acting.values, &self.inputs], self.state.time());
        let commands = courses(&self.inputs, acting.derivatives.as_ref());
        let delayed = |k: usize| actuators[k].as_ref().filter(|of| !of.is_immediate());
        std::array::from_fn(|k| delayed(k).map_or(0.0, |of| of.acting(&present.states[k], &commands[k])[1]))
    }

    /// Direction in which state and inputs change with time, without temperatures.
    pub fn time_direction(&self) -> Direction {
        let mut direction = Direction::NONE;
        let Direction { q, v, .. } = &mut direction;
        self.rates(&self.state.q, &self.state.v, [q, v]);
        if let Some(input_derivatives) = self.input_derivatives() {
            [direction.inputs, direction.rates] = input_derivatives.rates;
        }
        direction.actuated = self.actuator_rates();
        direction
    }

    /// Rates of the temperatures [K/s].
    pub fn temperature_rates(&self) -> [f64; NODES] {
        of_scene::temperatures(&self.ledger_rates().readings)
    }

    /// Derivatives of angles and speeds along `direction`.
    pub fn motion_slopes(&self, direction: &Direction) -> Motion {
        let mut along = self.moved(&direction.q, &direction.v);
        along.state.whole_periods = [0; MAX_DOF];
        let slopes = along.motion_of_state();
        let spin = self.model.ideal.plan.layout().planet(0);
        let sense = if self.state.v[spin] == 0.0 { 0.0 } else { (self.state.v[spin] * direction.v[spin]).signum() };
        Motion { mesh_frequency: sense * slopes.mesh_frequency, ..slopes }
    }

    /// Forces along `direction`. If nothing moves, the meshes do not change and are left out.
    pub fn forces_along(&self, direction: &Direction) -> StencilReadings<Forces> {
        let extent = if direction.moves() { Extent::Components } else { Extent::Bodies };
        self.along(direction, |displaced| displaced.forces_of_state(extent))
    }

    /// Loaded tooth pairs along `direction`.
    pub fn pair_lines_along(&self, direction: &Direction) -> StencilReadings<PairLines> {
        if direction.moves() {
            self.along(direction, Self::pair_lines_of_state)
        } else {
            StencilReadings { read: Default::default(), apart: 1.0 }
        }
    }

    fn along<T>(&self, direction: &Direction, read: impl Fn(&Self) -> T) -> StencilReadings<T> {
        let size = self.natural_size(direction);
        let apart = if size > 0.0 { APART / size } else { 1.0 };
        let mut displaced = Self { forces: None, ..self.clone() };
        let read = STENCIL.map(|(offset, _)| {
            self.displace(&mut displaced, direction, offset * apart);
            read(&displaced)
        });
        StencilReadings { read, apart }
    }

    /// Rates of the continuous values of the ledger: heat, temperatures, and heat stored and given off.
    pub fn ledger_rates(&self) -> LedgerReadings {
        let (inputs, state) = (&self.inputs, &self.state);
        let heat = with_equations!(self.model, state, inputs, |equations| equations.evaluate(&state.point()).1.heat);
        let mut readings = [0.0; STEP_READINGS];
        if let Some(network) = &self.model.thermal {
            let Rates { temperatures, given_off } = self.thermal_rates(network, &heat);
            let heat = [network.absorbed(&temperatures), given_off];
            of_scene::set_readings(&mut readings, &temperatures, Some(heat));
        }
        LedgerReadings { heat, readings, ..LedgerReadings::default() }
    }

    /// Rates of the temperatures under the heat flows `heat` [W].
    fn thermal_rates(&self, network: &Network<HEATS>, heat: &[f64; HEATS]) -> Rates {
        let changes = self.inputs.changes_outside();
        let around = network.around.changed(changes);
        let is_limited = around.sump != network.around.commanded(changes).sump;
        let sump = if is_limited { 0.0 } else { self.input_derivatives().map_or(0.0, |of| of.rates[0].sump_change) };
        network.rates(&self.state.sums.thermal, heat, self.state.v[CARRIER].abs(), (around, sump))
    }

    /// Moves `displaced` to the point at `factor` times `direction`.
    fn displace(&self, displaced: &mut Self, direction: &Direction, factor: f64) {
        let (from, state) = (&self.state, &mut displaced.state);
        for i in 0..MAX_DOF {
            state.q[i] = from.q[i] + factor * direction.q[i];
            state.v[i] = from.v[i] + factor * direction.v[i];
        }
        if let (Some(from), Some(to)) = (&from.inputs.derivatives, &mut state.inputs.derivatives) {
            to.rates[0] = from.rates[0].plus(factor, &direction.rates);
        }
        if let (Some(from), Some(to)) = (&from.inputs.actuated, &mut state.inputs.actuated) {
            for (to, (from, change)) in to.states.iter_mut().zip(from.states.iter().zip(direction.actuated)) {
                (to.limited, to.value) = (from.limited + factor * change, from.value + factor * change);
            }
        }
        displaced.inputs = self.inputs.plus(factor, &direction.inputs);
        let rises = &from.sums.thermal.rises;
        state.sums.thermal.rises = std::array::from_fn(|i| rises[i] + factor * direction.temperatures[i]);
    }

    /// Largest change in `direction`, in natural magnitudes.
    fn natural_size(&self, direction: &Direction) -> f64 {
        let (inputs, state) = (&self.inputs, &self.state);
        let mut largest = 0.0f64;
        with_equations!(self.model, state, inputs, |equations| {
            let weights = equations.weights(&state.point());
            for i in 0..equations.degrees_of_freedom() {
                largest = largest.max((weights.q[i] * direction.q[i]).abs());
                largest = largest.max((weights.v[i] * direction.v[i]).abs());
            }
        });
        self.inputs.visit(&direction.inputs, |now, change| largest = largest.max(change.abs() / (1.0 + now.abs())));
        largest
    }

    /// Direction in which states and inputs change by `states` and `inputs`. Imposed motions follow their commands.
    pub fn direction(&self, states: &[f64; STATES], inputs: &Inputs) -> Direction {
        let mut direction = Direction { inputs: *inputs, ..Direction::NONE };
        self.model.ideal.plan.refer(&mut direction.inputs);
        self.set_from_states(states, &mut direction.q, &mut direction.v);
        let Direction { v, inputs, .. } = &mut direction;
        for speed in imposed_speeds(&self.model, inputs) {
            v[speed.freedom] = speed.value;
        }
        if let Gears::Ideal(_) = &self.model.gears {
            if !self.is_model_exchange() {
                add_impulse(&self.model, [v[CARRIER], v[PLANET]], v);
            }
            self.model.ideal.constrain(v);
        }
        direction
    }
}
