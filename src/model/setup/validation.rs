//! Rejection of scenes that contradict themselves.

use super::Parameters;
use crate::FULL;
use crate::contact::{ContactLaw, DampingModel};
use crate::geometry::Pair;
use crate::model::effect_kinds::BUILT;
use crate::model::scene::{CarrierDrive, GearContact, Method, PlanetSpin, Scene, SideDrive};
use crate::model::thermal::of_scene::constant_temperatures;
use crate::problem::Problem;

/// All contradictions in `p`.
pub fn problems(p: &Parameters, pair: &Pair) -> Vec<Problem> {
    let scene = &p.scene;
    let mut found: Vec<Problem> = too_many_imposed(scene).into_iter().collect();
    let mut refuse = |name: &'static str, message: String| found.push(Problem::new(name, message));
    let speed_driven = [scene.left_drive, scene.right_drive].map(|drive| drive == SideDrive::Speed);
    if !BUILT && (speed_driven[0] || speed_driven[1]) {
        let name = if speed_driven[0] { "scene.left_drive" } else { "scene.right_drive" };
        refuse(name, "a speed-driven side needs its half-shaft, and this build has no effects".into());
    }
    if !FULL && scene.gear_contact == GearContact::Solid {
        refuse("scene.gear_contact", "this real-time build has no solid teeth: choose ideal, lumped or tooth".into());
    }
    if !FULL && !matches!(p.solver.method, Method::Adaptive | Method::FixedStep) {
        refuse("solver.method", "this real-time build has only the methods fixed_step and adaptive".into());
    }
    let contact = &p.contact;
    if contact.stiffness_from_hertz && contact.exponent != crate::contact::hertz::EXPONENT {
        refuse(
            "contact.exponent",
            format!(
                "{} does not go with contact.stiffness_from_hertz, whose law has the exponent {}",
                contact.exponent,
                crate::contact::hertz::EXPONENT
            ),
        );
    }
    if contact.damping_model == DampingModel::Restitution
        && let Err(problem) = crate::contact::damping::dimensionless_damping(contact.restitution)
    {
        found.push(problem);
    }
    found.extend(constant_temperatures(p));
    if scene.gear_contact == GearContact::Solid {
        if contact.law != ContactLaw::Impact {
            found.push(Problem::new(
                "contact.law",
                "solid teeth are pressed together by Adams' IMPACT as in the study: with scene.gear_contact = solid \
                 choose impact",
            ));
        }
        if !p.effects.teeth.corner_contact {
            found.push(Problem::new(
                "effects.corner_contact",
                "solid teeth have corners: with scene.gear_contact = solid corner contact cannot be switched off",
            ));
        }
    }
    let effects = p.scene_effects(pair);
    found.extend(p.oil.problem().filter(|_| effects.oil_acts()));
    found.extend(effects.problems());
    found
}

/// Problem of a scene that imposes more than two speeds.
fn too_many_imposed(scene: &Scene) -> Option<Problem> {
    let imposed: Vec<&str> = [
        (scene.carrier_drive == CarrierDrive::Speed, "scene.carrier_drive"),
        (scene.left_drive == SideDrive::Speed, "scene.left_drive"),
        (scene.right_drive == SideDrive::Speed, "scene.right_drive"),
        (scene.planet_spin == PlanetSpin::Imposed, "scene.planet_spin"),
    ]
    .into_iter()
    .filter_map(|(on, name)| on.then_some(name))
    .collect();
    if imposed.len() <= 2 {
        return None;
    }
    let name = if scene.planet_spin == PlanetSpin::Imposed { "scene.planet_spin" } else { "scene.carrier_drive" };
    Some(problem!(
        name,
        "speeds are imposed by {}: a differential has two independent speeds, so at most two can be imposed; drive the \
         others by torque or leave the spin free",
        imposed.join(", ")
    ))
}
