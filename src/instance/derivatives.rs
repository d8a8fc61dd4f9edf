//! Derivatives with respect to time: those of inputs, which the host sets, and those of outputs.

use super::sensitivity::{OutputSlopes, check_built};
use super::unknowns::{finite_slope, output_source};
use super::values::row;
use super::{CallError, CallResult, InputArray, Instance, Kind, Output, Phase, Snapshot};
use crate::declaration::Range;
use crate::model::{InputDerivatives, InputField, Inputs, LedgerReadings, ORDERS};
use crate::variables::{Access, OutputSource, Table, Variable, accepted, table};

/// Highest order of output derivatives.
pub const OUTPUT_ORDER: i32 = 1;

impl Snapshot {
    /// Copies the inputs that the simulation has reached along their derivatives. Inputs in the mask `not_plain` (see
    /// [`Instance::check_inputs_within_step`]) may have passed a limit by rounding, and are then set to the limit. If
    /// the mask is empty, all rates are constant and need no copy.
    pub fn take_reached_inputs(&mut self, not_plain: u32) {
        let Some(simulation) = &mut self.simulation else { return };
        self.inputs = *simulation.inputs();
        if not_plain == 0 {
            return;
        }
        self.input_derivatives = simulation.input_derivatives().copied();
        keep_within_ranges(&mut self.inputs, not_plain);
        simulation.set_inputs(&self.inputs);
    }
}

/// Bit, row and field of each input in `mask`, in ascending order. Bits beyond the inputs are ignored.
pub fn inputs_in(mut mask: u32) -> impl Iterator<Item = (u32, &'static Variable, InputField)> {
    let Table { rows, inputs, .. } = table();
    std::iter::from_fn(move || {
        let index = inputs.get(mask.trailing_zeros() as usize)?;
        let bit = mask & mask.wrapping_neg();
        mask ^= bit;
        Some((bit, &rows[*index]))
    })
    .filter_map(|(bit, row)| if let Access::Input(slot) = row.access { Some((bit, row, slot)) } else { None })
}

/// Sets each of the `inputs` in `mask` that has passed a limit by rounding to the limit.
pub fn keep_within_ranges(inputs: &mut Inputs, mask: u32) {
    for (_, row, slot) in inputs_in(mask) {
        let reached = slot(inputs);
        *reached = accepted(row, *reached, f64::INFINITY).unwrap_or(*reached);
    }
}

/// Bit of an input in the masks `Snapshot::derivatives_set` and `Instance::changing`; 0 for other variables.
pub fn input_bit(reference: u32) -> u32 {
    let index = table().inputs.iter().position(|&i| i as u32 == reference);
    index.map_or(0, |index| 1 << index)
}

impl Instance {
    /// Sets derivatives of inputs. They apply from the next step until the host sets the input or its derivatives
    /// again.
    pub fn set_input_derivatives(
        &mut self,
        references: InputArray<u32>,
        orders: InputArray<i32>,
        values: InputArray<f64>,
    ) -> CallResult {
        if self.now.kind == Kind::ModelExchange {
            return Err(CallError::error(
                "in model exchange, inputs are set at every evaluation and have no derivatives",
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
        let input_derivatives = now.input_derivatives.get_or_insert(InputDerivatives::ZERO);
        let mut may_be_zero = false;
        for ((reference, order), value) in references.iter().zip(orders.iter()).zip(values.iter()) {
            if let Access::Input(slot) = row(reference)?.access {
                *slot(&mut input_derivatives.rates[order as usize - 1]) = value;
                may_be_zero |= value == 0.0;
                let bit = input_bit(reference);
                now.derivatives_set |= bit;
                self.changing |= bit;
            }
        }
        self.share_input_derivatives(may_be_zero);
        Ok(())
    }

    /// Holds inputs constant if they were set without derivatives since the last step.
    pub fn end_derivatives_of(&mut self, references: InputArray<u32>) {
        let Some(input_derivatives) = &mut self.now.input_derivatives else { return };
        for reference in references.iter() {
            let bit = input_bit(reference);
            if self.now.derivatives_set & bit == 0
                && let Ok(Variable { access: Access::Input(slot), .. }) = row(reference)
            {
                input_derivatives.rates.iter_mut().for_each(|rates| *slot(rates) = 0.0);
                self.changing &= !bit;
            }
        }
        self.share_input_derivatives(true);
    }

    /// Passes the derivatives to the simulation. Inputs are constant if all derivatives are 0, which is checked only
    /// with `may_be_zero`.
    fn share_input_derivatives(&mut self, may_be_zero: bool) {
        let now = &mut self.now;
        if self.changing == 0 || may_be_zero && now.input_derivatives.as_ref() == Some(&InputDerivatives::ZERO) {
            now.input_derivatives = None;
        }
        match (now.phase, &mut now.simulation) {
            (Phase::StepComplete, Some(simulation)) if simulation.ramps_inputs() => now.apply_unramped(),
            (Phase::StepComplete, Some(simulation)) => {
                simulation.share_input_derivatives(now.input_derivatives.as_ref());
            }
            _ => {}
        }
    }

    /// Refuses a step of `h` [s] in which an input would leave its range. Returns the inputs that are not plain in this
    /// step, as a bit mask in the order of the table. A plain input is constant, or changes at a constant rate far from
    /// its limits.
    pub fn check_inputs_within_step(&mut self, h: f64) -> CallResult<u32> {
        let mut not_plain = 0;
        let Some(input_derivatives) = &mut self.now.input_derivatives else { return Ok(not_plain) };
        for (bit, row, slot) in inputs_in(self.changing) {
            let [first, second] = input_derivatives.rates.each_mut().map(|rates| *slot(rates));
            if first == 0.0 && second == 0.0 {
                self.changing ^= bit;
                continue;
            }
            let last = *slot(&mut self.now.inputs);
            // twice the change, to cover the rounding of times
            let twice = 2.0 * h * first.abs();
            let is_far = |range: Range| range.min < last - twice && last + twice < range.max;
            if second == 0.0 && row.range.is_some_and(is_far) {
                continue;
            }
            not_plain |= bit;
            let peak = -first / second;
            for time in [h, peak].into_iter().filter(|&time| time > 0.0 && time <= h) {
                let reached = *slot(&mut input_derivatives.after(time, &self.now.inputs).0);
                accepted(row, reached, last).map_err(|problem| {
                    CallError::error(format!(
                        "with its derivatives, an input leaves its range within the step: {problem}"
                    ))
                })?;
            }
        }
        Ok(not_plain)
    }

    /// Returns derivatives of outputs with respect to time.
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
        let simulation = self.simulation()?.shown();
        let mut direction = simulation.time_direction();
        if reads_temperatures {
            direction.temperatures = simulation.temperature_rates();
        }
        let mut slopes = OutputSlopes::new(&simulation, &direction);
        let mut ledger: Option<LedgerReadings> = None;
        for ((reference, _), value) in wanted.zip(values) {
            let row = row(reference)?;
            let source = output_source(row)?;
            let slope = match source {
                OutputSource::Ledger(i, of) => of(ledger.get_or_insert_with(|| simulation.ledger_rates()), i),
                _ => slopes.of(source),
            };
            value.write(finite_slope(row, slope)?);
        }
        Ok(())
    }
}
