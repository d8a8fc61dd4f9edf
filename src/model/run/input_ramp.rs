//! Input ramps (`solver.input_ramp`): a jump of an input becomes a linear ramp over the next communication step.
//!
//! Between steps, the simulation keeps the inputs that it has reached, and the host's values are not applied yet. At
//! its start, a step sets the rate of each input so that the input reaches the host's value at the end of the step. A
//! host could do the same with input derivatives. If a step ends early, the next step continues the ramp. Torques and
//! imposed speeds ramp. Lock and fault trigger cause events, and outside temperatures act through slow thermal nodes,
//! so these inputs jump.

use super::Simulation;
use crate::model::scene::{InputDerivatives, Inputs};
use crate::numeric::Finite;

/// Mask of the inputs that jump: 1 for each of them.
const UNRAMPED: Inputs =
    Inputs { lock: 1.0, dog_command: [1.0; 2], fault: 1.0, ambient_change: 1.0, sump_change: 1.0, ..Inputs::ZERO };

/// Inputs as set by the host.
#[derive(Clone, Copy, Debug)]
pub struct HostInputs {
    /// Values.
    pub values: Inputs,
    /// Derivatives.
    pub derivatives: InputDerivatives,
    /// Mask of the inputs that follow the derivatives: 1 for each of them.
    pub follow: Inputs,
}

impl HostInputs {
    /// Values without derivatives.
    pub fn held(values: &Inputs) -> Self {
        Self { values: *values, derivatives: InputDerivatives::ZERO, follow: Inputs::ZERO }
    }
}

impl Simulation {
    /// True if jumps of inputs become ramps.
    pub fn ramps_inputs(&self) -> bool {
        self.model.parameters.solver.input_ramp && !self.is_model_exchange()
    }

    /// Applies the inputs that do not ramp. The others keep the values and rates that they have reached.
    pub fn apply_unramped(&mut self, host: &HostInputs) {
        let at_once = UNRAMPED.plus(1.0, &host.follow);
        self.set_inputs(&self.inputs.pick(&host.values, &at_once));
        let reached = self.state.inputs.derivatives.unwrap_or(InputDerivatives::ZERO);
        self.set_rates(reached.pick(&host.derivatives, &host.follow));
    }

    /// Prepares a step in which all inputs reach the host's values at the time `until` [s].
    pub fn ramp_inputs(&mut self, host: &HostInputs, until: f64) {
        self.apply_unramped(host);
        self.note_ramps(&host.follow);
        let mut values = host.values;
        self.model.ideal.plan.refer(&mut values);
        let first = self.inputs.rates_to(&values, until - self.time());
        let lines = InputDerivatives { rates: [first, Inputs::ZERO] };
        // over the shortest steps a rate may overflow; then the inputs jump
        if lines.is_finite() {
            self.set_rates(lines.pick(&host.derivatives, &host.follow));
        } else {
            self.set_inputs(&host.values);
            self.set_rates(host.derivatives);
        }
    }

    /// Ends a step in which all ramps are complete. Their inputs become exactly the host's values.
    pub fn end_ramp(&mut self, host: &HostInputs) {
        self.set_inputs(&host.values.pick(&self.inputs, &host.follow));
    }

    fn set_rates(&mut self, derivatives: InputDerivatives) {
        let derivatives = self.model.ideal.plan.with_drive(derivatives);
        self.set_input_derivatives((derivatives != InputDerivatives::ZERO).then_some(derivatives));
    }
}
