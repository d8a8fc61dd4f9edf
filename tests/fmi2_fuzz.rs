//! Thousands of calls at random, right and wrong ones: nothing panics, and after a reset all is as new.

mod common;

use std::ptr;

use bevel_differential::fmi2::*;
use bevel_differential::variables::table;
use common::Host;

/// Xorshift generator of Marsaglia (2003).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    fn below(&mut self, n: usize) -> usize {
        (self.next() >> 11) as usize % n
    }

    fn chance(&mut self, one_in: usize) -> bool {
        self.below(one_in) == 0
    }

    fn pick<T: Copy>(&mut self, from: &[T]) -> T {
        from[self.below(from.len())]
    }

    fn real(&mut self) -> f64 {
        let any = f64::from_bits(self.next());
        let near = (self.below(2001) as f64 - 1000.0) * 10f64.powi(self.below(9) as i32 - 6);
        self.pick(&[near, near, near, any, 0.0, -0.0, f64::NAN, f64::INFINITY, f64::MIN_POSITIVE])
    }

    fn references(&mut self) -> Vec<u32> {
        let rows = table().rows.len();
        (0..self.below(4)).map(|_| if self.chance(8) { self.next() as u32 } else { self.below(rows) as u32 }).collect()
    }
}

/// What the host holds besides the component.
#[derive(Default)]
struct Held {
    states: Vec<FmuState>,
    blob: Vec<u8>,
    good_steps: usize,
}

/// One call at random.
#[allow(clippy::too_many_lines)] // one arm per function
fn call(r: &mut Random, c: ComponentPointer, held: &mut Held) {
    let references = r.references();
    let n = references.len();
    let reals: Vec<f64> = (0..n).map(|_| r.real()).collect();
    let integers: Vec<i32> =
        (0..n).map(|_| if r.chance(4) { r.next() as i32 } else { r.below(40) as i32 - 4 }).collect();
    let vr = if r.chance(20) { ptr::null() } else { references.as_ptr() };
    let (mut room, mut integer_room) = ([0.0; 4], [0; 4]);
    let state = if held.states.is_empty() || r.chance(10) { ptr::null_mut() } else { r.pick(&held.states) };
    let kind = r.below(6) as i32 - 1;
    // SAFETY: live component and states, arrays of the length told, or NULL, which is legal to pass
    unsafe {
        match r.below(29) {
            0 => drop(fmi2SetDebugLogging(c, r.below(2) as i32, r.below(2), &c"logStatusError".as_ptr())),
            1 => drop(fmi2SetupExperiment(c, r.below(2) as i32, r.real(), r.real(), r.below(2) as i32, r.real())),
            2 => drop(fmi2EnterInitializationMode(c)),
            3 => drop(fmi2ExitInitializationMode(c)),
            4 if r.chance(10) => drop(fmi2Terminate(c)),
            5 if r.chance(5) => drop(fmi2Reset(c)),
            6 | 7 => drop(fmi2SetReal(c, vr, n, reals.as_ptr())),
            8 => drop(fmi2SetInteger(c, vr, n, integers.as_ptr())),
            9 => drop(fmi2SetBoolean(c, vr, n, integers.as_ptr())),
            10 => drop(fmi2SetString(c, vr, n, ptr::null())),
            11 | 12 => drop(fmi2GetReal(c, vr, n, room.as_mut_ptr())),
            13 => drop(fmi2GetInteger(c, vr, n, integer_room.as_mut_ptr())),
            14 => drop(fmi2GetBoolean(c, vr, n, integer_room.as_mut_ptr())),
            15 => drop(fmi2GetString(c, vr, n, ptr::null_mut())),
            16 if held.states.len() < 20 => {
                let mut made = ptr::null_mut();
                if fmi2GetFMUstate(c, &mut made) == Status::Ok {
                    held.states.push(made);
                }
            }
            16 => {
                let mut old = held.states[r.below(20)];
                fmi2GetFMUstate(c, &mut old);
            }
            17 => drop(fmi2SetFMUstate(c, state)),
            18 => {
                let mut size = 0;
                if fmi2SerializedFMUstateSize(c, state, &mut size) == Status::Ok {
                    held.blob = vec![0; size];
                    fmi2SerializeFMUstate(c, state, held.blob.as_mut_ptr().cast(), size);
                }
            }
            19 => {
                let mut blob = held.blob.clone();
                if !blob.is_empty() && r.chance(2) {
                    let at = r.below(blob.len());
                    blob[at] ^= r.next() as u8;
                }
                let length = if r.chance(4) { r.below(blob.len() + 1) } else { blob.len() };
                let mut made = ptr::null_mut();
                if fmi2DeSerializeFMUstate(c, blob.as_ptr().cast(), length, &mut made) == Status::Ok {
                    held.states.push(made);
                }
            }
            20 if r.chance(4) && !held.states.is_empty() => {
                let at = r.below(held.states.len());
                let mut gone = held.states.swap_remove(at);
                fmi2FreeFMUstate(c, &mut gone);
            }
            21 => drop(fmi2GetDirectionalDerivative(c, vr, n, vr, n, reals.as_ptr(), room.as_mut_ptr())),
            22 => drop(fmi2SetRealInputDerivatives(c, vr, n, integers.as_ptr(), reals.as_ptr())),
            23 => drop(fmi2GetRealOutputDerivatives(c, vr, n, integers.as_ptr(), room.as_mut_ptr())),
            24 => drop(fmi2CancelStep(c)),
            25 => drop(fmi2GetStatus(c, kind, &mut Status::Ok)),
            26 => drop(fmi2GetStringStatus(c, kind, &mut ptr::null())),
            27 => drop((fmi2GetIntegerStatus(c, kind, &mut 0), fmi2GetBooleanStatus(c, kind, &mut 0))),
            _ => {
                let mut now = 0.0;
                fmi2GetRealStatus(c, LAST_SUCCESSFUL_TIME, &mut now);
                let point = if r.chance(10) { r.real() } else { now };
                let h = r.pick(&[1e-4, 1e-4, 1e-5, 3e-4, 0.0, -1.0, f64::NAN, 1e-300]);
                let status = fmi2DoStep(c, point, h, r.below(2) as i32);
                held.good_steps += usize::from(status == Status::Ok);
            }
        }
    }
}

#[test]
fn three_thousand_random_calls_never_panic_and_a_reset_makes_all_new() {
    let plain = Host::new();
    plain.start();
    let expected = plain.journey(0, 3);
    for seed in 1..=4 {
        let mut random = Random(seed * 0x9e37_79b9_7f4a_7c15);
        let (host, mut held) = (Host::new(), Held::default());
        for i in 0..3000 {
            call(&mut random, host.c, &mut held);
            // wild parameters seldom start: begin anew now and then, so that steps are taken too
            if i % 100 == 0 {
                host.reset();
                if i % 200 == 0 {
                    host.enter();
                    host.exit();
                }
            }
        }
        // SAFETY: a live component
        unsafe { fmi2SetDebugLogging(host.c, 1, 0, ptr::null()) };
        assert!(host.log().iter().all(|line| !line.message.contains("internal error")), "seed {seed}");
        assert!(held.good_steps > 30, "seed {seed}: only {} steps", held.good_steps);
        held.states.into_iter().for_each(|state| host.free_state(state));
        assert_eq!(host.reset(), Status::Ok);
        host.start();
        assert!(host.journey(0, 3) == expected, "seed {seed}");
    }
}
