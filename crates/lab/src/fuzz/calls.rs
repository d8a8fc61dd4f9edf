//! Calls with random arguments, grouped by the signatures of functions. Both versions of FMI use them; their tables
//! assign a signature to each function.

use std::ffi::CStr;
use std::ptr;

use bevel_differential::instance::{ComponentPointer, Kind, Status, Text};
use bevel_differential::model::STATES;
use fastrand::Rng;

use super::arguments::{CallResult, Flaws, VariableKind, references, row};
use super::random::{integer_for, real};
use super::site::{ROOM, Site};
use crate::random::Draws;

/// Step sizes that must be refused [s].
const INVALID_STEPS: [f64; 4] = [0.0, -1.0, f64::NAN, f64::INFINITY];
/// Maximum deviation of the time after a step from the step's end, relative to the time or to 1 s.
const ROUNDING: f64 = 1e-12;

/// A value of a variable.
pub trait Value: Copy + PartialEq {
    /// Value that no call writes.
    const UNWRITTEN: Self;
    /// Creates a value from an integer.
    fn of(drawn: i32) -> Self;
}

macro_rules! values {
    ($($type:ty: $unwritten:expr, $of:expr;)+) => {$(
        impl Value for $type {
            const UNWRITTEN: Self = $unwritten;

            fn of(drawn: i32) -> Self {
                $of(drawn)
            }
        }
    )+};
}

values! {
    i32: i32::MIN, |drawn| drawn;
    i64: i64::MIN, i64::from;
    u64: u64::MAX, |drawn: i32| u64::from(drawn.unsigned_abs());
    u8: 9, |drawn: i32| u8::try_from(drawn).unwrap_or(7);
    Text: ptr::null(), |_| ptr::null();
}

/// Reads variables: references and their number, room for values and its size.
pub type Getter<T> = unsafe fn(ComponentPointer, *const u32, usize, *mut T, usize) -> Status;
/// Sets variables: references and their number, values and their number.
pub type Setter<T> = unsafe fn(ComponentPointer, *const u32, usize, *const T, usize) -> Status;
/// Computes directional derivatives: unknowns, knowns, seeds and results, each with its number.
pub type Sensitivity =
    unsafe fn(ComponentPointer, *const u32, usize, *const u32, usize, *const f64, usize, *mut f64, usize) -> Status;
type Filler = unsafe extern "C" fn(ComponentPointer, *mut f64, usize) -> Status;
type Setup<B> = unsafe extern "C" fn(ComponentPointer, B, f64, f64, B, f64) -> Status;
type Completed<B> = unsafe extern "C" fn(ComponentPointer, B, *mut B, *mut B) -> Status;
type Logging<B> = unsafe extern "C" fn(ComponentPointer, B, usize, *const Text) -> Status;

// SAFETY of all calls below: the component and the pointers are valid, or the library must refuse them.
// Lengths are those of the arrays, or larger than the library may ever accept.

/// Calls a function that needs only an instance.
pub fn plain(s: &mut Site, function: unsafe extern "C" fn(ComponentPointer) -> Status) -> CallResult {
    let status = unsafe { function(s.c) };
    s.result(status)
}

/// Resets an instance, which also discards announced tolerances and stop times.
pub fn reset(s: &mut Site) -> CallResult {
    let status = unsafe { (s.interface.reset)(s.c) };
    s.instance.has_announced &= status != Status::Ok;
    s.result(status)
}

/// Calls a function that returns a text.
pub fn text(s: &Site, function: extern "C" fn() -> Text) -> CallResult {
    s.result(Status::Ok).unless(function().is_null(), "NULL")
}

/// Draws name and token of an instance, valid or not. Also returns true if an instance can be created with them.
/// `right` is the valid token.
pub fn name_and_token(r: &mut Rng, right: &CStr) -> ([Text; 2], bool) {
    let (name, token) = (r.below(4), r.below(4));
    let names = [c"a".as_ptr(), c"%s%n \xff".as_ptr(), c"".as_ptr(), ptr::null()];
    let tokens = [right.as_ptr(), right.as_ptr(), c"%n".as_ptr(), ptr::null()];
    ([names[name], tokens[token]], name < 2 && token < 2)
}

/// Result of an instantiation that must succeed if `is_right` and otherwise be refused. `is_silent` is true if the host
/// has a log and nothing was written to it, which is wrong only after a refusal.
pub fn instantiated(c: ComponentPointer, is_right: bool, is_silent: bool) -> CallResult {
    let outcome = CallResult::of(Status::Ok, &Flaws::default());
    let outcome = outcome.unless(c.is_null() && is_silent, "refused without a line in the log");
    outcome.unless(
        c.is_null() == is_right,
        if is_right { "refused although everything is valid" } else { "created although something is invalid" },
    )
}

/// Frees a null pointer and an invalid one, which must have no effect. Valid instances are freed elsewhere, by the
/// round that created them.
pub fn free(s: &Site) -> CallResult {
    unsafe {
        (s.interface.free)(ptr::null_mut());
        (s.interface.free)(s.instance.component.wrapping_byte_add(1));
    }
    s.result(Status::Ok)
}

/// Sets the logged categories.
pub fn logging<B: From<bool>>(s: &mut Site, function: Logging<B>) -> CallResult {
    let names = [c"logStatusError", c"logStatusDiscard", c"logEvents", c"logNonsense", c""].map(|t| t.as_ptr());
    let count = if s.r.chance(3) { 0 } else { s.r.below(names.len() + 1) };
    let pointer = s.read(names.as_ptr(), count > 0);
    let status = unsafe { function(s.c, B::from(s.r.bool()), count, pointer) };
    s.instance.is_filtered |= s.c == s.instance.component && status != Status::Error;
    s.result(status)
}

/// Announces tolerance, start and stop times.
pub fn setup<B: From<bool>>(s: &mut Site, function: Setup<B>) -> CallResult {
    let defined = [s.r.chance(2), s.r.chance(3)];
    let start = if s.r.chance(2) { 0.0 } else { real(s.r) };
    let (tolerance, stop) = (if s.r.chance(2) { 1e-5 } else { real(s.r) }, real(s.r));
    let status = unsafe { function(s.c, B::from(defined[0]), tolerance, start, B::from(defined[1]), stop) };
    if status == Status::Ok {
        s.instance.has_announced = defined != [false; 2];
    }
    s.result(status)
}

/// Calls a getter with room filled with `unwritten`. Returns its status and the values.
fn read_values<T: Copy>(s: &mut Site, wanted: VariableKind, unwritten: T, function: Getter<T>) -> (Status, Vec<T>) {
    let vr = references(s.r, wanted);
    let (n, needed) = (vr.len(), !vr.is_empty());
    let mut values = vec![unwritten; n + 1];
    let [count, room] = s.counts(n);
    let (references, place) = (s.read(vr.as_ptr(), needed), s.place(values.as_mut_ptr(), needed));
    let status = unsafe { function(s.c, references, count, place, room) };
    values.truncate(n);
    (status, values)
}

/// Calls a setter with `values` for `references`.
fn write_values<T: Copy>(s: &mut Site, vr: &[u32], mut values: Vec<T>, unused: T, function: Setter<T>) -> CallResult {
    let needed = !vr.is_empty();
    // room for a count that is too large by one
    values.push(unused);
    let [count, given] = s.counts(vr.len());
    let (references, values) = (s.read(vr.as_ptr(), needed), s.read(values.as_ptr(), needed));
    let status = unsafe { function(s.c, references, count, values, given) };
    s.result(status)
}

/// Reads numbers.
pub fn get_reals(s: &mut Site, wanted: VariableKind, function: Getter<f64>) -> CallResult {
    let (status, numbers) = read_values(s, wanted, f64::NAN, function);
    s.result(status).with(&numbers)
}

/// Reads an array into room that may differ from the array's size.
pub fn get_array(s: &mut Site, function: Getter<f64>) -> CallResult {
    let (reference, room) = (s.r.pick(&VariableKind::Array.all()), s.r.below(9));
    let mut numbers = [f64::NAN; 9];
    let place = s.place(numbers.as_mut_ptr(), room > 0);
    let status = unsafe { function(s.c, &reference, 1, place, room) };
    let is_overrun = numbers[room..].iter().any(|number| !number.is_nan());
    s.result(status).with(&numbers[..room]).unless(is_overrun, "more values were written than there is room for")
}

/// Reads integers, choices, switches or texts.
pub fn get<T: Value>(s: &mut Site, wanted: VariableKind, function: Getter<T>) -> CallResult {
    let (status, values) = read_values(s, wanted, T::UNWRITTEN, function);
    s.result(status).unless(values.contains(&T::UNWRITTEN), "a value was not written")
}

/// Sets numbers: parameters and inputs, in model exchange also states.
pub fn set_reals(s: &mut Site, function: Setter<f64>) -> CallResult {
    let is_state = s.instance.options.kind == Kind::ModelExchange && s.r.chance(2);
    let wanted = if is_state { VariableKind::State } else { VariableKind::Settable };
    let vr = references(s.r, wanted);
    let values = s.reals(&vr, wanted);
    write_values(s, &vr, values, 0.0, function)
}

/// Sets integers, choices or switches.
pub fn set<T: Value>(s: &mut Site, wanted: VariableKind, function: Setter<T>) -> CallResult {
    let vr = references(s.r, wanted);
    let drawn = |&v: &u32| T::of(row(v).map_or(0, |row| integer_for(s.r, row)));
    let values = vr.iter().map(drawn).collect();
    write_values(s, &vr, values, T::of(0), function)
}

/// Reads or sets variables of a type that the FMU does not use: every reference must be refused.
pub fn none(s: &mut Site, function: unsafe fn(ComponentPointer, *const u32, usize) -> Status) -> CallResult {
    let vr = references(s.r, VariableKind::Output);
    s.flaws.any |= !vr.is_empty();
    let (references, count) = (s.read(vr.as_ptr(), !vr.is_empty()), s.flaws.count(s.r, vr.len()));
    let status = unsafe { function(s.c, references, count) };
    s.result(status)
}

/// Sets derivatives of inputs.
pub fn set_rates(
    s: &mut Site,
    function: unsafe fn(ComponentPointer, *const u32, usize, *const i32, *const f64) -> Status,
) -> CallResult {
    let vr = references(s.r, VariableKind::Input);
    let (needed, orders) = (!vr.is_empty(), orders(s.r, vr.len()));
    let values = s.reals(&vr, VariableKind::Input);
    let rates: Vec<f64> = values.iter().map(|x| if s.r.chance(3) { 0.0 } else { x * 0.1 }).collect();
    let count = s.flaws.count(s.r, vr.len());
    let (vr, orders, rates) =
        (s.read(vr.as_ptr(), needed), s.read(orders.as_ptr(), needed), s.read(rates.as_ptr(), needed));
    let status = unsafe { function(s.c, vr, count, orders, rates) };
    s.result(status)
}

/// Reads derivatives of outputs with respect to time.
pub fn get_rates(
    s: &mut Site,
    function: unsafe fn(ComponentPointer, *const u32, usize, *const i32, *mut f64, usize) -> Status,
) -> CallResult {
    let vr = references(s.r, VariableKind::Output);
    let (n, needed, orders) = (vr.len(), !vr.is_empty(), orders(s.r, vr.len()));
    let mut numbers = vec![f64::NAN; n + 1];
    let [count, room] = s.counts(n);
    let (vr, orders) = (s.read(vr.as_ptr(), needed), s.read(orders.as_ptr(), needed));
    let place = s.place(numbers.as_mut_ptr(), needed);
    let status = unsafe { function(s.c, vr, count, orders, place, room) };
    s.result(status).with(&numbers[..n])
}

fn orders(r: &mut Rng, count: usize) -> Vec<i32> {
    (0..count).map(|_| if r.chance(10) { r.i32(..) } else { 1 }).collect()
}

/// Computes directional derivatives along the knowns or, if `is_adjoint`, adjoint derivatives of the unknowns.
pub fn sensitivity(s: &mut Site, is_adjoint: bool, function: Sensitivity) -> CallResult {
    let by = s.r.pick(&[VariableKind::Input, VariableKind::State]);
    let (unknown, known) = (references(s.r, VariableKind::Output), references(s.r, by));
    let (n, m) = (unknown.len(), known.len());
    let (given, wanted) = if is_adjoint { (n, m) } else { (m, n) };
    let seed: Vec<f64> = (0..given).map(|_| if s.r.chance(6) { real(s.r) } else { 1.0 }).collect();
    let mut numbers = vec![f64::NAN; wanted + 1];
    let (of, place) = (s.read(unknown.as_ptr(), n > 0), s.place(numbers.as_mut_ptr(), wanted > 0));
    let (by, along) = (s.read(known.as_ptr(), m > 0), s.read(seed.as_ptr(), given > 0));
    let status = unsafe { function(s.c, of, n, by, m, along, given, place, wanted) };
    s.result(status).with(&numbers[..wanted])
}

/// Fills an array of numbers.
pub fn fill(s: &mut Site, right: usize, function: Filler) -> CallResult {
    let mut room = [f64::NAN; ROOM];
    let count = counted(s, right);
    let place = s.place(room.as_mut_ptr(), true);
    let status = unsafe { function(s.c, place, count) };
    s.result(status).with(&room[..right])
}

/// Returns the right count, or sometimes another one that must be refused and for which there is room.
fn counted(s: &mut Site, right: usize) -> usize {
    let count = if s.r.chance(20) { s.r.below(ROOM) } else { right };
    s.flaws.any |= count != right;
    count
}

/// Completes a step of the host's solver.
pub fn completed<B: From<bool>>(s: &mut Site, function: Completed<B>) -> CallResult {
    let (mut event, mut end) = (B::from(false), B::from(false));
    let (event, end) = (s.place(&raw mut event, true), s.place(&raw mut end, true));
    let status = unsafe { function(s.c, B::from(s.r.bool()), event, end) };
    s.result(status)
}

/// Sets the time.
pub fn set_time(s: &mut Site, function: unsafe extern "C" fn(ComponentPointer, f64) -> Status) -> CallResult {
    let now = s.instance.time().unwrap_or(0.0);
    let time = if s.r.chance(12) { real(s.r) } else { now + s.r.pick(&[0.0, 1e-6, 1e-5, 1e-4]) };
    let status = unsafe { function(s.c, time) };
    s.result(status)
}

/// Sets all continuous states.
pub fn set_states(
    s: &mut Site,
    function: unsafe extern "C" fn(ComponentPointer, *const f64, usize) -> Status,
) -> CallResult {
    let x = s.next_states();
    let count = counted(s, STATES);
    let states = s.read(x.as_ptr(), true);
    let status = unsafe { function(s.c, states, count) };
    s.result(status)
}

/// End of a step: its status, the reached time if the function returns one, and true if the step ended early.
pub type Ended = (Status, Option<f64>, bool);

/// Executes a step, mostly from the present time, with `step(site, point, size)`.
pub fn step(s: &mut Site, step: fn(&mut Site, f64, f64) -> Ended) -> CallResult {
    let now = s.instance.time().unwrap_or(0.0);
    let point = if s.r.chance(20) { real(s.r) } else { now };
    // no long steps, because a step cannot be interrupted
    let h = if s.r.chance(8) { s.r.pick(&INVALID_STEPS) } else { s.r.pick(&[1e-4, 1e-4, 1e-5, 3e-4, 1e-3, 1e-300]) };
    s.flaws.any |= INVALID_STEPS.iter().any(|none| none.to_bits() == h.to_bits());
    let (status, last, is_early) = step(s, point, h);
    let (after, until) = (s.instance.time(), last.unwrap_or(point + h));
    let is_reached = after.is_some_and(|after| same_time(after, until)) && (is_early || same_time(until, point + h));
    // if an event ends a step at its start, time still advances by the smallest distinguishable amount, which may
    // exceed the step
    let is_within = until >= point && (until <= point + h || same_time(until, point + h));
    let mut outcome = s.result(status);
    if status == Status::Ok && !(is_reached && is_within) {
        outcome.broken =
            Some(format!("a step from {point:?} by {h:?} has ended at {until:?}, and the time is {after:?}"));
    }
    outcome
}

fn same_time(a: f64, b: f64) -> bool {
    (a - b).abs() <= ROUNDING * b.abs().max(1.0)
}
