//! Derivatives of initial values with respect to inputs and parameters, by finite differences within the ranges.

use super::unknowns::{Unknown, finite_slope};
use super::values::row;
use super::{CallError, CallResult, Snapshot};
use crate::model::GearCache;
use crate::variables::{Access, Range};

/// A point of a finite difference: its position in steps, and its weights in the differences of order 2 and of order 4.
type Difference = (f64, [f64; 2]);

/// Central differences.
const CENTRAL: [Difference; 4] =
    [(-2.0, [0.0, 1.0 / 12.0]), (-1.0, [-0.5, -2.0 / 3.0]), (1.0, [0.5, 2.0 / 3.0]), (2.0, [0.0, -1.0 / 12.0])];
/// One-sided differences, forward.
const FORWARD: [Difference; 5] =
    [(0.0, [-1.5, -25.0 / 12.0]), (1.0, [2.0, 4.0]), (2.0, [-0.5, -3.0]), (3.0, [0.0, 4.0 / 3.0]), (4.0, [0.0, -0.25])];
/// One-sided differences, backward.
const BACKWARD: [Difference; 5] = [
    (0.0, [1.5, 25.0 / 12.0]),
    (-1.0, [-2.0, -4.0]),
    (-2.0, [0.5, 3.0]),
    (-3.0, [0.0, -4.0 / 3.0]),
    (-4.0, [0.0, 0.25]),
];
/// Maximum step of the differences, relative to the changed value. The step is long because the initial equilibrium has
/// a noise of about [`START_NOISE`].
const RELATIVE_STEP: f64 = 3e-3;
/// Relative noise of initial values.
const START_NOISE: f64 = 1e-9;
/// Smallest magnitude assumed for a value other than 0, as a fraction of its range or of 1 SI unit, whichever is
/// smaller.
const LEAST_SIZE: f64 = 1e-3;
/// Minimum step of central differences, as a fraction of the wanted step. If the ranges leave less room, differences are
/// one-sided.
const LEAST_CENTRAL_STEP: f64 = 0.1;
/// Factors of the step, tried in turn until the differences of both orders agree. A long step may pass a kink.
const REDUCTIONS: [f64; 4] = [1.0, 0.125, 0.015625, 0.001953125];
/// Maximum disagreement of a shorter step, as a fraction of the best one so far, at which the shorter step replaces it.
const BETTER: f64 = 0.5;
/// Relative difference between both orders below which they agree.
const AGREEMENT: f64 = 1e-4;

/// Computes derivatives of initial values with respect to inputs and parameters. Finite differences are needed, because
/// initialisation solves for an equilibrium.
pub fn initial_derivatives(
    (now, cache): (&Snapshot, &GearCache),
    unknowns: &[Unknown],
    known: impl Iterator<Item = (u32, f64)> + Clone,
    slopes: &mut [f64],
) -> CallResult {
    let Some(room) = Room::of(now, known.clone())? else { return Ok(()) };
    let estimate = |reduction| differences((now, cache), unknowns, known.clone(), room.sides(reduction));
    let mut best = estimate(REDUCTIONS[0]);
    for reduction in &REDUCTIONS[1..] {
        if best.as_ref().is_ok_and(|best| best.disagreement < 1.0) {
            break;
        }
        let shorter = estimate(*reduction);
        let is_better = match (&shorter, &best) {
            // if a shorter step agrees no better, the longer one has less noise
            (Ok(shorter), Ok(best)) => shorter.disagreement < BETTER * best.disagreement,
            (shorter, _) => shorter.is_ok(),
        };
        if is_better {
            best = shorter;
        }
    }
    for ((slope, found), (row, _)) in slopes.iter_mut().zip(best?.slopes).zip(unknowns) {
        *slope = finite_slope(row, found)?;
    }
    Ok(())
}

/// Distances over which the known values may change.
struct Room {
    /// Step as a multiple of the requested changes. The value with the largest relative change then changes by
    /// [`RELATIVE_STEP`] of its magnitude.
    step: f64,
    /// Distances to the nearest end of a range, backward and forward, as multiples of the requested changes.
    ends: [f64; 2],
}

impl Room {
    /// Returns the room in which the values `known` may change in their directions, or `None` if no value changes.
    fn of(now: &Snapshot, known: impl Iterator<Item = (u32, f64)>) -> CallResult<Option<Self>> {
        let (mut size, mut ends) = (0.0f64, [f64::INFINITY; 2]);
        for (reference, change) in known {
            let row = row(reference)?;
            let value = match row.access {
                Access::Input(slot) => *slot(&mut { now.inputs }),
                Access::Real(slot) => *slot(&mut { now.parameters }),
                _ => {
                    return Err(CallError::error(format!(
                        "{} is neither an input nor a real parameter, so there is no derivative with respect to it",
                        row.name
                    )));
                }
            };
            let range = row.range.unwrap_or(Range { min: f64::NEG_INFINITY, max: f64::INFINITY });
            let unit = (range.max - range.min).min(1.0);
            size = size.max(change.abs() / if value == 0.0 { unit } else { value.abs().max(LEAST_SIZE * unit) });
            if change != 0.0 {
                let [min, max] = [value - range.min, range.max - value].map(|room| room.max(0.0) / change.abs());
                let [backward, forward] = if change > 0.0 { [min, max] } else { [max, min] };
                ends = [ends[0].min(backward), ends[1].min(forward)];
            }
        }
        Ok((size > 0.0).then(|| Self { step: RELATIVE_STEP / size, ends }))
    }

    /// Returns differences whose step is multiplied by `reduction`: central ones within the range, one-sided ones at an
    /// end.
    fn sides(&self, reduction: f64) -> (&'static [Difference], f64) {
        let (step, [backward, forward]) = (self.step * reduction, self.ends);
        let central = backward.min(forward) / 2.0;
        if central >= LEAST_CENTRAL_STEP * step {
            (&CENTRAL, step.min(central))
        } else if forward >= backward {
            (&FORWARD, step.min(forward / 4.0))
        } else {
            (&BACKWARD, step.min(backward / 4.0))
        }
    }
}

/// Derivatives of initial values from finite differences of one step.
struct Estimate {
    /// Differences of order 4.
    slopes: Vec<f64>,
    /// Largest deviation between order 2 and order 4, relative to the tolerated deviation. Below 1, both orders agree.
    disagreement: f64,
}

fn differences(
    (now, cache): (&Snapshot, &GearCache),
    unknowns: &[Unknown],
    known: impl Iterator<Item = (u32, f64)> + Clone,
    (points, step): (&[Difference], f64),
) -> CallResult<Estimate> {
    let count = unknowns.len();
    let (mut second, mut fourth, mut largest) = (vec![0.0; count], vec![0.0; count], vec![0.0f64; count]);
    let mut first = vec![None; count];
    for &(position, [of_second, of_fourth]) in points {
        let (mut parameters, mut inputs) = (now.parameters, now.inputs);
        for (reference, change) in known.clone() {
            let row = row(reference)?;
            let value = match row.access {
                Access::Input(slot) => slot(&mut inputs),
                Access::Real(slot) => slot(&mut parameters),
                _ => continue,
            };
            let wanted = *value + position * step * change;
            // rounding must not leave the range
            *value = row.range.map_or(wanted, |range| wanted.clamp(range.min, range.max));
        }
        let mut simulation = now.start_from(&parameters, &inputs, cache).map_err(|problems| {
            CallError::error(format!(
                "there is no derivative, because initialisation fails close to these values:\n{}",
                crate::problem::list(&problems)
            ))
        })?;
        for (k, (_, source)) in unknowns.iter().enumerate() {
            let value = source.read(&mut simulation);
            // the slope of a constant is exactly 0
            let change = value - *first[k].get_or_insert(value);
            second[k] += of_second * change / step;
            fourth[k] += of_fourth * change / step;
            largest[k] = largest[k].max(value.abs());
        }
    }
    let disagreement = |k: usize| {
        let accepted = AGREEMENT * fourth[k].abs() + START_NOISE * largest[k] / step;
        (second[k] - fourth[k]).abs() / accepted.max(f64::MIN_POSITIVE)
    };
    Ok(Estimate { disagreement: (0..count).map(disagreement).fold(0.0, f64::max), slopes: fourth })
}
