//! Tests that a stack of 128 KiB is enough for every level, every effect, every method, and both kinds of instances.

use std::ptr;

use bevel_differential::fmi2::*;
use bevel_differential::model::STATES;
use bevel_differential::variables::{Access, table};

use crate::common::{Host, reference};

const STACK: usize = 128 * 1024;
const SOLID: i32 = 4;

/// A scene: integers, enumerations and switches by name.
type Scene = Vec<(&'static str, i32)>;

fn set(host: &Host, scene: &Scene) {
    for &(name, value) in scene {
        let status = match table().rows[reference(name) as usize].access {
            Access::Boolean(_) => host.set_boolean(name, value),
            _ => host.set_integer(name, value),
        };
        assert_eq!(status, Status::Ok, "{name}: {:?}", host.log());
    }
    let given = [
        ("inertia.left_end", 0.5),
        ("inertia.right_end", 0.5),
        ("limited_slip.preload", 50.0),
        ("limited_slip.torque_coefficient", 0.1),
        ("bearing_drag.carrier_torque", 0.5),
        ("bearing_drag.carrier_churning", 1e-4),
        ("bearing_drag.side_torque", 0.2),
    ];
    let (names, values): (Vec<&str>, Vec<f64>) = given.into_iter().unzip();
    assert_eq!(host.set_many(&names, &values), Status::Ok);
}

fn starts(scene: &Scene) -> bool {
    let host = Host::new();
    set(&host, scene);
    [host.setup(), host.enter(), host.exit()] == [Status::Ok; 3]
}

/// Creates a scene with gear contact `level` and every effect that can be combined with it.
fn with_all_effects(level: i32) -> Scene {
    let mut scene = vec![("scene.gear_contact", level), ("geometry.planet_count", 4), ("solid.facets", 8)];
    if !starts(&scene) {
        scene[1].1 = 2;
    }
    assert!(starts(&scene), "level {level}");
    for row in table().rows.iter().filter(|row| row.name.starts_with("effects.")) {
        if matches!(row.access, Access::Boolean(_)) {
            scene.push((row.name, 1));
            if !starts(&scene) {
                scene.pop();
            }
        }
    }
    scene
}

/// Calls every function for the kind of instance once.
fn exercise_all_functions(kind: i32, scene: &Scene) {
    let host = if kind == MODEL_EXCHANGE { Host::for_exchange() } else { Host::new() };
    let (load, speed) = (reference("left.load_torque"), reference("left.speed"));
    // a failed initialisation first, because its messages are the longest
    assert_eq!(host.set("geometry.module", 4.5), Status::Ok);
    assert_eq!([host.enter(), host.exit()], [Status::Ok, Status::Error]);
    assert_eq!(host.reset(), Status::Ok);
    set(&host, scene);
    assert_eq!([host.setup(), host.enter()], [Status::Ok; 2]);
    let derive = || {
        let mut slope = f64::NAN;
        // SAFETY: a live component, one value each
        let status = unsafe { fmi2GetDirectionalDerivative(host.c, &speed, 1, &load, 1, &1.0, &mut slope) };
        assert_eq!(status, Status::Ok, "{:?}", host.log());
    };
    derive();
    assert_eq!(host.exit(), Status::Ok, "{:?}", host.log());
    host.outputs();
    if kind == MODEL_EXCHANGE {
        host.update();
        let (mut x, mut rates, mut indicators) = ([0.0; STATES], [0.0; STATES], [0.0; EVENT_INDICATORS]);
        // SAFETY: a live component and memory for these counts
        let statuses = unsafe {
            [
                fmi2EnterContinuousTimeMode(host.c),
                fmi2GetContinuousStates(host.c, x.as_mut_ptr(), STATES),
                fmi2GetDerivatives(host.c, rates.as_mut_ptr(), STATES),
                fmi2SetTime(host.c, 1e-7),
                fmi2SetContinuousStates(host.c, x.as_ptr(), STATES),
                fmi2GetEventIndicators(host.c, indicators.as_mut_ptr(), EVENT_INDICATORS),
                fmi2CompletedIntegratorStep(host.c, 1, &mut 0, &mut 0),
                fmi2EnterEventMode(host.c),
            ]
        };
        assert_eq!(statuses, [Status::Ok; 8], "{:?}", host.log());
        host.update();
    } else {
        // SAFETY: a live component, one value each
        let set = unsafe { fmi2SetRealInputDerivatives(host.c, &load, 1, &1, &1.0) };
        assert_eq!(set, Status::Ok);
        host.steps(0.0, 1e-4, 3);
        // SAFETY: as above
        let status = unsafe { fmi2GetRealOutputDerivatives(host.c, &speed, 1, &1, &mut 0.0) };
        assert_eq!(status, Status::Ok, "{:?}", host.log());
    }
    derive();
    host.outputs();
    let state = host.get_state();
    let bytes = host.serialize(state);
    let (status, copy) = host.deserialize(&bytes);
    assert_eq!(status, Status::Ok, "{:?}", host.log());
    assert_eq!(host.set_state(copy), Status::Ok);
    assert_eq!(host.deserialize(&bytes[1..]), (Status::Error, ptr::null_mut()));
    host.free_state(state);
    host.free_state(copy);
    assert_eq!(host.terminate(), Status::Ok);
}

fn with_a_small_stack(kind: i32, scene: Scene) {
    let thread =
        std::thread::Builder::new().stack_size(STACK).spawn(move || exercise_all_functions(kind, &scene)).unwrap();
    thread.join().unwrap();
}

#[test]
fn a_small_stack_is_enough_for_every_level_with_all_its_effects() {
    for level in 1..=SOLID {
        let scene = with_all_effects(level);
        let effects = scene.iter().filter(|(name, on)| name.starts_with("effects.") && *on == 1).count();
        let least = [0, 4, 4, 10, 4][level as usize];
        assert!(effects >= least, "level {level} takes only {scene:?}");
        for kind in [MODEL_EXCHANGE, CO_SIMULATION] {
            with_a_small_stack(kind, scene.clone());
        }
    }
}

#[test]
fn a_small_stack_is_enough_for_the_history_of_many_teeth() {
    let teeth = [("geometry.planet_count", 4), ("geometry.planet_teeth", 200), ("geometry.side_teeth", 200)];
    let scene: Scene = teeth.into_iter().chain([("effects.strength", 1)]).collect();
    for kind in [MODEL_EXCHANGE, CO_SIMULATION] {
        with_a_small_stack(kind, scene.clone());
    }
}

#[test]
fn a_small_stack_is_enough_for_every_method() {
    let Access::Enumeration(methods, ..) = table().rows[reference("solver.method") as usize].access else {
        panic!("solver.method is not an enumeration")
    };
    // the size of the matrices depends on the method; teeth with all effects have the most degrees of freedom
    let with_all_effects = with_all_effects(3);
    for choice in methods.choices {
        let mut scene = with_all_effects.clone();
        scene.push(("solver.method", choice.value));
        let scene = if starts(&scene) { scene } else { vec![("solver.method", choice.value)] };
        with_a_small_stack(CO_SIMULATION, scene);
    }
}
