//! Scenes that contradict themselves, refused by name.

use super::effects::left_out;
use super::parameters::{CarrierDrive, GearContact, Parameters, PlanetSpin, SideDrive};
use super::solid;
use crate::contact::{ContactLaw, DampingModel};
use crate::geometry::Pair;
use crate::problem::Problem;

/// All that does not go together in `p`.
pub fn problems(p: &Parameters, pair: &Pair) -> Vec<Problem> {
    let mut found = Vec::new();
    let mut refuse = |name: &'static str, message: String| found.push(Problem::new(name, message));
    let scene = &p.scene;
    for (name, on) in p.effects.list() {
        if on && left_out(name) {
            refuse(name, "this build leaves the effect out; switch it off or use a full build".into());
        }
    }
    let imposed: Vec<&str> = [
        (scene.carrier_drive == CarrierDrive::Speed, "scene.carrier_drive"),
        (scene.left_drive == SideDrive::Speed, "scene.left_drive"),
        (scene.right_drive == SideDrive::Speed, "scene.right_drive"),
        (scene.planet_spin == PlanetSpin::Imposed, "scene.planet_spin"),
    ]
    .into_iter()
    .filter_map(|(on, name)| on.then_some(name))
    .collect();
    if imposed.len() > 2 {
        let name = if scene.planet_spin == PlanetSpin::Imposed { "scene.planet_spin" } else { "scene.carrier_drive" };
        refuse(
            name,
            format!(
                "speeds are imposed by {}: a differential has two independent speeds, so that at most two can be; \
                 drive the others by torque or leave the spin free",
                imposed.join(", ")
            ),
        );
    }
    let speed_driven = scene.left_drive == SideDrive::Speed || scene.right_drive == SideDrive::Speed;
    if speed_driven && left_out("effects.half_shaft") {
        let name = if scene.left_drive == SideDrive::Speed { "scene.left_drive" } else { "scene.right_drive" };
        refuse(name, "a speed-driven side needs its half-shaft, which this build leaves out".into());
    }
    let shaft = &p.specs.half_shaft;
    for (s, (drive, end)) in
        [(scene.left_drive, p.inertia.left_end), (scene.right_drive, p.inertia.right_end)].into_iter().enumerate()
    {
        let twists = drive == SideDrive::Speed || p.effects.half_shaft && end > 0.0;
        if twists && shaft.stiffness[s] <= 0.0 {
            let name = ["half_shaft.left_stiffness", "half_shaft.right_stiffness"][s];
            refuse(name, format!("{} N.m/rad: a half-shaft that twists needs a stiffness above 0", shaft.stiffness[s]));
        }
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
    let mut needs = |on: bool, name: &'static str, what: &str| {
        if on {
            found.push(Problem::new(name, what));
        }
    };
    let e = &p.effects;
    if scene.gear_contact == GearContact::Solid {
        solid::problems(p, &mut needs);
    } else if scene.gear_contact != GearContact::Tooth {
        let what = "acts on single tooth pairs: it needs scene.gear_contact = tooth";
        needs(e.tooth_errors, "effects.tooth_errors", what);
        needs(e.tooth_fault, "effects.tooth_fault", what);
        needs(e.tooth_friction, "effects.tooth_friction", what);
    }
    if scene.gear_contact == GearContact::Ideal {
        let what = "follows from the forces of the meshes: it needs scene.gear_contact = lumped or tooth";
        needs(e.thrust_friction, "effects.thrust_friction", what);
        needs(e.pin_compliance, "effects.pin_compliance", what);
        needs(e.strength, "effects.strength", what);
        needs(
            e.limited_slip && p.specs.limited_slip.torque_coefficient != 0.0,
            "limited_slip.torque_coefficient",
            "a torque-proportional clutch follows from the forces of the meshes: with scene.gear_contact = ideal it must be \
             0 (preload alone), or choose lumped or tooth",
        );
    }
    if e.tooth_friction {
        found.extend(p.tooth_friction.problem());
    }
    if e.tooth_errors {
        found.extend(p.tooth_errors.check().err());
    }
    if e.tooth_fault {
        let teeth = pair.gears.map(|g| g.teeth);
        let planets = usize::try_from(p.geometry.planet_count).unwrap_or(0);
        found.extend(p.tooth_fault.check(teeth, planets).err());
        if contact.law == ContactLaw::Impact && p.tooth_fault.missing_fraction <= 0.5 {
            found.push(Problem::new(
                "tooth_fault.missing_fraction",
                format!(
                    "{}: contact.law = impact acts at the middle of the face alone and sees only a piece of more than \
                     0.5 of it; choose line or line_weber, or a larger piece",
                    p.tooth_fault.missing_fraction
                ),
            ));
        }
    }
    found
}
