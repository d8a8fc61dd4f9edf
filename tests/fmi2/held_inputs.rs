//! Tests of inputs that the host holds during each communication step and changes at the next point, as a staircase.

use bevel_differential::fmi2::Status;

use crate::common::Host;

const H: f64 = 1e-3;

/// Value that the host sets at communication point `k`.
type Staircase = fn(usize) -> f64;

/// Slow sine with an amplitude of 100 N·m.
fn sine(k: usize) -> f64 {
    835.0 + 100.0 * (std::f64::consts::TAU * 2.0 * k as f64 * H).sin()
}

/// Creates a turn under loads with contact law `law`, solver `method` and relative `tolerance`.
fn turn(law: i32, method: i32, tolerance: f64) -> Host {
    let host = Host::new();
    assert_eq!(host.set_integer("contact.law", law), Status::Ok);
    assert_eq!(host.set_integer("scene.planet_spin", 2), Status::Ok);
    assert_eq!(host.set_integer("solver.method", method), Status::Ok);
    assert_eq!(host.set_many(&["spin.command", "solver.relative_tolerance"], &[3.5, tolerance]), Status::Ok);
    host.start();
    host
}

/// Steps from point `first` to `last` and returns the outputs after each step. Before each step, calls `before`, in
/// which the host may read outputs.
fn drive(host: &Host, [first, last]: [usize; 2], torque: Staircase, before: impl Fn(&Host)) -> Vec<Vec<u64>> {
    (first..last)
        .map(|k| {
            assert_eq!(host.set("left.load_torque", torque(k)), Status::Ok);
            before(host);
            assert_eq!(host.step(k as f64 * H, H), Status::Ok, "{:?}", host.log());
            host.outputs()
        })
        .collect()
}

/// Mean numbers of evaluations and rejected attempts per communication step, from step 100 to step 200.
fn cost(host: &Host, torque: Staircase) -> [f64; 2] {
    let counts = || ["solver.rhs_calls", "solver.rejected"].map(|name| host.get(name));
    drive(host, [0, 100], torque, |_| {});
    let before = counts();
    drive(host, [100, 200], torque, |_| {});
    let after = counts();
    [0, 1].map(|i| (after[i] - before[i]) / 100.0)
}

#[test]
fn steps_after_a_jump_start_with_sizes_that_were_right_after_earlier_jumps() {
    for (law, most) in [(1, 80.0), (2, 95.0)] {
        let [evaluations, rejected] = cost(&turn(law, 1, 1e-6), sine);
        // a step size that is divided until it fits, and then grows, needs about 130 evaluations and 5 rejected
        // attempts
        assert!(evaluations < most && rejected < 0.5, "law {law}: {evaluations} evaluations, {rejected} rejected");
    }
}

#[test]
fn jumps_far_below_the_tolerance_do_not_shorten_steps() {
    for law in [1, 2] {
        let [constant, _] = cost(&turn(law, 1, 1e-6), |_| 835.0);
        let [tiny, _] = cost(&turn(law, 1, 1e-6), |k| 835.0 + 835e-9 * (k % 7) as f64);
        assert!(tiny < 1.9 * constant, "law {law}: {tiny} evaluations, {constant} with constant inputs");
    }
}

#[test]
fn results_with_held_inputs_are_within_the_tolerance() {
    let names = ["left.speed", "right.speed", "left.tangential_force", "planet[1].left_normal_force", "heat.contact"];
    for (law, allowed) in [(1, [1e-6, 1e-6, 3e-6, 3e-6, 3e-5]), (2, [1e-6, 1e-6, 3e-6, 3e-6, 5e-5])] {
        // the reference is Radau IIA with a tolerance tighter by four orders of magnitude
        let [host, reference] = [turn(law, 1, 1e-6), turn(law, 3, 1e-10)];
        let (mut largest, mut errors) = ([0.0f64; 5], [0.0f64; 5]);
        for k in 0..120 {
            for host in [&host, &reference] {
                drive(host, [k, k + 1], sine, |_| {});
            }
            for (i, name) in names.iter().enumerate() {
                let expected = reference.get(name);
                largest[i] = largest[i].max(expected.abs());
                errors[i] = errors[i].max((host.get(name) - expected).abs());
            }
        }
        for i in 0..names.len() {
            let error = errors[i] / largest[i];
            assert!(error < allowed[i], "law {law}: {} is off by {error:e}", names[i]);
        }
    }
}

#[test]
fn reading_between_set_and_step_changes_nothing() {
    let quiet = drive(&turn(1, 1, 1e-6), [0, 40], sine, |_| {});
    let read = drive(&turn(1, 1, 1e-6), [0, 40], sine, |host| {
        let _ = host.outputs();
    });
    assert_eq!(quiet, read);
}

#[test]
fn the_memory_of_jumps_is_part_of_the_state() {
    let host = turn(2, 1, 1e-6);
    drive(&host, [0, 60], sine, |_| {});
    let saved = host.get_state();
    let bytes = host.serialize(saved);
    let first = drive(&host, [60, 90], sine, |_| {});
    assert_eq!(host.set_state(saved), Status::Ok);
    assert_eq!(drive(&host, [60, 90], sine, |_| {}), first);
    host.free_state(saved);
    // in another instance, whose step-size memory is empty
    let other = turn(2, 1, 1e-6);
    let (status, state) = other.deserialize(&bytes);
    assert_eq!((status, other.set_state(state)), (Status::Ok, Status::Ok));
    assert_eq!(drive(&other, [60, 90], sine, |_| {}), first);
    other.free_state(state);
}

#[test]
fn rounding_of_communication_times_does_not_change_steps() {
    let (exact, rounded) = (turn(1, 1, 1e-6), turn(1, 1, 1e-6));
    let mut time = 0.0;
    for k in 0..300 {
        drive(&exact, [k, k + 1], sine, |_| {});
        assert_eq!(rounded.set("left.load_torque", sine(k)), Status::Ok);
        assert_eq!(rounded.step(time, H), Status::Ok, "{:?}", rounded.log());
        time += H;
    }
    assert_eq!(exact.get("solver.steps"), rounded.get("solver.steps"));
    let error = (exact.get("heat.contact") - rounded.get("heat.contact")).abs() / exact.get("heat.contact");
    assert!(error < 1e-9, "{error:e}");
}
