//! Records the exchange with the host over each communication step (`effects.coupling_advice`).
//!
//! Positions do not jump at communication points, so the end of a step is also the start of the next one. Between
//! them, the input is constant or follows its derivatives, so its mean is exact.

use super::{Simulation, StepFailure};
use crate::model::dynamics::event::AdvanceOptions;
use crate::model::effect_kinds::{BUILT, Changes};
use crate::model::effects::coupling_advice::{Coupling, PORTS, PortStep};
use crate::model::scene::{CARRIER, Inputs};
use crate::model::setup::effect_outputs::places_of;
use crate::model::setup::{Parameters, STEP_READINGS};

/// Positions and their rates of all ports.
type Places = [[f64; 2]; PORTS];

/// Record of a new simulation with `parameters`, if its scene has the effect.
pub fn new_record(parameters: &Parameters) -> Option<Box<Coupling>> {
    (BUILT && parameters.effects.coupling_advice).then(Box::default)
}

/// Value of `inputs` at each port: torques, or the speeds of sides driven by speed.
fn given(inputs: &Inputs, side_imposed: [bool; 2]) -> [f64; PORTS] {
    let [left, right] = [0, 1].map(|s| if side_imposed[s] { inputs.side_speed[s] } else { inputs.load_torque[s] });
    [inputs.carrier_torque, left, right]
}

impl Simulation {
    /// Advances as [`Simulation::advance_by`] does, and records the exchange. A part of a communication step is
    /// recorded with its end.
    #[cold]
    #[inline(never)]
    pub(super) fn advance_recorded(&mut self, until: f64, options: AdvanceOptions) -> Result<(), StepFailure> {
        let before = given(&self.inputs, self.model.ideal.plan.side_imposed);
        let rates = self.state.input_derivatives.as_ref().map(|input_derivatives| {
            input_derivatives.rates.each_ref().map(|rates| given(rates, self.model.ideal.plan.side_imposed))
        });
        let begin = self.time();
        let start = match self.coupling.as_ref().and_then(|coupling| coupling.last) {
            Some(last) => last,
            None => (begin, self.places()),
        };
        self.advance_unrecorded(until, options)?;
        let (time, end) = (self.time(), self.places());
        let last = Some(if options.is_part { start } else { (time, end) });
        let mut steps = [PortStep::default(); PORTS];
        if !options.is_part {
            let after = given(&self.inputs, self.model.ideal.plan.side_imposed);
            let h = time - begin;
            for (port, step) in steps.iter_mut().enumerate() {
                *step = PortStep { given: before[port], mean: before[port], h: time - start.0, ..PortStep::default() };
                if let Some([first, second]) = rates.map(|rates| rates.map(|rate| rate[port])) {
                    step.mean += h * (0.5 * first + h * second / 6.0);
                    step.is_line = first != 0.0 || second != 0.0;
                }
                // a ramp reaches the host's value at the end of the step
                if self.ramps_inputs() {
                    (step.given, step.is_line) = (after[port], false);
                }
                self.exchange(port, [start.1[port], end[port]], step);
            }
        }
        let delay = self.model.parameters.specs.coupling_advice.host_delay;
        if let Some(coupling) = &mut self.coupling {
            coupling.last = last;
            if !options.is_part {
                coupling.add(&steps, delay);
            }
        }
        Ok(())
    }

    /// Sets the movement of `port` from `start` to `end`. A carrier driven by speed has no port.
    fn exchange(&self, port: usize, [start, end]: [[f64; 2]; 2], step: &mut PortStep) {
        let plan = &self.model.ideal.plan;
        let moved = end[0] - start[0];
        match port.checked_sub(1) {
            None if plan.carrier_imposed => *step = PortStep::default(),
            Some(s) if plan.side_imposed[s] => {
                // the position is the twist of the half-shaft, and the rate its torque
                let shaft = &self.model.parameters.specs.half_shaft;
                step.moved = 0.5 * step.h * shaft.stiffness[s] * (start[0] + end[0]) + shaft.damping[s] * moved;
                step.changed = end[1] - start[1];
            }
            _ => (step.moved, step.changed) = (moved, end[1] - start[1]),
        }
    }

    /// Angle and speed of each port driven by torque; twist and torque of a half-shaft whose wheel is driven by speed.
    fn places(&self) -> Places {
        let (model, state) = (&self.model, &self.state);
        let (plan, layout) = (&model.ideal.plan, &model.layout);
        let position = |i: usize| state.position(i, &model.periods);
        let carrier = position(CARRIER);
        let side = |s: usize| {
            if !plan.shafts[s] {
                return [carrier + position(s), state.v[s]];
            }
            let end = layout.end(s);
            if plan.side_imposed[s] {
                let (twist, shaft) = (position(end), &model.parameters.specs.half_shaft);
                let rate = state.v[s] - state.v[end];
                [twist, shaft.stiffness[s] * twist + shaft.damping[s] * rate]
            } else {
                [carrier + position(s) - position(end), state.v[end]]
            }
        };
        [[carrier, state.v[CARRIER]], side(0), side(1)]
    }

    /// Sets the readings of the effect in the ledger.
    pub(in crate::model) fn read_coupling(&self, readings: &mut [f64; STEP_READINGS]) {
        let Some(coupling) = &self.coupling else { return };
        let readings = &mut readings[const { places_of("coupling_advice", Changes::ByStep) }];
        readings[..PORTS].copy_from_slice(&coupling.errors());
        let wanted = self.model.parameters.specs.coupling_advice.wanted_ratio;
        readings[PORTS..].copy_from_slice(&[coupling.ratio(), coupling.advice(wanted)]);
    }

    /// Record of the exchange with the host, for snapshots.
    pub fn coupling(&self) -> Option<&Coupling> {
        self.coupling.as_deref()
    }

    /// Returns the simulation with `coupling` as the record of its exchange with the host, if its scene has one.
    pub fn with_coupling(mut self, coupling: Option<Box<Coupling>>) -> Self {
        if self.coupling.is_some() && coupling.is_some() {
            self.coupling = coupling;
        }
        self
    }
}
