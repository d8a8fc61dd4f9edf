//! Values by FMI 3.0 types: rows of the table, arrays of rows, and the additional variables of FMI 3.0.

use super::variables::{HAPPENINGS, Item, held, item, planet_count};
use crate::instance::values::{row, wrong_type};
use crate::instance::{CallError, CallResult, InputArray, Instance, Output, OutputArray, Phase, Text};
use crate::variables::{Access, table};

/// Returns the variable of a value reference.
fn known(reference: u32) -> CallResult<Item> {
    item(reference).ok_or_else(|| CallError::error(format!("there is no variable with value reference {reference}")))
}

/// Fails if the number of values differs from that of the variables.
fn check_count(needed: usize, given: usize) -> CallResult {
    if needed == given {
        return Ok(());
    }
    Err(CallError::error(format!("the variables have {needed} values, but the host has room for {given}")))
}

fn other_type(reference: u32, wanted: &str) -> CallError {
    let name = name(reference);
    CallError::error(format!("{name} is not of type {wanted}"))
}

/// Name of a variable; empty for an unknown value reference.
fn name(reference: u32) -> &'static str {
    let rows = table().rows;
    let index = reference as usize;
    match rows.get(index) {
        Some(row) => row.name,
        None => super::variables::added().get(index - rows.len()).map_or("", |added| added.name),
    }
}

/// fmi3GetFloat64.
pub fn get_float64(instance: &mut Instance, references: InputArray<u32>, values: OutputArray<f64>) -> CallResult {
    let rows = table().rows.len() as u32;
    let is_plain = |reference: u32| reference < rows && held(reference as usize).is_none();
    if references.iter().all(is_plain) {
        check_count(references.len(), values.len())?;
        return instance.get_real(references.iter(), values.iter());
    }
    let items =
        references.iter().map(|reference| Ok((reference, known(reference)?))).collect::<CallResult<Vec<_>>>()?;
    check_count(items.iter().map(|(_, item)| item.len(&instance.now.parameters)).sum(), values.len())?;
    let mut slots = values.iter();
    // all rows in a single call, because they share intermediate results
    let (mut wanted, mut room): (Vec<u32>, Vec<Output<f64>>) = (Vec::new(), Vec::new());
    for (reference, item) in &items {
        let mut one = || slots.next().ok_or_else(|| CallError::error("there is no room for a value"));
        if let Item::Row(index) = item
            && let Some(mask) = held(*index)
        {
            one()?.write(instance.discrete()?.held[mask]);
            continue;
        }
        match item {
            Item::Row(_) | Item::Planets(_) | Item::Pairs(_) => {
                for &index in item.rows(&instance.now.parameters) {
                    wanted.push(index as u32);
                    room.push(one()?);
                }
            }
            Item::Time => one()?.write(time(instance)),
            Item::EventTime => one()?.write(instance.discrete()?.event.time),
            Item::Indicator(k) => one()?.write(instance.simulation()?.indicators()[*k]),
            _ => return Err(other_type(*reference, "Float64")),
        }
    }
    instance.get_real(wanted.into_iter(), room.into_iter())
}

fn time(instance: &Instance) -> f64 {
    instance.now.simulation.as_ref().map_or(instance.now.start_time, |simulation| simulation.time())
}

/// fmi3SetFloat64.
pub fn set_float64(instance: &mut Instance, references: InputArray<u32>, values: InputArray<f64>) -> CallResult {
    for reference in references.iter() {
        settable(reference, "Float64")?;
    }
    check_count(references.len(), values.len())?;
    if instance.now.phase == Phase::IntermediateUpdate {
        for reference in references.iter() {
            if !matches!(row(reference)?.access, Access::Input(_)) {
                let name = name(reference);
                return Err(CallError::error(format!(
                    "{name} is not an input, but only inputs may be set within a step"
                )));
            }
        }
    }
    instance.set_real(references, values)
}

fn settable(reference: u32, wanted: &str) -> CallResult {
    match known(reference)? {
        Item::Row(_) => Ok(()),
        _ => Err(CallError::error(format!("{} is calculated and cannot be set as {wanted}", name(reference)))),
    }
}

/// Fails unless there are as many values as variables, and each of these can be set and is of the type `wanted`.
fn check_all(
    references: InputArray<u32>,
    values: usize,
    wanted: &str,
    is_wanted: impl Fn(u32) -> CallResult<bool>,
) -> CallResult {
    check_count(references.len(), values)?;
    for reference in references.iter() {
        settable(reference, wanted)?;
        if !is_wanted(reference)? {
            return Err(wrong_type(row(reference)?));
        }
    }
    Ok(())
}

/// fmi3GetInt32.
pub fn get_int32(instance: &mut Instance, references: InputArray<u32>, values: OutputArray<i32>) -> CallResult {
    check_count(references.len(), values.len())?;
    values.write_each(references, |reference| match known(reference)? {
        Item::EventBody => Ok(instance.discrete()?.event.number()),
        Item::EventCount => Ok(i32::try_from(instance.discrete()?.event.count).unwrap_or(i32::MAX)),
        Item::Row(_) if is_int32(reference)? => instance.get_integer(reference),
        _ => Err(other_type(reference, "Int32")),
    })
}

/// True if a row is an Int32, that is, an integer that no array size depends on.
fn is_int32(reference: u32) -> CallResult<bool> {
    Ok(matches!(row(reference)?.access, Access::Integer(_)) && reference != planet_count())
}

/// fmi3SetInt32.
pub fn set_int32(instance: &mut Instance, references: InputArray<u32>, values: InputArray<i32>) -> CallResult {
    check_all(references, values.len(), "Int32", is_int32)?;
    instance.set_integer(references.iter().zip(values.iter()))
}

/// fmi3GetInt64, for enumerations.
pub fn get_int64(instance: &mut Instance, references: InputArray<u32>, values: OutputArray<i64>) -> CallResult {
    check_count(references.len(), values.len())?;
    values.write_each(references, |reference| match known(reference)? {
        Item::EventKind => Ok(i64::from(instance.discrete()?.event.what as u8)),
        Item::Row(_) if is_enumeration(reference)? => instance.get_integer(reference).map(i64::from),
        _ => Err(other_type(reference, "enumeration")),
    })
}

fn is_enumeration(reference: u32) -> CallResult<bool> {
    Ok(row(reference)?.access.enumeration().is_some())
}

/// fmi3SetInt64, for enumerations.
pub fn set_int64(instance: &mut Instance, references: InputArray<u32>, values: InputArray<i64>) -> CallResult {
    check_all(references, values.len(), "enumeration", is_enumeration)?;
    // a number outside the range of an Int32 is not a choice of any enumeration
    let choices = values.iter().map(|value| i32::try_from(value).unwrap_or(i32::MIN));
    instance.set_integer(references.iter().zip(choices))
}

/// fmi3GetUInt64, for the number of planets.
pub fn get_uint64(instance: &mut Instance, references: InputArray<u32>, values: OutputArray<u64>) -> CallResult {
    check_count(references.len(), values.len())?;
    values.write_each(references, |reference| {
        check_structural(reference)?;
        Ok(u64::try_from(instance.get_integer(reference)?).unwrap_or(0))
    })
}

/// fmi3SetUInt64, for the number of planets. Sizes of arrays depend on it, so it can be set only in configuration mode.
pub fn set_uint64(instance: &mut Instance, references: InputArray<u32>, values: InputArray<u64>) -> CallResult {
    check_count(references.len(), values.len())?;
    for reference in references.iter() {
        check_structural(reference)?;
        if instance.now.phase != Phase::Configuration {
            let name = name(reference);
            return Err(CallError::error(format!(
                "{name} is a structural parameter: set it between fmi3EnterConfigurationMode and fmi3ExitConfigurationMode"
            )));
        }
    }
    let numbers = values.iter().map(|value| i32::try_from(value).unwrap_or(i32::MAX));
    instance.set_integer(references.iter().zip(numbers))
}

fn check_structural(reference: u32) -> CallResult {
    known(reference)?;
    if reference == planet_count() { Ok(()) } else { Err(other_type(reference, "UInt64")) }
}

/// fmi3GetBoolean.
pub fn get_boolean(instance: &mut Instance, references: InputArray<u32>, values: OutputArray<u8>) -> CallResult {
    check_count(references.len(), values.len())?;
    values.write_each(references, |reference| match known(reference)? {
        Item::Row(_) => instance.get_boolean(reference).map(u8::from),
        _ => Err(other_type(reference, "Boolean")),
    })
}

/// fmi3SetBoolean.
pub fn set_boolean(instance: &mut Instance, references: InputArray<u32>, values: InputArray<u8>) -> CallResult {
    // `set_boolean` refuses other types
    check_all(references, values.len(), "Boolean", |_| Ok(true))?;
    instance.set_boolean(references.iter().zip(values.iter().map(|value| value != 0)))
}

/// fmi3GetString, for the text of the last event.
pub fn get_string(instance: &mut Instance, references: InputArray<u32>, values: OutputArray<Text>) -> CallResult {
    check_count(references.len(), values.len())?;
    values.write_each(references, |reference| match known(reference)? {
        Item::EventText => Ok(HAPPENINGS[instance.discrete()?.event.what as usize].1.as_ptr()),
        _ => Err(other_type(reference, "String")),
    })
}

/// Refuses every reference, because there are no variables of the type `wanted`.
pub fn none_of(references: InputArray<u32>, wanted: &str) -> CallResult {
    references.iter().next().map_or(Ok(()), |reference| {
        known(reference)?;
        Err(other_type(reference, wanted))
    })
}

/// Returns the rows of the table behind all variables, in their order.
fn rows_of(instance: &Instance, references: InputArray<u32>) -> CallResult<Vec<u32>> {
    let mut rows = Vec::with_capacity(references.len());
    for reference in references.iter() {
        let item = known(reference)?;
        rows.extend(rows_with_derivatives(instance, reference, &item)?.iter().map(|&index| index as u32));
    }
    Ok(rows)
}

/// Returns the rows of the table behind a variable. Fails if it has no derivatives.
fn rows_with_derivatives<'a>(instance: &Instance, reference: u32, item: &'a Item) -> CallResult<&'a [usize]> {
    match item.rows(&instance.now.parameters) {
        [] => Err(CallError::error(format!("{} has no derivatives", name(reference)))),
        shown => Ok(shown),
    }
}

/// Returns the rows of unknowns and knowns. Fails unless their numbers match `values`, the numbers `[of unknowns, of
/// knowns]`.
fn rows_of_both(
    instance: &Instance,
    [unknowns, knowns]: [InputArray<u32>; 2],
    values: [usize; 2],
) -> CallResult<[Vec<u32>; 2]> {
    let rows = [rows_of(instance, unknowns)?, rows_of(instance, knowns)?];
    check_count(rows[1].len(), values[1])?;
    check_count(rows[0].len(), values[0])?;
    Ok(rows)
}

/// fmi3GetOutputDerivatives. Arrays are handled element by element. The time of the last event is piecewise constant,
/// so its derivative is 0.
pub fn output_derivatives(
    instance: &mut Instance,
    references: InputArray<u32>,
    orders: InputArray<i32>,
    values: OutputArray<f64>,
) -> CallResult {
    let (mut wanted, mut room) = (Vec::with_capacity(values.len()), Vec::with_capacity(values.len()));
    let mut slots = values.iter();
    let mut needed = 0;
    for (reference, order) in references.iter().zip(orders.iter()) {
        let item = known(reference)?;
        if matches!(item, Item::EventTime) {
            needed += 1;
            slots.next().into_iter().for_each(|value| value.write(0.0));
            continue;
        }
        let rows = rows_with_derivatives(instance, reference, &item)?;
        needed += rows.len();
        wanted.extend(rows.iter().map(|&index| (index as u32, order)));
        room.extend(slots.by_ref().take(rows.len()));
    }
    check_count(needed, values.len())?;
    instance.get_output_derivatives(wanted.into_iter(), room.into_iter())
}

/// fmi3GetDirectionalDerivative: changes of unknowns for the changes `seed` of knowns.
pub fn directional_derivative(
    instance: &mut Instance,
    references: [InputArray<u32>; 2],
    seed: InputArray<f64>,
    sensitivity: OutputArray<f64>,
) -> CallResult {
    let [unknown, known] = rows_of_both(instance, references, [sensitivity.len(), seed.len()])?;
    let directed = known.iter().copied().zip(seed.iter());
    instance.get_directional_derivative(unknown.into_iter(), directed, sensitivity.iter())
}

/// fmi3GetAdjointDerivative: for each known, the sum over unknowns of `seed` times the derivative with respect to the
/// known.
pub fn adjoint_derivative(
    instance: &mut Instance,
    references: [InputArray<u32>; 2],
    seed: InputArray<f64>,
    sensitivity: OutputArray<f64>,
) -> CallResult {
    let [unknown, known] = rows_of_both(instance, references, [seed.len(), sensitivity.len()])?;
    instance.get_adjoint_derivative(unknown.into_iter(), seed.iter(), known.into_iter(), sensitivity.iter())
}
