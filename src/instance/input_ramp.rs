//! Steps in which jumps of inputs become ramps (`solver.input_ramp`).
//!
//! The snapshot contains the values set by the host, the simulation the values reached so far. An input with
//! derivatives from the host follows these derivatives instead of a ramp to the next value.

use super::Snapshot;
use super::derivatives::{inputs_in, keep_within_ranges};
use crate::model::{HostInputs, InputDerivatives, Inputs, Simulation};

impl Snapshot {
    /// Passes the inputs that the host has set to the simulation, between steps.
    #[inline]
    pub fn pass_inputs(&mut self) {
        match &mut self.simulation {
            Some(simulation) if simulation.ramps_inputs() => self.apply_unramped(),
            Some(simulation) => simulation.set_inputs(&self.inputs),
            None => {}
        }
    }

    /// Passes the inputs that jump and those that follow derivatives.
    #[cold]
    pub fn apply_unramped(&mut self) {
        let host = self.host_inputs();
        if let Some(simulation) = &mut self.simulation {
            simulation.apply_unramped(&host);
        }
    }

    /// Starts or continues a step to `until` [s]. Returns true if jumps of inputs become ramps.
    #[inline]
    pub fn begin_ramp(&mut self, until: f64) -> bool {
        let ramps = self.simulation.as_ref().is_some_and(Simulation::ramps_inputs);
        if ramps {
            let host = self.host_inputs();
            self.simulation.iter_mut().for_each(|simulation| simulation.ramp_inputs(&host, until));
        }
        ramps
    }

    /// Ends a step to `until` [s] in which jumps of inputs became ramps. An input at the end of its ramp gets exactly
    /// the host's value.
    pub fn end_ramp(&mut self, until: f64) {
        let HostInputs { values, follow, .. } = self.host_inputs();
        let Some(simulation) = &self.simulation else { return };
        let (is_complete, reached) = (simulation.time() >= until, simulation.input_derivatives().copied());
        self.inputs = values.pick(simulation.inputs(), &follow);
        keep_within_ranges(&mut self.inputs, u32::MAX);
        self.input_derivatives = reached
            .map(|reached| InputDerivatives::ZERO.pick(&reached, &follow))
            .filter(|derivatives| *derivatives != InputDerivatives::ZERO);
        match &mut self.simulation {
            Some(simulation) if is_complete => simulation.set_inputs(&self.inputs),
            _ => self.apply_unramped(),
        }
    }

    /// Returns the inputs as the host has set them.
    fn host_inputs(&self) -> HostInputs {
        let mut derivatives = self.input_derivatives.unwrap_or(InputDerivatives::ZERO);
        let mut follow = Inputs::ZERO;
        for (bit, _, slot) in inputs_in(u32::MAX) {
            let is_set = self.derivatives_set & bit != 0;
            if is_set || derivatives.rates.iter_mut().any(|rates| *slot(rates) != 0.0) {
                *slot(&mut follow) = 1.0;
            }
        }
        HostInputs { values: self.inputs, derivatives, follow }
    }
}
