//! Initialisation of instances with random scenes and effects.

use bevel_differential::instance::{EVENT_INDICATORS, Kind, Status};
use bevel_differential::model::STATES;
use bevel_differential::variables::{Access, index_of, table};
use fastrand::Rng;

use super::instance::FuzzedInstance;
use crate::random::Draws;

/// Number of scenes that are tried before the study's scene is used.
const TRIES: usize = 4;
/// Integers and enumerations that define a scene.
const CHOICES: [&str; 9] = [
    "scene.gear_contact",
    "scene.carrier_drive",
    "scene.left_drive",
    "scene.right_drive",
    "scene.planet_spin",
    "scene.start",
    "contact.law",
    "contact.damping_model",
    "solver.method",
];
/// Level of solid teeth, which are the most expensive.
const SOLID: i32 = 4;

/// Brings a new or reset instance to a running simulation. Returns true on success.
pub fn start(instance: &FuzzedInstance, r: &mut Rng) -> bool {
    for attempt in 0..=TRIES {
        // SAFETY: a live component
        unsafe { (instance.interface.reset)(instance.component) };
        if attempt < TRIES {
            draw(instance, r);
        }
        if initialised(instance) {
            return true;
        }
    }
    false
}

/// Initialises an instance and brings it to the mode in which steps are possible. Returns true on success.
fn initialised(instance: &FuzzedInstance) -> bool {
    // SAFETY: a live component
    let is_initialised = unsafe { (instance.interface.initialise)(instance.component) } == [Status::Ok; 2];
    if is_initialised {
        // SAFETY: as above
        unsafe { (instance.interface.run)(instance.component, instance.options.kind) };
    }
    is_initialised
}

fn draw(instance: &FuzzedInstance, r: &mut Rng) {
    let mut integers: Vec<(&str, i32)> = vec![("geometry.planet_count", 2 + r.below(3) as i32), ("solid.facets", 4)];
    for name in CHOICES {
        let Some(Access::Enumeration(kind, ..)) = index_of(name).map(|i| table().rows[i].access) else { continue };
        if r.chance(2) {
            let value = kind.choices[r.below(kind.choices.len())].value;
            let dear = name == "scene.gear_contact" && value == SOLID && !r.chance(8);
            integers.push((name, if dear { 1 } else { value }));
        }
    }
    // solid teeth are the most expensive, so they run only with the default method
    if integers.contains(&("scene.gear_contact", SOLID)) {
        integers.retain(|(name, _)| *name != "solver.method");
    }
    let interface = instance.interface;
    for (name, value) in integers {
        if let Some(i) = index_of(name) {
            // SAFETY: a live component
            unsafe { (interface.set_integer)(instance.component, i as u32, value) };
        }
    }
    for (i, row) in table().rows.iter().enumerate().filter(|(_, row)| row.name.starts_with("effects.")) {
        if matches!(row.access, Access::Boolean(_)) && r.chance(4) {
            // SAFETY: a live component
            unsafe { (interface.set_boolean)(instance.component, i as u32, r.bool()) };
        }
    }
    let values =
        [("inertia.left_end", 0.5), ("inertia.right_end", 0.5), ("lock.command", 1.0), ("left.brake_torque", 500.0)];
    for (name, value) in values {
        if let (true, Some(i)) = (r.chance(2), index_of(name)) {
            // SAFETY: a live component
            unsafe { (interface.set_real)(instance.component, i as u32, value) };
        }
    }
}

/// Results of the study's scene after a reset, bit by bit: three steps, or rates and indicators at the start.
pub fn study(instance: &FuzzedInstance) -> Option<Vec<u64>> {
    let (interface, c) = (instance.interface, instance.component);
    let mut numbers = vec![f64::NAN; STATES + EVENT_INDICATORS];
    // the host ends steps early depending on the number of updates
    instance.host.updates.set(0);
    // SAFETY, for all: a live component and room for the counts passed
    unsafe {
        let mut statuses = vec![(interface.reset)(c)];
        let fine = initialised(instance);
        if instance.options.kind == Kind::ModelExchange {
            let (rates, indicators) = numbers.split_at_mut(STATES);
            statuses.push((interface.get_rates)(c, rates.as_mut_ptr(), rates.len()));
            statuses.push((interface.get_indicators)(c, indicators.as_mut_ptr(), indicators.len()));
        } else {
            // a step may end early if the host has allowed it
            statuses.extend([(); 3].map(|()| (interface.step)(c, instance.time().unwrap_or(f64::NAN), 1e-3)));
            let outputs: Vec<u32> = table().real_outputs().collect();
            numbers.resize(outputs.len(), f64::NAN);
            statuses.push((interface.get_reals)(c, outputs.as_ptr(), outputs.len(), numbers.as_mut_ptr()));
        }
        instance.take_log();
        let fine = fine && statuses.iter().all(|&status| status == Status::Ok);
        fine.then(|| numbers.into_iter().map(f64::to_bits).collect())
    }
}
