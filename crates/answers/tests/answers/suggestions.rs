//! Suggestions for wrong names, with guesses that a drivetrain engineer might make.

use answers::scene::set::{output, variable};
use answers::text::near::near;
use bevel_differential::variables::table;

/// Guesses with their suggestions.
const GUESSES: [(&str, &[&str]); 52] = [
    // the group is wrong or missing, or another word is used
    ("planet.count", &["geometry.planet_count"]),
    ("gear.module", &["geometry.module"]),
    ("module", &["geometry.module"]),
    ("planet.teeth", &["geometry.planet_teeth"]),
    ("side.teeth", &["geometry.side_teeth"]),
    ("pressure_angle", &["geometry.pressure_angle"]),
    ("teeth.backlash", &["geometry.backlash", "effects.backlash"]),
    ("planet.bore", &["geometry.planet_bore"]),
    ("material.young", &["material.young_modulus"]),
    ("oil.viscosity", &["oil.viscosity_40", "oil.viscosity_100"]),
    ("clutch.preload", &["limited_slip.preload"]),
    ("contact_ratio", &["geometry.contact_ratio"]),
    ("wheel.speed", &["left.wheel_speed", "right.wheel_speed"]),
    ("wheel.angle", &["left.wheel_angle", "right.wheel_angle"]),
    ("torque.bias", &["torque_bias_ratio"]),
    ("bias.ratio", &["torque_bias_ratio"]),
    ("scene.contact", &["scene.gear_contact"]),
    ("ring.teeth", &["final_drive.ring_teeth"]),
    ("loss.power", &["power.loss"]),
    ("lock.torqe", &["lock.torque"]),
    // wrong letters
    ("carier.speed", &["carrier.speed"]),
    ("carrier.spede", &["carrier.speed"]),
    ("geometry.modul", &["geometry.module"]),
    ("geometry.planet_tooth", &["geometry.planet_teeth"]),
    ("left.load_torqe", &["left.load_torque"]),
    ("left.sped", &["left.speed"]),
    ("carrier.tork", &["carrier.torque"]),
    ("geometry.backslash", &["geometry.backlash"]),
    ("efficency", &["efficiency"]),
    // plural, other spelling, order or punctuation
    ("geometry.modules", &["geometry.module"]),
    ("geometry.planets_count", &["geometry.planet_count"]),
    ("effects.half_shafts", &["effects.half_shaft"]),
    ("tooth_friction.regularization_speed", &["tooth_friction.regularisation_speed"]),
    ("geometry.count_planet", &["geometry.planet_count"]),
    ("geometry.teeth_planet", &["geometry.planet_teeth"]),
    ("torque.left.load", &["left.load_torque"]),
    ("speed.carrier", &["carrier.speed"]),
    ("geometry.planetcount", &["geometry.planet_count"]),
    ("Geometry.Module", &["geometry.module"]),
    ("geometry-face-width", &["geometry.face_width"]),
    ("bearing_drag.oillevel", &["bearing_drag.oil_level"]),
    // too many names are equally similar, or no name is
    ("torque", &[]),
    ("planet.torque_capacity_of_gearbox", &[]),
    ("speed", &[]),
    ("ratio", &[]),
    ("static_ratio", &[]),
    ("clutch.torque", &["clutches.torque"]),
    ("wheel_torque", &[]),
    ("axle.torque", &[]),
    ("engine.displacement", &[]),
    ("xyz", &[]),
    ("", &[]),
];

#[test]
fn a_wrong_name_suggests_the_intended_one() {
    let names: Vec<&str> = table().rows.iter().map(|row| row.name).collect();
    let mut wrong = Vec::new();
    for (guess, expected) in GUESSES {
        let (found, mut expected) = (near(guess, names.iter().copied()), expected.to_vec());
        let mut sorted = found.clone();
        sorted.sort_unstable();
        expected.sort_unstable();
        if sorted != expected {
            wrong.push(format!("{guess}: {found:?} instead of {expected:?}"));
        }
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

#[test]
fn every_variable_is_found_if_its_last_letter_is_missing_or_swapped() {
    let names: Vec<&str> = table().rows.iter().map(|row| row.name).collect();
    for name in &names {
        let place = name.rfind(|letter: char| letter.is_ascii_alphabetic()).expect("a letter");
        let (before, after) = (&name[..place - 1], &name[place + 1..]);
        let [first, last] = [place - 1, place].map(|at| &name[at..=at]);
        for slip in [format!("{before}{first}{after}"), format!("{before}{last}{first}{after}")] {
            let found = near(&slip, names.iter().copied());
            assert!(names.contains(&slip.as_str()) || found.contains(name), "{slip}: {found:?}");
        }
    }
}

#[test]
fn without_similar_names_the_command_that_finds_the_name_is_shown() {
    for (guess, command) in [
        ("axle.torque", "`bevel-differential variables torque` lists those that may be meant"),
        ("ratio", "`bevel-differential variables ratio` lists those that may be meant"),
        ("xyz", "`bevel-differential variables` lists all variables"),
    ] {
        let problem = variable(guess).err().expect("no variable");
        assert_eq!(problem, format!("there is no variable \"{guess}\"; {command}"));
    }
    let problem = output("left.load").err().expect("no output");
    assert!(problem.contains("no output \"left.load\"; did you mean left.load_torque?"), "{problem}");
    assert!(output("geometry.contact_ratio").is_ok() && output("left.speed").is_ok());
    assert!(output("left.load_torque").is_ok(), "inputs can be recorded");
    let problem = output("geometry.module").err();
    assert_eq!(problem.as_deref(), Some("geometry.module is a parameter; outputs and inputs can be recorded"));
}
