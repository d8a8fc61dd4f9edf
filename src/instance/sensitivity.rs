//! Directional and adjoint derivatives of a running simulation, and of initial values during initialisation.

use crate::FULL;

use super::initial_derivatives::initial_derivatives;
use super::unknowns::{Unknown, finite_slope, unknowns};
use super::values::row;
use super::{CallError, CallResult, Instance, Output, Phase, Snapshot};
use crate::model::{Direction, Forces, GearCache, Inputs, PairLines, STATES, Simulation, StencilReadings};
use crate::variables::{Access, OutputSource, table};

impl Instance {
    /// Returns derivatives of unknowns along a direction of knowns.
    pub fn get_directional_derivative<'a>(
        &mut self,
        unknown: impl Iterator<Item = u32>,
        known: impl Iterator<Item = (u32, f64)> + Clone,
        values: impl Iterator<Item = Output<'a, f64>>,
    ) -> CallResult {
        check_built()?;
        let unknowns = unknowns(unknown)?;
        if let Some((_, bad)) = known.clone().find(|(_, x)| !x.is_finite()) {
            return Err(CallError::discard(format!("{bad} in the direction is not a finite number")));
        }
        let mut slopes = vec![0.0; unknowns.len()];
        self.with_columns(&unknowns, |columns| columns.write(&unknowns, known, &mut slopes))?;
        values.zip(slopes).for_each(|(value, slope)| value.write(slope));
        Ok(())
    }

    /// Returns, for each known, the sum over unknowns of `seed` times the derivative with respect to the known.
    /// Derivatives are computed column by column, except for knowns without effect in the scene.
    pub fn get_adjoint_derivative<'a>(
        &mut self,
        unknown: impl Iterator<Item = u32>,
        seed: impl Iterator<Item = f64> + Clone,
        known: impl Iterator<Item = u32>,
        values: impl Iterator<Item = Output<'a, f64>>,
    ) -> CallResult {
        check_built()?;
        let unknowns = unknowns(unknown)?;
        if let Some(bad) = seed.clone().find(|x| !x.is_finite()) {
            return Err(CallError::discard(format!("{bad} in the seed is not a finite number")));
        }
        let known: Vec<(u32, f64)> = known.map(|known| (known, f64::from(self.has_effect(known)))).collect();
        let (mut column, mut sums) = (vec![0.0; unknowns.len()], vec![0.0; known.len()]);
        self.with_columns(&unknowns, |columns| {
            known.into_iter().zip(&mut sums).try_for_each(|(known, sum)| {
                column.fill(0.0);
                columns.write(&unknowns, std::iter::once(known), &mut column)?;
                let product = column.iter().zip(seed.clone()).map(|(slope, seed)| slope * seed).sum();
                // the sum may overflow for a large finite seed
                *sum = finite_slope(row(known.0)?, product)?;
                Ok(())
            })
        })?;
        values.zip(sums).for_each(|(value, sum)| value.write(sum));
        Ok(())
    }

    /// Calls `act` with the source of derivatives, if there are unknowns.
    fn with_columns(&mut self, unknowns: &[Unknown], act: impl FnOnce(&Columns) -> CallResult) -> CallResult {
        if unknowns.is_empty() {
            return Ok(());
        }
        if self.now.phase == Phase::Initialization {
            return act(&Columns::Initial(&self.now, &self.cache));
        }
        act(&Columns::Running(&self.simulation()?.shown()))
    }
}

/// Refuses derivatives of variables in a build without them.
#[inline]
pub fn check_built() -> CallResult {
    if FULL {
        Ok(())
    } else {
        Err(CallError::error("this build for real-time targets has no derivatives of variables"))
    }
}

/// Source of derivatives.
enum Columns<'a> {
    /// Initial values, during initialisation.
    Initial(&'a Snapshot, &'a GearCache),
    /// A simulation under its present inputs.
    Running(&'a Simulation),
}

impl Columns<'_> {
    /// Writes the derivatives of `unknowns` along `known` to `slopes`, which must be zero before.
    fn write(
        &self,
        unknowns: &[Unknown],
        known: impl Iterator<Item = (u32, f64)> + Clone,
        slopes: &mut [f64],
    ) -> CallResult {
        let simulation = match self {
            Self::Initial(now, cache) => return initial_derivatives((now, cache), unknowns, known, slopes),
            Self::Running(simulation) => simulation,
        };
        let (mut states, mut inputs) = ([0.0; STATES], Inputs::ZERO);
        let mut changes = false;
        for (reference, change) in known {
            let row = row(reference)?;
            let state = table().state(reference);
            match (row.access, state) {
                (Access::Input(slot), _) => *slot(&mut inputs) += change,
                (_, Some(k)) => states[k] += change,
                _ => {
                    return Err(CallError::error(format!(
                        "{} is neither an input nor a continuous state, so there is no derivative with respect to it",
                        row.name
                    )));
                }
            }
            changes |= change != 0.0;
        }
        if changes {
            let braked = simulation.with_friction_applied(&inputs);
            let simulation = braked.as_ref().unwrap_or(simulation);
            let direction = simulation.direction(&states, &inputs);
            let mut along = OutputSlopes::new(simulation, &direction);
            for (&(row, source), slope) in unknowns.iter().zip(slopes) {
                *slope = finite_slope(row, along.of(source))?;
            }
        }
        Ok(())
    }
}

/// Derivatives along a direction. Each kind is computed on demand.
pub struct OutputSlopes<'a> {
    simulation: &'a Simulation,
    direction: &'a Direction,
    motion: Option<crate::model::Motion>,
    forces: Option<StencilReadings<Forces>>,
    pairs: Option<StencilReadings<PairLines>>,
    states: Option<[f64; STATES]>,
    rates: Option<[f64; STATES]>,
}

impl<'a> OutputSlopes<'a> {
    /// Prepares derivatives of `simulation` along `direction`.
    pub fn new(simulation: &'a Simulation, direction: &'a Direction) -> Self {
        Self { simulation, direction, motion: None, forces: None, pairs: None, states: None, rates: None }
    }

    /// Returns the derivative of an output. It is 0 for outputs that change only with time.
    pub fn of(&mut self, source: OutputSource) -> f64 {
        let Self { simulation, direction, .. } = *self;
        match source {
            OutputSource::Motion(i, of) => {
                of(self.motion.get_or_insert_with(|| simulation.motion_slopes(direction)), i)
            }
            OutputSource::Forces(i, of) | OutputSource::Components(i, of) => {
                let along = self.forces.get_or_insert_with(|| simulation.forces_along(direction));
                along.slope(|forces| of(forces, i))
            }
            OutputSource::Reading(index) => {
                let along = self.forces.get_or_insert_with(|| simulation.forces_along(direction));
                along.slope(|forces| forces.readings[index])
            }
            OutputSource::Pair(k, of) => {
                let along = self.pairs.get_or_insert_with(|| simulation.pair_lines_along(direction));
                along.slope(|lines| of(&lines[k]))
            }
            // the ledger changes only with time
            OutputSource::Constant(..) | OutputSource::Ledger(..) | OutputSource::Choice(..) => 0.0,
            OutputSource::State(k) => {
                self.states.get_or_insert_with(|| simulation.states_of(|i| direction.q[i], &direction.v))[k]
            }
            OutputSource::Rate(k) => self.rates.get_or_insert_with(|| {
                let [q, v] = simulation.rate_slopes(direction);
                simulation.states_of(|i| q[i], &v)
            })[k],
        }
    }
}
