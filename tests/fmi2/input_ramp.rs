//! Tests of `solver.input_ramp`: jumps of torques and imposed speeds become ramps over the following step.

use bevel_differential::fmi2::*;

use crate::common::{Host, assert_contains, reference};

/// Step of these tests [s]. It is a power of two, so that ramps between values with few binary digits are exact.
const STEP: f64 = 1.0 / 1024.0;
/// Inertia of the carrier [kg·m²]. Gears have almost none.
const CARRIER: f64 = 0.25;
/// Inertia of each wheel side [kg·m²].
const END: f64 = 0.5;

fn with_ramp(host: Host, ramps: bool) -> Host {
    assert_eq!(host.set_boolean("solver.input_ramp", i32::from(ramps)), Status::Ok);
    host
}

/// Creates a free differential at rest, with ideal gears without inertia, driven by torques.
fn at_rest(ramps: bool) -> Host {
    let host = with_ramp(Host::on_level(1), ramps);
    assert_eq!(host.set_integer("scene.carrier_drive", 2), Status::Ok);
    assert_eq!(host.set_integer("scene.start", 3), Status::Ok);
    assert_eq!(host.set_boolean("inertia.from_geometry", 0), Status::Ok);
    let names = ["inertia.carrier", "inertia.side_gear", "inertia.planet", "inertia.left_end", "inertia.right_end"];
    assert_eq!(host.set_many(&names, &[CARRIER, 1e-12, 1e-12, END, END]), Status::Ok);
    assert_eq!(host.set_many(&TORQUES, &[0.0; 3]), Status::Ok);
    assert_eq!(host.set("carrier.speed_command", 0.0), Status::Ok);
    host
}

const TORQUES: [&str; 3] = ["carrier.torque_command", "left.load_torque", "right.load_torque"];
/// Torques set by the host at the communication points [N·m].
const COURSE: [[f64; 3]; 6] = [
    [300.0, 100.0, 20.0],
    [-120.0, 100.0, 80.0],
    [40.0, -60.0, 0.0],
    [40.0, -60.0, 0.0],
    [500.0, 10.0, -30.0],
    [0.0, 0.0, 0.0],
];

/// Executes step `i`.
fn step(host: &Host, i: usize) {
    assert_eq!(host.step(i as f64 * STEP, STEP), Status::Ok, "{:?}", host.log());
}

fn set_derivative(host: &Host, name: &str, value: f64) {
    // SAFETY: a live component and one value each
    let status = unsafe { fmi2SetRealInputDerivatives(host.c, &reference(name), 1, &1, &value) };
    assert_eq!(status, Status::Ok, "{name}: {:?}", host.log());
}

/// Accelerations of the carrier and of half the speed difference of the wheels under torques [rad/s²].
fn accelerations([drive, left, right]: [f64; 3]) -> [f64; 2] {
    [(drive - left - right) / (CARRIER + 2.0 * END), (right - left) / (2.0 * END)]
}

#[test]
fn speeds_are_the_integral_of_ramped_torques_or_without_ramps_of_held_torques() {
    for ramps in [true, false] {
        let host = at_rest(ramps);
        host.start();
        let (mut expected, mut before) = ([0.0; 2], [0.0; 3]);
        for (i, torques) in COURSE.into_iter().enumerate() {
            assert_eq!(host.set_many(&TORQUES, &torques), Status::Ok);
            step(&host, i);
            let (from, to) = (accelerations(before), accelerations(torques));
            for k in 0..2 {
                expected[k] += STEP * if ramps { 0.5 * (from[k] + to[k]) } else { to[k] };
            }
            before = torques;
            let [carrier, left, right] = ["carrier.speed", "left.speed", "right.speed"].map(|name| host.get(name));
            for (found, expected) in [(carrier, expected[0]), (0.5 * (left - right), expected[1])] {
                assert!((found - expected).abs() < 1e-10, "{ramps}, step {i}: {found} instead of {expected} rad/s");
            }
        }
    }
}

#[test]
fn negated_torques_give_the_negated_motion_to_the_last_bit() {
    let [one, other] = [1.0, -1.0].map(|sign| {
        let host = at_rest(true);
        host.start();
        let mut bits = Vec::new();
        for (i, torques) in COURSE.into_iter().enumerate() {
            assert_eq!(host.set_many(&TORQUES, &torques.map(|torque| sign * torque)), Status::Ok);
            step(&host, i);
            let outputs = ["carrier.speed", "left.speed", "right.speed", "left.wheel_angle", "carrier.acceleration"];
            bits.extend(outputs.map(|name| (sign * host.get(name) + 0.0).to_bits()));
        }
        bits
    });
    assert_eq!(one, other);
}

/// Scenes with torques, imposed speeds and brakes: level of teeth, enumerations, switches, and inputs with their start
/// values and maximum changes. All values have few binary digits, so that ramps between them are exact.
type Scene = (i32, &'static [(&'static str, i32)], &'static [(&'static str, i32)], &'static [(&'static str, f64, f64)]);
const SCENES: [Scene; 4] = [
    (
        1,
        &[("scene.carrier_drive", 2)],
        &[],
        &[("carrier.torque_command", 1670.0, 64.0), ("left.load_torque", 835.0, 32.0)],
    ),
    (3, &[], &[], &[("carrier.speed_command", 50.0, 0.25), ("right.load_torque", 835.0, -32.0)]),
    (
        3,
        &[("scene.left_drive", 2)],
        &[("effects.half_shaft", 1)],
        &[("left.speed_command", 50.0, -0.25), ("right.load_torque", 835.0, 32.0)],
    ),
    (
        1,
        &[("scene.carrier_drive", 2)],
        &[("effects.wheel_brake", 1)],
        &[("left.brake_torque", 0.0, 256.0), ("right.brake_torque", 128.0, -16.0)],
    ),
];
/// Fractions of the maximum changes, at the start and at the communication points.
const PARTS: [f64; 7] = [0.0, 1.0, 1.0, 0.25, 0.75, 0.5, 0.0];

fn started((level, integers, booleans, inputs): Scene, ramps: bool) -> Host {
    let host = with_ramp(Host::on_level(level), ramps);
    for (name, value) in integers {
        assert_eq!(host.set_integer(name, *value), Status::Ok);
    }
    for (name, value) in booleans {
        assert_eq!(host.set_boolean(name, *value), Status::Ok);
    }
    for (name, start, _) in inputs {
        assert_eq!(host.set(name, *start), Status::Ok);
    }
    host.start();
    host
}

/// Sets the inputs to their values at the end of step `i`.
fn set_inputs(host: &Host, scene: Scene, i: usize) {
    for (name, start, change) in scene.3 {
        assert_eq!(host.set(name, start + change * PARTS[i + 1]), Status::Ok);
    }
}

/// Returns all outputs after each step of the scene from step `first` on, while inputs are set to their values at the
/// end of each step.
fn outputs_of_steps(host: &Host, scene: Scene, first: usize) -> Vec<Vec<u64>> {
    (first..PARTS.len() - 1)
        .map(|i| {
            set_inputs(host, scene, i);
            step(host, i);
            host.outputs()
        })
        .collect()
}

#[test]
fn a_ramp_equals_a_value_and_derivative_of_the_host_to_the_last_bit() {
    for scene in SCENES {
        let with_lines = started(scene, false);
        let lines: Vec<Vec<u64>> = (0..PARTS.len() - 1)
            .map(|i| {
                for (name, start, change) in scene.3 {
                    assert_eq!(with_lines.set(name, start + change * PARTS[i]), Status::Ok);
                    set_derivative(&with_lines, name, change * (PARTS[i + 1] - PARTS[i]) / STEP);
                }
                step(&with_lines, i);
                with_lines.outputs()
            })
            .collect();
        let host = started(scene, true);
        let ramps = outputs_of_steps(&host, scene, 0);
        assert!(ramps == lines, "{scene:?}");
        // only the option makes the difference
        assert!(outputs_of_steps(&started(scene, false), scene, 0) != lines, "{scene:?}");
        // inputs are read as they were set
        for (name, start, _) in scene.3 {
            assert_eq!(host.get(name), *start);
        }
    }
}

#[test]
fn reading_between_setting_and_stepping_shows_the_present_inputs_and_changes_nothing() {
    for scene in SCENES {
        let expected = outputs_of_steps(&started(scene, true), scene, 0);
        let host = started(scene, true);
        for (i, expected) in expected.iter().enumerate() {
            let before = host.outputs();
            set_inputs(&host, scene, i);
            assert!(host.outputs() == before, "{scene:?}: nothing acts before the step");
            step(&host, i);
            assert!(host.outputs() == *expected, "{scene:?}, step {i}");
        }
    }
}

#[test]
fn states_saved_before_a_step_contain_the_start_of_its_ramp() {
    for scene in SCENES {
        let expected = outputs_of_steps(&started(scene, true), scene, 0);
        let host = started(scene, true);
        for i in 0..3 {
            set_inputs(&host, scene, i);
            step(&host, i);
        }
        set_inputs(&host, scene, 3);
        let state = host.get_state();
        let bytes = host.serialize(state);
        assert!(outputs_of_steps(&host, scene, 3) == expected[3..], "{scene:?}");
        assert_eq!(host.set_state(state), Status::Ok);
        step(&host, 3);
        assert!(host.outputs() == expected[3] && outputs_of_steps(&host, scene, 4) == expected[4..], "{scene:?}");
        host.free_state(state);
        let other = Host::new();
        let (status, copy) = other.deserialize(&bytes);
        assert_eq!(status, Status::Ok, "{:?}", other.log());
        assert_eq!(other.serialize(copy), bytes);
        assert_eq!(other.set_state(copy), Status::Ok);
        other.free_state(copy);
        step(&other, 3);
        assert!(other.outputs() == expected[3] && outputs_of_steps(&other, scene, 4) == expected[4..], "{scene:?}");
        // a reset also switches the option off
        assert_eq!(other.reset(), Status::Ok);
        let unset = Host::new();
        other.start();
        unset.start();
        assert!(other.record_steps(0, 3) == unset.record_steps(0, 3));
    }
}

#[test]
fn inputs_with_derivatives_from_the_host_follow_these_and_others_ramp() {
    let torques = ["left.load_torque", "right.load_torque"];
    let host = at_rest(true);
    host.start();
    // the left load jumps to 100 N·m and rises, the right one ramps to 20 N·m; a slope of 0 also counts as a derivative
    for (i, slope) in [8192.0, 0.0].into_iter().enumerate() {
        let (left, right, before) = (host.get("left.wheel_speed"), host.get("right.wheel_speed"), host.get(torques[1]));
        set_derivative(&host, torques[0], slope);
        assert_eq!(host.set_many(&torques, &[100.0, 20.0]), Status::Ok);
        step(&host, i);
        let means = [0.0, 100.0 + 0.5 * slope * STEP, 0.5 * (before + 20.0)];
        let [carrier, difference] = accelerations(means).map(|acceleration| acceleration * STEP);
        let found = [host.get("left.wheel_speed") - left, host.get("right.wheel_speed") - right];
        assert!((found[0] - carrier - difference).abs() < 1e-10, "{found:?}");
        assert!((found[1] - carrier + difference).abs() < 1e-10, "{found:?}");
        assert_eq!([host.get(torques[0]), host.get(torques[1])], [100.0 + slope * STEP, 20.0]);
    }
    // without a derivative, the left load ramps from the value that its line has reached
    let before = host.get("left.wheel_speed");
    assert_eq!(host.set(torques[0], 0.0), Status::Ok);
    step(&host, 2);
    let [carrier, difference] = accelerations([0.0, 50.0, 20.0]).map(|acceleration| acceleration * STEP);
    assert!((host.get("left.wheel_speed") - before - carrier - difference).abs() < 1e-10);
}

#[test]
fn locks_jump_and_inputs_that_never_change_do_not_ramp() {
    let runs = [true, false].map(|ramps| {
        let host = with_ramp(Host::on_level(1), ramps);
        assert_eq!(host.set_integer("scene.carrier_drive", 2), Status::Ok);
        // values set before the end of initialisation are start values
        assert_eq!(host.set_many(&TORQUES, &[200.0, 140.0, 20.0]), Status::Ok);
        host.start();
        let commands = [0.0, 1.0, 1.0, 0.25];
        let steps = commands.into_iter().enumerate().map(|(i, command)| {
            assert_eq!(host.set("lock.command", command), Status::Ok);
            step(&host, i);
            host.outputs()
        });
        let steps: Vec<Vec<u64>> = steps.collect();
        (steps, host.get("left.speed") - host.get("right.speed"))
    });
    assert!(runs[0].0 == runs[1].0);
    assert_ne!(runs[0].1, 0.0, "the loads differ, so that the lock has something to hold");
}

#[test]
fn a_host_that_integrates_is_warned_that_the_option_changes_nothing() {
    let speeds = [true, false].map(|ramps| {
        let host = with_ramp(Host::for_exchange(), ramps);
        assert_eq!(host.set_integer("scene.carrier_drive", 2), Status::Ok);
        host.start_exchange();
        assert_eq!(host.set("carrier.torque_command", 2000.0), Status::Ok);
        if ramps {
            let said: Vec<String> = host.log().into_iter().map(|line| line.message).collect();
            assert_contains(&said.join("\n"), &["solver.input_ramp", "changes nothing", "co-simulation"]);
        }
        host.get("carrier.acceleration").to_bits()
    });
    assert_eq!(speeds[0], speeds[1]);
}

/// Stiffness of the host's spring at the left wheel [N·m/rad].
const SPRING: f64 = 4000.0;
/// Damping of the host's damper at the left wheel [N·m·s/rad].
const DAMPER: f64 = 20.0;

/// Angle, speed and torque of the left wheel at the start and after each of `count` steps of `h` [s]. The host has a
/// spring and a damper, which start from a twist of 1 mrad. The carrier does not move, so the right wheel turns
/// backward.
fn coupled(ramps: bool, h: f64, count: usize) -> Vec<[f64; 3]> {
    let host = at_rest(ramps);
    assert_eq!(host.set_integer("scene.carrier_drive", 1), Status::Ok);
    host.start();
    let start = host.get("left.wheel_angle");
    let read = |torque: f64| [host.get("left.wheel_angle") - start, host.get("left.wheel_speed"), torque];
    let mut all = vec![read(0.0)];
    for i in 0..count {
        let [angle, speed, _] = all[i];
        let torque = SPRING * (angle + 1e-3) + DAMPER * speed;
        assert_eq!(host.set("left.load_torque", torque), Status::Ok);
        assert_eq!(host.step(i as f64 * h, h), Status::Ok, "{:?}", host.log());
        all.push(read(torque));
    }
    all
}

/// Angle, speed and torque like [`coupled`], from the recursion of a single inertia of 1 kg·m² under a torque that is
/// ramped or held.
fn recursion(ramps: bool, h: f64, count: usize) -> Vec<[f64; 3]> {
    let mut all = vec![[0.0; 3]];
    for i in 0..count {
        let [angle, speed, last] = all[i];
        let torque = SPRING * (angle + 1e-3) + DAMPER * speed;
        let first = if ramps { last } else { torque };
        let moved = angle + h * speed - h * h * (first / 3.0 + torque / 6.0);
        all.push([moved, speed - 0.5 * h * (first + torque), torque]);
    }
    all
}

#[test]
fn a_spring_of_the_host_becomes_unstable_at_the_step_size_given_by_the_eigenvalues() {
    // Limits from Jury's criterion on the characteristic polynomials, with C = hc/J and K = h²k/J. Held inputs need K <
    // 2C and C < 2, and ramps need K (1 - C/6) < C (1 - C/2). With c = 20, k = 4000 and J = 1, these limits are 10 ms
    // and 4.84 ms.
    let excess = |h: f64| h * SPRING * (1.0 - h * DAMPER / 6.0) - DAMPER * (1.0 - 0.5 * h * DAMPER);
    let (mut low, mut high) = (0.0, 0.01);
    while high - low > 1e-12 {
        let middle = 0.5 * (low + high);
        if excess(middle) < 0.0 { low = middle } else { high = middle }
    }
    for (ramps, limit) in [(false, 2.0 * DAMPER / SPRING), (true, low)] {
        for part in [0.9, 1.1] {
            let (h, count) = (part * limit, 800);
            let (found, expected) = (coupled(ramps, h, count), recursion(ramps, h, count));
            let size =
                |from: usize| expected[from..from + 20].iter().map(|at| (at[0] + 1e-3).abs()).fold(0.0, f64::max);
            for (found, expected) in found.iter().zip(&expected) {
                let off = (0..2).map(|k| (found[k] - expected[k]).abs()).fold(0.0, f64::max);
                let scale = size(0) + size(count - 20);
                assert!(off < 1e-6 * scale, "{ramps}, {h}: {found:?} instead of {expected:?}");
            }
            let growth = size(count - 20) / size(0);
            assert!((growth > 10.0) == (part > 1.0) && (growth < 0.1) == (part < 1.0), "{ramps}, {h}: × {growth}");
        }
    }
}
