//! Tests of `solver.input_ramp` with FMI 3.0: steps that end early, and steps that are completed in parts.

use std::ffi::{CString, c_void};
use std::ptr;

use bevel_differential::fmi3::*;
use bevel_differential::variables::{guid, table};

/// Step of these tests [s].
const STEP: f64 = 1.0 / 1024.0;
/// Speed of the carrier at the start [rad/s].
const SPEED: f64 = 50.0;

fn reference(name: &str) -> u32 {
    table().rows.iter().position(|row| row.name == name).unwrap_or_else(|| panic!("no variable {name}")) as u32
}

/// An instance for co-simulation.
struct Unit(ComponentPointer);

impl Drop for Unit {
    fn drop(&mut self) {
        // SAFETY: the component belongs to this unit
        unsafe { fmi3FreeInstance(self.0) }
    }
}

/// End of a step: early or not, and its time [s].
type Ended = (bool, f64);

impl Unit {
    /// Creates an instance with tooth pairs and an imposed carrier speed. Early returns are allowed, and `update` is
    /// called back, if given.
    fn new(update: Option<IntermediateUpdate>, environment: *mut c_void) -> Self {
        let (name, token) = (CString::new("test").unwrap(), CString::new(guid()).unwrap());
        // SAFETY: texts and environment are valid, and no messages are requested
        let c = unsafe {
            fmi3InstantiateCoSimulation(
                name.as_ptr(),
                token.as_ptr(),
                ptr::null(),
                0,
                0,
                0,
                1,
                ptr::null(),
                0,
                environment,
                None,
                update,
            )
        };
        assert!(!c.is_null());
        let unit = Self(c);
        unit.set_boolean("solver.input_ramp", true);
        unit.set("carrier.speed_command", SPEED);
        unit
    }

    fn start(&self) {
        // SAFETY: a live component
        let statuses =
            unsafe { [fmi3EnterInitializationMode(self.0, 0, 0.0, 0.0, 0, 0.0), fmi3ExitInitializationMode(self.0)] };
        assert_eq!(statuses, [Status::Ok; 2]);
    }

    fn set(&self, name: &str, value: f64) {
        // SAFETY: a live component and one value
        assert_eq!(unsafe { fmi3SetFloat64(self.0, &reference(name), 1, &value, 1) }, Status::Ok, "{name}");
    }

    fn set_boolean(&self, name: &str, value: bool) {
        // SAFETY: a live component and one value
        assert_eq!(unsafe { fmi3SetBoolean(self.0, &reference(name), 1, &u8::from(value), 1) }, Status::Ok, "{name}");
    }

    fn get(&self, name: &str) -> f64 {
        let mut value = f64::NAN;
        // SAFETY: a live component and memory for one value
        assert_eq!(unsafe { fmi3GetFloat64(self.0, &reference(name), 1, &mut value, 1) }, Status::Ok, "{name}");
        value
    }

    fn step(&self, time: f64, h: f64) -> Ended {
        let (mut event, mut end, mut early, mut last) = (0, 0, 0, f64::NAN);
        // SAFETY: a live component and memory for the results
        let status = unsafe { fmi3DoStep(self.0, time, h, 1, &mut event, &mut end, &mut early, &mut last) };
        assert_eq!(status, Status::Ok);
        (early != 0, last)
    }
}

/// Checks the carrier's speed, and the angle turned since `before` [rad].
fn assert_moved(unit: &Unit, before: f64, [speed, turned]: [f64; 2]) {
    let found = [unit.get("carrier.speed"), unit.get("carrier.angle") - before];
    assert!((found[0] - speed).abs() < 1e-12 * SPEED, "{found:?} instead of {speed} rad/s");
    assert!((found[1] - turned).abs() < 1e-11, "{found:?} instead of {turned} rad");
}

/// Creates a unit whose tooth breaks in the middle of its first step. The speed should rise by 0.25 rad/s over this
/// step.
fn breaking() -> Unit {
    let unit = Unit::new(None, ptr::null_mut());
    unit.set_boolean("effects.tooth_fault", true);
    unit.set_boolean("tooth_fault.at_onset", true);
    unit.set("tooth_fault.onset", 0.5 * STEP);
    unit.start();
    unit.set("carrier.speed_command", SPEED + 0.25);
    unit
}

#[test]
fn a_step_that_ends_early_leaves_the_rest_of_its_ramp_to_the_next_step() {
    for next in [None, Some(SPEED - 0.5)] {
        let unit = breaking();
        let angle = unit.get("carrier.angle");
        assert_eq!(unit.step(0.0, STEP), (true, 0.5 * STEP));
        let half = 0.5 * STEP * (SPEED + 0.5 * 0.125);
        assert_moved(&unit, angle, [SPEED + 0.125, half]);
        assert_eq!(unit.get("carrier.speed_command"), SPEED + 0.25, "as the host has set it");
        if let Some(speed) = next {
            unit.set("carrier.speed_command", speed);
        }
        let until = next.unwrap_or(SPEED + 0.25);
        assert_eq!(unit.step(0.5 * STEP, STEP), (false, 1.5 * STEP));
        assert_moved(&unit, angle, [until, half + STEP * 0.5 * (SPEED + 0.125 + until)]);
    }
}

#[test]
fn a_state_saved_after_an_early_end_continues_the_ramp_bit_by_bit() {
    let unit = breaking();
    unit.step(0.0, STEP);
    let mut state = ptr::null_mut();
    // SAFETY: a live component and memory for a pointer
    assert_eq!(unsafe { fmi3GetFMUState(unit.0, &mut state) }, Status::Ok);
    let mut size = 0;
    // SAFETY: a live component and a live state
    assert_eq!(unsafe { fmi3SerializedFMUStateSize(unit.0, state, &mut size) }, Status::Ok);
    let mut bytes = vec![0; size];
    // SAFETY: as above, and memory for the bytes
    assert_eq!(unsafe { fmi3SerializeFMUState(unit.0, state, bytes.as_mut_ptr(), size) }, Status::Ok);
    let go_on = |unit: &Unit| {
        unit.step(0.5 * STEP, STEP);
        ["carrier.speed", "carrier.angle", "left.speed", "carrier.torque"].map(|name| unit.get(name).to_bits())
    };
    let expected = go_on(&unit);
    // SAFETY: a live component and a live state
    assert_eq!(unsafe { fmi3SetFMUState(unit.0, state) }, Status::Ok);
    assert_eq!(go_on(&unit), expected);
    let (other, mut copy) = (Unit::new(None, ptr::null_mut()), ptr::null_mut());
    // SAFETY: live components and states
    unsafe {
        assert_eq!(fmi3DeserializeFMUState(other.0, bytes.as_ptr(), size, &mut copy), Status::Ok);
        assert_eq!(fmi3SetFMUState(other.0, copy), Status::Ok);
        assert_eq!(fmi3FreeFMUState(other.0, &mut copy), Status::Ok);
        assert_eq!(fmi3FreeFMUState(unit.0, &mut state), Status::Ok);
    }
    assert_eq!(go_on(&other), expected);
}

#[test]
fn a_command_that_ends_a_step_at_its_start_leaves_the_whole_ramp() {
    let unit = Unit::new(None, ptr::null_mut());
    unit.start();
    let angle = unit.get("carrier.angle");
    unit.set("carrier.speed_command", SPEED + 0.25);
    unit.set("lock.command", 1.0);
    assert_eq!(unit.step(0.0, STEP), (true, 0.0));
    assert_moved(&unit, angle, [SPEED, 0.0]);
    assert_eq!(unit.step(0.0, STEP), (false, STEP));
    assert_moved(&unit, angle, [SPEED + 0.25, STEP * (SPEED + 0.125)]);
}

/// Host's actions and records at the parts of a step.
#[derive(Default)]
struct Parts {
    unit: Option<ComponentPointer>,
    /// Number of parts so far.
    count: usize,
    /// Speed to set at the next part.
    speed: Option<f64>,
    /// Time at which the speed was set [s].
    set_at: f64,
}

unsafe extern "C" fn at_part(
    environment: *mut c_void,
    time: f64,
    set_requested: Boolean,
    _get_allowed: Boolean,
    _step_finished: Boolean,
    _can_return_early: Boolean,
    early_return: *mut Boolean,
    _early_return_time: *mut f64,
) {
    // SAFETY: the environment is a `Parts` that outlives the step, and nothing else uses it meanwhile
    let parts = unsafe { &mut *environment.cast::<Parts>() };
    parts.count += 1;
    if let (Some(c), Some(speed)) = (parts.unit, parts.speed.filter(|_| set_requested != 0)) {
        // SAFETY: a live component and one value
        let status = unsafe { fmi3SetFloat64(c, &reference("carrier.speed_command"), 1, &speed, 1) };
        assert_eq!(status, Status::Ok);
        (parts.speed, parts.set_at) = (None, time);
    }
    // SAFETY: memory of the unit
    unsafe { *early_return = 0 };
}

#[test]
fn a_ramp_is_one_part_and_inputs_set_within_a_step_ramp_to_its_end() {
    let parts = Box::into_raw(Box::<Parts>::default());
    let unit = Unit::new(Some(at_part), parts.cast());
    unit.start();
    // SAFETY, for all: between steps, only this function uses the parts
    let change = |parts: *mut Parts, speed| unsafe {
        *parts = Parts { unit: Some(unit.0), speed, ..Parts::default() };
    };
    let read = |parts: *mut Parts| unsafe { ((*parts).count, (*parts).set_at) };
    let angle = unit.get("carrier.angle");
    change(parts, Some(SPEED + 0.25));
    assert_eq!(unit.step(0.0, STEP), (false, STEP));
    let (count, set_at) = read(parts);
    assert_eq!(count, 2, "the first part, and the rest in a single part");
    assert!(set_at > 0.0 && set_at < STEP, "{set_at}");
    let turned = STEP * SPEED + 0.5 * 0.25 * (STEP - set_at);
    assert_moved(&unit, angle, [SPEED + 0.25, turned]);
    change(parts, None);
    unit.set("carrier.speed_command", SPEED);
    assert_eq!(unit.step(STEP, STEP), (false, 2.0 * STEP));
    assert_eq!(read(parts).0, 1);
    assert_moved(&unit, angle, [SPEED, turned + STEP * (SPEED + 0.125)]);
    change(parts, None);
    unit.step(2.0 * STEP, 8.0 * STEP);
    assert!(read(parts).0 > 1, "without a ramp, steps have parts");
    drop(unit);
    // SAFETY: created above, and no longer used
    drop(unsafe { Box::from_raw(parts) });
}
