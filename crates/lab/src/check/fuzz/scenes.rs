//! Instances brought to where steps happen: scenes and effects at random.

use bevel_differential::fmi2::*;
use bevel_differential::variables::{Access, index_of, table};

use super::instance::FuzzedInstance;
use super::random::Random;

/// Scenes that are tried before the study's own is taken.
const TRIES: usize = 4;
/// Integers and choices that make a scene.
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
/// Level of solid teeth, which cost most.
const SOLID: i32 = 4;

/// Brings a fresh or reset instance to a running simulation; whether that succeeded.
pub fn start(instance: &FuzzedInstance, r: &mut Random) -> bool {
    for attempt in 0..=TRIES {
        // SAFETY: a live component
        unsafe { fmi2Reset(instance.component) };
        if attempt < TRIES {
            draw(instance, r);
        }
        if initialised(instance) {
            if instance.kind == MODEL_EXCHANGE {
                // SAFETY: a live component and a place for the answer
                unsafe {
                    fmi2NewDiscreteStates(instance.component, &mut EventInfo::default());
                    fmi2EnterContinuousTimeMode(instance.component);
                }
            }
            return true;
        }
    }
    false
}

/// Sets an instance up and initialises it; whether all calls succeed.
fn initialised(instance: &FuzzedInstance) -> bool {
    // SAFETY: a live component
    let statuses = unsafe {
        [
            fmi2SetupExperiment(instance.component, 0, 0.0, 0.0, 0, 0.0),
            fmi2EnterInitializationMode(instance.component),
            fmi2ExitInitializationMode(instance.component),
        ]
    };
    statuses == [Status::Ok; 3]
}

fn draw(instance: &FuzzedInstance, r: &mut Random) {
    let mut integers: Vec<(&str, i32)> = vec![("geometry.planet_count", 2 + r.below(3) as i32), ("solid.facets", 4)];
    for name in CHOICES {
        let Some(Access::Enumeration(kind, ..)) = index_of(name).map(|i| table().rows[i].access) else { continue };
        if r.chance(2) {
            let value = r.pick(kind.choices).value;
            let dear = name == "scene.gear_contact" && value == SOLID && !r.chance(8);
            integers.push((name, if dear { 1 } else { value }));
        }
    }
    // solid teeth cost most: they run with the default method only
    if integers.contains(&("scene.gear_contact", SOLID)) {
        integers.retain(|(name, _)| *name != "solver.method");
    }
    for (name, value) in integers {
        if let Some(i) = index_of(name) {
            // SAFETY: a live component and one value
            unsafe { fmi2SetInteger(instance.component, &(i as u32), 1, &value) };
        }
    }
    for (i, row) in table().rows.iter().enumerate().filter(|(_, row)| row.name.starts_with("effects.")) {
        if matches!(row.access, Access::Boolean(_)) && r.chance(4) {
            // SAFETY: a live component and one value
            unsafe { fmi2SetBoolean(instance.component, &(i as u32), 1, &(r.below(2) as i32)) };
        }
    }
    let values =
        [("inertia.left_end", 0.5), ("inertia.right_end", 0.5), ("lock.command", 1.0), ("left.brake_torque", 500.0)];
    for (name, value) in values {
        if let (true, Some(i)) = (r.chance(2), index_of(name)) {
            // SAFETY: a live component and one value
            unsafe { fmi2SetReal(instance.component, &(i as u32), 1, &value) };
        }
    }
}

/// What the study's own scene gives after a reset, bit by bit: three steps, or rates and indicators at the start.
pub fn study(instance: &FuzzedInstance) -> Option<Vec<u64>> {
    // SAFETY, for all: a live component and room for the counts passed
    unsafe {
        let mut statuses = vec![fmi2Reset(instance.component)];
        let fine = initialised(instance);
        let mut numbers = vec![f64::NAN; bevel_differential::model::STATES + EVENT_INDICATORS];
        if instance.kind == MODEL_EXCHANGE {
            let (rates, indicators) = numbers.split_at_mut(bevel_differential::model::STATES);
            statuses.push(fmi2GetDerivatives(instance.component, rates.as_mut_ptr(), rates.len()));
            statuses.push(fmi2GetEventIndicators(instance.component, indicators.as_mut_ptr(), indicators.len()));
        } else {
            statuses.extend([0.0, 1e-3, 2e-3].map(|t| fmi2DoStep(instance.component, t, 1e-3, 1)));
            let outputs: Vec<u32> = table().outputs.iter().map(|&i| i as u32).collect();
            numbers.resize(outputs.len(), f64::NAN);
            statuses.push(fmi2GetReal(instance.component, outputs.as_ptr(), outputs.len(), numbers.as_mut_ptr()));
        }
        instance.take_log();
        let fine = fine && statuses.iter().all(|&status| status == Status::Ok);
        fine.then(|| numbers.into_iter().map(f64::to_bits).collect())
    }
}
