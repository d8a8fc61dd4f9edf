//! A round: a few instances of both kinds, and calls at random on them, each checked against what the FMU promises.

use std::ptr;

use bevel_differential::fmi2::*;
use cpu_time::ThreadTime;

use super::arguments::CallResult;
use super::calls::call;
use super::functions::Function;
use super::instance::FuzzedInstance;
use super::random::Random;
use super::scenes;
use super::states::HeldStates;
use super::tally::Tally;

/// Calls of a round.
pub const CALLS: usize = 500;
/// Instances of a round.
const INSTANCES: usize = 4;
/// For one call in this many the states before and after it are compared.
const COMPARED: usize = 6;
/// Refusals in a row after which an instance is started again.
const PATIENCE: usize = 10;

/// A promise that was not kept.
#[derive(Clone, Debug)]
pub struct BrokenPromise {
    /// Number of the call in its round.
    pub at: usize,
    /// What was called.
    pub function: &'static str,
    /// What it should not have done.
    pub what: String,
}

/// Calls `calls` functions at random by `seed`, and counts them in `tally`.
pub fn run(seed: u64, calls: usize, tally: &mut Tally) -> Result<(), BrokenPromise> {
    let mut r = Random::new(seed);
    let outside = |what: &str| BrokenPromise { at: 0, function: "start of the round", what: what.to_owned() };
    let mut expected = Vec::new();
    for kind in [MODEL_EXCHANGE, CO_SIMULATION] {
        let plain = FuzzedInstance::new(kind).ok_or_else(|| outside("no instance was made"))?;
        expected.push(scenes::study(&plain).ok_or_else(|| outside("the study's scene does not run"))?);
    }
    let mut instances = Vec::new();
    for i in 0..INSTANCES {
        let instance = FuzzedInstance::new(i as i32 % 2).ok_or_else(|| outside("no instance was made"))?;
        if i > 0 {
            tally.started_instances += u64::from(scenes::start(&instance, &mut r));
        }
        instance.take_log();
        instances.push(instance);
    }
    let mut held = HeldStates::default();
    let outcome = (0..calls).try_for_each(|at| {
        let chosen = r.below(INSTANCES);
        make_call((seed, at), &mut r, &mut instances[chosen], &mut held, tally)
    });
    for (mut state, _) in held.states.drain(..) {
        // SAFETY: a live component and a live state
        unsafe { fmi2FreeFMUstate(instances[0].component, &mut state) };
    }
    outcome?;
    // after a reset every instance behaves as new, whatever was called before
    for instance in &instances {
        if scenes::study(instance).as_ref() != Some(&expected[instance.kind as usize]) {
            return Err(BrokenPromise {
                at: calls,
                function: "fmi2Reset",
                what: "the study's scene gives other numbers than in a fresh instance".into(),
            });
        }
    }
    Ok(())
}

/// Makes one call and checks all that is promised about it.
fn make_call(
    (seed, at): (u64, usize),
    r: &mut Random,
    instance: &mut FuzzedInstance,
    held: &mut HeldStates,
    tally: &mut Tally,
) -> Result<(), BrokenPromise> {
    if instance.refused > PATIENCE {
        (instance.refused, instance.has_announced) = (0, false);
        tally.started_instances += u64::from(scenes::start(instance, r));
        instance.take_log();
    }
    let function = draw(r, instance.kind);
    let component = match r.below(150) {
        0 => ptr::null_mut(),
        1 => instance.component.wrapping_byte_add(1),
        _ => instance.component,
    };
    let before = if r.chance(COMPARED) { instance.bytes() } else { None };
    // processor time, so that other load of the machine does not count
    let start = ThreadTime::now();
    let outcome = call(function, component, r, instance, held);
    tally.count(function, outcome.status, start.elapsed(), (seed, at));
    let refused = !matches!(outcome.status, Status::Ok | Status::Warning);
    instance.refused = if refused { instance.refused + 1 } else { 0 };
    let broken = |what: String| BrokenPromise { at, function: function.name(), what };
    let lines = instance.take_log();
    if let Some(line) = lines.iter().find(|line| line.message.contains("internal error")) {
        return Err(broken(line.message.clone()));
    }
    check(function, component != instance.component, instance.is_filtered, &outcome, &lines).map_err(broken)?;
    if let Some(before) = before {
        tally.compared += 1;
        compare(function, refused, &before, instance).map_err(|what| BrokenPromise {
            at,
            function: function.name(),
            what: format!("{what}; it said: {lines:?}"),
        })?;
    }
    if let Some(restored) = outcome.restored
        && !instance.has_announced
        && instance.bytes().is_some_and(|bytes| bytes != restored)
    {
        return Err(broken("the instance is not in the state that was set".into()));
    }
    if instance.is_filtered && r.chance(10) {
        // SAFETY: a live component; no categories means all
        unsafe { fmi2SetDebugLogging(instance.component, 0, 0, ptr::null()) };
        instance.is_filtered = false;
    }
    Ok(())
}

/// Checks what every call must return.
fn check(
    function: Function,
    is_foreign: bool,
    is_filtered: bool,
    outcome: &CallResult,
    lines: &[super::instance::Line],
) -> Result<(), String> {
    let status = outcome.status;
    if let Some(what) = &outcome.broken {
        return Err(what.clone());
    }
    if matches!(status, Status::Fatal | Status::Pending) {
        return Err(format!("answered {status:?}"));
    }
    let has_component = !matches!(
        function,
        Function::fmi2GetTypesPlatform
            | Function::fmi2GetVersion
            | Function::fmi2Instantiate
            | Function::fmi2FreeInstance
    );
    if has_component && is_foreign {
        return if status == Status::Error { Ok(()) } else { Err(format!("{status:?} without a component")) };
    }
    if outcome.must_fail && status != Status::Error {
        return Err(format!("{status:?} for arguments that must be refused"));
    }
    if status == Status::Ok {
        let bad = outcome.numbers.iter().position(|x| !x.is_finite());
        return bad.map_or(Ok(()), |i| Err(format!("fmi2OK, but number {i} is {}", outcome.numbers[i])));
    }
    let is_reported = lines.iter().any(|line| line.status == status && line.message.starts_with(function.name()));
    if is_reported || is_filtered { Ok(()) } else { Err(format!("{status:?} without a message: {lines:?}")) }
}

/// Calls that may change the instance although they fail: a start or a step may fail halfway.
fn may_change_on_failure(function: Function) -> bool {
    use Function as F;
    matches!(
        function,
        F::fmi2DoStep | F::fmi2ExitInitializationMode | F::fmi2CompletedIntegratorStep | F::fmi2NewDiscreteStates
    )
}

/// Calls that only read.
fn only_reads(function: Function) -> bool {
    let name = function.name();
    name.starts_with("fmi2Get") || name.contains("erialize") || name == "fmi2FreeFMUstate"
}

fn compare(function: Function, refused: bool, before: &[u8], instance: &mut FuzzedInstance) -> Result<(), String> {
    let must_not_change = only_reads(function) || refused && !may_change_on_failure(function);
    if !must_not_change {
        return Ok(());
    }
    // in initialisation mode the first read builds the simulation
    let starts = before.get(PHASE) == Some(&(Phase::Initialization as u8));
    match instance.bytes() {
        None => Err("the instance failed".into()),
        Some(after) if after != before && !starts => {
            Err("the call was refused or only reads, but changed the state".into())
        }
        _ => Ok(()),
    }
}

/// Where a serialised state holds the phase: after the header, the version of FMI and the kind.
const PHASE: usize = 30;

/// Draws a function by its weight; functions of the other kind of instance seldom.
fn draw(r: &mut Random, kind: i32) -> Function {
    use Function as F;
    loop {
        let total: usize = F::ALL.iter().map(|f| f.weight()).sum();
        let mut left = r.below(total);
        let chosen = F::ALL.iter().copied().find(|f| {
            let found = left < f.weight();
            left = left.saturating_sub(f.weight());
            found
        });
        let Some(chosen) = chosen else { continue };
        let of_steps = matches!(
            chosen,
            F::fmi2DoStep | F::fmi2SetRealInputDerivatives | F::fmi2GetRealOutputDerivatives | F::fmi2CancelStep
        );
        let of_exchange = matches!(
            chosen,
            F::fmi2EnterEventMode
                | F::fmi2NewDiscreteStates
                | F::fmi2EnterContinuousTimeMode
                | F::fmi2CompletedIntegratorStep
                | F::fmi2SetTime
                | F::fmi2SetContinuousStates
                | F::fmi2GetDerivatives
                | F::fmi2GetEventIndicators
                | F::fmi2GetContinuousStates
        );
        let foreign = if kind == MODEL_EXCHANGE { of_steps } else { of_exchange };
        if !foreign || r.chance(10) {
            return chosen;
        }
    }
}
