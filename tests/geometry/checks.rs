//! Gears that cannot be built give errors, unusual ones warnings, and usual ones no message.

use bevel_differential::geometry::{AddendumSystem, GearSpec, Pair, checks};

/// Default gears with an unquestionable face width.
fn usual() -> GearSpec {
    GearSpec { face_width: 14e-3, ..GearSpec::default() }
}

fn explicit(planet: [f64; 2], side: [f64; 2]) -> GearSpec {
    GearSpec {
        addendum_system: AddendumSystem::Explicit,
        planet_addendum: planet[0],
        planet_dedendum: planet[1],
        side_addendum: side[0],
        side_dedendum: side[1],
        ..usual()
    }
}

fn found(spec: &GearSpec) -> (Vec<String>, Vec<String>) {
    let pair = Pair::new(spec);
    let texts = |problems: Vec<_>| problems.iter().map(ToString::to_string).collect();
    (texts(checks::errors(spec, &pair)), texts(checks::warnings(spec, &pair)))
}

fn assert_warns(spec: &GearSpec, words: &[&str]) {
    let (errors, warnings) = found(spec);
    assert!(errors.is_empty(), "{errors:?}");
    let all = warnings.join("\n");
    assert!(words.iter().all(|word| all.contains(word)), "{words:?} in {warnings:?}");
}

fn assert_refused(spec: &GearSpec, words: &[&str]) {
    let all = found(spec).0.join("\n");
    assert!(words.iter().all(|word| all.contains(word)), "{words:?} in {all}");
}

#[test]
fn usual_gears_give_no_message() {
    assert_eq!(found(&usual()), (Vec::new(), Vec::new()));
}

#[test]
fn standard_addenda_undercut_a_ten_tooth_planet() {
    // at 20°, the side gear's addendum must not exceed 0.787 modules
    let spec = GearSpec { addendum_system: AddendumSystem::Standard, ..usual() };
    assert_warns(&spec, &["undercut of the planet", "1.000 modules", "limit of 0.787 modules"]);
    // conversely, a tall planet tip jams in a small side gear
    assert_warns(&GearSpec { planet_teeth: 16, side_teeth: 10, ..spec }, &["tip interference in the side gear"]);
}

#[test]
fn a_wide_face_a_pointed_tooth_and_a_thin_rim_give_warnings() {
    assert_warns(&GearSpec { face_width: 22e-3, ..usual() }, &["geometry.face_width", "0.518 R_e", "R_e/2 = 21.23"]);
    assert_warns(&explicit([1.75, 0.5], [0.25, 2.0]), &["pointed planet teeth"]);
    assert_warns(&GearSpec { planet_bore: 22e-3, ..usual() }, &["geometry.planet_bore", "half the tooth depth"]);
}

#[test]
fn proportions_usual_for_forged_gears_give_a_remark_and_not_a_warning() {
    // the outer cone distance is 42.45 mm, and faces of 0.35 to 0.5 R_e are usual for forged gears
    for (width, is_remarked) in [(14e-3, false), (15e-3, true), (20e-3, true), (21.2e-3, true), (21.3e-3, false)] {
        let spec = GearSpec { face_width: width, ..usual() };
        let remarks: Vec<String> = checks::remarks(&spec, &Pair::new(&spec)).iter().map(ToString::to_string).collect();
        assert_eq!(
            remarks.iter().any(|text| text.starts_with("geometry.face_width")),
            is_remarked,
            "{width} {remarks:?}"
        );
        assert_eq!(found(&spec).1.is_empty(), width < 21.23e-3, "{width}");
    }
    // a pin of 16 mm leaves a rim of 4.4 mm under teeth that are 6.6 mm deep
    let spec = GearSpec { planet_bore: 16e-3, ..usual() };
    let remarks = checks::remarks(&spec, &Pair::new(&spec));
    assert!(remarks.len() == 1 && remarks[0].to_string().contains("the planet's rim"), "{remarks:?}");
    assert_eq!(found(&spec).1, Vec::<String>::new());
}

#[test]
fn a_face_that_is_barely_too_wide_is_distinguished_from_the_limit() {
    let limit = Pair::new(&usual()).outer_cone / 2.0;
    for excess in [1e-2, 1e-4, 1e-7, 1e-12] {
        let warnings = found(&GearSpec { face_width: limit * (1.0 + excess), ..usual() }).1;
        let text = warnings.iter().find(|text| text.starts_with("geometry.face_width")).expect("a warning");
        let mut numbers = text.split([' ', ')']).filter_map(|word| word.parse::<f64>().ok());
        // the width, its share of R_e, the limit
        let (width, limit) = (numbers.next().expect("a width"), numbers.nth(1).expect("a limit"));
        assert!(width > limit, "{text}");
    }
}

#[test]
fn a_contact_ratio_below_one_gives_a_warning() {
    assert_warns(&explicit([0.6, 0.8], [0.3, 0.9]), &["contact ratio 0."]);
}

#[test]
fn planets_that_strike_their_neighbours_give_a_warning() {
    let four = |planet_teeth, side_teeth| GearSpec { planet_teeth, side_teeth, planet_count: 4, ..usual() };
    let mitre = four(14, 14);
    let tip = Pair::new(&mitre).gears[0].tip.to_degrees();
    let overlap = format!("overlap by {:.3} deg", 2.0 * tip - 90.0);
    assert!((2.0 * tip - 90.0 - 11.5).abs() < 0.05, "{tip}");
    assert_warns(&mitre, &["geometry.planet_count: 4 planets strike", &overlap, "at most 45.000 deg", "(2 have room)"]);
    let quiet = |spec| !found(&spec).1.join("\n").contains("strike");
    assert!(quiet(four(10, 16)) && quiet(GearSpec { planet_count: 2, ..mitre }));
}

#[test]
fn a_fillet_that_does_not_fit_gives_a_warning() {
    let spec = GearSpec { root_fillet: 1.0, ..usual() };
    let words = [
        "geometry.root_fillet: the planet's root fillet is cut to",
        "not 4.500 mm = 1.000 modules",
        "the whole tooth space is rounded",
    ];
    assert_warns(&spec, &words);
    let steep = GearSpec { pressure_angle: 30f64.to_radians(), ..explicit([1.0, 2.0], [1.0, 2.0]) };
    let deep = GearSpec { planet_teeth: 40, side_teeth: 60, ..steep };
    assert_warns(&deep, &["cut to 0.000 mm", "flanks meet above the root cone"]);
}

#[test]
fn gears_that_cannot_be_built_give_errors() {
    assert_refused(&GearSpec { face_width: 41e-3, ..usual() }, &["geometry.face_width", "no teeth at the toe"]);
    assert_refused(&GearSpec { backlash: 20e-3, ..usual() }, &["geometry.backlash", "whole tooth"]);
    assert_refused(&GearSpec { backlash: 9e-3, ..usual() }, &["geometry.backlash", "flanks meet below its tip"]);
    assert_refused(&GearSpec { planet_bore: 33e-3, ..usual() }, &["geometry.planet_bore", "root circle at the toe"]);
    assert_refused(&explicit([2.5, 0.8], [0.5, 2.8]), &["geometry.planet_addendum", "flanks meet below its tip"]);
    assert_refused(&explicit([1.3, 0.8], [0.7, 1.0]), &["the planet's tip would strike the side gear's root"]);
    assert_refused(&explicit([0.7, 0.8], [0.9, 1.0]), &["the side gear's tip would strike the planet's root"]);
    let lopsided = GearSpec { pressure_angle: 30f64.to_radians(), ..explicit([3.0, 0.1], [0.05, 3.1]) };
    assert_refused(&lopsided, &["geometry.side_addendum", "no tooth at the pitch circle"]);
    let thin = GearSpec { thickness_shift: -0.5, ..usual() };
    assert_refused(&thin, &["geometry.thickness_shift", "flanks meet below its tip"]);
}

#[test]
fn a_rim_is_measured_along_the_toe_s_front_cone() {
    let spec = GearSpec { planet_bore: 22e-3, ..usual() };
    let pair = Pair::new(&spec);
    // from the root cone at the toe straight to the bore, perpendicular to the line of the root cone
    let (sine, cosine) = (pair.gears[0].root.sin(), pair.gears[0].root.cos());
    let (mut near, mut far) = (0.0, 0.1);
    for _ in 0..100 {
        let middle = 0.5 * (near + far);
        let radius = pair.inner_cone * sine - middle * cosine;
        if radius > spec.planet_bore / 2.0 { near = middle } else { far = middle }
    }
    assert_warns(&spec, &[&format!("the planet's rim at the toe is {:.2} mm", 1e3 * near)]);
}
