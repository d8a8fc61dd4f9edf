//! Tests of `Differential`, the interface for programs in Rust.

use bevel_differential::*;

fn refused(outcome: Result<(), DifferentialError>) -> String {
    outcome.expect_err("it is refused").to_string()
}

#[test]
fn invalid_values_are_refused_with_name_value_and_range() {
    let mut it = Differential::new();
    for (outcome, words) in [
        (it.set("geometry.modul", 1.0), vec!["geometry.modul"]),
        (it.set("geometry.module", 4.5), vec!["geometry.module", "4.5 m", "did you mean 4.5 mm"]),
        (it.set("geometry.planet_teeth", 10.5), vec!["geometry.planet_teeth", "10.5", "whole"]),
        (it.set("effects.strength", 2.0), vec!["effects.strength", "true"]),
        (it.set("contact.law", 99.0), vec!["contact.law", "line_weber"]),
        (it.set_text("contact.law", "lines"), vec!["\"lines\"", "impact (1)", "line (2)"]),
        (it.set_text("geometry.module", "big"), vec!["geometry.module", "\"big\""]),
        (it.set("left.speed", 1.0), vec!["left.speed", "output"]),
        (it.set("left.load_torque", f64::NAN), vec!["left.load_torque", "finite"]),
        (it.advance(f64::NAN), vec!["NaN s"]),
        (it.advance(-1.0), vec!["-1 s"]),
    ] {
        let said = refused(outcome);
        assert!(words.iter().all(|word| said.contains(word)), "{said}");
    }
    assert_eq!(it.time(), 0.0);
}

#[test]
fn a_refused_start_names_its_problems_and_keeps_all_values() {
    let mut it = Differential::new();
    it.set("geometry.face_width", 0.2).expect("within its range");
    let said = refused(it.advance(0.1));
    assert!(said.contains("geometry.face_width"), "{said}");
    it.set("geometry.face_width", 0.02).expect("it was not started");
    it.advance(0.01).expect("it runs now");
    assert!(refused(it.set("geometry.face_width", 0.03)).contains("fixed parameter"));
}

#[test]
fn inputs_and_tunable_parameters_act_from_the_time_they_are_set() {
    let mut it = Differential::new();
    it.set_text("scene.carrier_drive", "torque").expect("a choice");
    it.advance(0.01).expect("a step");
    let before = it.get("der(carrier.speed)").expect("an output");
    it.set("carrier.torque_command", 5000.0).expect("an input");
    it.set("contact.damping", 2e4).expect("a tunable parameter");
    it.advance(0.01).expect("a step");
    assert_eq!(it.get("carrier.torque_command").expect("an input"), 5000.0);
    assert!(it.get("der(carrier.speed)").expect("an output") > before);
    assert_eq!(it.time(), 0.02);
}

#[test]
fn a_clone_continues_independently_with_the_same_results() {
    let mut it = Differential::new();
    it.advance(0.01).expect("a step");
    let mut other = it.clone();
    it.advance(0.02).expect("a step");
    other.advance(0.02).expect("a step");
    assert_eq!(it.get("left.speed"), other.get("left.speed"));
}

#[test]
fn a_pin_deflects_by_its_force_over_its_stiffness() {
    let (stiffness, load, teeth) = (2e8, 700.0, [11.0, 18.0]);
    let (module, face) = (4.5e-3, 14e-3);
    let mut it = Differential::new();
    for (name, value) in [
        ("geometry.planet_teeth", teeth[0]),
        ("geometry.side_teeth", teeth[1]),
        ("geometry.planet_count", 3.0),
        ("geometry.module", module),
        ("geometry.face_width", face),
        ("effects.pin_compliance", 1.0),
        ("pin_compliance.pin_stiffness", stiffness),
        ("left.load_torque", load),
        ("right.load_torque", load),
    ] {
        it.set(name, value).expect(name);
    }
    it.set_text("scene.start", "equilibrium").expect("a start");
    it.advance(1e-3).expect("a step");
    // each of three pins carries a third of both loads, at the middle of the face on the planet's axis
    let mean = 0.5 * module * f64::hypot(teeth[0], teeth[1]) - 0.5 * face;
    let arm = mean * teeth[1] / f64::hypot(teeth[0], teeth[1]);
    let expected = 2.0 * load / 3.0 / (arm * arm * stiffness);
    let found = it.get("planet[1].pin_angle").expect("an angle");
    assert!((found.abs() / expected - 1.0).abs() < 1e-6, "{found:e} {expected:e}");
}

#[test]
fn under_input_ramps_a_speed_is_reached_at_the_end_of_the_next_step() {
    let mut turn = Differential::new();
    turn.set_text("scene.gear_contact", "ideal").unwrap();
    turn.set_text("solver.input_ramp", "true").unwrap();
    turn.set("carrier.speed_command", 50.0).unwrap();
    turn.advance(1e-3).unwrap();
    let angle = turn.get("carrier.angle").unwrap();
    turn.set("carrier.speed_command", 51.0).unwrap();
    assert_eq!(turn.get("carrier.speed"), Ok(50.0), "nothing moves before the step");
    turn.advance(1e-3).unwrap();
    assert!((turn.get("carrier.speed").unwrap() - 51.0).abs() < 1e-12);
    let turned = turn.get("carrier.angle").unwrap() - angle;
    assert!((turned - 50.5e-3).abs() < 1e-12, "{turned} rad");
}
