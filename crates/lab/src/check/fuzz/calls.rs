//! One call of one function with arguments at random.

use std::ffi::CString;
use std::ptr;

use bevel_differential::fmi2::*;
use bevel_differential::model::STATES;
use bevel_differential::variables::{guid, table};

use super::arguments::{CallResult, Flaws, VariableKind, references, row};
use super::functions::Function;
use super::instance::FuzzedInstance;
use super::random::Random;
use super::states::{HELD, HeldStates, a_state, deserialize, get_state};

/// Room for arrays of states and event indicators, and the largest count announced for it.
const ROOM: usize = 64;

/// Sizes of communication steps that must be refused [s].
const NO_STEPS: [f64; 4] = [0.0, -1.0, f64::NAN, f64::INFINITY];

/// Calls `function` on `instance` through `c`, which is its component or a pointer that must be refused.
#[allow(clippy::too_many_lines)] // one arm per function
pub fn call(
    function: Function,
    c: ComponentPointer,
    r: &mut Random,
    instance: &mut FuzzedInstance,
    held: &mut HeldStates,
) -> CallResult {
    use Function as F;
    let f = &mut Flaws::default();
    let wanted = match function {
        F::fmi2GetReal => VariableKind::Real,
        F::fmi2SetReal if instance.kind == MODEL_EXCHANGE && r.chance(2) => VariableKind::State,
        F::fmi2SetReal => VariableKind::Settable,
        F::fmi2GetInteger | F::fmi2SetInteger => VariableKind::Integer,
        F::fmi2GetBoolean | F::fmi2SetBoolean => VariableKind::Boolean,
        F::fmi2SetRealInputDerivatives => VariableKind::Input,
        _ => VariableKind::Output,
    };
    let vr = references(r, wanted);
    let n = vr.len();
    let (mut numbers, mut integers) = (vec![f64::NAN; n.max(ROOM)], vec![i32::MIN; n.max(1)]);
    let orders: Vec<i32> = vr.iter().map(|_| if r.chance(10) { r.bits() as i32 } else { 1 }).collect();
    let mut values: Vec<f64> =
        vr.iter().map(|&v| row(v).map_or(0.0, |row| r.value_for(row)) * if r.chance(2) { 1.0 } else { 0.9 }).collect();
    if wanted == VariableKind::State {
        let x = next_states(instance, r);
        let states = vr.iter().map(|&v| table().state(v));
        values.iter_mut().zip(states).for_each(|(value, k)| *value = k.map_or(*value, |k| x[k]));
    }
    let whole: Vec<i32> = vr.iter().map(|&v| row(v).map_or(0, |row| r.integer_for(row))).collect();
    let needed = n > 0;
    let count = match function {
        F::fmi2GetReal | F::fmi2SetReal | F::fmi2GetInteger | F::fmi2SetInteger | F::fmi2GetBoolean => f.count(r, n),
        F::fmi2SetBoolean | F::fmi2SetRealInputDerivatives | F::fmi2GetRealOutputDerivatives => f.count(r, n),
        _ => n,
    };
    // SAFETY, for all calls below: the component is alive or one that the library checks for, and so are the pointers;
    // lengths are those of the arrays, or more than the library may ever take for true
    macro_rules! run {
        ($($call:tt)+) => { unsafe { $($call)+ } };
    }
    macro_rules! read {
        ($pointer:expr) => {
            f.pointer(r, $pointer, needed)
        };
    }
    match function {
        F::fmi2GetTypesPlatform | F::fmi2GetVersion => {
            let text = if function == F::fmi2GetVersion { fmi2GetVersion() } else { fmi2GetTypesPlatform() };
            let mut outcome = CallResult::of(Status::Ok, f);
            outcome.broken = text.is_null().then(|| "NULL".into());
            outcome
        }
        F::fmi2Instantiate => instantiate(r),
        // the round frees and makes instances; here only what must do nothing
        F::fmi2FreeInstance => {
            run!(fmi2FreeInstance(ptr::null_mut()));
            run!(fmi2FreeInstance(instance.component.wrapping_byte_add(1)));
            CallResult::of(Status::Ok, f)
        }
        F::fmi2SetDebugLogging => {
            let names = [c"logStatusError", c"logStatusDiscard", c"logEvents", c"logNonsense", c""].map(|t| t.as_ptr());
            let count = if r.chance(3) { 0 } else { r.below(names.len() + 1) };
            let pointer = f.pointer(r, names.as_ptr(), count > 0);
            let status = run!(fmi2SetDebugLogging(c, r.below(2) as i32, count, pointer));
            instance.is_filtered |= c == instance.component && status != Status::Error;
            CallResult::of(status, f)
        }
        F::fmi2SetupExperiment => {
            let defined = [r.below(2), r.below(3) / 2].map(|x| x as i32);
            let start = if r.chance(2) { 0.0 } else { r.real() };
            let (tolerance, stop) = (if r.chance(2) { 1e-5 } else { r.real() }, r.real());
            let status = run!(fmi2SetupExperiment(c, defined[0], tolerance, start, defined[1], stop));
            if status == Status::Ok {
                instance.has_announced = defined != [0; 2];
            }
            CallResult::of(status, f)
        }
        F::fmi2EnterInitializationMode => CallResult::of(run!(fmi2EnterInitializationMode(c)), f),
        F::fmi2ExitInitializationMode => CallResult::of(run!(fmi2ExitInitializationMode(c)), f),
        F::fmi2Terminate => CallResult::of(run!(fmi2Terminate(c)), f),
        F::fmi2Reset => {
            let status = run!(fmi2Reset(c));
            instance.has_announced &= status != Status::Ok;
            CallResult::of(status, f)
        }
        F::fmi2GetReal => {
            let (vr, place) = (read!(vr.as_ptr()), f.place(r, numbers.as_mut_ptr(), needed));
            CallResult::of(run!(fmi2GetReal(c, vr, count, place)), f).with(&numbers[..n])
        }
        F::fmi2GetInteger | F::fmi2GetBoolean => {
            let (vr, place) = (read!(vr.as_ptr()), f.place(r, integers.as_mut_ptr(), needed));
            let status = match function {
                F::fmi2GetInteger => run!(fmi2GetInteger(c, vr, count, place)),
                _ => run!(fmi2GetBoolean(c, vr, count, place)),
            };
            let mut outcome = CallResult::of(status, f);
            let unwritten = status == Status::Ok && integers[..n].contains(&i32::MIN);
            outcome.broken = unwritten.then(|| "a value was not written".into());
            outcome
        }
        F::fmi2GetString => CallResult::of(run!(fmi2GetString(c, read!(vr.as_ptr()), n, ptr::null_mut())), f),
        F::fmi2SetString => CallResult::of(run!(fmi2SetString(c, read!(vr.as_ptr()), n, ptr::null())), f),
        F::fmi2SetReal => CallResult::of(run!(fmi2SetReal(c, read!(vr.as_ptr()), count, read!(values.as_ptr()))), f),
        F::fmi2SetInteger => {
            CallResult::of(run!(fmi2SetInteger(c, read!(vr.as_ptr()), count, read!(whole.as_ptr()))), f)
        }
        F::fmi2SetBoolean => {
            CallResult::of(run!(fmi2SetBoolean(c, read!(vr.as_ptr()), count, read!(whole.as_ptr()))), f)
        }
        F::fmi2GetFMUstate => get_state(c, r, f, held),
        F::fmi2SetFMUstate => {
            let (state, bytes) = a_state(r, f, held);
            let mut outcome = CallResult::of(run!(fmi2SetFMUstate(c, state)), f);
            outcome.restored = (outcome.status == Status::Ok).then_some(bytes);
            outcome
        }
        F::fmi2FreeFMUstate => {
            let mut outcome = CallResult::of(Status::Ok, f);
            if r.chance(4) || held.states.len() < HELD / 2 {
                let mut nothing = ptr::null_mut();
                let place = if r.chance(2) { ptr::null_mut() } else { &raw mut nothing };
                outcome.status = run!(fmi2FreeFMUstate(c, place));
            } else {
                let at = r.below(held.states.len());
                let state = &mut held.states[at].0;
                outcome.status = run!(fmi2FreeFMUstate(c, state));
                if outcome.status == Status::Ok {
                    outcome.broken = (!state.is_null()).then(|| "the pointer was not cleared".into());
                    held.states.swap_remove(at);
                }
            }
            outcome
        }
        F::fmi2SerializedFMUstateSize => {
            let (state, bytes) = a_state(r, f, held);
            let mut size = 0;
            let place = f.place(r, &raw mut size, true);
            let mut outcome = CallResult::of(run!(fmi2SerializedFMUstateSize(c, state, place)), f);
            if outcome.status == Status::Ok && size != bytes.len() {
                outcome.broken = Some(format!("{size} bytes, {} before", bytes.len()));
            }
            outcome
        }
        F::fmi2SerializeFMUstate => {
            let (state, bytes) = a_state(r, f, held);
            let mut room = vec![0u8; bytes.len() + 8];
            let size = if r.chance(6) { r.below(room.len() + 1) } else { bytes.len() };
            f.any |= size != bytes.len();
            let place = f.place(r, room.as_mut_ptr(), true);
            let mut outcome = CallResult::of(run!(fmi2SerializeFMUstate(c, state, place.cast(), size)), f);
            let differ = outcome.status == Status::Ok && room[..size] != bytes;
            outcome.broken = differ.then(|| "other bytes than before".into());
            outcome
        }
        F::fmi2DeSerializeFMUstate => deserialize(c, r, f, held),
        F::fmi2GetDirectionalDerivative => {
            let by = r.pick(&[VariableKind::Input, VariableKind::State]);
            let known = references(r, by);
            let change: Vec<f64> = known.iter().map(|_| if r.chance(6) { r.real() } else { 1.0 }).collect();
            let (vr, place) = (read!(vr.as_ptr()), f.place(r, numbers.as_mut_ptr(), needed));
            let known_needed = !known.is_empty();
            let (by, along) = (f.pointer(r, known.as_ptr(), known_needed), f.pointer(r, change.as_ptr(), known_needed));
            let status = run!(fmi2GetDirectionalDerivative(c, vr, n, by, known.len(), along, place));
            CallResult::of(status, f).with(&numbers[..n])
        }
        F::fmi2EnterEventMode => CallResult::of(run!(fmi2EnterEventMode(c)), f),
        F::fmi2NewDiscreteStates => {
            let mut info = EventInfo { next_event: f64::NAN, ..EventInfo::default() };
            let place = f.place(r, &raw mut info, true);
            CallResult::of(run!(fmi2NewDiscreteStates(c, place)), f).with(&[info.next_event])
        }
        F::fmi2EnterContinuousTimeMode => CallResult::of(run!(fmi2EnterContinuousTimeMode(c)), f),
        F::fmi2CompletedIntegratorStep => {
            let (mut event, mut end) = (0, 0);
            let (event, end) = (f.place(r, &raw mut event, true), f.place(r, &raw mut end, true));
            CallResult::of(run!(fmi2CompletedIntegratorStep(c, r.below(2) as i32, event, end)), f)
        }
        F::fmi2SetTime => {
            let now = time_of(instance);
            let time = if r.chance(12) { r.real() } else { now + r.pick(&[0.0, 1e-6, 1e-5, 1e-4]) };
            CallResult::of(run!(fmi2SetTime(c, time)), f)
        }
        F::fmi2SetContinuousStates => {
            let x = next_states(instance, r);
            let count = counted(r, f, STATES);
            CallResult::of(run!(fmi2SetContinuousStates(c, f.pointer(r, x.as_ptr(), true), count)), f)
        }
        F::fmi2GetDerivatives => fill(c, r, f, STATES, fmi2GetDerivatives),
        F::fmi2GetEventIndicators => fill(c, r, f, EVENT_INDICATORS, fmi2GetEventIndicators),
        F::fmi2GetContinuousStates => fill(c, r, f, STATES, fmi2GetContinuousStates),
        F::fmi2GetNominalsOfContinuousStates => fill(c, r, f, STATES, fmi2GetNominalsOfContinuousStates),
        F::fmi2SetRealInputDerivatives => {
            let rates: Vec<f64> = values.iter().map(|x| if r.chance(3) { 0.0 } else { x * 0.1 }).collect();
            let (vr, orders) = (read!(vr.as_ptr()), read!(orders.as_ptr()));
            CallResult::of(run!(fmi2SetRealInputDerivatives(c, vr, count, orders, read!(rates.as_ptr()))), f)
        }
        F::fmi2GetRealOutputDerivatives => {
            let (vr, orders) = (read!(vr.as_ptr()), read!(orders.as_ptr()));
            let place = f.place(r, numbers.as_mut_ptr(), needed);
            CallResult::of(run!(fmi2GetRealOutputDerivatives(c, vr, count, orders, place)), f).with(&numbers[..n])
        }
        F::fmi2DoStep => {
            let now = time_of(instance);
            let point = if r.chance(20) { r.real() } else { now };
            // no step that is meant to take hours: the host gets what it asks for
            let h = if r.chance(8) { r.pick(&NO_STEPS) } else { r.pick(&[1e-4, 1e-4, 1e-5, 3e-4, 1e-3, 1e-300]) };
            f.any |= NO_STEPS.iter().any(|none| none.to_bits() == h.to_bits());
            CallResult::of(run!(fmi2DoStep(c, point, h, r.below(2) as i32)), f)
        }
        F::fmi2CancelStep => CallResult::of(run!(fmi2CancelStep(c)), f),
        F::fmi2GetStatus => {
            let mut value = Status::Ok;
            let place = f.place(r, &raw mut value, true);
            CallResult::of(run!(fmi2GetStatus(c, a_kind(r), place)), f)
        }
        F::fmi2GetRealStatus => {
            let place = f.place(r, numbers.as_mut_ptr(), true);
            CallResult::of(run!(fmi2GetRealStatus(c, a_kind(r), place)), f).with(&numbers[..1])
        }
        F::fmi2GetIntegerStatus => CallResult::of(run!(fmi2GetIntegerStatus(c, a_kind(r), integers.as_mut_ptr())), f),
        F::fmi2GetBooleanStatus => {
            let place = f.place(r, integers.as_mut_ptr(), true);
            CallResult::of(run!(fmi2GetBooleanStatus(c, a_kind(r), place)), f)
        }
        F::fmi2GetStringStatus => {
            let mut text = ptr::null();
            let place = f.place(r, &raw mut text, true);
            let mut outcome = CallResult::of(run!(fmi2GetStringStatus(c, a_kind(r), place)), f);
            outcome.broken = (outcome.status == Status::Ok && text.is_null()).then(|| "NULL".into());
            outcome
        }
    }
}

fn a_kind(r: &mut Random) -> i32 {
    if r.chance(8) { r.bits() as i32 } else { r.below(4) as i32 }
}

/// Time of the instance [s]; 0 where it does not report it.
fn time_of(instance: &FuzzedInstance) -> f64 {
    let mut now = 0.0;
    // SAFETY: a live component and a place
    unsafe { fmi2GetRealStatus(instance.component, LAST_SUCCESSFUL_TIME, &mut now) };
    instance.take_log();
    now
}

/// A step of Euler's from where the instance is, now and then with something wild in it.
fn next_states(instance: &FuzzedInstance, r: &mut Random) -> [f64; ROOM] {
    let (mut x, mut rates) = ([0.0; ROOM], [0.0; STATES]);
    // SAFETY: a live component and places for all states
    unsafe {
        fmi2GetContinuousStates(instance.component, x.as_mut_ptr(), STATES);
        fmi2GetDerivatives(instance.component, rates.as_mut_ptr(), STATES);
    }
    instance.take_log();
    let h = r.pick(&[0.0, 1e-7, 1e-6]);
    x.iter_mut().zip(rates).for_each(|(x, rate)| *x += h * rate);
    if r.chance(8) {
        x[r.below(STATES)] = r.real();
    }
    x
}

/// The right count, or seldom one that must be refused and for which there is room nonetheless.
fn counted(r: &mut Random, f: &mut Flaws, right: usize) -> usize {
    let count = if r.chance(20) { r.below(ROOM) } else { right };
    f.any |= count != right;
    count
}

type Filler = unsafe extern "C" fn(ComponentPointer, *mut f64, usize) -> Status;

fn fill(c: ComponentPointer, r: &mut Random, f: &mut Flaws, right: usize, function: Filler) -> CallResult {
    let mut room = [f64::NAN; ROOM];
    let count = counted(r, f, right);
    let place = f.place(r, room.as_mut_ptr(), true);
    // SAFETY: a live component and room for `count` values, or a pointer that the library checks for
    let status = unsafe { function(c, place, count) };
    CallResult::of(status, f).with(&room[..right])
}

/// fmi2Instantiate with anything; what is made is freed.
fn instantiate(r: &mut Random) -> CallResult {
    let recorder = super::instance::Recorder::default();
    let callbacks = recorder.callbacks();
    let right = CString::new(guid()).unwrap_or_default();
    let (kind, name, id) = (r.below(4) as i32 - 1, r.below(4), r.below(4));
    let names = [c"a".as_ptr(), c"%s%n \xff".as_ptr(), c"".as_ptr(), ptr::null()];
    let ids = [right.as_ptr(), right.as_ptr(), c"%n".as_ptr(), ptr::null()];
    let places = [ptr::null(), c"file:///a%20b".as_ptr(), c"\xff".as_ptr()];
    let callbacks = if r.chance(4) { ptr::null() } else { &raw const callbacks };
    // SAFETY: all pointers are NULL or valid through the call
    let c = unsafe { fmi2Instantiate(names[name], kind, ids[id], r.pick(&places), callbacks, 0, r.below(2) as i32) };
    let expected = (kind == MODEL_EXCHANGE || kind == CO_SIMULATION) && name < 2 && id < 2;
    let mut outcome = CallResult::of(Status::Ok, &Flaws::default());
    if c.is_null() == expected {
        outcome.broken = Some(format!("kind {kind}, name {name}, GUID {id}: made {}", !c.is_null()));
    }
    let silent = recorder.lines().is_empty();
    if c.is_null() && silent && !callbacks.is_null() {
        outcome.broken = Some("refused without a line in the log".into());
    }
    // SAFETY: NULL, or a component that nothing else holds; it is freed before its log
    unsafe { fmi2FreeInstance(c) };
    outcome
}
