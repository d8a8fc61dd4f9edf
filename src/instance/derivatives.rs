//! Derivatives by time: of inputs, as the host sets them, and of outputs.

use super::sensitivity::{Slopes, check_built};
use super::unknowns::{finite_slope, output_source};
use super::values::row;
use super::{CallError, CallResult, InputArray, Instance, Kind, Output, Phase, Snapshot};
use crate::model::{InputDerivatives, Inputs, LedgerReadings, ORDERS};
use crate::variables::{Access, OutputSource, Variable, accepted, table};

/// Highest order of output derivatives.
pub const OUTPUT_ORDER: i32 = 1;

impl Snapshot {
    /// Takes over the inputs that their derivatives have reached in a step.
    pub fn take_reached_inputs(&mut self) {
        let Some(simulation) = &mut self.simulation else { return };
        (self.inputs, self.input_derivatives) =
            (within_ranges(*simulation.inputs()), simulation.input_derivatives().copied());
        simulation.set_inputs(&self.inputs);
    }
}

/// Returns `inputs` with the limit in place of each input that has passed it by rounding.
pub fn within_ranges(mut inputs: Inputs) -> Inputs {
    for &index in &table().inputs {
        let row = &table().rows[index];
        if let Access::Input(slot) = row.access {
            let reached = slot(&mut inputs);
            *reached = accepted(row, *reached, f64::INFINITY).unwrap_or(*reached);
        }
    }
    inputs
}

/// Bit of an input in `Snapshot::derivatives_set`.
pub fn input_bit(reference: u32) -> u32 {
    let index = table().inputs.iter().position(|&i| i as u32 == reference);
    index.map_or(0, |index| 1 << index)
}

impl Instance {
    /// Derivatives of inputs. They hold from the next step until the host sets the input or its derivatives again.
    pub fn set_input_derivatives(
        &mut self,
        references: InputArray<u32>,
        orders: InputArray<i32>,
        values: InputArray<f64>,
    ) -> CallResult {
        if self.now.kind == Kind::ModelExchange {
            return Err(CallError::error(
                "in model exchange inputs are set at every evaluation; they have no derivatives",
            ));
        }
        for ((reference, order), value) in references.iter().zip(orders.iter()).zip(values.iter()) {
            let row = row(reference)?;
            let Access::Input(_) = row.access else {
                return Err(CallError::error(format!("{} is not an input, so it has no input derivative", row.name)));
            };
            if !(1..=ORDERS as i32).contains(&order) {
                return Err(CallError::error(format!(
                    "{}: derivatives of order {order} are not supported, only of order 1 to {ORDERS}",
                    row.name
                )));
            }
            if !value.is_finite() {
                return Err(CallError::discard(format!(
                    "the derivative of order {order} of {} is {value}, not a finite number",
                    row.name
                )));
            }
        }
        let now = &mut self.now;
        let mut input_derivatives = now.input_derivatives.unwrap_or(InputDerivatives::ZERO);
        for ((reference, order), value) in references.iter().zip(orders.iter()).zip(values.iter()) {
            if let Access::Input(slot) = row(reference)?.access {
                *slot(&mut input_derivatives.rates[order as usize - 1]) = value;
                now.derivatives_set |= input_bit(reference);
            }
        }
        self.replace_input_derivatives(input_derivatives);
        Ok(())
    }

    /// An input set without derivatives since the last step is held constant.
    pub fn end_derivatives_of(&mut self, references: InputArray<u32>) {
        let Some(mut input_derivatives) = self.now.input_derivatives else { return };
        for reference in references.iter().filter(|&r| self.now.derivatives_set & input_bit(r) == 0) {
            if let Ok(Variable { access: Access::Input(slot), .. }) = row(reference) {
                input_derivatives.rates.iter_mut().for_each(|rates| *slot(rates) = 0.0);
            }
        }
        self.replace_input_derivatives(input_derivatives);
    }

    fn replace_input_derivatives(&mut self, input_derivatives: InputDerivatives) {
        let now = &mut self.now;
        now.input_derivatives = (input_derivatives != InputDerivatives::ZERO).then_some(input_derivatives);
        match (now.phase, &mut now.simulation) {
            (Phase::StepComplete, Some(simulation)) if simulation.ramps_inputs() => now.apply_jumps(),
            (Phase::StepComplete, Some(simulation)) => simulation.set_input_derivatives(now.input_derivatives),
            _ => {}
        }
    }

    /// Refuses a step of `h` [s] in which an input would leave its range.
    pub fn check_inputs_within_step(&self, h: f64) -> CallResult {
        let Some(input_derivatives) = self.now.input_derivatives else { return Ok(()) };
        let [mut first, mut second] = input_derivatives.rates;
        for &index in &table().inputs {
            let row = &table().rows[index];
            let Access::Input(slot) = row.access else { continue };
            let peak = -*slot(&mut first) / *slot(&mut second);
            for time in [h, peak].into_iter().filter(|&time| time > 0.0 && time <= h) {
                let (mut inputs, _) = input_derivatives.after(time, &self.now.inputs);
                let (reached, last) = (*slot(&mut inputs), *slot(&mut { self.now.inputs }));
                accepted(row, reached, last).map_err(|problem| {
                    CallError::error(format!(
                        "with its derivatives, an input leaves its range within the step: {problem}"
                    ))
                })?;
            }
        }
        Ok(())
    }

    /// Derivatives of outputs by time.
    pub fn get_output_derivatives<'a>(
        &mut self,
        wanted: impl Iterator<Item = (u32, i32)> + Clone,
        values: impl Iterator<Item = Output<'a, f64>>,
    ) -> CallResult {
        check_built()?;
        let (mut is_any, mut reads_temperatures) = (false, false);
        for (reference, order) in wanted.clone() {
            let row = row(reference)?;
            if order != OUTPUT_ORDER {
                return Err(CallError::error(format!(
                    "{}: derivatives of order {order} are not available, only of order {OUTPUT_ORDER}",
                    row.name
                )));
            }
            is_any = true;
            reads_temperatures |= matches!(output_source(row)?, OutputSource::Reading(_));
        }
        if !is_any {
            return Ok(());
        }
        let simulation = self.simulation()?;
        let present = simulation.shown();
        let simulation = present.as_ref().unwrap_or(simulation);
        let mut direction = simulation.time_direction();
        if reads_temperatures {
            direction.temperatures = simulation.temperature_rates();
        }
        let mut slopes = Slopes::new(simulation, &direction);
        let mut ledger: Option<LedgerReadings> = None;
        for ((reference, _), value) in wanted.zip(values) {
            let row = row(reference)?;
            let source = output_source(row)?;
            let slope = match source {
                OutputSource::Ledger(of) => of(ledger.get_or_insert_with(|| simulation.ledger_rates())),
                OutputSource::LedgerReading(place) => {
                    ledger.get_or_insert_with(|| simulation.ledger_rates()).readings[place]
                }
                OutputSource::Heat(place) => ledger.get_or_insert_with(|| simulation.ledger_rates()).heat[place],
                _ => slopes.of(source),
            };
            value.write(finite_slope(row, slope)?);
        }
        Ok(())
    }
}
