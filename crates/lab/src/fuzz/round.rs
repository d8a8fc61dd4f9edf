//! A round: several instances of both kinds with random calls, each checked against the promises of the FMU.

use std::ptr;

use bevel_differential::instance::{Call, Kind, Phase, Status};
use cpu_time::ThreadTime;
use fastrand::Rng;

use super::arguments::{CallResult, Flaws};
use super::choice::{VERSIONS, draw};
use super::host::{InstanceOptions, Line};
use super::instance::FuzzedInstance;
use super::scenes;
use super::site::{HeldStates, Site};
use super::tally::Tally;
use super::version::{Function, Version};
use crate::random::Draws;

/// Kinds of the instances of a round.
const KINDS: [Kind; 4] = [Kind::ModelExchange, Kind::CoSimulation, Kind::ModelExchange, Kind::CoSimulation];
/// The state before and after is compared for one call out of this number.
const COMPARED: usize = 6;
/// One call out of this number is a function of the other version of FMI.
const OTHER: usize = 100;
/// Number of consecutive refusals after which an instance is restarted.
const PATIENCE: usize = 10;
/// Position of the phase in a serialised state: after the header, the version of FMI and the kind.
const PHASE: usize = 30;

/// A broken promise.
#[derive(Clone, Debug)]
pub struct BrokenPromise {
    /// Index of the call in its round.
    pub at: usize,
    /// Called function.
    pub function: &'static str,
    /// Description of the broken promise.
    pub what: String,
}

/// Calls `calls` functions of `version` at random with `seed`, and counts them in `tally`.
pub fn run(version: &'static Version, seed: u64, calls: usize, tally: &mut Tally) -> Result<(), BrokenPromise> {
    let mut r = Rng::with_seed(seed);
    let outside = |what: &str| BrokenPromise { at: 0, function: "start of the round", what: what.to_owned() };
    let (mut instances, mut expected) = (Vec::new(), Vec::new());
    // a host that handles events cannot restore a state of one that does not
    let events = r.bool();
    for (i, kind) in KINDS.into_iter().enumerate() {
        let options = InstanceOptions { events, ..InstanceOptions::drawn(&mut r, kind) };
        let make = || FuzzedInstance::new(&version.interface, options).ok_or_else(|| outside("no instance was made"));
        expected.push(scenes::study(&make()?).ok_or_else(|| outside("the study's scene does not run"))?);
        let instance = make()?;
        if i > 0 {
            tally.started_instances += u64::from(scenes::start(&instance, &mut r));
        }
        instance.take_log();
        instances.push(instance);
    }
    let mut held = HeldStates::default();
    let outcome = (0..calls).try_for_each(|at| {
        let chosen = r.below(instances.len());
        make_call((seed, at), &mut r, &mut instances[chosen], &mut held, tally)
    });
    for (mut state, _) in held.states.drain(..) {
        // SAFETY: a live component and a live state
        unsafe { (version.interface.free_state)(instances[0].component, &mut state) };
    }
    outcome?;
    // after a reset, every instance must behave like a new one, regardless of previous calls
    for (instance, expected) in instances.iter().zip(&expected) {
        tally.updates += instance.host.updates.get();
        if scenes::study(instance).as_ref() != Some(expected) {
            let what = "after a reset the study's scene gives other numbers than in a fresh instance".into();
            return Err(BrokenPromise { at: calls, function: "end of the round", what });
        }
    }
    Ok(())
}

/// Executes one call and checks all promises about it.
fn make_call(
    (seed, at): (u64, usize),
    r: &mut Rng,
    instance: &mut FuzzedInstance,
    held: &mut HeldStates,
    tally: &mut Tally,
) -> Result<(), BrokenPromise> {
    if instance.refused > PATIENCE {
        (instance.refused, instance.has_announced) = (0, false);
        tally.started_instances += u64::from(scenes::start(instance, r));
        instance.take_log();
    }
    let is_other = r.chance(OTHER);
    let version = VERSIONS.into_iter().find(|v| (v.interface.number != instance.interface.number) == is_other);
    let version = version.unwrap_or(VERSIONS[0]);
    let function = draw(r, version, instance.options.kind);
    let c = match r.below(150) {
        0 => ptr::null_mut(),
        1 => instance.component.wrapping_byte_add(1),
        _ => instance.component,
    };
    let before = if r.chance(COMPARED) { instance.bytes() } else { None };
    // processor time, which excludes other load of the machine
    let start = ThreadTime::now();
    let outcome =
        (function.call)(&mut Site { interface: &version.interface, c, r, flaws: Flaws::default(), instance, held });
    tally.count(function.name, outcome.status, start.elapsed(), (seed, at));
    let refused = !matches!(outcome.status, Status::Ok | Status::Warning);
    instance.refused = if refused { instance.refused + 1 } else { 0 };
    let broken = |what: String| BrokenPromise { at, function: function.name, what };
    let lines = instance.take_log();
    let internal = lines.iter().find(|line| line.message.contains("internal error"));
    if let Some(what) = internal.map(|line| line.message.clone()).or_else(|| instance.host.broken.take()) {
        return Err(broken(what));
    }
    check(function, c != instance.component, is_other, instance.is_filtered, &outcome, &lines).map_err(broken)?;
    if let Some(before) = before {
        tally.compared += 1;
        compare(function, refused, &before, instance).map_err(|what| broken(format!("{what}; it said: {lines:?}")))?;
    }
    if let Some(restored) = outcome.restored
        && !instance.has_announced
        && instance.bytes().is_some_and(|bytes| bytes != restored)
    {
        return Err(broken("the instance is not in the state that was set".into()));
    }
    // FMI 2.0 provides the time only between steps
    match instance.time() {
        None if instance.interface.number > 2 => return Err(broken("the time cannot be read afterwards".into())),
        Some(now) if !now.is_finite() => return Err(broken(format!("the time is {now} afterwards"))),
        _ => {}
    }
    if instance.is_filtered && r.chance(10) {
        // SAFETY: a live component; no categories means all
        unsafe { (instance.interface.log_all)(instance.component) };
        instance.is_filtered = false;
    }
    Ok(())
}

/// Checks the status and log of a call.
fn check(
    function: &Function,
    is_foreign: bool,
    is_other: bool,
    is_filtered: bool,
    outcome: &CallResult,
    lines: &[Line],
) -> Result<(), String> {
    let status = outcome.status;
    if let Some(what) = &outcome.broken {
        return Err(what.clone());
    }
    if matches!(status, Status::Fatal | Status::Pending) {
        return Err(format!("answered {status:?}"));
    }
    let row = function.row();
    if row.is_some() && (is_foreign || is_other) && status != Status::Error {
        let instance = if is_foreign { "no instance" } else { "an instance of another version of FMI" };
        return Err(format!("{status:?} for {instance}"));
    }
    if row.is_some() && is_foreign {
        return Ok(());
    }
    if outcome.must_fail && status != Status::Error {
        return Err(format!("{status:?} for arguments that must be refused"));
    }
    if status == Status::Ok {
        let bad = outcome.numbers.iter().position(|x| !x.is_finite());
        return bad.map_or(Ok(()), |i| Err(format!("OK, but number {i} is {}", outcome.numbers[i])));
    }
    let prefix = row.map_or(function.name, Call::name);
    let is_reported = lines.iter().any(|line| line.status == status && line.message.starts_with(prefix));
    if is_reported || is_filtered { Ok(()) } else { Err(format!("{status:?} without a message: {lines:?}")) }
}

/// Checks that a call that was refused or only reads has not changed the state `before`.
fn compare(function: &Function, refused: bool, before: &[u8], instance: &mut FuzzedInstance) -> Result<(), String> {
    let must_not_change = function.only_reads() || refused && !function.may_change_on_failure();
    if !must_not_change {
        return Ok(());
    }
    // in initialisation mode, the first read builds the simulation
    let starts = before.get(PHASE) == Some(&(Phase::Initialization as u8));
    match instance.bytes() {
        None => Err("the instance failed".into()),
        Some(after) if after != before && !starts => {
            Err("the call was refused or only reads, but changed the state".into())
        }
        _ => Ok(()),
    }
}
