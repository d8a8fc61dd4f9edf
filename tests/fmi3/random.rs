//! Calls at random, legal or not, with values at random: no status but those of FMI, no refusal without a message, no number that is
//! none, and a time that only steps move. The environment variable CALLS asks for more of them.

use std::cell::RefCell;
use std::ffi::{CStr, CString, c_char, c_void};
use std::ptr;

use bevel_differential::fmi3::variables::added;
use bevel_differential::fmi3::*;
use bevel_differential::model::STATES;
use bevel_differential::variables::{guid, table};

/// Calls of an instance.
const ROUND: usize = 400;
/// Values to set: usual ones, and those that no variable takes.
const VALUES: [f64; 12] = [0.0, 1.0, -1.0, 2.0, 3.5, 200.0, 1e-3, 1e9, f64::NAN, f64::INFINITY, -0.0, 1e-300];

thread_local! {
    static LOGGED: RefCell<Vec<String>> = const { RefCell::new(Vec::new()) };
}

unsafe extern "C" fn log(_environment: *mut c_void, _status: Status, _category: Text, message: Text) {
    // SAFETY: the library passes a text that ends with NUL
    let message = unsafe { CStr::from_ptr(message) }.to_string_lossy().into_owned();
    LOGGED.with_borrow_mut(|logged| logged.push(message));
}

/// Reads and sets within a step, and asks for an early return now and then.
unsafe extern "C" fn update(
    environment: *mut c_void,
    time: f64,
    _set: Boolean,
    get: Boolean,
    _finished: Boolean,
    _may_return: Boolean,
    early: *mut Boolean,
    _early_time: *mut f64,
) {
    assert!(time.is_finite() && get == 1);
    // SAFETY: the environment is the round's counter; `early` is the library's
    unsafe {
        let count = &mut *environment.cast::<u64>();
        *count += 1;
        *early = Boolean::from(count.is_multiple_of(17));
    }
}

/// SplitMix64.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, n: usize) -> usize {
        (self.next() % n as u64) as usize
    }

    fn value(&mut self) -> f64 {
        VALUES[self.below(VALUES.len())]
    }

    fn reference(&mut self) -> u32 {
        let all = table().rows.len() + added().len();
        if self.below(20) == 0 { u32::MAX - self.below(3) as u32 } else { self.below(all) as u32 }
    }
}

/// What a round is about.
struct Round {
    c: ComponentPointer,
    state: FmuState,
    time: f64,
}

fn instance(random: &mut Random, count: *mut u64) -> ComponentPointer {
    let (name, token) = (c"random", CString::new(guid()).expect("a token"));
    let flag = |random: &mut Random| random.below(2) as Boolean;
    let (events, early, updates) = (flag(random), flag(random), random.below(3) == 0);
    // SAFETY: valid texts and functions
    unsafe {
        if random.below(3) == 0 {
            fmi3InstantiateModelExchange(name.as_ptr(), token.as_ptr(), ptr::null(), 0, 1, ptr::null_mut(), Some(log))
        } else {
            fmi3InstantiateCoSimulation(
                name.as_ptr(),
                token.as_ptr(),
                ptr::null::<c_char>(),
                0,
                1,
                events,
                early,
                ptr::null(),
                0,
                count.cast(),
                Some(log),
                updates.then_some(update as IntermediateUpdate),
            )
        }
    }
}

/// One call. Returns its status.
fn call(random: &mut Random, round: &mut Round) -> Status {
    let c = round.c;
    let (vr, value) = ([random.reference(), random.reference()], [random.value(), random.value()]);
    let n = random.below(3);
    let (mut floats, mut flags, mut states) = ([0.0f64; 8], [9u8; 6], [0.0; STATES]);
    let room = random.below(9);
    // SAFETY: every pointer points to as many values as are announced
    unsafe {
        match random.below(36) {
            0 => fmi3EnterInitializationMode(c, 0, 0.0, 0.0, 0, 0.0),
            1 => fmi3ExitInitializationMode(c),
            2 => fmi3EnterEventMode(c),
            3 => fmi3EnterStepMode(c),
            4 => fmi3EnterContinuousTimeMode(c),
            5 => fmi3EnterConfigurationMode(c),
            6 => fmi3ExitConfigurationMode(c),
            7 if random.below(8) == 0 => fmi3Terminate(c),
            8 if random.below(8) == 0 => fmi3Reset(c),
            9 | 10 => {
                let status = fmi3GetFloat64(c, vr.as_ptr(), n.min(1), floats.as_mut_ptr(), room);
                if status == Status::Ok && n > 0 {
                    assert!(floats[..room].iter().all(|x| x.is_finite()), "{vr:?} {floats:?}");
                }
                status
            }
            11 => fmi3GetInt32(c, vr.as_ptr(), n, [0i32; 2].as_mut_ptr(), n),
            12 => fmi3GetInt64(c, vr.as_ptr(), n, [0i64; 2].as_mut_ptr(), n),
            13 => fmi3GetUInt64(c, [3u32].as_ptr(), 1, [0u64].as_mut_ptr(), 1),
            14 => fmi3GetBoolean(c, vr.as_ptr(), n, flags.as_mut_ptr(), n),
            15 => fmi3GetString(c, vr.as_ptr(), n, [ptr::null(); 2].as_mut_ptr(), n),
            16 | 17 => fmi3SetFloat64(c, vr.as_ptr(), n, value.as_ptr(), n),
            18 => fmi3SetInt32(c, vr.as_ptr(), n, [random.below(6) as i32, -1].as_ptr(), n),
            19 => fmi3SetInt64(c, vr.as_ptr(), n, [random.below(6) as i64, i64::MAX].as_ptr(), n),
            20 => fmi3SetUInt64(c, [3u32].as_ptr(), 1, [random.below(6) as u64].as_ptr(), 1),
            21 => fmi3SetBoolean(c, vr.as_ptr(), n, [1u8, 0].as_ptr(), n),
            22 => fmi3GetFMUState(c, &mut round.state),
            23 if !round.state.is_null() => fmi3SetFMUState(c, round.state),
            24 => fmi3GetDirectionalDerivative(
                c,
                vr.as_ptr(),
                n,
                vr[1..].as_ptr(),
                1,
                value.as_ptr(),
                1,
                floats.as_mut_ptr(),
                n,
            ),
            25 => fmi3GetAdjointDerivative(
                c,
                vr.as_ptr(),
                n,
                vr[1..].as_ptr(),
                1,
                value.as_ptr(),
                n,
                floats.as_mut_ptr(),
                1,
            ),
            26 => fmi3UpdateDiscreteStates(
                c,
                &mut flags[0],
                &mut flags[1],
                &mut flags[2],
                &mut flags[3],
                &mut flags[4],
                &mut floats[0],
            ),
            27 => fmi3CompletedIntegratorStep(c, 0, &mut flags[0], &mut flags[1]),
            28 => fmi3GetContinuousStates(c, states.as_mut_ptr(), STATES),
            29 => fmi3GetContinuousStateDerivatives(c, states.as_mut_ptr(), STATES),
            30 => fmi3GetOutputDerivatives(c, vr.as_ptr(), n, [1, 1].as_ptr(), floats.as_mut_ptr(), n),
            31 => fmi3GetFloat32(c, vr.as_ptr(), n, ptr::null_mut(), 0),
            32 | 33 => {
                // some states close to where they are, and anything else
                fmi3GetContinuousStates(c, states.as_mut_ptr(), STATES);
                let k = random.below(STATES);
                let near = states[k] + [0.0, 1e-7, -1e-6][random.below(3)];
                let (vr, values) = ([table().states[k] as u32, vr[0]], [near, value[0]]);
                fmi3SetFloat64(c, vr.as_ptr(), n, values.as_ptr(), n)
            }
            _ => {
                let h = [1e-3, 1e-5, 0.0, -1.0, f64::NAN, 5e-3][random.below(6)];
                let mut last = f64::NAN;
                let at = round.time;
                let (event, rest) = flags.split_at_mut(1);
                let (terminate, early) = rest.split_at_mut(1);
                let status = fmi3DoStep(c, at, h, 1, &mut event[0], &mut terminate[0], &mut early[0], &mut last);
                if status == Status::Ok {
                    assert!(last.is_finite() && last >= at && last <= at + h, "{at} {h} {last}");
                    assert!(early[0] == 1 || (last - at - h).abs() <= 1e-12, "{at} {h} {last}");
                }
                status
            }
        }
    }
}

#[test]
fn calls_at_random_keep_all_promises() {
    let calls = std::env::var("CALLS").ok().and_then(|calls| calls.parse().ok()).unwrap_or(20_000);
    let seed = std::env::var("SEED").ok().and_then(|seed| seed.parse().ok()).unwrap_or(1);
    let mut random = Random(seed);
    let mut tally = [0usize; 6];
    for number in 0..calls / ROUND {
        let mut count = 0u64;
        let c = instance(&mut random, &raw mut count);
        assert!(!c.is_null());
        let mut round = Round { c, state: ptr::null_mut(), time: 0.0 };
        for _ in 0..ROUND {
            LOGGED.with_borrow_mut(Vec::clear);
            let status = call(&mut random, &mut round);
            tally[status as usize] += 1;
            assert!(status <= Status::Error, "{status:?}");
            let logged = LOGGED.with_borrow(Vec::len);
            assert!(status == Status::Ok || logged > 0, "round {number}: {status:?} without a message");
            let mut now = [f64::NAN];
            // SAFETY: one value of room
            let read = unsafe { fmi3GetFloat64(round.c, [table().rows.len() as u32].as_ptr(), 1, now.as_mut_ptr(), 1) };
            assert!(read == Status::Ok && now[0].is_finite(), "round {number}: the time is {now:?}");
            round.time = now[0];
        }
        // SAFETY: a live instance, the last use of it
        unsafe {
            assert_eq!(fmi3FreeFMUState(round.c, &mut round.state), Status::Ok);
            fmi3FreeInstance(round.c);
        }
    }
    // some of everything came about
    assert!(tally[..4].iter().filter(|&&count| count > 0).count() >= 3, "{tally:?}");
    assert!(tally[0] > calls / 10, "{tally:?}");
}
