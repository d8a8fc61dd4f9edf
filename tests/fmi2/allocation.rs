//! Tests that setting inputs, stepping and reading outputs allocate nothing after initialisation.

use bevel_differential::fmi2::*;
use bevel_differential::model::{EFFECTS, STATES};
use bevel_differential::variables::{Access, table};

use crate::common::counting_allocator::allocations;
use crate::common::{Host, reference};

/// Scenes by the values they set in addition to those of [`Host::on_level`]: every level, law, method and effect, and
/// effects combined.
fn scenes() -> Vec<(String, Vec<(&'static str, f64)>)> {
    let level = |level: f64| vec![("scene.gear_contact", level)];
    let mut scenes: Vec<(String, Vec<(&'static str, f64)>)> =
        (1..=4).map(|number| (format!("level {number}"), level(f64::from(number)))).collect();
    for law in 1..=3 {
        scenes.push((format!("law {law}"), vec![("contact.law", f64::from(law))]));
    }
    for method in 1..=3 {
        let with = |extra: &[(&'static str, f64)]| [&[("solver.method", f64::from(method))], extra].concat();
        scenes.push((format!("method {method}"), with(&[])));
        scenes.push((format!("method {method}, solid"), with(&level(4.0))));
        scenes.push((format!("method {method}, pins"), with(&[("effects.pin_compliance", 1.0)])));
    }
    let switched = |number: usize| {
        let effect = &EFFECTS[number];
        effect.switch.map(|name| (name, 1.0)).into_iter().chain(effect.example.iter().copied())
    };
    for (number, effect) in EFFECTS.iter().enumerate() {
        scenes.push((effect.name.into(), switched(number).collect()));
    }
    let together = |method: f64| {
        let excluded = ["lock", "tooth_fault"];
        let all = (0..EFFECTS.len()).filter(|&number| !excluded.contains(&EFFECTS[number].name)).flat_map(switched);
        all.chain([("contact.law", 2.0), ("solver.method", method)]).collect()
    };
    for method in [1.0, 2.0, 3.0] {
        scenes.push((format!("effects together, method {method}"), together(method)));
    }
    scenes
}

/// Sets a variable of any type.
fn set(host: &Host, name: &'static str, value: f64) {
    let status = match table().rows[reference(name) as usize].access {
        Access::Integer(_) | Access::Enumeration(..) => host.set_integer(name, value as i32),
        Access::Boolean(_) => host.set_boolean(name, value as i32),
        _ => host.set(name, value),
    };
    assert_eq!(status, Status::Ok, "{name}: {:?}", host.log());
}

#[test]
fn setting_stepping_and_reading_allocate_nothing_with_any_level_law_method_and_effect() {
    for (name, values) in scenes() {
        let host = Host::on_level(3);
        values.iter().for_each(|&(name, value)| set(&host, name, value));
        host.start();
        let outputs: Vec<u32> = table().real_outputs().collect();
        let (mut read, mut slope) = (vec![f64::NAN; outputs.len()], f64::NAN);
        let inputs = [reference("left.load_torque"), reference("right.load_torque"), reference("contact.damping")];
        // the log reports once that ideal gears do not depend on this value
        assert_eq!(host.set("contact.damping", 5e4 + 1.0), Status::Ok);
        let (mut counts, mut silent) = ([0; 5], 0);
        let mut ok = true;
        for i in 0..20 {
            let t = f64::from(i) * 1e-3;
            let loads = [800.0 + 50.0 * (300.0 * t).sin(), 800.0, 5e4 + t];
            // SAFETY, for all: a live component and arrays of these lengths
            let mut calls: [&mut dyn FnMut() -> Status; 5] = [
                &mut || unsafe { fmi2SetReal(host.c, inputs.as_ptr(), 3, loads.as_ptr()) },
                &mut || unsafe { fmi2SetRealInputDerivatives(host.c, inputs.as_ptr(), 1, &1, &2e4) },
                &mut || unsafe { fmi2DoStep(host.c, t, 1e-3, 1) },
                &mut || unsafe { fmi2GetRealOutputDerivatives(host.c, outputs.as_ptr(), 1, &1, &mut slope) },
                &mut || unsafe { fmi2GetReal(host.c, outputs.as_ptr(), outputs.len(), read.as_mut_ptr()) },
            ];
            for (call, count) in calls.iter_mut().zip(&mut counts) {
                let (before, said) = (allocations(), host.log_length());
                ok &= call() == Status::Ok;
                // a message, which is logged once, needs memory
                let allocated = allocations() - before;
                if host.log_length() == said {
                    *count += allocated;
                    silent += 1;
                }
            }
        }
        assert!(silent > 90, "{name}: {:?}", host.log());
        assert!(ok && read.iter().all(|v| v.is_finite()), "{name}: {:?}", host.log());
        assert_eq!(counts, [0; 5], "{name}: set, set derivatives, step, get derivatives, get");
    }
}

#[test]
fn stepping_with_held_inputs_allocates_nothing() {
    let host = Host::on_level(3);
    host.start();
    let before = allocations();
    let mut ok = true;
    for i in 0..500 {
        // SAFETY: a live component
        ok &= unsafe { fmi2DoStep(host.c, f64::from(i) * 1e-4, 1e-4, 1) } == Status::Ok;
    }
    assert_eq!((ok, allocations() - before), (true, 0), "{:?}", host.log());
}

#[test]
fn model_exchange_allocates_nothing() {
    let host = Host::for_exchange();
    host.start_exchange();
    let (mut states, mut rates) = ([0.0; STATES], [0.0; STATES]);
    let (mut indicators, mut event, mut end) = ([0.0; EVENT_INDICATORS], 0, 0);
    let before = allocations();
    let mut ok = true;
    for i in 1..50 {
        // SAFETY: a live component and arrays of these lengths
        unsafe {
            ok &= fmi2GetContinuousStates(host.c, states.as_mut_ptr(), STATES) == Status::Ok;
            ok &= fmi2GetDerivatives(host.c, rates.as_mut_ptr(), STATES) == Status::Ok;
            states.iter_mut().zip(&rates).for_each(|(x, rate)| *x += 1e-8 * rate);
            ok &= fmi2SetTime(host.c, 1e-8 * f64::from(i)) == Status::Ok;
            ok &= fmi2SetContinuousStates(host.c, states.as_ptr(), STATES) == Status::Ok;
            ok &= fmi2GetEventIndicators(host.c, indicators.as_mut_ptr(), EVENT_INDICATORS) == Status::Ok;
            ok &= fmi2CompletedIntegratorStep(host.c, 1, &mut event, &mut end) == Status::Ok;
        }
    }
    assert!(ok, "{:?}", host.log());
    assert_eq!(allocations() - before, 0);
}

#[test]
fn overwriting_a_state_allocates_nothing() {
    let host = Host::on_level(3);
    host.start();
    let mut state = host.get_state();
    let before = allocations();
    // SAFETY: a live component and a live state
    let statuses = unsafe { [fmi2GetFMUstate(host.c, &mut state), fmi2SetFMUstate(host.c, state)] };
    assert_eq!((statuses, allocations() - before), ([Status::Ok; 2], 0));
    host.free_state(state);
}
