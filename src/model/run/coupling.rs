//! Records the exchange with the host over each communication step (`effects.coupling_advice`).
//!
//! Positions do not jump at communication points, so the end of a step is also the start of the next one. Between
//! them, the input is constant or follows its derivatives, so its mean is exact.

use super::{Simulation, StepFailure};
use crate::model::dynamics::event::AdvanceOptions;
use crate::model::effect_kinds::Changes;
use crate::model::effects::coupling_advice::{Coupling, Cut, PORTS, PortStep, Shaft};
use crate::model::scene::{CARRIER, Inputs};
use crate::model::setup::STEP_READINGS;
use crate::model::setup::effect_outputs::indices_of;
use crate::numeric::quotient;

/// Positions and their rates of all ports.
type PortMotion = [[f64; 2]; PORTS];

/// Value of `inputs` at each port: torques, or the speeds of sides driven by speed.
fn given(inputs: &Inputs, side_imposed: [bool; 2]) -> [f64; PORTS] {
    let [left, right] = [0, 1].map(|s| if side_imposed[s] { inputs.side_speed[s] } else { inputs.load_torque[s] });
    [inputs.drive_torque, left, right]
}

impl Simulation {
    /// True if the exchange with the host is recorded.
    #[inline]
    pub(super) fn records_exchange(&self) -> bool {
        self.memories.coupling_advice.is_on()
    }

    /// Advances as [`Simulation::advance_by`] does, and records the exchange. A part of a communication step is
    /// recorded with its end.
    #[cold]
    #[inline(never)]
    pub(super) fn advance_recorded(&mut self, until: f64, options: AdvanceOptions) -> Result<(), StepFailure> {
        let side_imposed = self.model.ideal.plan.side_imposed;
        let before = given(&self.inputs, side_imposed);
        let derivatives = self.state.inputs.derivatives.as_ref();
        let rates = derivatives.map(|derivatives| derivatives.rates.each_ref().map(|rates| given(rates, side_imposed)));
        if self.memories.coupling_advice.get().is_some_and(|coupling| coupling.last.is_none()) {
            let last = Some((self.time(), self.port_motion()));
            self.memories.coupling_advice.get_mut().into_iter().for_each(|coupling| coupling.last = last);
        }
        let begin = self.time();
        self.advance_unrecorded(until, options)?;
        // a part of a communication step belongs to the record of the whole step
        if !options.is_part {
            let mut memory = std::mem::take(&mut self.memories.coupling_advice);
            if let Some(coupling) = memory.get_mut() {
                self.record(coupling, before, (begin, rates));
            }
            self.memories.coupling_advice = memory;
        }
        Ok(())
    }

    /// Notes which inputs `follow` derivatives in a step in which the others ramp: 1 for each of them.
    pub(super) fn note_ramps(&mut self, follow: &Inputs) {
        if let Some(coupling) = self.memories.coupling_advice.get_mut() {
            let follows = given(follow, self.model.ideal.plan.side_imposed);
            coupling.follows = follows.map(|follows| follows != 0.0);
        }
    }

    /// Adds the step that ends now to `coupling`. The host's values were `before` at `begin` [s], with the first and
    /// second `rates` of the inputs.
    #[inline]
    fn record(&self, coupling: &mut Coupling, before: [f64; PORTS], (begin, rates): (f64, Option<[[f64; PORTS]; 2]>)) {
        let (time, end) = (self.time(), self.port_motion());
        let Some((last, start)) = coupling.last.replace((time, end)) else { return };
        let mut steps = before.map(|given| PortStep { given, mean: given, h: time - last, ..PortStep::default() });
        if let Some([first, second]) = rates {
            let h = time - begin;
            for (port, step) in steps.iter_mut().enumerate() {
                step.mean += h * (0.5 * first[port] + h * second[port] / 6.0);
                step.is_line = first[port] != 0.0 || second[port] != 0.0;
            }
        }
        // a ramp reaches the host's value at the end of the step
        if self.ramps_inputs() {
            let after = given(&self.inputs, self.model.ideal.plan.side_imposed);
            let ramps = steps.iter_mut().zip(after).zip(coupling.follows).filter(|(_, follows)| !follows);
            ramps.for_each(|((step, given), _)| (step.given, step.is_line) = (given, false));
        }
        for (port, step) in steps.iter_mut().enumerate() {
            self.exchange(port, [start[port], end[port]], step);
        }
        coupling.add(&steps, &self.cut());
    }

    /// Delay of the host, and half-shafts at the cut.
    pub(in crate::model) fn cut(&self) -> Cut {
        let (specs, imposed) = (&self.model.parameters.specs, self.model.ideal.plan.side_imposed);
        let shaft = |s: usize| {
            let (stiffness, damping) = (specs.half_shaft.stiffness[s], specs.half_shaft.damping[s]);
            imposed[s].then_some(Shaft { stiffness, damping })
        };
        Cut {
            delay: specs.coupling_advice.host_delay,
            is_ramp: self.ramps_inputs(),
            shafts: [None, shaft(0), shaft(1)],
            ..Cut::default()
        }
    }

    /// The cut with the mobilities of the ports. Teeth are rigid compared with hosts, so they are those of ideal gears,
    /// and the end of a half-shaft that twists moves separately, as does a drive behind an elastic mesh or shaft.
    pub(in crate::model) fn cut_with_mobility(&self) -> Cut {
        let ideal = &self.model.ideal;
        let under = |inputs: &Inputs| {
            let motion = ideal.motion(inputs);
            let [left, right] = ideal.side_accelerations(&motion);
            [motion.carrier, left, right]
        };
        let unit = |s: usize| Inputs { load_torque: [0, 1].map(|side| f64::from(u8::from(side == s))), ..Inputs::ZERO };
        let by_torque = [under(&Inputs { drive_torque: 1.0, ..Inputs::ZERO }), under(&unit(0)), under(&unit(1))];
        let mut mobility: [[f64; PORTS]; PORTS] = std::array::from_fn(|port| by_torque.map(|of| of[port]));
        let plan = &ideal.plan;
        let separate = [(!plan.drives_carrier(), ideal.inertia.of_port(plan))]
            .into_iter()
            .chain([0, 1].map(|s| (plan.shafts[s], ideal.inertia.end[s])));
        for (port, (_, inertia)) in separate.enumerate().filter(|(_, (is_separate, _))| *is_separate) {
            mobility.iter_mut().for_each(|row| row[port] = 0.0);
            mobility[port] = [0.0; PORTS];
            mobility[port][port] = quotient(1.0, inertia).unwrap_or(0.0);
        }
        Cut { mobility, ..self.cut() }
    }

    /// Sets the movement of `port` from `start` to `end`. A drive by speed has no port.
    #[inline]
    fn exchange(&self, port: usize, [start, end]: [[f64; 2]; 2], step: &mut PortStep) {
        let plan = &self.model.ideal.plan;
        let moved = end[0] - start[0];
        (step.moved, step.changed) = (moved, end[1] - start[1]);
        match port.checked_sub(1) {
            None if plan.drive_imposed => *step = PortStep::default(),
            // the position is the twist of the half-shaft, and the rate its torque
            Some(s) if plan.side_imposed[s] => {
                let shaft = &self.model.parameters.specs.half_shaft;
                step.moved = 0.5 * step.h * shaft.stiffness[s] * (start[0] + end[0]) + shaft.damping[s] * moved;
            }
            _ => {}
        }
    }

    /// Angle and speed of each port driven by torque, of the drive at the carrier's speed; twist and torque of a half-shaft whose wheel is driven by speed.
    fn port_motion(&self) -> PortMotion {
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
        let drive = layout.angle(layout.port).map(|(i, factor)| factor * position(i)).sum();
        [[drive, state.v[layout.port]], side(0), side(1)]
    }

    /// Sets the readings of the effect in the ledger.
    pub(in crate::model) fn read_coupling(&self, readings: &mut [f64; STEP_READINGS]) {
        let Some(coupling) = self.memories.coupling_advice.get() else { return };
        let readings = &mut readings[const { indices_of("coupling_advice", Changes::ByStep) }];
        readings[..PORTS].copy_from_slice(&coupling.errors());
        let wanted = self.model.parameters.specs.coupling_advice.wanted_ratio;
        let (step, state) = coupling.advice(wanted, &self.cut_with_mobility());
        readings[PORTS..].copy_from_slice(&[coupling.ratio(), step, f64::from(state as u8)]);
    }
}
